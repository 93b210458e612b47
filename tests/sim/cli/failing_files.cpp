// Preloaded into the program: counts its calls that change files and lets one of them go wrong. Environment:
//   KINEMESH_FAULT_COUNT=FILE       add a byte to FILE for each call
//   KINEMESH_FAULT_AT=N             the N-th call, from 1, ...
//   KINEMESH_FAULT=fail             ... fails with EIO, and all others work
//                  full             ... and all later ones that need room fail with ENOSPC
//                  kill             ... kills the process, a write after half of its bytes
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

std::string_view variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

void count() {
  const char* file = std::getenv("KINEMESH_FAULT_COUNT");
  if (!file) return;
  const int counter = next<int(const char*, int, ...)>("open")(file, O_WRONLY | O_CREAT | O_APPEND, 0600);
  if (next<ssize_t(int, const void*, size_t)>("write")(counter, ".", 1) != 1) std::abort();
  next<int(int)>("close")(counter);
}

std::atomic<long> calls{0};

// True if this call has to fail; errno says how. `half` is done before a kill.
template <class Half>
bool goes_wrong(bool needs_room, const Half& half) {
  static const long at = std::atol(variable("KINEMESH_FAULT_AT").data());
  count();
  const long call = ++calls;
  const auto fault = variable("KINEMESH_FAULT");
  if (at == 0 || call < at || (call > at && fault != "full")) return false;
  if (fault == "kill") {
    half();
    std::raise(SIGKILL);
  }
  if (fault == "full" && !needs_room) return false;
  errno = fault == "full" ? ENOSPC : EIO;
  return true;
}

bool goes_wrong(bool needs_room) {
  return goes_wrong(needs_room, [] {});
}

int open_as(const char* name, const char* path, int flags, mode_t mode) {
  if ((flags & (O_WRONLY | O_RDWR | O_CREAT)) != 0 && goes_wrong((flags & O_CREAT) != 0)) return -1;
  return next<int(const char*, int, ...)>(name)(path, flags, mode);
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = va_arg(arguments, mode_t);
  va_end(arguments);
  return open_as("open", path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = va_arg(arguments, mode_t);
  va_end(arguments);
  return open_as("open64", path, flags, mode);
}

ssize_t write(int file, const void* bytes, size_t size) {
  const auto real = next<ssize_t(int, const void*, size_t)>("write");
  if (file > 2 && goes_wrong(true, [&] { (void)!real(file, bytes, size / 2); })) return -1;
  return real(file, bytes, size);
}

int fsync(int file) {
  return goes_wrong(true) ? -1 : next<int(int)>("fsync")(file);
}

int rename(const char* from, const char* to) noexcept {
  return goes_wrong(false) ? -1 : next<int(const char*, const char*)>("rename")(from, to);
}

int ftruncate(int file, off_t length) noexcept {
  return goes_wrong(false) ? -1 : next<int(int, off_t)>("ftruncate")(file, length);
}

int mkdir(const char* path, mode_t mode) noexcept {
  return goes_wrong(true) ? -1 : next<int(const char*, mode_t)>("mkdir")(path, mode);
}

int unlink(const char* path) noexcept {
  return goes_wrong(false) ? -1 : next<int(const char*)>("unlink")(path);
}

int remove(const char* path) noexcept {
  return goes_wrong(false) ? -1 : next<int(const char*)>("remove")(path);
}
}
