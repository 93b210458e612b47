// A list that is short most of the time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <type_traits>

#pragma GCC visibility push(default)
namespace kinemesh {

// The first `n_inside` items take no memory of their own. All that a vector of plain items is used for here.
template <class T, std::size_t n_inside = 12>
class ShortList {
 public:
  static_assert(std::is_trivially_copyable_v<T>);
  using value_type = T;
  using iterator = T*;
  using const_iterator = const T*;

  ShortList() = default;
  template <class Iterator>
  ShortList(Iterator first, Iterator last) {
    assign(first, last);
  }
  ShortList(const ShortList& other) { assign(other.begin(), other.end()); }
  ShortList(ShortList&& other) noexcept { swap(other); }
  ShortList& operator=(ShortList other) noexcept {
    swap(other);
    return *this;
  }

  T* begin() { return outside_ ? outside_.get() : inside_.data(); }
  const T* begin() const { return outside_ ? outside_.get() : inside_.data(); }
  T* end() { return begin() + size_; }
  const T* end() const { return begin() + size_; }
  T* data() { return begin(); }
  const T* data() const { return begin(); }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& operator[](std::size_t i) { return begin()[i]; }
  const T& operator[](std::size_t i) const { return begin()[i]; }
  const T& front() const { return *begin(); }
  const T& back() const { return end()[-1]; }

  void reserve(std::size_t n) {
    if (n <= capacity_) return;
    std::unique_ptr<T[]> larger(new T[n]);
    std::copy(begin(), end(), larger.get());
    outside_ = std::move(larger);
    capacity_ = n;
  }
  void push_back(const T& item) {
    const T kept = item;  // which may be one of the list
    if (size_ == capacity_) reserve(2 * capacity_);
    begin()[size_++] = kept;
  }
  template <class Iterator>
  void assign(Iterator first, Iterator last) {
    size_ = 0;
    reserve(static_cast<std::size_t>(std::distance(first, last)));
    size_ = static_cast<std::size_t>(std::copy(first, last, begin()) - begin());
  }
  T* erase(T* first, T* last) {
    size_ -= static_cast<std::size_t>(last - first);
    std::copy(last, last + (begin() + size_ - first), first);
    return first;
  }
  void clear() { size_ = 0; }
  void swap(ShortList& other) noexcept {
    std::swap(inside_, other.inside_);
    std::swap(outside_, other.outside_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }

  friend bool operator==(const ShortList& a, const ShortList& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  std::array<T, n_inside> inside_{};
  std::unique_ptr<T[]> outside_;  // all items, once they are more
  std::size_t size_ = 0, capacity_ = n_inside;
};

}  // namespace kinemesh
#pragma GCC visibility pop
