// The arrays of a VTU file, in all the ways VTK encodes them: ascii, base64 inline, appended base64 or raw;
// each of the binary ones plain or in blocks compressed by zlib.
#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace kinemesh::io {

class VtuArrays {
 public:
  // `xml` is what offsets of nodes refer to. Refuses byte orders, header types and compressors that are not
  // read.
  VtuArrays(std::string file, std::string_view xml, const pugi::xml_node& root, std::string_view appended);

  // Values of a DataArray. Floating-point ones are finite. Memory stays in proportion to the file's size.
  std::vector<double> reals(const pugi::xml_node& array) const;
  std::vector<long long> integers(const pugi::xml_node& array) const;
  static bool is_integer(const pugi::xml_node& array);

  int line_of(const pugi::xml_node& node) const;
  [[noreturn]] void fail(const pugi::xml_node& node, const std::string& what) const;

 private:
  template <class Number, class Read>
  std::vector<Number> ascii(const pugi::xml_node& array, const Read& read) const;
  std::string bytes(const pugi::xml_node& array) const;
  std::string appended_bytes(const pugi::xml_node& array) const;
  std::string block(std::string_view encoded, bool is_base64) const;

  std::string file_;
  std::string_view xml_;
  std::string_view appended_;
  bool appended_is_base64_ = false;
  bool is_compressed_ = false;
  std::size_t header_bytes_ = 4;
};

}  // namespace kinemesh::io
