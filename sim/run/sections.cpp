#include "sim/run/sections.h"

#include <zlib.h>

#include <algorithm>
#include <set>

#include "core/base/printable.h"

namespace kinemesh::binary {

template <class Archive, class S>
requires Is<S, SectionEntry>
void members(Archive& archive, S& entry) {
  archive(entry.name, entry.version, entry.length, entry.checksum);
}

namespace {

// Layouts 1 to 5 had no sections.
constexpr std::uint32_t layout = 6;
constexpr std::size_t magic_size = 8;
constexpr std::size_t head_size = magic_size + sizeof layout + sizeof(std::uint64_t);
constexpr std::size_t tail_size = sizeof(std::uint32_t);

std::uint32_t checksum_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(crc32_z(0, nullptr, 0), reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

template <class Number>
Number number_at(std::string_view bytes, std::size_t place) {
  return parsed<Number>(bytes.substr(place, sizeof(Number)));
}

[[noreturn]] void refuse_length(std::string_view file, const std::string& expected) {
  throw InputError("is damaged: " + std::to_string(file.size()) + " bytes long, " + expected + " expected");
}

void check_head(const FileKind& kind, std::string_view file) {
  if (!file.starts_with(kind.magic)) throw InputError("is no " + std::string(kind.name));
  if (file.size() < head_size + tail_size)
    refuse_length(file, "at least " + std::to_string(head_size + tail_size));
  const auto found = number_at<std::uint32_t>(file, magic_size);
  if (found == layout) return;
  const std::string versions =
      "has layout " + std::to_string(found) + ", this program reads " + std::to_string(layout);
  if (found >= 1 && found < layout)
    throw InputError(versions + ": an older version has written it; " + std::string(kind.remedy));
  throw InputError(versions + ": it is damaged, or a later version has written it");
}

// One line of whatever a file may call it.
std::string quoted(std::string_view name) {
  return "section '" + printable(name, 40) + "'";
}

// The bytes of the table; its checksum is right.
std::string_view table_in(std::string_view file) {
  const auto length = number_at<std::uint64_t>(file, magic_size + sizeof layout);
  if (length > file.size() - head_size - tail_size)
    refuse_length(file, "a table of contents of " + std::to_string(length));
  const std::size_t end = head_size + length;
  if (checksum_of(file.substr(0, end)) != number_at<std::uint32_t>(file, end))
    throw InputError("is damaged: the checksum of its table of contents is not that of the table");
  return file.substr(head_size, length);
}

std::vector<SectionEntry> entries_of(std::string_view table) {
  try {
    return parsed<std::vector<SectionEntry>>(table);
  } catch (const InputError& error) {
    throw InputError(std::string("is damaged: its table of contents: ") + error.what());
  }
}

void check_entries(const std::vector<SectionEntry>& entries, std::string_view file, std::size_t contents) {
  std::set<std::string_view> names;
  std::size_t rest = contents;
  for (const SectionEntry& entry : entries) {
    if (!names.insert(entry.name).second)
      throw InputError("is damaged: it has " + quoted(entry.name) + " twice");
    if (entry.length > rest) refuse_length(file, "more, in " + quoted(entry.name) + ",");
    rest -= entry.length;
  }
  if (rest > 0) refuse_length(file, std::to_string(file.size() - rest));
}

}  // namespace

void SectionWriter::close(const SectionKind& kind, std::size_t start) {
  const auto contents = std::string_view(contents_.bytes()).substr(start);
  entries_.push_back({std::string(kind.name), kind.version, contents.size(), checksum_of(contents)});
}

std::string SectionWriter::file(const FileKind& kind) && {
  const std::string table = bytes_of(entries_);
  std::string head =
      std::string(kind.magic) + bytes_of(layout) + bytes_of(std::uint64_t{table.size()}) + table;
  head += bytes_of(checksum_of(head));
  std::string file = std::move(contents_).take();
  file.insert(0, head);
  return file;
}

SectionReader::SectionReader(const FileKind& kind, std::string_view file) {
  check_head(kind, file);
  const std::string_view table = table_in(file);
  auto entries = entries_of(table);
  std::string_view rest = file.substr(head_size + table.size() + tail_size);
  check_entries(entries, file, rest.size());
  for (SectionEntry& entry : entries) {
    const std::string_view contents = rest.substr(0, entry.length);
    rest.remove_prefix(entry.length);
    if (checksum_of(contents) != entry.checksum)
      throw InputError("is damaged: the checksum of " + quoted(entry.name) + " is not that of its contents");
    sections_.push_back({std::move(entry), contents});
  }
}

std::string_view SectionReader::take(const SectionKind& kind) {
  const auto found =
      std::ranges::find_if(sections_, [&](const Section& s) { return s.entry.name == kind.name; });
  if (found == sections_.end()) throw InputError("has no " + quoted(kind.name));
  if (found->entry.version != kind.version)
    refuse(kind.name, " has version " + std::to_string(found->entry.version) + ", this program reads " +
                          std::to_string(kind.version));
  found->is_read = true;
  return found->contents;
}

void SectionReader::expect_end() const {
  for (const Section& section : sections_)
    if (!section.is_read) refuse(section.entry.name, " is unknown to this program");
}

void SectionReader::refuse(std::string_view name, const std::string& why) {
  throw InputError(quoted(name) + why);
}

}  // namespace kinemesh::binary
