#include "golden/control_variate.h"

#include <array>
#include <cmath>
#include <vector>

#include "number/cpu.h"

namespace sheen::golden {
namespace {

constexpr std::size_t terms = ControlVariate::terms;

struct Node {
  double at, weight;
};

// Gauss-Legendre on [-1, 1], by Newton's method on Legendre's polynomial (NIST DLMF 3.5.18).
std::vector<Node> gauss_legendre(std::size_t degree) {
  const auto count = static_cast<int>(degree);
  std::vector<Node> nodes;
  for (int i = 0; i < count; ++i) {
    double x = std::cos(brdf::pi * (i + 0.75) / (count + 0.5));
    double slope = 1.0;
    for (int pass = 0; pass < 8; ++pass) {
      double before = 1.0;
      double now = x;
      for (int l = 1; l < count; ++l) {
        const double next = ((2 * l + 1) * x * now - l * before) / (l + 1);
        before = now;
        now = next;
      }
      slope = count * (before - x * now) / (1.0 - x * x);
      x -= now / slope;
    }
    nodes.push_back({x, 2.0 / ((1.0 - x * x) * slope * slope)});
  }
  return nodes;
}

// The monomials in the order of the coefficients, at one direction.
std::array<double, terms> monomials(double x, double z) {
  std::array<double, terms> out{};
  std::size_t at = 0;
  for (int i = ControlVariate::degree; i >= 0; --i) {
    for (int j = ControlVariate::degree - i; j >= 0; --j) {
      out[at++] = std::pow(x, i) * std::pow(z, j);
    }
  }
  return out;
}

double product(const std::array<double, terms>& a, const std::array<double, terms>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < terms; ++i) {
    sum += a[i] * b[i];
  }
  return sum;
}

// What turns values at nodes into coefficients, and coefficients into an integral.
struct Projection {
  struct Point {
    double x, y, z, weight;
  };
  std::vector<Point> nodes;  // where a surface is shaded
  std::array<double, terms> to_coefficients[control_nodes];
  SpherePoints sphere{};

  Projection() {
    std::size_t n = 0;
    for (const Node& node : gauss_legendre(SpherePoints::rows)) {
      for (std::size_t k = 0; k < SpherePoints::columns; ++k, ++n) {
        const double azimuth = 2.0 * brdf::pi * static_cast<double>(k) / SpherePoints::columns;
        const double sine = std::sqrt(1.0 - node.at * node.at);
        sphere.x[n] = sine * std::cos(azimuth);
        sphere.y[n] = sine * std::sin(azimuth);
        sphere.z[n] = node.at;
        sphere.weight[n] = node.weight * 2.0 * brdf::pi / SpherePoints::columns;
      }
    }
    const std::vector<std::array<double, terms>> basis = orthonormal_basis();
    // On one side of the plane of N and V, which stands for both.
    constexpr int rows = 8;
    constexpr int columns = 8;
    static_assert(rows * columns == control_nodes);
    for (const Node& node : gauss_legendre(rows)) {
      for (int k = 0; k < columns; ++k) {
        const double cosine = 0.5 * (1.0 + node.at);
        const double sine = std::sqrt(1.0 - cosine * cosine);
        const double azimuth = brdf::pi * (k + 0.5) / columns;
        const Point p{sine * std::cos(azimuth), sine * std::sin(azimuth), cosine, 0.5 * node.weight * 2.0 * brdf::pi / columns};
        const std::array<double, terms> powers = monomials(p.x, p.z);
        std::array<double, terms>& row = to_coefficients[nodes.size()];
        nodes.push_back(p);
        row.fill(0.0);
        for (const std::array<double, terms>& e : basis) {
          const double share = p.weight * product(e, powers);
          for (std::size_t i = 0; i < terms; ++i) {
            row[i] += share * e[i];
          }
        }
      }
    }
  }

