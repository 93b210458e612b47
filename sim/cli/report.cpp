#include "sim/report/report.h"

#include <fmt/core.h>

#include <memory>

#include "core/io/atomic_file.h"
#include "sim/cli/commands.h"
#include "sim/cli/console.h"
#include "sim/cli/file_arguments.h"
#include "sim/cli/numbers.h"
#include "sim/run/run_directory.h"

namespace kinemesh::cli {
namespace {

struct ReportArguments {
  std::string directory, output;
  report::ReportOptions options;
};

namespace fs = std::filesystem;

bool is_inside(const fs::path& path, const fs::path& directory) {
  std::error_code ignored;
  for (fs::path folder = fs::absolute(path).parent_path(); folder.has_relative_path();
       folder = folder.parent_path())
    if (fs::equivalent(folder, directory, ignored)) return true;
  return false;
}

// Nothing in the folder is replaced but a page like the one to come.
void check(const fs::path& output, const fs::path& directory) {
  require_none_of_run(output, directory);
  require_place_for(output);
  if (is_inside(output, directory) && fs::exists(output) && !is_report(output))
    throw InputError(output.string(), 0, "is no page of kinemesh report, and not replaced; -o names another");
  remove_leftovers(fs::absolute(output).parent_path());
}

int make_report(const ReportArguments& arguments) {
  const fs::path directory = arguments.directory;
  const fs::path output = arguments.output.empty() ? directory / "report.html" : fs::path(arguments.output);
  if (fs::is_directory(directory)) check(output, directory);
  const report::Report made = report::make_report(directory, arguments.options);
  for (const std::string& text : made.notes) print_note(text);
  write_file_atomically(output, made.html);
  print_line(fmt::format("written: {}, {:.1f} MB; open it in a browser", output.string(),
                         static_cast<double>(made.html.size()) / 1e6));
  return done;
}

}  // namespace

void add_report(CLI::App& program, Action& action) {
  const auto arguments = std::make_shared<ReportArguments>();
  CLI::App& command =
      *program.add_subcommand("report", "Show a run or a benchmark as one HTML page to open and send");
  command.add_option("DIR", arguments->directory, "Folder that a run or a benchmark has written to")
      ->required();
  command.add_option("-o,--output", arguments->output, "File to write; default: DIR/report.html");
  command.add_option("--max-size", arguments->options.max_megabytes, "Megabytes the page may have")
      ->transform(number_within(0.0, 1000.0))
      ->capture_default_str();
  command.footer(
      "The page plays the mesh with what each step replaced and plots the logs; it needs no network.\n"
      "Every step can be played after a run with [output] patches = true, otherwise the meshes written.\n"
      "What does not fit into --max-size is thinned out, and the page says so.");
  command.callback([arguments, &action] { action = [arguments] { return make_report(*arguments); }; });
}

}  // namespace kinemesh::cli
