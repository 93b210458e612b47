// Feeds every reader with mutants of its files, in this process:
//   mutate_files N [FORMAT [FIRST]]    N mutants of each format, or of one, from number FIRST on
// A mutant is wrong where anything but InputError comes out, where it takes more memory than 40 times its
// size and a little, or longer than two seconds. It is left in a file of its own, and the exit code is 1.
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "kinemesh/error.h"
#include "tests/fuzz/memory_meter.h"
#include "tests/fuzz/subjects.h"

namespace kinemesh {
namespace {

namespace fs = std::filesystem;

// Bytes, of a file's size and beside it: less than the 64 MiB that docs/formats.md leaves, as the files are
// small.
constexpr std::size_t most_times = 40, most_beside = 8 << 20;
constexpr std::chrono::seconds longest{2};

// What to say where the process ends before its time.
char last_words[200] = "";

void say_last_words(int signal) {
  static_cast<void>(!write(STDERR_FILENO, last_words, std::strlen(last_words)));
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

std::uint64_t seed_of(const Subject& subject, std::uint64_t number) {
  std::uint64_t seed = number;
  for (const char c : subject.name) seed = seed * 257 + static_cast<unsigned char>(c);
  return seed;
}

std::string outcome_of(const Subject& subject, const std::string& mutant, int& n_refused) {
  try {
    return subject.read(mutant);
  } catch (const InputError&) {
    ++n_refused;
    return "";
  } catch (const std::exception& error) {
    return std::string("not an InputError: ") + error.what();
  }
}

// With time and memory looked at.
std::string verdict_on(const Subject& subject, const std::string& mutant, int& n_refused) {
  memory_meter::start();
  const auto before = std::chrono::steady_clock::now();
  const std::string wrong = outcome_of(subject, mutant, n_refused);
  const auto after = std::chrono::steady_clock::now();
  if (!wrong.empty()) return wrong;
  if (after - before > longest) return "it takes longer than two seconds";
  if (memory_meter::peak() > most_times * mutant.size() + most_beside)
    return "it takes " + std::to_string(memory_meter::peak()) + " bytes";
  return "";
}

int feed(const Subject& subject, std::uint64_t first, std::uint64_t n) {
  int n_refused = 0, n_wrong = 0;
  for (std::uint64_t i = first; i < first + n; ++i) {
    Dice dice(seed_of(subject, i));
    const std::string mutant = subject.mutant(dice);
    std::snprintf(last_words, sizeof last_words, "mutant %s %llu ends the process\n", subject.name.c_str(),
                  static_cast<unsigned long long>(i));
    const std::string wrong = verdict_on(subject, mutant, n_refused);
    if (wrong.empty()) continue;
    const std::string file = "mutant_" + subject.name + "_" + std::to_string(i);
    std::ofstream(file, std::ios::binary) << mutant;
    std::printf("%s: %s\n", file.c_str(), wrong.c_str());
    ++n_wrong;
  }
  if (n >= 100 && n_refused == static_cast<int>(n)) {
    std::printf("%s: no mutant was read\n", subject.name.c_str());
    ++n_wrong;
  }
  std::printf("%-14s %llu mutants, %d refused, %d wrong\n", subject.name.c_str(),
              static_cast<unsigned long long>(n), n_refused, n_wrong);
  std::fflush(stdout);
  return n_wrong;
}

int feed_all(int argc, char** argv) {
  const std::uint64_t n = std::strtoull(argv[1], nullptr, 10);
  const std::string only = argc > 2 ? argv[2] : "";
  const std::uint64_t first = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 0;
  std::string folder = (fs::temp_directory_path() / "kinemesh_mutants_XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) return 2;
  int n_wrong = 0;
  for (const Subject& subject : subjects(folder))
    if (only.empty() || only == subject.name) n_wrong += feed(subject, first, n);
  fs::remove_all(folder);
  return n_wrong == 0 ? 0 : 1;
}

}  // namespace
}  // namespace kinemesh

int main(int argc, char** argv) {
  if (argc < 2) return std::fputs("mutate_files N [FORMAT [FIRST]]\n", stderr), 2;
  for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGILL})
    std::signal(signal, kinemesh::say_last_words);
  return kinemesh::feed_all(argc, argv);
}
