// kinemesh: the command-line program. Contract of its exit codes and messages: docs/command_line.md.
#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <system_error>

#include "kinemesh/error.h"
#include "sim/cli/commands.h"
#include "sim/cli/console.h"
#include "sim/cli/launcher.h"

namespace kinemesh::cli {
namespace {

// A file opened while stdout or stderr is closed would take its number, and our messages.
void occupy_standard_files() {
  for (int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(number, F_GETFD) == -1)
      (void)open("/dev/null", O_RDONLY);  // takes the lowest number that is free
  }
}

// A file that exceeds its limit is an error like a full disk, no reason to be killed.
void take_file_limits_as_errors() {
  std::signal(SIGXFSZ, SIG_IGN);
}

std::string command_names(const CLI::App& program) {
  std::string names;
  for (const CLI::App* command : program.get_subcommands({})) names += " " + command->get_name();
  return names;
}

// The mistake in a sentence, and whose help tells more.
void explain(const CLI::App& program, const std::string& mistake) {
  const auto chosen = program.get_subcommands();
  const std::string command = chosen.empty() ? "" : chosen.front()->get_name();
  const std::vector<std::string> unknown = program.remaining();
  if (!command.empty())
    print_error(fmt::format("{}: {}; see kinemesh {} --help", command, mistake, command));
  else if (!unknown.empty())
    print_error(
        fmt::format("{}: no such command, expected one of{}", unknown.front(), command_names(program)));
  else
    print_error(fmt::format("no command, expected one of{}; see kinemesh --help", command_names(program)));
}

// CLI11 has an exit code for every kind of mistake; ours is one.
int answer_to(const CLI::App& program, const CLI::ParseError& error) {
  if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) return program.exit(error);
  explain(program, error.what());
  return bad_input;
}

// Output that did not arrive (a full disk behind a redirection) must not look like success. lack: what the
// command returns for a lack of resources other than memory.
int after_flush(int code, int lack) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
  print_error("cannot write to standard output");
  return code == done ? lack : code;
}

int perform(const Action& action, int lack) try {
  return after_flush(action(), lack);
} catch (const InputError& error) {
  print_error(error.what());
  return bad_input;
} catch (const ResourceError& error) {
  print_error(error.what());
  return lack;
} catch (const std::bad_alloc&) {
  print_error("out of memory");
  return lacking;
} catch (const std::system_error& error) {  // by fmt::print, for one
  print_error(std::ferror(stdout) != 0 ? "cannot write to standard output" : error.what());
  return lack;
} catch (const std::exception& error) {
  print_error(fmt::format("internal error: {}", error.what()));
  return internal;
}

int run_program(int argc, char** argv) {
  CLI::App program("Moves the vertices of planar triangle meshes and untangles them locally.", "kinemesh");
  Action action;
  program.set_version_flag("--version", "kinemesh " KINEMESH_VERSION);
  program.require_subcommand(1);
  program.footer(
      "Exit codes: 0 done; 1 the mesh is not valid, or no valid mesh exists, or the run had to stop;\n"
      "2 bad input or usage, and nothing was written; 3 memory has run out, or in other commands than\n"
      "run another resource; 4 internal error.");
  add_run(program, action, {argv, argv + argc});
  add_replay(program, action);
  add_bench(program, action);
  add_check(program, action);
  add_untangle(program, action);
  add_convert(program, action);
  add_report(program, action);
  add_draw(program, action);
  add_list(program, action);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return after_flush(answer_to(program, error), lacking);
  }
  if (refuse_several(program)) return bad_input;
  return perform(action, program.got_subcommand("run") ? not_valid : lacking);
}

}  // namespace
}  // namespace kinemesh::cli

int main(int argc, char** argv) {
  kinemesh::cli::occupy_standard_files();
  kinemesh::cli::take_file_limits_as_errors();
  return kinemesh::cli::run_program(argc, argv);
}
