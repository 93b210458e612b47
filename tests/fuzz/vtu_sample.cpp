#include "tests/fuzz/vtu_sample.h"

#include <zlib.h>

#include <cstring>

namespace kinemesh {
namespace {

template <class Number>
void append(std::string& bytes, Number value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

struct Array {
  std::string attributes;
  std::string text;   // ascii
  std::string bytes;  // all other encodings
};

template <class Number>
Array array_of(const std::string& attributes, const std::vector<Number>& values) {
  Array array{attributes, {}, {}};
  for (const Number value : values) {
    array.text += std::to_string(value) + ' ';
    append(array.bytes, value);
  }
  return array;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : digits[bits >> (18 - 6 * k) & 63];
  }
  return text;
}

// With as little memory as there may be: most of the time would go there.
std::string deflated(std::string_view bytes) {
  z_stream stream{};
  ::deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, 9, 1, Z_DEFAULT_STRATEGY);
  std::string out(::deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  ::deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  ::deflateEnd(&stream);
  return out;
}

std::string zlib_block(const std::string& bytes) {
  constexpr std::size_t size = 64;
  std::string header, data;
  const std::size_t n = (bytes.size() + size - 1) / size;
  append(header, std::uint64_t{n});
  append(header, std::uint64_t{size});
  append(header, std::uint64_t{bytes.size() % size});
  for (std::size_t i = 0; i < n; ++i) {
    const std::string block = deflated(std::string_view(bytes).substr(i * size, size));
    append(header, std::uint64_t{block.size()});
    data += block;
  }
  return header + data;
}

std::string plain_block(const std::string& bytes) {
  std::string block;
  append(block, std::uint64_t{bytes.size()});
  return block + bytes;
}

class VtuMutant {
 public:
  VtuMutant(VtuEncoding encoding, Dice& dice) : encoding_(encoding), dice_(dice) {}

  std::string make(const MeshData& mesh) {
    const auto [n, m] = std::pair(mesh.points.size(), mesh.triangles.size());
    std::vector<double> x;
    for (const Point& p : mesh.points) x.insert(x.end(), {p.x, p.y, 0.0});
    std::vector<std::int32_t> corners, ends, marker;
    for (const Triangle& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
    for (std::size_t i = 0; i < m; ++i) ends.push_back(static_cast<std::int32_t>(3 * i + 3));
    for (const Edge& e : mesh.markers[0].edges) marker.insert(marker.end(), e.begin(), e.end());
    text_ += "<UnstructuredGrid>\n<FieldData>\n";
    add(array_of("type=\"Int32\" Name=\"marker:a\" NumberOfTuples=\"" + std::to_string(marker.size()) + "\"",
                 marker));
    add(array_of("type=\"Int32\" Name=\"marker:b\"", marker));
    add(array_of("type=\"Int32\" Name=\"label_name:c\" NumberOfTuples=\"1\"", std::vector<std::int32_t>{7}));
    text_ += "</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(n) + "\" NumberOfCells=\"" +
             std::to_string(m) + "\">\n<Points>\n";
    add(array_of("type=\"Float64\" NumberOfComponents=\"3\"", x));
    text_ += "</Points>\n<Cells>\n";
    add(array_of("type=\"Int32\" Name=\"connectivity\"", corners));
    add(array_of("type=\"Int32\" Name=\"offsets\"", ends));
    add(array_of("type=\"UInt8\" Name=\"types\"", std::vector<std::uint8_t>(m, 5)));
    text_ += "</Cells>\n<CellData>\n";
    add(array_of("type=\"Int32\" Name=\"label\"", std::vector<std::int32_t>(m, 7)));
    text_ += "</CellData>\n</Piece>\n</UnstructuredGrid>\n";
    return finish();
  }

 private:
  bool is_appended() const { return encoding_ == VtuEncoding::Raw || encoding_ == VtuEncoding::Zlib; }

  void add(Array array) {
    if (dice_.one_in(12)) array.text = mutated_text(array.text, dice_);
    if (dice_.one_in(12)) array.bytes = mutated_bytes(array.bytes, dice_);
    text_ += "<DataArray " + array.attributes;
    if (is_appended()) {
      text_ += " format=\"appended\" offset=\"" + std::to_string(appended_.size()) + "\"/>\n";
      appended_ += block_of(array.bytes);
    } else if (encoding_ == VtuEncoding::Base64) {
      text_ += " format=\"binary\">" + base64(block_of(array.bytes)) + "</DataArray>\n";
    } else {
      text_ += " format=\"ascii\">" + array.text + "</DataArray>\n";
    }
  }

  std::string block_of(const std::string& bytes) {
    std::string block = encoding_ == VtuEncoding::Zlib ? zlib_block(bytes) : plain_block(bytes);
    if (dice_.one_in(20))
      block =
          mutated_bytes(block.substr(0, 32), dice_) + block.substr(std::min<std::size_t>(32, block.size()));
    return block;
  }

  std::string finish() {
    std::string head =
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\"";
    if (encoding_ == VtuEncoding::Zlib) head += " compressor=\"vtkZLibDataCompressor\"";
    head += ">\n" + text_;
    if (is_appended()) head += "<AppendedData encoding=\"raw\">\n_";
    if (dice_.one_in(2)) head = mutated_text(head, dice_);
    return is_appended() ? head + appended_ + "\n</AppendedData>\n</VTKFile>\n" : head + "</VTKFile>\n";
  }

  VtuEncoding encoding_;
  Dice& dice_;
  std::string text_, appended_;
};

}  // namespace

std::string mutated_vtu(const MeshData& mesh, VtuEncoding encoding, Dice& dice) {
  return VtuMutant(encoding, dice).make(mesh);
}

}  // namespace kinemesh
