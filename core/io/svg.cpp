#include "kinemesh/svg.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/printable.h"
#include "core/io/svg_frame.h"
#include "core/io/text_buffer.h"
#include "core/io/writable.h"
#include "core/io/xml.h"
#include "kinemesh/error.h"
#include "kinemesh/predicates.h"

namespace kinemesh {
namespace {

using io::TextBuffer;

// Light enough for lines on top, and none near the amber and red of marked faces. By rank of the label.
constexpr std::array<const char*, 6> label_colours{"#e6edf5", "#dcebdf", "#e9e2f2",
                                                   "#d8ebee", "#efe9e1", "#e3e3e8"};
constexpr const char* replaced_colour = "#ffcf5c";
constexpr const char* inverted_colour = "#e02f36";
constexpr const char* line_colour = "#7d8ea3";
constexpr const char* constrained_colour = "#1d2733";
constexpr double band_height = 40.0;      // of the title and legend, in pixels
constexpr std::size_t most_title = 1000;  // characters: more take long to be drawn, and cannot be seen

struct Side {
  Edge ends;  // ascending
  int face;   // none: of a marker
};

class Drawing {
 public:
  Drawing(const MeshData& mesh, const SvgOptions& options)
      : mesh_(mesh),
        options_(options),
        frame_(options.view ? *options.view : io::whole_view(mesh), options.width) {
    for (const Point& p : mesh.points) pixels_.push_back(frame_.pixel(p));
    sort_faces();
    sort_edges();
  }

  std::string draw() {
    begin();
    fill_labels();
    fill(replaced_, replaced_colour, 1.0);
    if (options_.draw_edges) stroke(plain_edges_, line_colour, thin());
    draw_marked();
    stroke(constrained_edges_, constrained_colour, 1.6);
    svg_ << "</g>\n";
    write_band();
    svg_ << "</svg>\n";
    return svg_.take();
  }

 private:
  void sort_faces() {
    std::map<int, std::size_t> rank;
    for (int f = 0; f < mesh_.n_faces(); ++f) rank.emplace(mesh_.label(f), 0);
    std::size_t n = 0;
    for (auto& [label, number] : rank) number = n++;
    for (int f = 0; f < mesh_.n_faces(); ++f) {
      if (is_visible(f)) sort_face(f, rank.at(mesh_.label(f)) % label_colours.size());
    }
  }
  void sort_face(int face, std::size_t colour) {
    const Triangle& t = mesh_.triangles[face];
    const Orientation turn = orientation(mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]);
    if (turn == Orientation::Clockwise) {
      inverted_.push_back(face);
    } else if (turn == Orientation::Collinear) {
      flat_.push_back(face);
    } else {
      (is_replaced(face) ? replaced_ : by_label_[colour]).push_back(face);
    }
  }
  bool is_replaced(int face) const { return !options_.replaced.empty() && options_.replaced[face] != 0; }
  bool is_visible(int face) const {
    const auto [a, b, c] = mesh_.triangles[face];
    const auto [left, right] = std::minmax({pixels_[a].x, pixels_[b].x, pixels_[c].x});
    const auto [top, bottom] = std::minmax({pixels_[a].y, pixels_[b].y, pixels_[c].y});
    return right >= 0 && left <= frame_.width() && bottom >= 0 && top <= frame_.height();
  }

