// Operator new for a whole program: big arrays come in large pages where the system has them. A mesh is read
// in no order where it is tangled; without large pages the table that leads to them misses as often as the
// cache does. Libraries do not link this: who embeds one decides for himself (docs/embedding.md). Sanitizers
// bring an operator new of their own, which has more to do.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace {

constexpr std::size_t page = std::size_t{2} << 20, big = 4 * page;

void* take(std::size_t size) {
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  if (size >= big && size <= PTRDIFF_MAX) {
    const std::size_t whole = (size + page - 1) / page * page;
    void* const memory = std::aligned_alloc(page, whole);
    if (memory) madvise(memory, whole, MADV_HUGEPAGE);  // without it the memory is as good, only slower
    return memory;
  }
#endif
  return std::malloc(size == 0 ? 1 : size);
}

}  // namespace

void* operator new(std::size_t size) {
  while (true) {
    if (void* const memory = take(size)) return memory;
    const std::new_handler handler = std::get_new_handler();
    if (!handler) throw std::bad_alloc();
    handler();
  }
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

#endif
