// From a file to the end of the first step, against reading the file and all numbers in it.
#include <fmt/format.h>
#include <unistd.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "aims.h"
#include "core/base/stopwatch.h"
#include "kinemesh/build.h"
#include "kinemesh/mesh_io.h"
#include "kinemesh/motion.h"
#include "kinemesh/shapes.h"
#include "kinemesh/stepper.h"
#include "motion/fields/rigid.h"
#include "sim/step/threads.h"

namespace kinemesh::aims {
namespace {

namespace fs = std::filesystem;

constexpr int repeats = 3;

// A folder that is gone in the end.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / fmt::format("kinemesh_aims_{}", ::getpid())) {
    fs::create_directory(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// As text, which is what most programs write; ours writes binary data.
std::string text_vtu(const MeshData& mesh) {
  std::string text = fmt::format(
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n"
      "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n",
      mesh.n_vertices(), mesh.n_faces());
  auto out = std::back_inserter(text);
  for (const Point& p : mesh.points) fmt::format_to(out, "{} {} 0\n", p.x, p.y);
  text +=
      "</DataArray>\n</Points>\n<Cells>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">\n";
  for (const auto& t : mesh.triangles) fmt::format_to(out, "{} {} {}\n", t[0], t[1], t[2]);
  text += "</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">\n";
  for (int i = 1; i <= mesh.n_faces(); ++i) fmt::format_to(out, "{}\n", 3 * i);
  text += "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n";
  for (int i = 0; i < mesh.n_faces(); ++i) text += "5\n";
  return text + "</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

std::string content(const fs::path& path) {
  std::string text(fs::file_size(path), '\0');
  std::ifstream(path, std::ios::binary).read(text.data(), static_cast<std::streamsize>(text.size()));
  return text;
}

// What `cat` and a parser of floats do: the sum of everything that reads as a number.
double read_numbers(const fs::path& path) {
  const std::string text = content(path);
  const char* const end = text.data() + text.size();
  double sum = 0.0;
  for (const char* at = text.data(); at != end;) {
    double value;
    const auto [behind, error] = std::from_chars(at, end, value);
    if (error == std::errc()) sum += value;
    at = error == std::errc() ? behind : at + 1;
  }
  return sum;
}

void first_step(const fs::path& path, int n) {
  Mesh mesh = build_mesh(read_mesh(path).mesh);
  if (mesh.n_user_vertices() != n) throw std::logic_error("another mesh came back");
  const auto rotor = std::make_shared<Rotor>(Point(0.5, 0.5), 0.3, std::numbers::pi / 180.0);
  const Motion motion(mesh, {{rotor, {}}});
  Stepper stepper(std::move(mesh));
  const auto outcome = stepper.step(motion, 1.0);
  if (outcome.defect) throw std::runtime_error(outcome.defect->message());
}

void measure(const std::string& what, const fs::path& path, int n) {
  std::vector<double> starts, reads;
  volatile double sum = 0.0;
  for (int i = 0; i < repeats; ++i) {
    const Stopwatch reading;
    sum = sum + read_numbers(path);
    reads.push_back(reading.milliseconds());
    const Stopwatch starting;
    first_step(path, n);
    starts.push_back(starting.milliseconds());
  }
  report({"start to first step / reading the numbers: " + what, Aim::Kind::AtMost, 2.0,
          median(starts) / median(reads),
          fmt::format("{:.3g} MB; {:.4g} ms; reading {:.4g} ms; all cores",
                      1e-6 * static_cast<double>(fs::file_size(path)), median(starts), median(reads))});
}

}  // namespace

void first_step_of_file(int n) {
  const MeshData mesh = make_square(n);
  const Folder folder;
  const fs::path su2 = folder.path() / "square.su2", vtu = folder.path() / "square.vtu";
  write_mesh(su2, mesh);
  std::ofstream(vtu, std::ios::binary) << text_vtu(mesh);
  measure("SU2", su2, n);
  measure("VTU", vtu, n);
}

}  // namespace kinemesh::aims
