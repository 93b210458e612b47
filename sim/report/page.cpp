#include "sim/report/page.h"

#include <zlib.h>

#include <new>

namespace kinemesh::report {

std::string base64(std::string_view bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  const auto byte = [&](std::size_t i) {
    return i < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[i])) : 0u;
  };
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const unsigned three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    for (int k = 3; k >= 0; --k) text.push_back(digits[three >> 6 * k & 63]);
  }
  const std::size_t missing = (3 - bytes.size() % 3) % 3;
  text.replace(text.size() - missing, missing, missing, '=');
  return text;
}

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), 9) != Z_OK)
    throw std::bad_alloc();
  packed.resize(size);
  return packed;
}

std::string fill_page(std::string_view data, std::string_view frames) {
  const std::string_view page = page_template();
  const auto first = page.find("@DATA@"), second = page.find("@FRAMES@");
  std::string html;
  html.reserve(page.size() + data.size() + frames.size());
  html.append(page.substr(0, first)).append(data);
  html.append(page.substr(first + 6, second - first - 6)).append(frames);
  return html.append(page.substr(second + 8));
}

}  // namespace kinemesh::report
