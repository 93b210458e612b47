// Mesh files on the command line: what every command that reads or writes one has in common.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "kinemesh/build.h"
#include "kinemesh/mesh_data.h"

namespace kinemesh::cli {

struct MeshInput {
  std::string path;
  bool split_quads = false;
};

// The positional argument `name` and --split-quads.
void add_mesh_input(CLI::App& command, MeshInput& input, const std::string& name = "MESH");

// Reads the file and prints the reader's notes. Throws InputError.
MeshData read(const MeshInput& input);

// build_mesh of what was read; its InputErrors get the file's name, NoEmbedding stays as it is.
Mesh build(const MeshInput& input, const MeshData& data);

// Throws InputError if no writer knows the extension: before the work, not after it.
void require_writable(const std::string& path);

// Prints a note for what the path's format cannot keep. Pre: require_writable.
void note_losses(const std::string& path, const MeshData& data);

}  // namespace kinemesh::cli
