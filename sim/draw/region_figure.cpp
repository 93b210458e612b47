#include "sim/draw/region_figure.h"

#include <fmt/core.h>

#include <algorithm>

#include "core/io/svg_frame.h"
#include "kinemesh/predicates.h"
#include "untangle/explore/local_exploration.h"
#include "untangle/walk/detect.h"

namespace kinemesh::draw {
namespace {

using Polygon = std::vector<Point>;

constexpr const char *red = "#d55e00", *blue = "#0072b2", *amber = "#e69f00", *green = "#009e73";
constexpr double gap = 16.0, title_height = 24.0;  // pixels

// Not of the frame's corners, which are far away.
ViewBox view_of(const Mesh& mesh, const std::vector<Face>& region) {
  std::vector<Point> points;
  for (const Face face : region)
    for (const Vertex v : mesh.triangles()[face])
      if (mesh.user_vertex(v) != none) points.push_back(mesh.position(v));
  Point low = points.front(), high = low;
  for (const Point& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const Point half(0.6 * std::max(high.x - low.x, high.y - low.y));
  return {0.5 * (low + high) - half, 0.5 * (low + high) + half};
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
  explicit Drawing(const RegionFigure& figure)
      : figure_(figure),
        view_(figure.view ? *figure.view : view_of(figure.before, figure.region)),
        frame_(view_, 0.5 * (figure.width - gap)) {}

  std::string draw() {
    draw_tangle();
    draw_shadow();
    draw_old_faces();
    draw_new_faces();
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n{2}</svg></g>\n</svg>\n",
        figure_.width, 2.0 * (frame_.height() + gap + title_height), svg_);
  }

 private:
  void draw_tangle() {
    start_picture("The tangle: inverted triangles");
    lines(figure_.before, 0.4);
    for (const Face face : detect(figure_.before).inverted)
      fill(figure_.before, face, red, face == figure_.seed ? 0.9 : 0.4);
  }

  void draw_shadow() {
    const Mesh& mesh = figure_.before;
    LocalExploration exploration(mesh);
    if (figure_.is_local && figure_.seed != none && exploration.run(figure_.seed) &&
        exploration.faces() == figure_.region) {
      const ConvexPieces& x = exploration.shadow();
      start_picture(exploration.grown() > 0 ? "The shadow X at first, and what growing adds"
                                            : "Their shadow X, as far as the region goes");
      lines(mesh, 0.2);
      int n_first = 0;  // later pieces that are no overlaps are of components that growing has met
      while (n_first < x.size() && !x[n_first].is_grown()) ++n_first;
      for (int i = n_first; i < x.size(); ++i)
        if (x[i].is_grown()) fill(outline(x[i]), blue, 0.15);
      for (int i = 0; i < n_first; ++i) fill(outline(x[i]), red, 0.8);
      return;
    }
    start_picture("Their shadow X");
    lines(mesh, 0.2);
    for (const Face face : figure_.region)
      if (is_inverted(mesh, face)) fill(mesh, face, red, 0.8);
  }

  void draw_old_faces() {
    const std::size_t n = figure_.region.size();
    start_picture(fmt::format("R*: {} triangles go, drawn over each other", n));
    for (const Face face : figure_.region) fill(figure_.before, face, amber, 0.3);
    lines(figure_.before, 0.4);
  }

  void draw_new_faces() {
    const auto tangles = detect(figure_.after).inverted;
    start_picture(tangles.empty() ? "The new triangles" : "The new triangles; tangles elsewhere stay");
    for (const Face face : figure_.region) fill(figure_.after, face, green, 0.4);
    for (const Face face : tangles) fill(figure_.after, face, red, 0.35);
    lines(figure_.after, 0.4);
  }

  static bool is_inverted(const Mesh& mesh, Face face) {
    const auto [a, b, c] = mesh.corners(face);
    return orientation(a, b, c) == Orientation::Clockwise;
  }

  void start_picture(const std::string& title) {
    const double x = n_pictures_ % 2 * (frame_.width() + gap);
    const double y = n_pictures_ / 2 * (frame_.height() + gap + title_height);
    if (n_pictures_++ > 0) svg_ += "</svg></g>\n";
    svg_ += fmt::format(
        "<g transform=\"translate({:.2f},{:.2f})\"><text y=\"16\" font-family=\"sans-serif\" "
        "font-size=\"15\">{}</text>\n<svg y=\"{}\" width=\"{:.2f}\" height=\"{:.2f}\">"
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        x, y, title, title_height, frame_.width(), frame_.height());
  }

  void fill(const Mesh& mesh, Face face, const char* colour, double opacity) {
    const auto corners = mesh.corners(face);
    fill({corners.begin(), corners.end()}, colour, opacity);
  }
  void fill(const Polygon& polygon, const char* colour, double opacity) {
    add(polygon, fmt::format("fill=\"{}\" fill-opacity=\"{}\"", colour, opacity));
  }
  void lines(const Mesh& mesh, double width) {
    for (const Face face : mesh.faces()) {
      if (mesh.is_padding(face)) continue;
      const auto corners = mesh.corners(face);
      add({corners.begin(), corners.end()},
          fmt::format("fill=\"none\" stroke=\"#333\" stroke-width=\"{}\"", width));
    }
  }

  bool is_visible(const Polygon& polygon) const {
    const auto all = [&](const auto& is_beyond) { return std::ranges::all_of(polygon, is_beyond); };
    return !all([&](const Point& p) { return p.x < view_.lower.x; }) &&
           !all([&](const Point& p) { return p.x > view_.upper.x; }) &&
           !all([&](const Point& p) { return p.y < view_.lower.y; }) &&
           !all([&](const Point& p) { return p.y > view_.upper.y; });
  }
  void add(const Polygon& polygon, const std::string& style) {
    if (polygon.empty() || !is_visible(polygon)) return;
    svg_ += "<path d=\"";
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point pixel = frame_.pixel(polygon[i]);
      svg_ += fmt::format("{}{:.2f} {:.2f}", i == 0 ? "M" : "L", pixel.x, pixel.y);
    }
    svg_ += "Z\" " + style + "/>\n";
  }

  const RegionFigure& figure_;
  ViewBox view_;
  io::SvgFrame frame_;  // of a picture
  int n_pictures_ = 0;
  std::string svg_;
};

}  // namespace

std::string format_region_figure(const RegionFigure& figure) {
  return Drawing(figure).draw();
}

}  // namespace kinemesh::draw
