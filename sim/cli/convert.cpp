#include <memory>

#include "sim/cli/commands.h"
#include "sim/cli/file_arguments.h"
#include "sim/cli/mesh_arguments.h"

namespace kinemesh::cli {
namespace {

struct ConvertArguments {
  MeshInput input;
  std::string output;
};

int convert(const ConvertArguments& arguments) {
  require_writable(arguments.output);
  check_files({{"IN", arguments.input.path}}, {{"OUT", arguments.output}});
  stage_mesh(arguments.output, read(arguments.input)).commit();
  return done;
}

}  // namespace

void add_convert(CLI::App& program, Action& action) {
  const auto arguments = std::make_shared<ConvertArguments>();
  CLI::App& command = *program.add_subcommand("convert", "Write a mesh in another format");
  add_mesh_input(command, arguments->input, "IN");
  command
      .add_option("OUT", arguments->output,
                  "File to write; its extension names the format, .svg is a drawing")
      ->required();
  command.footer(
      "Vertices and faces keep their order, coordinates every bit; labels and markers are kept where the\n"
      "format can. In a drawing inverted and flat faces are red.");
  command.callback([arguments, &action] { action = [arguments] { return convert(*arguments); }; });
}

}  // namespace kinemesh::cli
