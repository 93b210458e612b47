#include "core/io/vtu_array.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>

#include "core/io/pieces.h"
#include "core/io/scanner.h"

namespace kinemesh::io {
namespace {

static_assert(std::endian::native == std::endian::little,
              "VTU data is read and written as it lies in memory");

// Bytes from raw data or from base64. VTK pads each piece it encodes, others encode all at once: padding ends
// nothing.
class ByteStream {
 public:
  ByteStream(std::string_view encoded, bool is_base64) : encoded_(encoded), is_base64_(is_base64) {}

  std::size_t most_left() const { return encoded_.size() + pending_.size(); }

  std::string take(std::size_t n) {
    if (n > most_left()) throw InputError("the data ends early");
    if (is_base64_) return take_base64(n);
    const std::string taken(encoded_.substr(0, n));
    encoded_.remove_prefix(n);
    return taken;
  }

  std::uint64_t take_number(std::size_t n_bytes) {
    std::uint64_t number = 0;
    std::memcpy(&number, take(n_bytes).data(), n_bytes);
    return number;
  }

 private:
  std::string take_base64(std::size_t n) {
    std::string taken = std::move(pending_);
    taken.reserve(n + 3);
    while (taken.size() < n) decode_group(taken);
    pending_ = taken.substr(n);
    taken.resize(n);
    return taken;
  }

  // Four characters to three bytes, fewer where padded.
  void decode_group(std::string& bytes) {
    std::uint32_t bits = 0;
    int n_digits = 0;
    for (int i = 0; i < 4; ++i) {
      const char c = next_character();
      if (c != '=' && n_digits < i) throw InputError("wrong padding in base64 data");
      bits = bits << 6 | (c == '=' ? 0 : digit(c));
      n_digits += c != '=';
    }
    if (n_digits < 2) throw InputError("wrong padding in base64 data");
    for (int i = 0; i + 1 < n_digits; ++i) bytes += static_cast<char>(bits >> (16 - 8 * i) & 255);
  }

  char next_character() {
    for (;;) {
      if (encoded_.empty()) throw InputError("the data ends early");
      const char c = encoded_.front();
      encoded_.remove_prefix(1);
      if (c != ' ' && c != '\n' && c != '\r' && c != '\t') return c;
    }
  }

  static std::uint32_t digit(char c) {
    if (c >= 'A' && c <= 'Z') return static_cast<std::uint32_t>(c - 'A');
    if (c >= 'a' && c <= 'z') return static_cast<std::uint32_t>(c - 'a' + 26);
    if (c >= '0' && c <= '9') return static_cast<std::uint32_t>(c - '0' + 52);
    if (c == '+') return 62;
    if (c == '/') return 63;
    throw InputError(in_quotes({&c, 1}) + " is not a base64 digit");
  }

  std::string_view encoded_;
  bool is_base64_;
  std::string pending_;  // decoded, not yet taken
};

// Deflate makes at most 1032 bytes of one: a block that claims more is not believed, and nothing allocated
// for it.
constexpr std::uint64_t largest_expansion = 1032;

void inflate_block(const std::string& compressed, std::uint64_t size, std::string& out) {
  if (size > largest_expansion * compressed.size())
    throw InputError("a compressed block cannot be as large as it says");
  const std::size_t before = out.size();
  out.resize(before + size);
  uLongf written = size;
  const int status = ::uncompress(reinterpret_cast<Bytef*>(out.data() + before), &written,
                                  reinterpret_cast<const Bytef*>(compressed.data()), compressed.size());
  if (status != Z_OK || written != size) throw InputError("a compressed block is damaged");
}

// "number of blocks, size, size of the last if smaller, sizes compressed..., blocks"
std::string inflate_blocks(ByteStream& stream, std::size_t header_bytes) {
  const std::uint64_t n = stream.take_number(header_bytes);
  if (n > stream.most_left() / header_bytes) throw InputError("the data ends early");
  const std::uint64_t size = stream.take_number(header_bytes);
  const std::uint64_t last_size = stream.take_number(header_bytes);
  std::vector<std::uint64_t> compressed_sizes;
  for (std::uint64_t i = 0; i < n; ++i) compressed_sizes.push_back(stream.take_number(header_bytes));
  std::string out;
  for (std::uint64_t i = 0; i < n; ++i) {
    inflate_block(stream.take(compressed_sizes[i]), i + 1 == n && last_size > 0 ? last_size : size, out);
  }
  return out;
}

template <class Stored, class Value>
std::vector<Value> convert(const std::string& bytes) {
  if (bytes.size() % sizeof(Stored) != 0) throw InputError("the data is not a whole number of values");
  std::vector<Value> values(bytes.size() / sizeof(Stored));
  for (std::size_t i = 0; i < values.size(); ++i) {
    Stored stored;
    std::memcpy(&stored, bytes.data() + i * sizeof(Stored), sizeof(Stored));
    if constexpr (std::is_same_v<Stored, std::uint64_t>) {
      if (stored > static_cast<std::uint64_t>(std::numeric_limits<long long>::max())) {
        throw InputError("a number is out of range");
      }
    }
    values[i] = static_cast<Value>(stored);
  }
  return values;
}

using IntegerConverter = std::vector<long long> (*)(const std::string&);

IntegerConverter integer_converter(std::string_view type) {
  if (type == "Int8") return convert<std::int8_t, long long>;
  if (type == "UInt8") return convert<std::uint8_t, long long>;
  if (type == "Int16") return convert<std::int16_t, long long>;
  if (type == "UInt16") return convert<std::uint16_t, long long>;
  if (type == "Int32") return convert<std::int32_t, long long>;
  if (type == "UInt32") return convert<std::uint32_t, long long>;
  if (type == "Int64") return convert<std::int64_t, long long>;
  if (type == "UInt64") return convert<std::uint64_t, long long>;
  return nullptr;
}

std::string_view attribute(const pugi::xml_node& node, const char* name, const char* standard = "") {
  return node.attribute(name).as_string(standard);
}

std::string name_of(const pugi::xml_node& array) {
  const std::string_view name = attribute(array, "Name");
  return name.empty() ? std::string("array") : "array " + in_quotes(name);
}

}  // namespace

VtuArrays::VtuArrays(std::string file, std::string_view xml, const pugi::xml_node& root,
                     std::string_view appended)
    : file_(std::move(file)), xml_(xml), appended_(appended) {
  if (const auto order = attribute(root, "byte_order", "LittleEndian"); order != "LittleEndian") {
    fail(root, "byte order " + in_quotes(order) + ", expected LittleEndian");
  }
  const auto header = attribute(root, "header_type", "UInt32");
  if (header != "UInt32" && header != "UInt64") fail(root, "header type " + in_quotes(header));
  header_bytes_ = header == "UInt64" ? 8 : 4;
  const auto compressor = attribute(root, "compressor");
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor") {
    fail(root, "compressed by " + in_quotes(compressor) + ", expected vtkZLibDataCompressor or none");
  }
  is_compressed_ = !compressor.empty();
  const auto encoding = attribute(root.child("AppendedData"), "encoding", "raw");
  if (encoding != "raw" && encoding != "base64")
    fail(root.child("AppendedData"), "encoding " + in_quotes(encoding));
  appended_is_base64_ = encoding == "base64";
}