 private:
  // Coefficients of polynomials orthonormal over the sphere: Gram and Schmidt's method, each polynomial treated twice against rounding.
  std::vector<std::array<double, terms>> orthonormal_basis() const {
    std::vector<std::array<double, terms>> powers;
    for (std::size_t i = 0; i < SpherePoints::count; ++i) {
      powers.push_back(monomials(sphere.x[i], sphere.z[i]));
    }
    const auto inner = [&](const std::array<double, terms>& a, const std::array<double, terms>& b) {
      double sum = 0.0;
      for (std::size_t i = 0; i < powers.size(); ++i) {
        sum += sphere.weight[i] * product(a, powers[i]) * product(b, powers[i]);
      }
      return sum;
    };
    std::vector<std::array<double, terms>> basis;
    for (std::size_t k = terms; k-- > 0;) {  // lowest powers first
      std::array<double, terms> e{};
      e[k] = 1.0;
      for (int pass = 0; pass < 2; ++pass) {
        for (const std::array<double, terms>& other : basis) {
          const double share = inner(e, other);
          for (std::size_t i = 0; i < terms; ++i) {
            e[i] -= share * other[i];
          }
        }
      }
      const double scale = 1.0 / std::sqrt(inner(e, e));
      for (double& c : e) {
        c *= scale;
      }
      basis.push_back(e);
    }
    return basis;
  }
};

const Projection& projection() {
  static const Projection made;
  return made;
}

// A highlight that falls between nodes would be found too large or not at all; what draws from its own lobe knows it well.
double wide_enough(double alpha) {
  constexpr double least = 0.1;
  return alpha < least ? 0.0 : alpha;
}

NodeValues node_values(const Surface<double>& surface, Layers layers, const Lighting& lighting) {
#if defined(__x86_64__) || defined(__i386__)
  if (number::has_batch()) {
    return node_values_batch(surface, layers, lighting);
  }
#endif
  return node_values_scalar(surface, layers, lighting);
}

}  // namespace

NodeValues node_values_scalar(const Surface<double>& surface, Layers layers, const Lighting& lighting) {
  return node_values<double>(surface, layers, lighting);
}

ControlVariate control_variate(const Surface<double>& surface, Layers layers, const Lighting& lighting) {
  const Projection& p = projection();
  ControlVariate out;
  out.z = surface.normal;
  const Vec3<double> flat = surface.view - surface.normal * dot(surface.view, surface.normal);
  const Vec3<double> axis = std::abs(out.z.x) < 0.7 ? Vec3<double>{1, 0, 0} : Vec3<double>{0, 1, 0};
  const Vec3<double> x = dot(flat, flat) > 1e-12 ? flat : cross(axis, out.z);
  out.x = x * (1.0 / std::sqrt(dot(x, x)));
  Surface<double> smooth = surface;
  smooth.base.alpha = wide_enough(surface.base.alpha);
  smooth.coat_alpha = wide_enough(surface.coat_alpha);
  out.y = cross(out.z, out.x);
  alignas(64) double world[3][control_nodes];
  alignas(64) double one[control_nodes];
  for (std::size_t i = 0; i < control_nodes; ++i) {
    const Vec3<double> d = out.x * p.nodes[i].x + out.y * p.nodes[i].y + out.z * p.nodes[i].z;
    world[0][i] = d.x;
    world[1][i] = d.y;
    world[2][i] = d.z;
    one[i] = 1.0;
  }
  const DistantLights lights{world[0], world[1], world[2], one, one, one};
  Lighting at_nodes = lighting;
  at_nodes.distant = &lights;
  const NodeValues values = node_values(smooth, layers, at_nodes);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t n = 0; n < control_nodes; ++n) {
      for (std::size_t i = 0; i < terms; ++i) {
        out.coefficients[c][i] += values.value[c][n] * p.to_coefficients[n][i];
      }
    }
  }
  return out;
}

brdf::Rgb<double> integral(const ControlVariate& control, const BandLimited& light) {
#if defined(__x86_64__) || defined(__i386__)
  if (number::has_batch()) {
    return integral_batch(control, light, projection().sphere);
  }
#endif
  return integral_scalar(control, light, projection().sphere);
}

brdf::Rgb<double> integral_scalar(const ControlVariate& control, const BandLimited& light, const SpherePoints& points) {
  return integral<double>(control, light, points);
}

}  // namespace sheen::golden