  // Each edge is drawn once: sides next to each other after sorting belong together.
  void sort_edges() {
    std::vector<Side> sides;
    const auto add = [&](int a, int b, int face) {
      sides.push_back({{std::min(a, b), std::max(a, b)}, face});
    };
    for (int f = 0; f < mesh_.n_faces(); ++f) {
      const Triangle& t = mesh_.triangles[f];
      for (int k = 0; k < 3; ++k) add(t[k], t[(k + 1) % 3], f);
    }
    for (const Marker& marker : mesh_.markers) {
      for (const Edge& e : marker.edges) add(e[0], e[1], none);
    }
    std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) { return s.ends < t.ends; });
    for (std::size_t i = 0, end; i < sides.size(); i = end) {
      end = i + 1;
      while (end < sides.size() && sides[end].ends == sides[i].ends) ++end;
      sort_edge({&sides[i], end - i});
    }
  }
  void sort_edge(std::span<const Side> sides) {
    if (!is_visible(sides[0].ends)) return;
    const auto is_other = [&](const Side& s) {
      return s.face == none || (sides[0].face != none && mesh_.label(s.face) != mesh_.label(sides[0].face));
    };
    const bool is_constrained = sides.size() == 1 || std::any_of(sides.begin(), sides.end(), is_other);
    (is_constrained ? constrained_edges_ : plain_edges_).push_back(sides[0].ends);
  }

  void begin() {
    svg_
        << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << frame_.width() << "\" height=\""
        << total_height() << "\" viewBox=\"0 0 " << frame_.width() << ' ' << total_height()
        << "\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n<clipPath id=\"view\"><rect width=\""
        << frame_.width() << "\" height=\"" << frame_.height()
        << "\"/></clipPath>\n<g transform=\"translate(0 " << band()
        << ")\" clip-path=\"url(#view)\" fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\n";
  }
  bool has_band() const { return !options_.title.empty() || !legend().empty(); }
  double band() const { return has_band() ? band_height : 0.0; }
  double total_height() const { return frame_.height() + band(); }

  void fill_labels() {
    for (std::size_t i = 0; i < by_label_.size(); ++i) fill(by_label_[i], label_colours[i], 1.0);
  }

  // One path for all: no seams between neighbours. All wind the same way, so that none cancels another.
  void fill(const std::vector<int>& faces, const char* colour, double opacity) {
    if (faces.empty()) return;
    svg_ << "<path fill=\"" << colour << '"';
    if (opacity != 1.0) svg_ << " fill-opacity=\"" << opacity << '"';
    write_faces(faces);
  }
  void outline(const std::vector<int>& faces, double line_width) {
    if (faces.empty()) return;
    begin_stroke(inverted_colour, line_width);
    write_faces(faces);
  }
  void stroke(const std::vector<Edge>& edges, const char* colour, double line_width) {
    if (edges.empty()) return;
    begin_stroke(colour, line_width);
    svg_ << " d=\"";
    for (const Edge& e : edges) {
      svg_ << 'M';
      write_pixel(e[0]);
      svg_ << 'L';
      write_pixel(e[1]);
    }
    svg_ << "\"/>\n";
  }
  void begin_stroke(const char* colour, double line_width) {
    svg_ << "<path stroke=\"" << colour << "\" stroke-width=\"" << line_width
         << "\" vector-effect=\"non-scaling-stroke\"";
  }
  bool is_visible(const Edge& e) const {
    const Point &p = pixels_[e[0]], &q = pixels_[e[1]];
    return std::max(p.x, q.x) >= 0 && std::min(p.x, q.x) <= frame_.width() && std::max(p.y, q.y) >= 0 &&
           std::min(p.y, q.y) <= frame_.height();
  }
  void write_faces(const std::vector<int>& faces) {
    svg_ << " d=\"";
    for (int f : faces) {
      char command = 'M';
      for (int v : mesh_.triangles[f]) {
        svg_ << std::exchange(command, 'L');
        write_pixel(v);
      }
      svg_ << 'Z';
    }
    svg_ << "\"/>\n";
  }
  void write_pixel(int vertex) {
    write_number(pixels_[vertex].x);
    svg_ << ' ';
    write_number(pixels_[vertex].y);
  }
  void write_number(double x) {
    char digits[32];
    constexpr int precision = 7;  // of a pixel's coordinates; leaves room to zoom in
    const auto end =
        std::to_chars(digits, digits + sizeof digits, x, std::chars_format::general, precision).ptr;
    svg_ << std::string_view(digits, static_cast<std::size_t>(end - digits));
  }

  // Thinner lines where edges are short, so that fine meshes do not turn grey.
  double thin() const {
    double sum = 0;
    for (const Edge& e : plain_edges_)
      sum += std::hypot(pixels_[e[0]].x - pixels_[e[1]].x, pixels_[e[0]].y - pixels_[e[1]].y);
    const double mean = plain_edges_.empty() ? 0 : sum / static_cast<double>(plain_edges_.size());
    return std::round(100 * std::clamp(0.05 * mean, 0.12, 0.8)) / 100;
  }

  void draw_marked() {
    fill(inverted_, inverted_colour, 0.6);
    outline(inverted_, 1.0);
    outline(flat_, 2.0);
  }

  // Title on the left, what the colours mean on the right.
  std::string legend() const {
    std::string text;
    const auto add = [&](std::size_t n, const std::string& what, const char* colour) {
      if (n == 0) return;
      if (!text.empty()) text += "&#160;&#160; ";
      text += std::string("<tspan fill=\"") + colour + "\">&#9632;</tspan> " + std::to_string(n) + ' ' + what;
    };
    add(replaced_.size(), io::xml_text(printable(options_.replaced_label, most_title)), replaced_colour);
    add(inverted_.size(), "inverted", inverted_colour);
    add(flat_.size(), "degenerate", inverted_colour);
    return text;
  }
  void write_band() {
    if (!has_band()) return;
    svg_ << "<g font-family=\"Helvetica, Arial, sans-serif\" font-size=\"16\" fill=\"" << constrained_colour
         << "\">\n"
         << "<text x=\"12\" y=\"26\">" << io::xml_text(printable(options_.title, most_title))
         << "</text>\n<text x=\"" << frame_.width() - 12 << "\" y=\"26\" text-anchor=\"end\">" << legend()
         << "</text>\n</g>\n";
  }

  const MeshData& mesh_;
  const SvgOptions& options_;
  io::SvgFrame frame_;
  std::vector<Point> pixels_;  // per vertex
  std::array<std::vector<int>, label_colours.size()> by_label_;
  std::vector<int> replaced_, inverted_, flat_;
  std::vector<Edge> plain_edges_, constrained_edges_;
  TextBuffer svg_;
};

void check_view(const ViewBox& view) {
  if (is_finite(view.lower) && is_finite(view.upper) && view.lower.x < view.upper.x &&
      view.lower.y < view.upper.y)
    return;
  throw InputError("the view has no inside");
}

}  // namespace

std::string format_svg(const MeshData& mesh, const SvgOptions& options) {
  io::check_writable(mesh);
  io::check_length(options.replaced.size(), mesh.triangles.size(), "flags of replaced faces");
  if (!(options.width > 0) || !std::isfinite(options.width))
    throw InputError("the width is not a positive number");
  if (options.view) check_view(*options.view);
  return Drawing(mesh, options).draw();
}

void write_svg(const std::filesystem::path& path, const MeshData& mesh, const SvgOptions& options) {
  io::write_content(path, [&] { return format_svg(mesh, options); });
}

}  // namespace kinemesh
