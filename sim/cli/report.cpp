#include "sim/report/report.h"

#include <fmt/core.h>

#include <memory>

#include "core/io/atomic_file.h"
#include "sim/cli/commands.h"
#include "sim/cli/console.h"
#include "sim/cli/numbers.h"

namespace kinemesh::cli {
namespace {

struct ReportArguments {
  std::string directory, output;
  report::ReportOptions options;
};

int make_report(const ReportArguments& arguments) {
  const std::filesystem::path directory = arguments.directory;
  const std::filesystem::path output =
      arguments.output.empty() ? directory / "report.html" : std::filesystem::path(arguments.output);
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
