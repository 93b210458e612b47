// Draws a local repair in four pictures: the tangle; the shadow X, red at first and blue where it grows;
// R*, the faces that go; and the new ones.
//
//   example_draw_region jitter|umbilic OUT.svg
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <stdexcept>
#include <string>

#include "core/build.h"
#include "core/io/atomic_file.h"
#include "core/predicates.h"
#include "core/shapes.h"
#include "untangle/detect.h"
#include "untangle/local.h"

namespace {

using namespace kinemesh;
using Polygon = std::vector<Point>;

constexpr const char *red = "#d55e00", *blue = "#0072b2", *amber = "#e69f00", *green = "#009e73";
constexpr double size = 480.0, gap = 16.0;  // of a picture, and between two, in pixels

Polygon shadow(const Mesh& mesh, int face) {
  const auto corners = mesh.corners(face);
  return {corners.begin(), corners.end()};
}

// What lies on the left of a -> b, to draw.
Polygon left_of(const Point& a, const Point& b, const Polygon& polygon) {
  const auto distance = [&](const Point& p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); };
  Polygon left;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double u = distance(p), w = distance(q);
    if (u >= 0.0) left.push_back(p);
    if ((u >= 0.0) != (w >= 0.0)) left.push_back(p + u / (u - w) * (q - p));
  }
  return left;
}

Polygon outline(const ConvexPiece& piece) {
  Polygon polygon(piece.shadows[0].begin(), piece.shadows[0].end());
  if (!piece.is_grown()) return polygon;
  const auto& [a, b, c] = piece.shadows[1];  // upright
  return left_of(c, a, left_of(b, c, left_of(a, b, polygon)));
}

class Drawing {
 public:
  Drawing(const Mesh& mesh, const std::vector<int>& region)
      : low_(mesh.corners(region.front())[0]), high_(low_) {
    for (const int face : region) {
      for (const Point& p : mesh.corners(face)) {
        low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
        high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
      }
    }
    const Point middle = 0.5 * (low_ + high_);
    const double half = 0.6 * std::max(high_.x - low_.x, high_.y - low_.y);
    low_ = middle - Point(half);
    high_ = middle + Point(half);
  }

  void start_picture(const std::string& title) {
    const double x = n_pictures_ % 2 * (size + gap), y = n_pictures_ / 2 * (size + gap + 24.0);
    if (n_pictures_++ > 0) svg_ += "</svg></g>\n";
    svg_ += fmt::format(
        "<g transform=\"translate({},{})\"><text y=\"16\" font-family=\"sans-serif\" "
        "font-size=\"15\">{}</text>\n"
        "<svg y=\"24\" width=\"{}\" height=\"{}\"><rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        x, y, title, size, size);
  }

  void fill(const Polygon& polygon, const char* colour, double opacity) {
    add(polygon, fmt::format("fill=\"{}\" fill-opacity=\"{}\"", colour, opacity));
  }

  void lines(const Mesh& mesh, double width) {
    for (int face = 0; face < mesh.n_faces(); ++face) {
      add(shadow(mesh, face), fmt::format("fill=\"none\" stroke=\"#333\" stroke-width=\"{}\"", width));
    }
  }

  std::string finish() const {
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n{2}</svg></g>\n</svg>\n",
        2.0 * size + gap, 2.0 * (size + gap + 24.0), svg_);
  }

 private:
  void add(const Polygon& polygon, const std::string& style) {
    svg_ += "<path d=\"";
    const double scale = size / (high_.x - low_.x);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      svg_ += fmt::format("{}{:.2f} {:.2f}", i == 0 ? "M" : "L", scale * (polygon[i].x - low_.x),
                          scale * (high_.y - polygon[i].y));
    }
    svg_ += "Z\" " + style + "/>\n";
  }

  Point low_, high_;
  int n_pictures_ = 0;
  std::string svg_;
};

