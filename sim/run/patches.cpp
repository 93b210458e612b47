#include "sim/run/patches.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "kinemesh/error.h"
#include "sim/run/binary.h"

namespace kinemesh {

// For binary::Writer and binary::Reader.
template <class Archive, class S>
requires binary::Is<S, PatchesStart>
void members(Archive& archive, S& start) {
  archive(start.points, start.triangles, start.labels);
}

template <class Archive, class S>
requires binary::Is<S, FacePatch>
void members(Archive& archive, S& patch) {
  archive(patch.regions, patch.faces, patch.before, patch.after, patch.label_before, patch.label_after);
}

template <class Archive, class S>
requires binary::Is<S, PatchesStep>
void members(Archive& archive, S& step) {
  archive(step.step, step.time, step.moved, step.positions, step.patches);
}

namespace {

constexpr std::string_view magic = "KMPATCH\n";
constexpr std::uint32_t version = 1;
constexpr std::uint64_t head_size = magic.size() + sizeof version;

using binary::bytes_of;

// LineFile adds the line feed that ends every block.
template <class T>
std::string block_of(const T& thing) {
  const std::string payload = bytes_of(thing);
  return bytes_of(std::uint64_t{payload.size()}) + payload;
}

PatchesStart start_of(const Mesh& mesh) {
  MeshData data = mesh.domain();
  data.labels.resize(data.triangles.size(), 0);
  return {std::move(data.points), std::move(data.triangles), std::move(data.labels)};
}

FacePatch arrays_of(const ChangedPatch& changed) {
  FacePatch patch;
  patch.regions = changed.regions;
  for (const FaceChange& change : changed.faces) {
    patch.faces.push_back(change.face);
    patch.before.push_back(numbers_of(change.before));
    patch.after.push_back(numbers_of(change.after));
    patch.label_before.push_back(change.label_before);
    patch.label_after.push_back(change.label_after);
  }
  return patch;
}

bool is_same(const Point& a, const Point& b) {
  return a.x == b.x && a.y == b.y;
}

// A list of the moved ones pays where it is shorter than all positions.
void add_positions(const StepChanges& changes, PatchesStep& step) {
  const int n = changes.mesh.n_user_vertices();
  for (const UserVertex v : Numbers<UserVertex>(n))
    if (!is_same(changes.before(v), changes.after(v))) step.moved.push_back(v);
  if (step.moved.size() * 20 >= static_cast<std::size_t>(n) * 16) {
    step.moved.clear();
    step.positions = changes.mesh.user_positions();
  } else {
    for (const int v : step.moved) step.positions.push_back(changes.after(UserVertex(v)));
  }
}

}  // namespace

std::uint64_t patches_length_up_to(const std::filesystem::path& directory, int last) {
  const auto file = directory / "patches.bin";
  PatchesReader reader(file);
  if (last == 0) return reader.position();
  while (const auto step = reader.next())
    if (step->step == last) return reader.position();
  throw InputError(file.string(), 0,
                   "does not reach step " + std::to_string(last) + ", from which the run is to go on");
}

PatchesWriter::PatchesWriter(const std::filesystem::path& directory, const Mesh& initial)
    : file_(directory / "patches.bin", std::string(magic) + bytes_of(version) + block_of(start_of(initial))),
      before_(file_.length()) {}

PatchesWriter::PatchesWriter(const std::filesystem::path& directory, std::uint64_t length)
    : file_(directory / "patches.bin", length), before_(file_.length()) {}

void PatchesWriter::note(const StepChanges& changes) {
  PatchesStep step;
  step.step = changes.step;
  step.time = changes.time;
  add_positions(changes, step);
  for (const ChangedPatch& patch : changes.patches) step.patches.push_back(arrays_of(patch));
  noted_ = block_of(step);
  before_ = file_.length();
}

void PatchesWriter::write() {
  file_.write(noted_);
}

PatchesReader::PatchesReader(const std::filesystem::path& file)
    : path_(file), stream_(file, std::ios::binary) {
  if (!stream_) fail("cannot be read");
  std::error_code error;
  size_ = std::filesystem::file_size(path_, error);
  std::string head(head_size, '\0');
  stream_.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (error || !stream_ || !head.starts_with(magic)) fail("is no patches.bin of a run");
  if (const std::string expected = bytes_of(version); !head.ends_with(expected))
    fail("has another version of the layout, " + std::to_string(version) + " expected");
  position_ = head_size;
  const auto first = block();
  if (!first) fail("ends before the mesh at the start");
  try {
    start_ = binary::parsed<PatchesStart>(*first);
  } catch (const InputError& what) {
    fail(std::string("is damaged: ") + what.what());
  }
  const int n = static_cast<int>(start_.points.size());
  const auto is_wrong = [n](int v) { return v < 0 || v >= n; };
  if (start_.labels.size() != start_.triangles.size()) fail("is damaged: not one label per face");
  for (const Triangle& t : start_.triangles)
    if (std::ranges::any_of(t, is_wrong)) fail("is damaged: a face with a vertex that is not there");
  if (!std::ranges::all_of(start_.points, is_finite)) fail("is damaged: a vertex at no finite place");
}

void PatchesReader::fail(const std::string& what) const {
  throw InputError(path_.string(), 0, what);
}

// Nothing at the end, or where the rest is not a whole block.
std::optional<std::string> PatchesReader::block() {
  std::uint64_t n = 0;
  std::string length(sizeof n, '\0');
  if (size_ - position_ < sizeof n + 1) return std::nullopt;
  stream_.read(length.data(), sizeof n);
  binary::Reader reader(length);
  reader(n);
  if (n > size_ - position_ - sizeof n - 1) return std::nullopt;
  std::string payload(n + 1, '\0');
  stream_.read(payload.data(), static_cast<std::streamsize>(payload.size()));
  if (!stream_ || payload.back() != '\n') fail("is damaged at byte " + std::to_string(position_));
  payload.pop_back();
  position_ += sizeof n + n + 1;
  return payload;
}

std::optional<PatchesStep> PatchesReader::next() {
  const auto start = position_;
  const auto bytes = block();
  if (!bytes) return std::nullopt;
  try {
    auto step = binary::parsed<PatchesStep>(*bytes);
    check(step);
    return step;
  } catch (const InputError& what) {
    fail("is damaged at byte " + std::to_string(start) + ": " + what.what());
  }
}

void PatchesReader::check(const PatchesStep& step) {
  const int n = static_cast<int>(start_.points.size());
  const auto expect = [](bool is_right) {
    if (!is_right) throw InputError("numbers that do not fit together");
  };
  expect(step.positions.size() ==
         (step.moved.empty() && !step.positions.empty() ? start_.points.size() : step.moved.size()));
  expect(std::ranges::all_of(step.positions, is_finite));
  expect(std::ranges::all_of(step.moved, [n](int v) { return 0 <= v && v < n; }));
  // Frame corners are none; padding faces are numbered behind the domain's, as many as a planar mesh can
  // have.
  const auto is_face = [n](int f) { return 0 <= f && f < 2 * n + 16; };
  const auto is_triangle = [n](const Triangle& t) {
    return std::ranges::all_of(t, [n](int v) { return none <= v && v < n; });
  };
  for (const FacePatch& patch : step.patches) {
    const auto size = patch.faces.size();
    expect(patch.before.size() == size && patch.after.size() == size && patch.label_before.size() == size &&
           patch.label_after.size() == size);
    expect(std::ranges::all_of(patch.faces, is_face));
    expect(std::ranges::all_of(patch.before, is_triangle) && std::ranges::all_of(patch.after, is_triangle));
  }
}

}  // namespace kinemesh