int VtuArrays::line_of(const pugi::xml_node& node) const {
  const auto offset = node.offset_debug();
  if (offset < 0) return 0;
  const auto end = xml_.begin() + std::min<std::ptrdiff_t>(offset, static_cast<std::ptrdiff_t>(xml_.size()));
  return 1 + static_cast<int>(std::count(xml_.begin(), end, '\n'));
}

void VtuArrays::fail(const pugi::xml_node& node, const std::string& what) const {
  throw InputError(file_, line_of(node), what);
}

bool VtuArrays::is_integer(const pugi::xml_node& array) {
  return integer_converter(attribute(array, "type")) != nullptr;
}

template <class Number, class Read>
std::vector<Number> VtuArrays::ascii(const pugi::xml_node& array, const Read& read) const {
  const std::string_view text = array.child_value();
  if (auto numbers = read_numbers<Number>(Scanner(text, file_), read)) return std::move(*numbers);
  std::vector<Number> numbers;
  Scanner scanner(text, file_, 0, line_of(array.first_child()));
  while (!scanner.at_end()) numbers.push_back(read(scanner));
  return numbers;
}

std::vector<double> VtuArrays::reals(const pugi::xml_node& array) const {
  const auto type = attribute(array, "type");
  if (type != "Float32" && type != "Float64") {
    fail(array, name_of(array) + " is of type " + in_quotes(type) + ", expected Float32 or Float64");
  }
  std::vector<double> values;
  if (attribute(array, "format", "ascii") == "ascii") {
    return ascii<double>(array, [](Scanner& scanner) { return scanner.number("coordinate"); });
  }
  try {
    values = type == "Float32" ? convert<float, double>(bytes(array)) : convert<double, double>(bytes(array));
  } catch (const InputError& error) {
    fail(array, name_of(array) + ": " + error.what());
  }
  const auto bad = std::find_if_not(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
  if (bad != values.end())
    fail(array, name_of(array) + ": value " + std::to_string(bad - values.begin()) + " is not finite");
  return values;
}

std::vector<long long> VtuArrays::integers(const pugi::xml_node& array) const {
  const IntegerConverter converter = integer_converter(attribute(array, "type"));
  if (converter == nullptr) {
    fail(array,
         name_of(array) + " is of type " + in_quotes(attribute(array, "type")) + ", expected whole numbers");
  }
  if (attribute(array, "format", "ascii") == "ascii") {
    return ascii<long long>(array, [](Scanner& scanner) { return scanner.long_integer("whole number"); });
  }
  try {
    return converter(bytes(array));
  } catch (const InputError& error) {
    fail(array, name_of(array) + ": " + error.what());
  }
}

std::string VtuArrays::bytes(const pugi::xml_node& array) const {
  const auto format = attribute(array, "format");
  if (format == "binary") return block(array.child_value(), true);
  if (format == "appended") return appended_bytes(array);
  throw InputError("format " + in_quotes(format) + ", expected ascii, binary or appended");
}

std::string VtuArrays::appended_bytes(const pugi::xml_node& array) const {
  const long long offset = to_integer(attribute(array, "offset"), "an offset into the appended data");
  if (offset < 0 || static_cast<unsigned long long>(offset) > appended_.size()) {
    throw InputError("offset " + std::to_string(offset) + " lies outside the appended data");
  }
  return block(appended_.substr(static_cast<std::size_t>(offset)), appended_is_base64_);
}

std::string VtuArrays::block(std::string_view encoded, bool is_base64) const {
  ByteStream stream(encoded, is_base64);
  if (is_compressed_) return inflate_blocks(stream, header_bytes_);
  const std::uint64_t size = stream.take_number(header_bytes_);
  return stream.take(size);
}

}  // namespace kinemesh::io
