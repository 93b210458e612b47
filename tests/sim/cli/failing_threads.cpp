// Loaded before a program with LD_PRELOAD: no threads from the KINEMESH_THREADS-th on, which has to be made.
#include <dlfcn.h>
#include <pthread.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
                              void* argument) noexcept {
  static std::atomic<int> made{0};
  const char* most = std::getenv("KINEMESH_THREADS");
  if (most != nullptr && made++ >= std::atoi(most)) return EAGAIN;
  using Create = int(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  return reinterpret_cast<Create*>(dlsym(RTLD_NEXT, "pthread_create"))(thread, attributes, start, argument);
}
