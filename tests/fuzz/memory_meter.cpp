#include "tests/fuzz/memory_meter.h"

#include <algorithm>
#include <atomic>
#include <cstdint>

#if defined(__SANITIZE_ADDRESS__)
#define KINEMESH_ASAN 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define KINEMESH_ASAN 1
#endif
#endif

#ifdef KINEMESH_ASAN
// Of <sanitizer/allocator_interface.h>, which g++ does not bring in Debian.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*taken)(const volatile void*, std::size_t),
                                                         void (*given_back)(const volatile void*));
extern "C" std::size_t __sanitizer_get_allocated_size(const volatile void* memory);
#else
#include <malloc.h>

#include <cstdlib>
#include <new>
#endif

namespace kinemesh::memory_meter {
namespace {

std::atomic<std::int64_t> now{0}, most{0};

void taken(std::size_t bytes) {
  const std::int64_t sum = now += static_cast<std::int64_t>(bytes);
  std::int64_t before = most;
  while (before < sum && !most.compare_exchange_weak(before, sum)) {
  }
}

void given_back(std::size_t bytes) {
  now -= static_cast<std::int64_t>(bytes);
}

}  // namespace

void start() {
#ifdef KINEMESH_ASAN
  static const int installed =
      __sanitizer_install_malloc_and_free_hooks([](const volatile void*, std::size_t bytes) { taken(bytes); },
                                                [](const volatile void* memory) {
                                                  if (memory != nullptr)
                                                    given_back(__sanitizer_get_allocated_size(memory));
                                                });
  static_cast<void>(installed);
#endif
  now = 0;
  most = 0;
}

std::size_t peak() {
  return static_cast<std::size_t>(std::max<std::int64_t>(most, 0));
}

}  // namespace kinemesh::memory_meter

#ifndef KINEMESH_ASAN

[[gnu::noinline]] void* operator new(std::size_t size) {
  void* memory = std::malloc(size > 0 ? size : 1);
  if (memory == nullptr) throw std::bad_alloc();
  kinemesh::memory_meter::taken(malloc_usable_size(memory));
  return memory;
}

[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  void* memory = std::malloc(size > 0 ? size : 1);
  if (memory != nullptr) kinemesh::memory_meter::taken(malloc_usable_size(memory));
  return memory;
}

[[gnu::noinline]] void operator delete(void* memory) noexcept {
  if (memory != nullptr) kinemesh::memory_meter::given_back(malloc_usable_size(memory));
  std::free(memory);
}

[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  ::operator delete(memory);
}

#endif
