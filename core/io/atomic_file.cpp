#include "core/io/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <utility>

namespace kinemesh {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, const std::string& doing, int error) {
  throw InputError(path.string(), 0, doing + ": " + std::strerror(error));
}

// An open file that is closed, and with `remove` also deleted, unless release() came first.
class File {
 public:
  File(fs::path path, int flags)
      : path_(std::move(path)), descriptor_(::open(path_.c_str(), flags | O_CLOEXEC, 0666)) {}
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (remove_) ::unlink(path_.c_str());
  }
  bool is_open() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }
  const fs::path& path() const { return path_; }
  int close() { return ::close(std::exchange(descriptor_, -1)); }
  void remove_unless_kept() { remove_ = true; }
  void keep() { remove_ = false; }

 private:
  fs::path path_;
  int descriptor_;
  bool remove_ = false;
};

void write_all(const File& file, std::string_view content, const fs::path& target) {
  while (!content.empty()) {
    const ssize_t n = ::write(file.descriptor(), content.data(), content.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(target, "cannot be written", errno);
    content.remove_prefix(static_cast<std::size_t>(n));
  }
}

// The short name leaves room where the target's own is as long as the file system allows.
fs::path temporary_beside(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  const std::string name =
      ".kinemesh-" + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".tmp";
  return target.parent_path() / name;
}

// Where links lead; refuses what a rename would destroy.
fs::path resolved(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    throw InputError(path.string(), 0,
                     fs::is_directory(status) ? "is a directory, expected a file" : "is not a regular file");
  }
  fs::path target = path;
  for (int links = 0; links < 40 && fs::is_symlink(fs::symlink_status(target, error)); ++links) {
    const fs::path next = fs::read_symlink(target, error);
    if (error) break;
    target = target.parent_path() / next;  // an absolute one replaces it all
  }
  return target;
}

// Keeps who may read and write a file that is replaced.
void copy_permissions(const fs::path& from, const File& to) {
  struct stat old;
  if (::stat(from.c_str(), &old) == 0) (void)!::fchmod(to.descriptor(), old.st_mode & 07777);
}

std::string read_to_end(const File& file, std::size_t expected, const fs::path& path) {
  std::string content(expected + 1, '\0');  // one more, to meet the end in the first round
  std::size_t size = 0;
  for (;;) {
    if (size == content.size()) content.resize(2 * size);
    const ssize_t n = ::read(file.descriptor(), content.data() + size, content.size() - size);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(path, "cannot be read", errno);
    if (n == 0) break;
    size += static_cast<std::size_t>(n);
  }
  content.resize(size);
  return content;
}

}  // namespace

void write_file_atomically(const fs::path& path, std::string_view content) {
  const fs::path target = resolved(path);
  File file(temporary_beside(target), O_WRONLY | O_CREAT | O_EXCL);
  if (!file.is_open()) fail(path, "cannot be written", errno);
  file.remove_unless_kept();
  copy_permissions(target, file);
  write_all(file, content, path);
  if (::fsync(file.descriptor()) != 0 && errno != EINVAL) fail(path, "cannot be flushed to the disk", errno);
  if (file.close() != 0) fail(path, "cannot be written", errno);
  if (::rename(file.path().c_str(), target.c_str()) != 0) fail(path, "cannot be put in place", errno);
  file.keep();
  flush_directory(target.has_parent_path() ? target.parent_path() : fs::path("."));
}

// Some file systems cannot flush directories: no reason to fail.
void flush_directory(const fs::path& directory) {
  const File opened(directory, O_RDONLY | O_DIRECTORY);
  if (opened.is_open()) ::fsync(opened.descriptor());
}

std::string read_file(const fs::path& path) {
  const File file(path, O_RDONLY | O_NONBLOCK);  // a pipe without a writer must not block the open
  if (!file.is_open()) fail(path, "cannot be opened", errno);
  struct stat status;
  if (::fstat(file.descriptor(), &status) != 0) fail(path, "cannot be read", errno);
  if (S_ISDIR(status.st_mode)) throw InputError(path.string(), 0, "is a directory, expected a file");
  if (!S_ISREG(status.st_mode)) throw InputError(path.string(), 0, "is not a regular file");
  return read_to_end(file, static_cast<std::size_t>(status.st_size), path);
}

}  // namespace kinemesh
