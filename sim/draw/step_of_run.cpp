#include "sim/draw/step_of_run.h"

#include <algorithm>

#include "kinemesh/error.h"
#include "sim/run/patches.h"

namespace kinemesh::draw {
namespace {

// The faces of the domain and others that vertices may have brought into it, by their numbers.
struct Faces {
  std::vector<Triangle> corners;
  std::vector<int> labels;
  std::vector<std::uint8_t> replaced = {};  // by the last step
  std::vector<int> last = {};               // those it has replaced

  void apply(const PatchesStep& step) {
    for (const int face : last) replaced[face] = 0;
    last.clear();
    for (const FacePatch& patch : step.patches) apply(patch);
  }

  void apply(const FacePatch& patch) {
    for (std::size_t i = 0; i < patch.faces.size(); ++i) {
      const auto face = static_cast<std::size_t>(patch.faces[i]);
      if (face >= corners.size()) {
        corners.resize(face + 1, {none, none, none});
        labels.resize(face + 1, padding_label);
        replaced.resize(face + 1, 0);
      }
      corners[face] = patch.after[i];
      labels[face] = patch.label_after[i];
      replaced[face] = 1;
      last.push_back(patch.faces[i]);
    }
  }
};

void move(const PatchesStep& step, std::vector<Point>& points) {
  if (step.moved.empty() && !step.positions.empty()) points = step.positions;
  for (std::size_t i = 0; i < step.moved.size(); ++i) points[step.moved[i]] = step.positions[i];
}

}  // namespace

StepOfRun step_of_run(const std::filesystem::path& directory, int step) {
  const auto file = directory / "patches.bin";
  if (!std::filesystem::exists(file))
    throw InputError(directory.string(), 0, "patches.bin expected in it: run with --set output.patches=true");
  PatchesReader reader(file);
  StepOfRun found;
  found.mesh.points = reader.start().points;
  Faces faces{reader.start().triangles, reader.start().labels};
  faces.replaced.resize(faces.corners.size(), 0);
  for (int last = 0; last < step;) {
    const auto next = reader.next();
    if (!next || next->step > step)
      throw InputError(file.string(), 0,
                       "no step " + std::to_string(step) + ", the last before it is " + std::to_string(last));
    move(*next, found.mesh.points);
    faces.apply(*next);
    last = next->step;
    found.time = next->time;
  }
  for (std::size_t f = 0; f < faces.corners.size(); ++f) {
    if (faces.labels[f] == padding_label || std::ranges::count(faces.corners[f], none) > 0) continue;
    found.mesh.triangles.push_back(faces.corners[f]);
    found.mesh.labels.push_back(faces.labels[f]);
    found.replaced.push_back(faces.replaced[f]);
  }
  return found;
}

}  // namespace kinemesh::draw
