#include "core/io/atomic_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/io/folder_lock.h"
#include "core/io/same_file.h"
#include "tests/core/io/meshes.h"

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

TEST_F(AtomicFile, KeepsPermissions) {
  const fs::path path = folder() / "file";
  write_file_atomically(path, "old");
  ASSERT_EQ(::chmod(path.c_str(), 0640), 0);
  write_file_atomically(path, "new");
  EXPECT_EQ(read_file(path), "new");
  EXPECT_EQ(fs::status(path).permissions(), static_cast<fs::perms>(0640));
}

TEST_F(AtomicFile, NeverWritesThroughALink) {
  const fs::path victim = folder() / "victim", link = folder() / "link", dangling = folder() / "dangling";
  write_file_atomically(victim, "precious");
  fs::create_symlink("victim", link);
  fs::create_symlink("nothing", dangling);
  for (const fs::path& path : {link, dangling})
    EXPECT_THAT(refusal([&] { write_file_atomically(path, "new"); }), ::testing::HasSubstr("symbolic link"));
  EXPECT_EQ(read_file(victim), "precious");
  EXPECT_FALSE(fs::exists(folder() / "nothing"));
  EXPECT_EQ(files_in(folder()), 3u);
}

// The other name goes on to stand for the old content.
TEST_F(AtomicFile, ReplacesOneNameOfAFileThatHasTwo) {
  const fs::path path = folder() / "file", other = folder() / "other";
  write_file_atomically(other, "precious");
  fs::create_hard_link(other, path);
  write_file_atomically(path, "new");
  EXPECT_EQ(read_file(path), "new");
  EXPECT_EQ(read_file(other), "precious");
}

TEST_F(AtomicFile, LinksCanBeFollowedBeforehand) {
  fs::create_directory(folder() / "sub");
  fs::create_symlink("sub/second", folder() / "first");
  fs::create_symlink("../file", folder() / "sub" / "second");
  const fs::path target = follow_links(folder() / "first");
  write_file_atomically(target, "new");
  EXPECT_EQ(read_file(folder() / "file"), "new");
  EXPECT_TRUE(fs::is_symlink(folder() / "first"));
  fs::create_symlink("ring", folder() / "ring");
  EXPECT_THAT(refusal([&] { write_file_atomically(follow_links(folder() / "ring"), "x"); }),
              ::testing::HasSubstr("symbolic link"));
}

TEST_F(AtomicFile, StagedFilesArePutInPlaceTogetherOrNotAtAll) {
  const fs::path a = folder() / "a", b = folder() / "b";
  write_file_atomically(a, "old");
  {
    StagedFile first(a, "new");
    EXPECT_EQ(files_in(folder()), 2u);
    EXPECT_NE(refusal([&] { StagedFile second(folder() / "none" / "b", "x"); }), "");
  }
  EXPECT_EQ(read_file(a), "old");
  EXPECT_EQ(files_in(folder()), 1u);
  StagedFile first(a, "new"), second(b, "new");
  first.commit();
  second.commit();
  EXPECT_EQ(read_file(a) + read_file(b), "newnew");
  EXPECT_EQ(files_in(folder()), 2u);
}

// Whoever has died with the number of this process may have left any of the names it is going to take.
TEST_F(AtomicFile, TakesAnotherNameWhereOneIsTaken) {
  for (int i = 0; i < 2000; ++i) {
    const std::string name = ".kinemesh-" + std::to_string(::getpid()) + "-" + std::to_string(i) + ".tmp";
    ASSERT_TRUE(is_staged_name(name));
    ::close(::open((folder() / name).c_str(), O_WRONLY | O_CREAT, 0600));
  }
  write_file_atomically(folder() / "file", "text");
  EXPECT_EQ(read_file(folder() / "file"), "text");
  remove_leftovers(folder());
  EXPECT_EQ(files_in(folder()), 1u);
}

TEST_F(AtomicFile, OnlyLeftoversOfTheDeadAreRemoved) {
  const StagedFile living(folder() / "file", "text");
  const pid_t child = ::fork();
  if (child == 0) {  // dies with its file staged
    new StagedFile(folder() / "other", "text");
    ::_exit(0);
  }
  ::waitpid(child, nullptr, 0);
  fs::create_symlink("nowhere", folder() / ".kinemesh-1-1.tmp");
  fs::create_directory(folder() / ".kinemesh-1-2.tmp");
  EXPECT_EQ(files_in(folder()), 4u);
  remove_leftovers(folder());
  EXPECT_EQ(files_in(folder()), 3u) << "the living one, the link, the folder";
}

TEST_F(AtomicFile, AFullDiskIsNobodysMistake) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  rlimit none = before;
  none.rlim_cur = 0;
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
  std::string reading, writing;
  try {
    (void)read_file(folder() / "file");
  } catch (const ResourceError& error) {
    reading = error.what();
  }
  try {
    write_file_atomically(folder() / "file", "x");
  } catch (const ResourceError& error) {
    writing = error.what();
  }
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &before), 0);
  EXPECT_THAT(reading, ::testing::HasSubstr("file: cannot be opened: Too many open files"));
  EXPECT_THAT(writing, ::testing::HasSubstr("file: cannot be written: Too many open files"));
}

TEST_F(AtomicFile, AFolderHasOneLockWhoeverAsks) {
  FolderLock lock(folder());
  EXPECT_THAT(refusal([&] { FolderLock second(folder()); }),
              ::testing::HasSubstr("another kinemesh is writing"));
  EXPECT_EQ(files_in(folder()), 0u);
  lock = FolderLock();
  EXPECT_TRUE(FolderLock(folder()).is_held());
  EXPECT_THAT(refusal([&] { FolderLock missing(folder() / "none"); }), ::testing::HasSubstr("No such file"));
}

// However it ends.
TEST_F(AtomicFile, ALockDiesWithItsProcess) {
  int told[2];
  ASSERT_EQ(::pipe(told), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const FolderLock lock(folder());
    (void)!::write(told[1], "x", 1);
    ::pause();
  }
  char byte = 0;
  ASSERT_EQ(::read(told[0], &byte, 1), 1);
  EXPECT_NE(refusal([&] { FolderLock second(folder()); }), "");
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(FolderLock(folder()).is_held());
  ::close(told[0]);
  ::close(told[1]);
}

TEST_F(AtomicFile, NamesOfOneFileAreKnown) {
  write_file_atomically(folder() / "file", "x");
  write_file_atomically(folder() / "other", "x");
  fs::create_directory(folder() / "sub");
  fs::create_symlink("../file", folder() / "sub" / "link");
  fs::create_symlink("new", folder() / "dangling");
  fs::create_hard_link(folder() / "file", folder() / "hard");
  for (const char* name : {"file", "sub/../file", "sub/link", "hard"})
    EXPECT_TRUE(is_same_file(folder() / "file", folder() / name)) << name;
  EXPECT_TRUE(is_same_file(folder() / "new", folder() / "dangling"));
  EXPECT_TRUE(is_same_file(folder() / "new", folder() / "sub" / ".." / "new"));
  EXPECT_FALSE(is_same_file(folder() / "new", folder() / "sub" / "new"));
  EXPECT_FALSE(is_same_file(folder() / "file", folder() / "other"));
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
  std::string message;
  try {
    write_file_atomically(path, std::string(100'000, 'x'));
  } catch (const ResourceError& error) {
    message = error.what();
  }
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
