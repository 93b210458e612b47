#include "core/io/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <tuple>
#include <utility>

#include "core/io/file_error.h"

namespace kinemesh {
namespace {

namespace fs = std::filesystem;
using io::fail;

constexpr std::string_view staged_begin = ".kinemesh-", staged_end = ".tmp";

// An open file that is closed at the end.
class File {
 public:
  File(const fs::path& path, int flags) : descriptor_(::open(path.c_str(), flags | O_CLOEXEC)) {}
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  bool is_open() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

void write_all(int descriptor, std::string_view content, const fs::path& target) {
  while (!content.empty()) {
    const ssize_t n = ::write(descriptor, content.data(), content.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(target, "cannot be written", errno);
    content.remove_prefix(static_cast<std::size_t>(n));
  }
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// The short name leaves room where the target's own is as long as the file system allows.
fs::path next_name_beside(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  return target.parent_path() / (std::string(staged_begin) + std::to_string(::getpid()) + "-" +
                                 std::to_string(counter++) + std::string(staged_end));
}

// The lock of a staged file tells remove_leftovers that its process lives. False if another process has it,
// which then removes the file. Where the file system knows no locks, nothing is ever taken for left over.
bool take_lock(int descriptor) {
  return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

bool is_still_there(int descriptor) {
  struct stat status;
  return ::fstat(descriptor, &status) == 0 && status.st_nlink > 0;
}

// A new file, locked, under a name that nothing has: what a killed process of the same number left is no
// hindrance.
std::pair<fs::path, int> open_staged(const fs::path& target) {
  for (;;) {
    fs::path path = next_name_beside(target);
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0 && take_lock(descriptor) && is_still_there(descriptor))
      return {std::move(path), descriptor};
    if (descriptor < 0 && errno != EEXIST) fail(target, "cannot be written", errno);
    if (descriptor >= 0) ::close(descriptor);
  }
}

// Keeps who may read and write a file that is replaced.
void copy_permissions(const fs::path& from, int to) {
  struct stat old;
  if (::lstat(from.c_str(), &old) == 0) (void)!::fchmod(to, old.st_mode & 07777);
}

const char* name_of(fs::file_type type) {
  switch (type) {
    case fs::file_type::directory:
      return "is a directory, expected a file";
    case fs::file_type::symlink:
      return "is a symbolic link, expected a file; it is not written through";
    default:
      return "is not a regular file";
  }
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

// Pre: a staged name. Its process may be at work: then the lock is taken.
void remove_if_left_over(const fs::path& path) {
  const File file(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK);
  struct stat status;
  if (!file.is_open() || ::fstat(file.descriptor(), &status) != 0 || !S_ISREG(status.st_mode)) return;
  if (::flock(file.descriptor(), LOCK_EX | LOCK_NB) == 0) ::unlink(path.c_str());
}

}  // namespace

StagedFile::StagedFile(const fs::path& path, std::string_view content) : path_(path) {
  require_regular_or_nothing(path_);
  std::tie(staged_, descriptor_) = open_staged(path_);
  try {
    copy_permissions(path_, descriptor_);
    write_all(descriptor_, content, path_);
    if (::fsync(descriptor_) != 0 && errno != EINVAL) fail(path_, "cannot be flushed to the disk", errno);
  } catch (...) {
    discard();
    throw;
  }
}

StagedFile::StagedFile(StagedFile&& other) noexcept
    : path_(std::move(other.path_)),
      staged_(std::move(other.staged_)),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

StagedFile::~StagedFile() {
  discard();
}

void StagedFile::discard() noexcept {
  if (descriptor_ < 0) return;
  ::unlink(staged_.c_str());
  ::close(std::exchange(descriptor_, -1));
}

// The descriptor stays open, and so the lock held, until the file has its own name.
void StagedFile::commit() {
  if (::rename(staged_.c_str(), path_.c_str()) != 0) fail(path_, "cannot be put in place", errno);
  if (::close(std::exchange(descriptor_, -1)) != 0) fail(path_, "cannot be written", errno);
  flush_directory(folder_of(path_));
}

void write_file_atomically(const fs::path& path, std::string_view content) {
  StagedFile(path, content).commit();
}

fs::path follow_links(const fs::path& path) {
  std::error_code error;
  fs::path target = path;
  for (int links = 0; links < 40 && fs::is_symlink(fs::symlink_status(target, error)); ++links) {
    const fs::path next = fs::read_symlink(target, error);
    if (error) break;
    target = target.parent_path() / next;  // an absolute one replaces it all
  }
  return target;
}

void require_regular_or_nothing(const fs::path& path) {
  std::error_code ignored;
  const auto type = fs::symlink_status(path, ignored).type();
  if (type == fs::file_type::regular || type == fs::file_type::not_found || type == fs::file_type::none)
    return;
  throw InputError(path.string(), 0, name_of(type));
}

void require_place_for(const fs::path& path) {
  require_regular_or_nothing(path);
  const fs::path folder = folder_of(path) / ".";
  if (::faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) != 0)
    fail(path, "cannot be written", errno);
}

bool is_staged_name(std::string_view name) {
  return name.starts_with(staged_begin) && name.ends_with(staged_end);
}

void remove_leftovers(const fs::path& directory) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(directory, ignored))
    if (is_staged_name(entry.path().filename().string())) remove_if_left_over(entry.path());
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
