#include "core/io/atomic_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/io/meshes.h"

namespace kinemesh {
namespace {

namespace fs = std::filesystem;
using AtomicFile = TemporaryFolder;

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST_F(AtomicFile, WritesAndReplaces) {
  const fs::path path = folder() / "file";
  write_file_atomically(path, "first");
  write_file_atomically(path, std::string("sec\0ond", 7));
  EXPECT_EQ(read_file(path), std::string("sec\0ond", 7));
  EXPECT_EQ(files_in(folder()), 1u);
}

TEST_F(AtomicFile, KeepsPermissionsAndLinks) {
  const fs::path path = folder() / "file", link = folder() / "link";
  write_file_atomically(path, "old");
  ASSERT_EQ(::chmod(path.c_str(), 0640), 0);
  fs::create_symlink("file", link);
  write_file_atomically(link, "new");
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(read_file(path), "new");
  EXPECT_EQ(fs::status(path).permissions(), static_cast<fs::perms>(0640));
}

TEST_F(AtomicFile, WritesThroughALinkToNothingYet) {
  fs::create_symlink("file", folder() / "link");
  write_file_atomically(folder() / "link", "new");
  EXPECT_EQ(read_file(folder() / "file"), "new");
  EXPECT_TRUE(fs::is_symlink(folder() / "link"));
}

TEST_F(AtomicFile, NamesAsLongAsTheFileSystemAllowsWork) {
  const fs::path path = folder() / std::string(255, 'x');
  write_file_atomically(path, "text");
  EXPECT_EQ(read_file(path), "text");
}

TEST_F(AtomicFile, RefusesWhatIsNoPlaceForAFile) {
  EXPECT_THAT(refusal([&] { write_file_atomically(folder() / "no" / "file", "x"); }),
              ::testing::HasSubstr("file: cannot be written: No such file or directory"));
  EXPECT_THAT(refusal([&] { write_file_atomically(folder(), "x"); }), ::testing::HasSubstr("is a directory"));
  EXPECT_THAT(refusal([&] { write_file_atomically("/dev/null", "x"); }),
              ::testing::StrEq("/dev/null: is not a regular file"));
  EXPECT_TRUE(fs::is_empty(folder()));
}

TEST_F(AtomicFile, LeavesTheOldFileWhereTheNewOneDoesNotFit) {
  rlimit before{}, small{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const fs::path path = folder() / "file";
  write_file_atomically(path, "old");
  small = before;
  small.rlim_cur = 1000;
  const auto old_handler = ::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = refusal([&] { write_file_atomically(path, std::string(100'000, 'x')); });
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  ::signal(SIGXFSZ, old_handler);
  EXPECT_THAT(message, ::testing::HasSubstr("file: cannot be written: File too large"));
  EXPECT_EQ(read_file(path), "old");
  EXPECT_EQ(files_in(folder()), 1u);
}

TEST_F(AtomicFile, ReadingRefusesDevicesAndPipesAtOnce) {
  EXPECT_THAT(refusal([] { read_file("/dev/zero"); }), ::testing::StrEq("/dev/zero: is not a regular file"));
  const fs::path pipe = folder() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(refusal([&] { read_file(pipe); }), ::testing::HasSubstr("is not a regular file"));
}

TEST_F(AtomicFile, ReadingRefusesWhatMayNotBeRead) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  write_file_atomically(folder() / "file", "x");
  ASSERT_EQ(::chmod((folder() / "file").c_str(), 0), 0);
  EXPECT_THAT(refusal([&] { read_file(folder() / "file"); }), ::testing::HasSubstr("Permission denied"));
}

}  // namespace
}  // namespace kinemesh
