#include "sim/run/binary.h"

#include <zlib.h>

namespace kinemesh::binary {
namespace {

constexpr std::size_t magic_size = 8;
constexpr std::size_t head_size = magic_size + sizeof(std::uint32_t) + sizeof(std::uint64_t);
constexpr std::size_t tail_size = sizeof(std::uint32_t);

std::uint32_t checksum(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(crc32_z(0, nullptr, 0), reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

template <class Number>
Number number_at(std::string_view bytes, std::size_t place) {
  return parsed<Number>(bytes.substr(place, sizeof(Number)));
}

[[noreturn]] void refuse_truncated(std::string_view file, const std::string& expected) {
  throw InputError("is damaged: " + std::to_string(file.size()) + " bytes long, " + expected + " expected");
}

}  // namespace

std::string seal(const Kind& kind, std::string_view payload) {
  std::string file;
  file.reserve(head_size + payload.size() + tail_size);
  file += kind.magic;
  file += bytes_of(kind.version);
  file += bytes_of(std::uint64_t{payload.size()});
  file += payload;
  file += bytes_of(checksum(file));
  return file;
}

std::string_view unseal(const Kind& kind, std::string_view file) {
  if (!file.starts_with(kind.magic)) throw InputError("is no " + std::string(kind.name));
  if (file.size() < head_size + tail_size)
    refuse_truncated(file, "at least " + std::to_string(head_size + tail_size));
  const auto size = number_at<std::uint64_t>(file, magic_size + sizeof kind.version);
  if (size != file.size() - head_size - tail_size)
    refuse_truncated(file, std::to_string(head_size + size + tail_size));
  if (checksum(file.substr(0, head_size + size)) != number_at<std::uint32_t>(file, head_size + size))
    throw InputError("is damaged: its checksum is not that of its content");
  if (const auto version = number_at<std::uint32_t>(file, magic_size); version != kind.version)
    throw InputError("has version " + std::to_string(version) + " of the layout, " +
                     std::to_string(kind.version) + " expected");
  return file.substr(head_size, size);
}

}  // namespace kinemesh::binary
