// The umbilic: rings of vertices, placed where the construction of [Agarwal 2008, Lemma 2.6] folds them.
#include <complex>
#include <string>

#include "core/shapes/shape_parts.h"
#include "kinemesh/shapes.h"

namespace kinemesh {
namespace {

using Complex = std::complex<double>;

constexpr double border_radius = 4.0;  // beyond all folds: the image of the disk stays within 2
constexpr double innermost = 0.38;     // first ring of the disk, in units of e
constexpr double small_circle = 2.2;   // last ring of the plane, in units of that ring's image
constexpr double turned_by = 0.1;      // radians; no edge is left parallel to an axis
constexpr int vertices_per_k = 189;    // the coarsest mesh: 9 k sectors of 21 rings

// The umbilic map, and how many rings of how many vertices show it.
struct Umbilic {
  int k, sectors;
  int plane, outwards, inwards;  // rings of the three parts; a vertex in the centre follows
  double e, slope;               // slope = k e^(k-1)

  int n_rings() const { return plane + outwards + inwards; }
  Complex operator()(Complex z) const { return std::pow(z, k) + slope * std::conj(z); }
};

Umbilic make(int k, int vertices) {
  const double refinement = std::sqrt((vertices - 1.0) / (vertices_per_k * k));
  const auto sectors = static_cast<int>(std::lround(9.0 * k * refinement));
  const auto n = static_cast<int>(std::lround((vertices - 1.0) / sectors));
  const int plane = n / 3, outwards = (n - plane + 1) / 2;
  // |z| = 1 maps to a curve that stays 1 - k e^(k-1) away from the origin: well outside the cusps, (k+1) e^k
  // away.
  const double e = std::pow(7.0 * (k + 1), -1.0 / k);
  return {k, sectors, plane, outwards, n - plane - outwards, e, k * std::pow(e, k - 1)};
}

// |z| of ring i of n from `first` to beyond 1, ring n being the unit circle. Two fifths of the rings are for
// |z| < e. None lies on e, where faces are nearly flat: the nearest is a fifth of a step below.
double disk_radius(double first, double e, int i, int n) {
  const int inner = std::max(2, static_cast<int>(std::lround(0.4 * n)));
  const double last_inner = e * (1.0 - 0.2 * (1.0 - innermost) / inner);
  if (i <= inner) return first + (last_inner - first) * i / inner;
  return std::pow(last_inner, static_cast<double>(n - i) / (n - inner));
}

// Ring 0 is the border.
Complex position(const Umbilic& f, int ring, double turns) {
  const double angle = 2.0 * std::numbers::pi * turns, first = innermost * f.e;
  if (ring < f.plane) {
    const double shrink = small_circle * f.slope * first / border_radius;
    return std::polar(border_radius * std::pow(shrink, static_cast<double>(ring) / (f.plane - 1)), angle);
  }
  const int out = ring - f.plane, back = f.n_rings() - ring;
  const double radius = out < f.outwards ? disk_radius(first, f.e, out, f.outwards - 1)
                                         : disk_radius(0.0, f.e, back, f.inwards + 1);
  return f(std::polar(radius, -angle));
}

void place_vertices(MeshData& mesh, const Umbilic& f, UniformRandom& random) {
  const double jitter = 0.02 * std::pow(f.e, f.k) / f.n_rings();
  const auto add = [&](Complex z, double amount) {
    z *= std::polar(1.0, turned_by);
    const double dx = random.between(-amount, amount);
    mesh.points.emplace_back(z.real() + dx, z.imag() + random.between(-amount, amount));
  };
  for (int ring = 0; ring < f.n_rings(); ++ring) {
    for (int i = 0; i < f.sectors; ++i)
      add(position(f, ring, static_cast<double>(i) / f.sectors), ring == 0 ? 0.0 : jitter);
  }
  add(0.0, jitter);
}

void connect_vertices(MeshData& mesh, const Umbilic& f, UniformRandom& random) {
  const auto vertex = [&](int ring, int i) { return ring * f.sectors + i % f.sectors; };
  for (int ring = 0; ring + 1 < f.n_rings(); ++ring) {
    for (int i = 0; i < f.sectors; ++i) {
      const int a = vertex(ring, i), b = vertex(ring, i + 1), c = vertex(ring + 1, i),
                d = vertex(ring + 1, i + 1);
      if (random.in_unit() < 0.5) {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {b, d, c}});
      } else {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {a, d, c}});
      }
    }
  }
  const int last = f.n_rings() - 1, centre = f.n_rings() * f.sectors;
  for (int i = 0; i < f.sectors; ++i)
    mesh.triangles.push_back({vertex(last, i), vertex(last, i + 1), centre});
  mesh.markers.push_back({"border", {}});
  for (int i = 0; i < f.sectors; ++i) mesh.markers[0].edges.push_back({i, vertex(0, i + 1)});
}

}  // namespace

MeshData make_umbilic(int k, int vertices, std::uint64_t seed) {
  if (k < 2 || k > 32) throw InputError("umbilic: k = " + std::to_string(k) + ", expected 2 to 32");
  require_vertices("umbilic with k = " + std::to_string(k), vertices, vertices_per_k * k + 1);
  const Umbilic f = make(k, vertices);
  UniformRandom random(seed);
  MeshData mesh;
  place_vertices(mesh, f, random);
  connect_vertices(mesh, f, random);
  return mesh;
}

}  // namespace kinemesh
