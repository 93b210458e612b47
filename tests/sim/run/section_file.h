// Files of sections by the letter of docs/formats.md, taken apart and put together byte by byte.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace kinemesh::test {

struct RawSection {
  std::string name;
  std::uint32_t version = 1;
  std::string contents;
};

struct SectionFile {
  std::string magic;
  std::uint32_t layout = 6;
  std::vector<RawSection> sections;

  RawSection& operator[](std::string_view name) {
    for (RawSection& section : sections)
      if (section.name == name) return section;
    return sections.emplace_back(RawSection{std::string(name), 1, ""});
  }
};

inline std::string little_endian(std::uint64_t number, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(number >> 8 * i & 0xff);
  return text;
}

inline std::string crc_of(std::string_view bytes) {
  return little_endian(
      crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())), 4);
}

inline std::string joined(const SectionFile& file) {
  std::string table = little_endian(file.sections.size(), 8), contents;
  for (const RawSection& section : file.sections) {
    table += little_endian(section.name.size(), 8) + section.name + little_endian(section.version, 4);
    table += little_endian(section.contents.size(), 8) + crc_of(section.contents);
    contents += section.contents;
  }
  std::string head = file.magic + little_endian(file.layout, 4) + little_endian(table.size(), 8) + table;
  return head + crc_of(head) + contents;
}

// Pre: it is a whole one.
inline SectionFile taken_apart(std::string_view file) {
  std::size_t place = 8;
  const auto number = [&](int bytes) {
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i)
      value |= std::uint64_t{static_cast<unsigned char>(file[place + i])} << 8 * i;
    place += bytes;
    return value;
  };
  SectionFile result{std::string(file.substr(0, 8)), static_cast<std::uint32_t>(number(4)), {}};
  number(8);
  std::vector<std::size_t> lengths(number(8));
  for (std::size_t& length : lengths) {
    RawSection& section = result.sections.emplace_back();
    const auto name_length = number(8);
    section.name = file.substr(place, name_length);
    place += name_length;
    section.version = static_cast<std::uint32_t>(number(4));
    length = number(8);
    number(4);
  }
  place += 4;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    result.sections[i].contents = file.substr(place, lengths[i]);
    place += lengths[i];
  }
  return result;
}

}  // namespace kinemesh::test
