// patches.bin: where every vertex went and what each step of a run replaced, before and after, so that every
// step can be shown, not only those whose mesh was written. The layout is in docs/formats.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "kinemesh/mesh.h"
#include "kinemesh/step_changes.h"
#include "sim/run/csv_log.h"

namespace kinemesh {

// The domain at the start of a run; vertices and faces by the user's numbers.
struct PatchesStart {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  std::vector<int> labels;
};

// A ChangedPatch as arrays, one entry per face. Labels are padding_label where a face is not of the domain.
struct FacePatch {
  std::vector<int> regions;
  std::vector<int> faces;
  std::vector<Triangle> before, after;
  std::vector<int> label_before, label_after;
};

struct PatchesStep {
  int step = 0;
  double time = 0.0;
  std::vector<int> moved;        // vertices; empty and as many positions as vertices: all
  std::vector<Point> positions;  // theirs after the step
  std::vector<FacePatch> patches;
};

// How long a folder's patches.bin is up to the end of a step; reads all of it up to there. Throws InputError
// if the step is not in it.
std::uint64_t patches_length_up_to(const std::filesystem::path& directory, int step);

class PatchesWriter {
 public:
  PatchesWriter(const std::filesystem::path& directory, const Mesh& initial);  // a new file

  // Goes on behind so many bytes, and drops what comes after them.
  PatchesWriter(const std::filesystem::path& directory, std::uint64_t length);

  void note(const StepChanges& changes);  // an observer's: remembers the step, writes nothing
  void write();                           // what was noted last; whole, or InputError and nothing of it
  void flush() { file_.flush(); }         // to the disk
  void take_back() noexcept { file_.shorten(before_); }  // what came after the last note

 private:
  LineFile file_;
  std::string noted_;
  std::uint64_t before_ = 0;  // length without what was noted last
};

// Reads a file from its start on, a step at a time. A last step that is not whole, as a killed run may leave
// it, is not there. Throws InputError naming the file: missing, no patches.bin, of another version, damaged.
class PatchesReader {
 public:
  explicit PatchesReader(const std::filesystem::path& file);

  const PatchesStart& start() const { return start_; }
  std::optional<PatchesStep> next();
  std::uint64_t position() const { return position_; }  // bytes read: where the next step starts

 private:
  std::optional<std::string> block();
  [[noreturn]] void fail(const std::string& what) const;
  void check(const PatchesStep& step);

  std::filesystem::path path_;
  std::ifstream stream_;
  std::uint64_t size_ = 0, position_ = 0;
  PatchesStart start_;
};

}  // namespace kinemesh
