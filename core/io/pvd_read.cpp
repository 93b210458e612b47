#include <algorithm>
#include <pugixml.hpp>

#include "core/io/atomic_file.h"
#include "core/io/pvd.h"
#include "core/io/scanner.h"

namespace kinemesh {
namespace {

class PvdReader {
 public:
  PvdReader(std::string file, const std::string& text) : file_(std::move(file)), text_(text) {}

  std::vector<PvdEntry> read() const {
    pugi::xml_document document;
    if (const auto result =
            document.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
        !result)
      fail(result.offset, std::string("not well-formed XML: ") + result.description());
    const auto collection = document.child("VTKFile").child("Collection");
    if (!collection) throw InputError(file_, 0, "no Collection in a VTKFile, a ParaView series expected");
    std::vector<PvdEntry> entries;
    for (const auto& node : collection.children("DataSet")) add(node, entries);
    if (entries.empty()) fail(collection.offset_debug(), "at least one DataSet expected");
    return entries;
  }

 private:
  void add(const pugi::xml_node& node, std::vector<PvdEntry>& entries) const {
    PvdEntry entry{time_of(node), node.attribute("file").as_string()};
    if (entry.file.empty()) fail(node.offset_debug(), "a DataSet without file");
    if (!entries.empty() && entry.time <= entries.back().time)
      fail(node.offset_debug(), "timestep '" + std::string(node.attribute("timestep").as_string()) +
                                    "', later than that of the DataSet before expected");
    entries.push_back(std::move(entry));
  }

  double time_of(const pugi::xml_node& node) const {
    try {
      return io::to_number(node.attribute("timestep").as_string(), "a timestep");
    } catch (const InputError& error) {
      fail(node.offset_debug(), error.what());
    }
  }

  [[noreturn]] void fail(std::ptrdiff_t offset, const std::string& what) const {
    const auto line =
        1 + std::count(text_.begin(), text_.begin() + std::min(offset, std::ssize(text_)), '\n');
    throw InputError(file_, static_cast<int>(line), what);
  }

  std::string file_;
  const std::string& text_;
};

}  // namespace

std::vector<PvdEntry> read_pvd(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  return PvdReader(path.string(), text).read();
}

}  // namespace kinemesh
