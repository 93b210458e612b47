#include "sim/report/frame_source.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "kinemesh/mesh_io.h"
#include "sim/run/patches.h"
#include "sim/run/run_directory.h"

namespace kinemesh::report {
namespace {

namespace fs = std::filesystem;

class PatchFrames : public FrameSource {
 public:
  explicit PatchFrames(const fs::path& file)
      : reader_(file),
        start_{reader_.start().points, reader_.start().triangles, reader_.start().labels},
        points_(start_.points) {}

  const StartMesh& start() const override { return start_; }
  bool has_every_step() const override { return true; }

  std::optional<Frame> next() override {
    if (std::exchange(is_first_, false)) return Frame{0, 0.0, points_, {}, {}};
    const auto step = reader_.next();
    if (!step) return std::nullopt;
    move(*step);
    Frame frame{step->step, step->time, points_, {}, {}};
    for (const FacePatch& patch : step->patches) frame.patches.push_back(edits_of(patch));
    return frame;
  }

 private:
  void move(const PatchesStep& step) {
    if (step.moved.empty() && !step.positions.empty()) points_ = step.positions;
    for (std::size_t i = 0; i < step.moved.size(); ++i) points_[step.moved[i]] = step.positions[i];
  }

  static PatchEdit edits_of(const FacePatch& patch) {
    PatchEdit edit{patch.regions, {}};
    for (std::size_t i = 0; i < patch.faces.size(); ++i) {
      const bool is_outside = patch.label_after[i] == padding_label;
      edit.faces.push_back({patch.faces[i], is_outside ? Triangle{0, 0, 0} : patch.after[i]});
    }
    return edit;
  }

  PatchesReader reader_;
  StartMesh start_;
  std::vector<Point> points_;
  bool is_first_ = true;
};

class MeshFrames : public FrameSource {
 public:
  MeshFrames(std::map<int, fs::path> files, std::map<int, double> times)
      : files_(std::move(files)), times_(std::move(times)), at_(files_.begin()) {
    const MeshData mesh = read_mesh(at_->second).mesh;
    start_ = {mesh.points, mesh.triangles, mesh.labels};
    start_.labels.resize(start_.triangles.size(), 0);
    triangles_ = start_.triangles;
  }

  const StartMesh& start() const override { return start_; }
  bool has_every_step() const override { return false; }

  std::optional<Frame> next() override {
    if (at_ == files_.end()) return std::nullopt;
    const auto& [step, file] = *at_++;
    const MeshData mesh = read_mesh(file).mesh;
    if (mesh.points.size() != start_.points.size())
      throw InputError(file.string(), 0, "as many vertices as in the first mesh of the run expected");
    const auto time = times_.find(step);
    return Frame{step, time == times_.end() ? step : time->second, mesh.points, differences(mesh), {}};
  }

 private:
  std::vector<FaceEdit> differences(const MeshData& mesh) {
    std::vector<FaceEdit> edits;
    const std::size_t n = std::max(mesh.triangles.size(), triangles_.size());
    triangles_.resize(n, {0, 0, 0});
    for (std::size_t f = 0; f < n; ++f) {
      const Triangle now = f < mesh.triangles.size() ? mesh.triangles[f] : Triangle{0, 0, 0};
      if (now != triangles_[f]) edits.push_back({static_cast<int>(f), now});
      triangles_[f] = now;
    }
    return edits;
  }

  std::map<int, fs::path> files_;
  std::map<int, double> times_;
  std::map<int, fs::path>::const_iterator at_;
  StartMesh start_;
  std::vector<Triangle> triangles_;
};

// By the numbers of their steps.
std::map<int, fs::path> meshes_in(const fs::path& directory) {
  std::map<int, fs::path> files;
  for (const auto& entry : fs::directory_iterator(directory)) {
    const std::string name = entry.path().filename().string();
    int step = -1;
    if (name.starts_with("mesh_") && name.ends_with(".vtu"))
      std::from_chars(name.data() + 5, name.data() + name.size() - 4, step);
    if (step >= 0 && name == mesh_file_name(step)) files[step] = entry.path();
  }
  return files;
}

}  // namespace

std::unique_ptr<FrameSource> open_frames(const fs::path& directory, const std::map<int, double>& times) {
  if (fs::exists(directory / "patches.bin")) return std::make_unique<PatchFrames>(directory / "patches.bin");
  auto files = meshes_in(directory);
  if (files.empty()) return nullptr;
  return std::make_unique<MeshFrames>(std::move(files), times);
}

}  // namespace kinemesh::report