// Inner vertices at random within a square of the given half width.
Mesh jittered(int vertices, double step, unsigned seed) {
  Mesh mesh = build_mesh(make_square(vertices, seed));
  std::mt19937 random(seed);
  const auto uniform = [&] { return step * (2.0 * static_cast<double>(random()) / 0xffffffffu - 1.0); };
  for (int v = 0; v < mesh.n_vertices(); ++v) {
    if (!mesh.is_constrained(v)) mesh.positions()[v] += Point(uniform(), uniform());
  }
  return mesh;
}

// An inverted face of the component whose region, of no more than so many faces, is the most telling.
int choose_seed(const Mesh& mesh, std::size_t most) {
  int best = none, most_grown = -1;
  std::size_t largest = 0;
  const auto inverted = detect(mesh).inverted;
  const auto components = inverted_components(mesh, inverted);
  std::vector<bool> is_tried(components.count, false);
  for (std::size_t i = 0; i < inverted.size(); ++i) {
    const int seed = inverted[i];
    if (is_tried[components.of[i]]) continue;
    is_tried[components.of[i]] = true;
    LocalExploration exploration(mesh);
    if (!exploration.run(seed)) continue;
    const std::size_t n = exploration.faces().size();
    if (n > most || std::pair(exploration.grown(), n) <= std::pair(most_grown, largest)) continue;
    best = seed;
    most_grown = exploration.grown();
    largest = n;
  }
  return best;
}

void draw(Mesh mesh, std::size_t most, const std::string& file) {
  const int seed = choose_seed(mesh, most);
  if (seed == none) throw std::runtime_error("no region of that size");
  LocalExploration exploration(mesh);
  if (!exploration.run(seed)) throw std::runtime_error("degenerate");
  const auto region = exploration.faces();
  Drawing drawing(mesh, region);

  drawing.start_picture("The tangle: inverted triangles, the seed darker");
  drawing.lines(mesh, 0.4);
  for (const int face : detect(mesh).inverted)
    drawing.fill(shadow(mesh, face), red, face == seed ? 0.9 : 0.35);

  drawing.start_picture("The shadow X at first, and what growing adds");
  drawing.lines(mesh, 0.2);
  const auto& x = exploration.shadow();
  int at_first = 0;
  while (at_first < x.size() && !x[at_first].is_grown()) ++at_first;
  for (int i = at_first; i < x.size(); ++i) {
    if (x[i].is_grown()) drawing.fill(outline(x[i]), blue, 0.15);
  }
  for (int i = 0; i < at_first; ++i) drawing.fill(outline(x[i]), red, 0.8);

  drawing.start_picture(fmt::format("R*: {} triangles go, drawn over each other", region.size()));
  for (const int face : region) drawing.fill(shadow(mesh, face), amber, 0.3);
  drawing.lines(mesh, 0.4);

  const std::vector<int> seeds{seed};
  LocalUntangling local;
  if (const auto outcome = local.repair_seeds(mesh, seeds, {}); !outcome)
    throw std::runtime_error(outcome.defect->message());
  drawing.start_picture("The new triangles; tangles elsewhere stay");
  for (const int face : region) drawing.fill(shadow(mesh, face), green, 0.4);
  for (const int face : detect(mesh).inverted) drawing.fill(shadow(mesh, face), red, 0.35);
  drawing.lines(mesh, 0.4);
  write_file_atomically(file, drawing.finish());
  std::printf("seed %d: %zu triangles replaced, %d inverted components, %d pieces grown\n",
              mesh.user_face(seed), region.size(), exploration.components(), exploration.grown());
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string kind = argc == 3 ? argv[1] : "";
  if (kind == "jitter") {
    draw(jittered(400, 0.04, 3), 60, argv[2]);
  } else if (kind == "umbilic") {
    draw(build_mesh(make_umbilic(2, 400)), 2000, argv[2]);
  } else {
    throw std::runtime_error("jitter|umbilic OUT.svg expected");
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "example_draw_region: %s\n", error.what());
  return 1;
}
