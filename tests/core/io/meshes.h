// Meshes and checks that the tests of readers and writers share.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "kinemesh/mesh_io.h"

namespace kinemesh {

// Two triangles of the unit square, with awkward coordinates, labels, and a marker at the bottom.
MeshData square();

// A grid with faces left out, coordinates of all magnitudes, labels of all int32 and markers; consistently
// wound.
MeshData random_mesh(std::uint64_t seed);

// The same to the last bit in what the format keeps.
::testing::AssertionResult same(const MeshData& a, const MeshData& b, Format keeping = Format::Vtu);

// What the format cannot keep taken away.
MeshData as_kept(MeshData mesh, Format format);

ReadResult parse(std::string_view text, Format format, bool split_quads = false);

// Parsing fails with "test:LINE: ..." (line 0: "test: ...") and a message that has `what` in it.
void expect_refused(std::string_view text, Format format, int line, std::string_view what,
                    bool split_quads = false);

// A folder of its own for each test, removed at its end.
class TemporaryFolder : public ::testing::Test {
 protected:
  TemporaryFolder();
  ~TemporaryFolder() override;
  std::filesystem::path folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

}  // namespace kinemesh
