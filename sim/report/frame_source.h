// The frames of a run, one after the other, from whatever it has written. Internal to sim/report/.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "kinemesh/types.h"

namespace kinemesh::report {

// A face and its corners from now on; {0, 0, 0}: it is not of the domain.
struct FaceEdit {
  int face;
  Triangle corners;
};

// Faces that one step has replaced together, and the regions they were.
struct PatchEdit {
  std::vector<int> regions;
  std::vector<FaceEdit> faces;
};

struct Frame {
  int step = 0;
  double time = 0.0;
  std::vector<Point> positions;    // of all vertices
  std::vector<FaceEdit> silent;    // what came before this step's patches
  std::vector<PatchEdit> patches;  // of this step
};

struct StartMesh {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  std::vector<int> labels;
};

class FrameSource {
 public:
  virtual ~FrameSource() = default;
  virtual const StartMesh& start() const = 0;
  virtual std::optional<Frame> next() = 0;  // the first is the start; ascending steps
  virtual bool has_every_step() const = 0;  // with patches; otherwise the meshes written
};

// From patches.bin, or else from mesh_NNNNNN.vtu; nothing where there is neither. times: of steps, where
// known.
std::unique_ptr<FrameSource> open_frames(const std::filesystem::path& directory,
                                         const std::map<int, double>& times);

}  // namespace kinemesh::report
