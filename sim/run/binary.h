// Numbers, texts and lists of them as bytes in a fixed order, little endian. The layer below checkpoints,
// failed steps and patches; the layout is in docs/formats.md. Internal to sim/.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "kinemesh/error.h"
#include "kinemesh/types.h"

namespace kinemesh::binary {

// Types made of numbers of one kind, one behind the other: these are copied as they lie in memory.
template <class T>
struct NumbersOf {
  static constexpr std::size_t size = std::is_arithmetic_v<T> ? sizeof(T) : 0;
};
template <>
struct NumbersOf<Point> {
  static constexpr std::size_t size = sizeof(double);
};
template <std::size_t n>
struct NumbersOf<std::array<int, n>> {
  static constexpr std::size_t size = sizeof(int);
};
template <class T>
concept Numeric = NumbersOf<T>::size >
0;
static_assert(sizeof(int) == 4 && sizeof(double) == 8 && sizeof(Point) == 16 && sizeof(bool) == 1);

// Reverses the bytes of each number where the machine is not little endian.
inline void little_endian(std::span<char> bytes, std::size_t size) {
  if constexpr (std::endian::native == std::endian::little) return;
  for (std::size_t i = 0; i < bytes.size(); i += size)
    std::reverse(bytes.begin() + i, bytes.begin() + i + size);
}

// Structs say their members, in order, once for both directions:
//   template <class Archive, class S> requires Is<S, Thing>
//   void members(Archive& archive, S& thing) { archive(thing.a, thing.b); }
template <class S, class Thing>
concept Is = std::is_same_v<std::remove_const_t<S>, Thing>;

class Writer {
 public:
  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }
  const std::string& bytes() const { return bytes_; }
  std::string take() && { return std::move(bytes_); }

 private:
  template <Numeric T>
  void put(const T& value) {
    put_numbers(std::span<const T>(&value, 1));
  }
  template <class T>
  void put(const std::vector<T>& items) {
    put(std::uint64_t{items.size()});
    if constexpr (Numeric<T>) {
      put_numbers(std::span<const T>(items));
    } else {
      for (const T& item : items) put(item);
    }
  }
  void put(const std::string& text) {
    put(std::uint64_t{text.size()});
    bytes_ += text;
  }
  template <class K, class V>
  void put(const std::map<K, V>& items) {
    put(std::uint64_t{items.size()});
    for (const auto& [key, value] : items) (*this)(key, value);
  }
  template <class T>
  requires(!Numeric<T>) void put(const T& thing) { members(*this, thing); }
  template <class T>
  void put_numbers(std::span<const T> values) {
    const std::size_t start = bytes_.size();
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
    little_endian(std::span(bytes_).subspan(start), NumbersOf<T>::size);
  }

  std::string bytes_;
};

// Throws InputError where the bytes end too early or hold a count they have no room for.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }
  void expect_end() const {
    if (!rest_.empty()) throw InputError("more bytes than expected");
  }

 private:
  template <Numeric T>
  void get(T& value) {
    get_numbers(std::span<T>(&value, 1));
  }
  void get(bool& value) {
    std::uint8_t byte = 0;
    get(byte);
    if (byte > 1) throw InputError("neither true nor false");
    value = byte == 1;
  }
  template <class T>
  void get(std::vector<T>& items) {
    items.clear();
    if constexpr (Numeric<T>) {
      items.resize(count(sizeof(T)));
      get_numbers(std::span<T>(items));
    } else {
      for (auto left = count(1); left > 0; --left) get(items.emplace_back());  // takes no more than there is
    }
  }
  void get(std::string& text) { text = take(count(1)); }
  template <class K, class V>
  void get(std::map<K, V>& items) {
    for (auto left = count(1); left > 0; --left) {
      std::pair<K, V> item;
      (*this)(item.first, item.second);
      items.insert(std::move(item));
    }
  }
  template <class T>
  requires(!Numeric<T>) void get(T& thing) { members(*this, thing); }
  template <class T>
  void get_numbers(std::span<T> values) {
    const std::string_view source = take(values.size_bytes());
    if (source.empty()) return;
    std::memcpy(values.data(), source.data(), source.size());
    little_endian({reinterpret_cast<char*>(values.data()), source.size()}, NumbersOf<T>::size);
  }
  std::size_t count(std::size_t bytes_each) {
    std::uint64_t n = 0;
    get(n);
    if (n > rest_.size() / bytes_each) throw InputError("a count it has no room for");
    return n;
  }
  std::string_view take(std::size_t n) {
    if (n > rest_.size()) throw InputError("ends too early");
    const auto taken = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return taken;
  }

  std::string_view rest_;
};

// One thing as bytes, and back; throws InputError unless it takes all of them.
template <class T>
std::string bytes_of(const T& thing) {
  Writer writer;
  writer(thing);
  return std::move(writer).take();
}

template <class T>
T parsed(std::string_view bytes) {
  Reader reader(bytes);
  T thing;
  reader(thing);
  reader.expect_end();
  return thing;
}

}  // namespace kinemesh::binary
