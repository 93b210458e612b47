#include "program.h"

#include <fcntl.h>
#include <pty.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace kinemesh::testing {
namespace fs = std::filesystem;
namespace {

fs::path make_folder(const char* kind) {
  std::string name = (fs::temp_directory_path() / (std::string("kinemesh_") + kind + "_XXXXXX")).string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
  return name;
}

// In the child: nothing but calls that are safe after fork.
[[noreturn]] void become_program(const char* folder, const char* out, int err_file, char** argv) {
  const int out_file = open(out, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (out_file >= 0 && err_file >= 0 && chdir(folder) == 0) {
    dup2(out_file, STDOUT_FILENO);
    dup2(err_file, STDERR_FILENO);
    execv(argv[0], argv);
  }
  _exit(99);
}

// In the child: becomes the parent of the program, which is number 1 of a new namespace, and ends as it does.
// Nothing but calls that are safe after fork.
void enter_namespace() {
  if (unshare(CLONE_NEWPID) != 0) _exit(98);
  const pid_t program = fork();
  if (program == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    return;
  }
  int status = 0;
  waitpid(program, &status, 0);
  if (WIFSIGNALED(status)) raise(WTERMSIG(status));
  _exit(WEXITSTATUS(status));
}

}  // namespace

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) result.push_back(line);
  return result;
}

std::string read_text(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::string> Result::err_lines() const {
  return lines_of(err);
}

ProgramTest::ProgramTest() : folder_(make_folder("test")), capture_(make_folder("capture")) {}

ProgramTest::~ProgramTest() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  fs::remove_all(capture_, ignored);
}

std::string ProgramTest::write(const std::string& name, const std::string& text) const {
  std::ofstream(path(name), std::ios::binary) << text;
  return path(name).string();
}

std::vector<std::string> ProgramTest::files() const {
  std::vector<std::string> result;
  for (const auto& entry : fs::directory_iterator(folder_))
    result.push_back(entry.path().filename().string());
  std::sort(result.begin(), result.end());
  return result;
}

pid_t ProgramTest::start(const std::vector<std::string>& arguments, int err_file) const {
  return start(arguments, err_file, false);
}

pid_t ProgramTest::start_in_namespace(const std::vector<std::string>& arguments) const {
  return start(arguments, -1, true);
}

pid_t ProgramTest::start(const std::vector<std::string>& arguments, int err_file, bool in_namespace) const {
  std::vector<std::string> words{KINEMESH_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const std::string out = capture_ / "out", err = capture_ / "err";
  const int kept = open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  const pid_t process = fork();
  if (process == 0) {
    if (in_namespace) enter_namespace();
    become_program(folder_.c_str(), out.c_str(), err_file < 0 ? kept : err_file, argv.data());
  }
  close(kept);
  return process;
}

Result ProgramTest::wait(pid_t process) const {
  int status = 0;
  if (waitpid(process, &status, 0) != process) return {};
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, read_text(capture_ / "out"), read_text(capture_ / "err")};
}

Result ProgramTest::run(const std::vector<std::string>& arguments) const {
  return wait(start(arguments));
}

bool ProgramTest::has_terminals() {
  int master = -1, slave = -1;
  if (openpty(&master, &slave, nullptr, nullptr, nullptr) != 0) return false;
  close(slave);
  close(master);
  return true;
}

Result ProgramTest::run_on_terminal(const std::vector<std::string>& arguments, unsigned short columns) const {
  int master = -1, slave = -1;
  const winsize size{24, columns, 0, 0};
  if (openpty(&master, &slave, nullptr, nullptr, &size) != 0) return {};
  fcntl(master, F_SETFD, FD_CLOEXEC);
  const pid_t process = start(arguments, slave);
  close(slave);
  std::string said;
  char buffer[4096];
  for (ssize_t n; (n = read(master, buffer, sizeof buffer)) > 0;) said.append(buffer, n);
  close(master);
  Result result = wait(process);
  result.err = said;
  return result;
}

void ProgramTest::expect_error(const Result& result, int code,
                               std::initializer_list<const char*> words) const {
  EXPECT_EQ(result.code, code) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err_lines().size(), 1u) << result.err;
  EXPECT_EQ(result.err.rfind("kinemesh: ", 0), 0u) << result.err;
  for (const char* word : words)
    EXPECT_NE(result.err.find(word), std::string::npos) << word << " in: " << result.err;
}

std::string grid_off(int n, const std::vector<Move>& moves) {
  std::ostringstream off;
  off << "OFF\n" << (n + 1) * (n + 1) << ' ' << 2 * n * n << " 0\n";
  for (int v = 0; v < (n + 1) * (n + 1); ++v) {
    const auto moved = std::find_if(moves.begin(), moves.end(), [&](const Move& m) { return m.vertex == v; });
    if (moved == moves.end())
      off << v % (n + 1) << ' ' << v / (n + 1) << " 0\n";
    else
      off << moved->x << ' ' << moved->y << " 0\n";
  }
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) {
      const int v = row * (n + 1) + column;
      off << "3 " << v << ' ' << v + 1 << ' ' << v + n + 2 << '\n';
      off << "3 " << v << ' ' << v + n + 2 << ' ' << v + n + 1 << '\n';
    }
  }
  return off.str();
}

}  // namespace kinemesh::testing
