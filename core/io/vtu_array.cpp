#include "core/io/vtu_array.h"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

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
  std::size_t n_encoded() const { return encoded_.size(); }  // characters not yet read

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
  const std::size_t before = out.size();
  out.resize(before + size);
  uLongf written = size;
  const int status = ::uncompress(reinterpret_cast<Bytef*>(out.data() + before), &written,
                                  reinterpret_cast<const Bytef*>(compressed.data()), compressed.size());
  if (status != Z_OK || written != size) throw InputError("a compressed block is damaged");
}

struct Block {
  std::uint64_t size, compressed_size;
};

// "number of blocks, size, size of the last if smaller, sizes compressed..."
std::vector<Block> take_blocks(ByteStream& stream, std::size_t header_bytes) {
  const std::uint64_t n = stream.take_number(header_bytes);
  if (n > stream.most_left() / header_bytes) throw InputError("the data ends early");
  const std::uint64_t size = stream.take_number(header_bytes);
  const std::uint64_t last_size = stream.take_number(header_bytes);
  std::vector<Block> blocks(n);
  for (Block& block : blocks) block = {size, stream.take_number(header_bytes)};
  if (n > 0 && last_size > 0) blocks.back().size = last_size;
  return blocks;
}

// Of all blocks together. Refuses those that cannot be there, or cannot be as large as they say.
std::uint64_t inflated_size(const std::vector<Block>& blocks, std::uint64_t most_compressed) {
  std::uint64_t size = 0, compressed = 0;
  for (const Block& block : blocks) {
    if (block.compressed_size > most_compressed - compressed) throw InputError("the data ends early");
    if (block.size > largest_expansion * block.compressed_size)
      throw InputError("a compressed block cannot be as large as it says");
    size += block.size;
    compressed += block.compressed_size;
  }
  return size;
}

void check_size(std::uint64_t size, std::uint64_t most) {
  if (size > most)
    throw InputError(std::to_string(size) + " bytes of data, expected no more than " + std::to_string(most));
}

