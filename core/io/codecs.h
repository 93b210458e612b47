// The readers and writers of the formats, one pair each; mesh_io.cpp chooses among them.
#pragma once

#include <string>
#include <string_view>

#include "kinemesh/mesh_io.h"

namespace kinemesh::io {

// OFF: header OFF or COFF, counts on the same line or the next; comments from #; colours are skipped.
ReadResult read_off(std::string_view text, const std::string& file, const ReadOptions& options);
std::string write_off(const MeshData& mesh);

// OBJ: v and f (v, v/vt, v//vn, v/vt/vn, negative numbers). Groups, materials, normals, texture coordinates,
// points and polylines are skipped; any other statement is refused.
ReadResult read_obj(std::string_view text, const std::string& file, const ReadOptions& options);
std::string write_obj(const MeshData& mesh);

// ASCII PLY: elements vertex (x, y, perhaps z) and face (vertex_indices or vertex_index), other properties
// and elements are skipped by their declared types.
ReadResult read_ply(std::string_view text, const std::string& file, const ReadOptions& options);
std::string write_ply(const MeshData& mesh);

// SU2, two-dimensional, one zone. Halo markers (SEND_RECEIVE), periodicity and deformation boxes are skipped
// with a note.
ReadResult read_su2(std::string_view text, const std::string& file, const ReadOptions& options);
std::string write_su2(const MeshData& mesh);

// Gmsh 2.2 and 4.1, ASCII. Physical curves are markers, without a name they are called by their number; a
// face's label is the number of its physical surface, 0 where it is in none. Written as 2.2, labels as they
// are: Gmsh itself only shows positive ones.
ReadResult read_gmsh(std::string_view text, const std::string& file, const ReadOptions& options);
std::string write_gmsh(const MeshData& mesh);

// VTU: one piece; ascii, base64 and appended data, plain or compressed by zlib, little endian. Vertex and
// line cells are skipped with a note. The cell data `label` and what kinemesh/vtu.h writes beside it is
// restored.
ReadResult read_vtu(std::string_view text, const std::string& file, const ReadOptions& options);

}  // namespace kinemesh::io
