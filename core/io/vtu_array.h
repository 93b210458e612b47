// The arrays of a VTU file, in all the ways VTK encodes them: ascii, base64 inline, appended base64 or raw;
// each of the binary ones plain or in blocks compressed by zlib.
#pragma once

#include <cstdint>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "kinemesh/error.h"

namespace kinemesh::io {

class VtuArrays {
 public:
  // `xml` is what offsets of nodes refer to. Refuses byte orders, header types and compressors that are not
  // read.
  VtuArrays(std::string file, std::string_view xml, const pugi::xml_node& root, std::string_view appended);

  // Values of a DataArray. Floating-point ones are finite. Compressed ones are inflated only if they are no
  // more than `most`. Memory stays in proportion to the file's size, or to `most`: arrays at one offset are
  // decoded once, and refused where what they repeat would be many times the file.
  std::vector<double> reals(const pugi::xml_node& array, std::uint64_t most);
  std::vector<long long> integers(const pugi::xml_node& array, std::uint64_t most);
  static bool is_integer(const pugi::xml_node& array);

  int line_of(const pugi::xml_node& node) const;
  [[noreturn]] void fail(const pugi::xml_node& node, const std::string& what) const;

 private:
  struct Shared {
    int arrays = 0;     // that have this offset
    std::string bytes;  // once decoded, where there are several
    bool is_decoded = false;
  };

  template <class Number, class Read>
  std::vector<Number> ascii(const pugi::xml_node& array, const Read& read) const;
  template <class Converter>
  auto converted(const pugi::xml_node& array, std::uint64_t most, const Converter& converter);
  std::string appended_bytes(const pugi::xml_node& array, std::uint64_t most);
  std::string decode_appended(std::size_t offset, std::uint64_t most);
  std::string block(std::string_view encoded, bool is_base64, std::uint64_t most, std::size_t& taken) const;
  void count_offsets(const pugi::xml_node& grid);
  void repeat(std::size_t n_bytes);

  std::string file_;
  std::string_view xml_;
  std::string_view appended_;
  bool appended_is_base64_ = false;
  bool is_compressed_ = false;
  std::size_t header_bytes_ = 4;
  std::vector<std::size_t> line_ends_;            // places of the line ends in xml_
  std::unordered_map<long long, Shared> shared_;  // by offset
  std::size_t appended_taken_ = 0;                // bytes that were decoded
  std::size_t repeated_ = 0;                      // bytes of arrays that share those of one before
};

}  // namespace kinemesh::io
