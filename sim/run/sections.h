// Files of named sections: what checkpoints and failed steps are. Internal to sim/.
//
// A file begins with a table of contents: each section's name, version, length and checksum. A section
// changes without the others, and its version with it. What a program does not know it refuses by name: a
// run that left out what another version had thought worth keeping would go on to other results. Layout in
// docs/formats.md.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/run/binary.h"

namespace kinemesh::binary {

// The first eight bytes of a file, what messages call it, and what to do about an old one.
struct FileKind {
  std::string_view magic, name, remedy;
};

struct SectionKind {
  std::string_view name;
  std::uint32_t version;
};

// As it stands in the table of contents.
struct SectionEntry {
  std::string name;
  std::uint32_t version = 0;
  std::uint64_t length = 0;  // bytes
  std::uint32_t checksum = 0;
};

// Takes sections in the order of the file. Pre: each name once.
class SectionWriter {
 public:
  template <class... T>
  void operator()(const SectionKind& kind, const T&... values) {
    const std::size_t start = contents_.bytes().size();
    contents_(values...);
    close(kind, start);
  }

  // The whole file; takes the contents along.
  std::string file(const FileKind& kind) &&;

 private:
  void close(const SectionKind& kind, std::size_t start);

  Writer contents_;
  std::vector<SectionEntry> entries_;
};

// Gives them in any order. What it says where something is wrong names the section, but not the file.
class SectionReader {
 public:
  // Checks the table and all checksums, and copies nothing: the file stays the caller's. Throws InputError
  // that says in which way it is no such file: of another kind, of an older program, truncated, damaged.
  // Every change of up to 32 bits in a row is noticed, and others but for one in four billion.
  SectionReader(const FileKind& kind, std::string_view file);

  // Reads a section that must be there. Throws InputError where it is not, or not in this version, or holds
  // anything but these values.
  template <class... T>
  void operator()(const SectionKind& kind, T&... values) {
    const std::string_view contents = take(kind);
    try {
      Reader reader(contents);
      reader(values...);
      reader.expect_end();
    } catch (const InputError& error) {
      refuse(kind.name, std::string(": ") + error.what());
    }
  }

  // Throws InputError that names a section nobody has read.
  void expect_end() const;

 private:
  struct Section {
    SectionEntry entry;
    std::string_view contents;
    bool is_read = false;
  };

  std::string_view take(const SectionKind& kind);
  [[noreturn]] static void refuse(std::string_view name, const std::string& why);

  std::vector<Section> sections_;
};

}  // namespace kinemesh::binary