std::string inflate_blocks(ByteStream& stream, std::size_t header_bytes, std::uint64_t most) {
  const std::vector<Block> blocks = take_blocks(stream, header_bytes);
  const std::uint64_t size = inflated_size(blocks, stream.most_left());
  check_size(size, most);
  std::string out;
  out.reserve(size);
  for (const Block& block : blocks) inflate_block(stream.take(block.compressed_size), block.size, out);
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

struct IntegerType {
  std::size_t bytes;
  std::vector<long long> (*convert)(const std::string&);
};

template <class Stored>
constexpr IntegerType integer_type{sizeof(Stored), convert<Stored, long long>};

std::optional<IntegerType> integer_type_of(std::string_view type) {
  if (type == "Int8") return integer_type<std::int8_t>;
  if (type == "UInt8") return integer_type<std::uint8_t>;
  if (type == "Int16") return integer_type<std::int16_t>;
  if (type == "UInt16") return integer_type<std::uint16_t>;
  if (type == "Int32") return integer_type<std::int32_t>;
  if (type == "UInt32") return integer_type<std::uint32_t>;
  if (type == "Int64") return integer_type<std::int64_t>;
  if (type == "UInt64") return integer_type<std::uint64_t>;
  return std::nullopt;
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
  for (std::size_t end = xml_.find('\n'); end != std::string_view::npos; end = xml_.find('\n', end + 1))
    line_ends_.push_back(end);
  count_offsets(root.child("UnstructuredGrid"));
}

void VtuArrays::count_offsets(const pugi::xml_node& grid) {
  const auto count = [&](const pugi::xml_node& parent) {
    for (const pugi::xml_node& section : parent.children())
      for (const pugi::xml_node& array : section.children("DataArray"))
        if (const auto offset = array.attribute("offset")) ++shared_[offset.as_llong(none)].arrays;
  };
  count(grid);
  count(grid.child("Piece"));
}

int VtuArrays::line_of(const pugi::xml_node& node) const {
  const auto offset = node.offset_debug();
  if (offset < 0) return 0;
  const auto at = std::lower_bound(line_ends_.begin(), line_ends_.end(), static_cast<std::size_t>(offset));
  return 1 + static_cast<int>(at - line_ends_.begin());
}

void VtuArrays::fail(const pugi::xml_node& node, const std::string& what) const {
  throw InputError(file_, line_of(node), what);
}

bool VtuArrays::is_integer(const pugi::xml_node& array) {
  return integer_type_of(attribute(array, "type")).has_value();
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

// The converter turns bytes into values; its mistakes are the array's.
template <class Converter>
auto VtuArrays::converted(const pugi::xml_node& array, std::uint64_t most, const Converter& converter) {
  try {
    const auto format = attribute(array, "format");
    std::size_t taken = 0;
    if (format == "binary") return converter(block(array.child_value(), true, most, taken));
    if (format == "appended") return converter(appended_bytes(array, most));
    throw InputError("format " + in_quotes(format) + ", expected ascii, binary or appended");
  } catch (const InputError& error) {
    fail(array, name_of(array) + ": " + error.what());
  }
}

std::vector<double> VtuArrays::reals(const pugi::xml_node& array, std::uint64_t most) {
  const auto type = attribute(array, "type");
  if (type != "Float32" && type != "Float64") {
    fail(array, name_of(array) + " is of type " + in_quotes(type) + ", expected Float32 or Float64");
  }
  if (attribute(array, "format", "ascii") == "ascii") {
    return ascii<double>(array, [](Scanner& scanner) { return scanner.number("coordinate"); });
  }
  const auto values = type == "Float32" ? converted(array, most * sizeof(float), convert<float, double>)
                                        : converted(array, most * sizeof(double), convert<double, double>);
  const auto bad = std::find_if_not(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
  if (bad != values.end())
    fail(array, name_of(array) + ": value " + std::to_string(bad - values.begin()) + " is not finite");
  return values;
}

std::vector<long long> VtuArrays::integers(const pugi::xml_node& array, std::uint64_t most) {
  const auto type = integer_type_of(attribute(array, "type"));
  if (!type) {
    fail(array,
         name_of(array) + " is of type " + in_quotes(attribute(array, "type")) + ", expected whole numbers");
  }
  if (attribute(array, "format", "ascii") == "ascii") {
    return ascii<long long>(array, [](Scanner& scanner) { return scanner.long_integer("whole number"); });
  }
  return converted(array, most * type->bytes, type->convert);
}

std::string VtuArrays::appended_bytes(const pugi::xml_node& array, std::uint64_t most) {
  const long long offset = to_integer(attribute(array, "offset"), "an offset into the appended data");
  if (offset < 0 || static_cast<unsigned long long>(offset) > appended_.size()) {
    throw InputError("offset " + std::to_string(offset) + " lies outside the appended data");
  }
  Shared& shared = shared_[offset];
  if (shared.arrays < 2) return decode_appended(static_cast<std::size_t>(offset), most);
  if (!std::exchange(shared.is_decoded, true))
    shared.bytes = decode_appended(static_cast<std::size_t>(offset), most);
  else
    repeat(shared.bytes.size());
  if (is_compressed_) check_size(shared.bytes.size(), most);
  return shared.bytes;
}

// No byte belongs to two arrays at different offsets: else a short file could hold many long ones.
std::string VtuArrays::decode_appended(std::size_t offset, std::uint64_t most) {
  std::size_t taken = 0;
  std::string bytes = block(appended_.substr(offset), appended_is_base64_, most, taken);
  appended_taken_ += taken;
  if (appended_taken_ > appended_.size()) throw InputError("arrays overlap in the appended data");
  return bytes;
}

void VtuArrays::repeat(std::size_t n_bytes) {
  constexpr std::size_t most = 4;  // times the file
  repeated_ += n_bytes;
  if (repeated_ / most > xml_.size() + appended_.size())
    throw InputError("too many arrays share their data, " + std::to_string(most) +
                     " times the size of the file is the most");
}

std::string VtuArrays::block(std::string_view encoded, bool is_base64, std::uint64_t most,
                             std::size_t& taken) const {
  ByteStream stream(encoded, is_base64);
  std::string bytes = is_compressed_ ? inflate_blocks(stream, header_bytes_, most)
                                     : stream.take(stream.take_number(header_bytes_));
  taken = encoded.size() - stream.n_encoded();
  return bytes;
}

}  // namespace kinemesh::io
