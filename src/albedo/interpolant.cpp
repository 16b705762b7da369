#include "albedo/interpolant.h"

#include <array>
#include <cmath>
#include <mutex>

#include "albedo/chebyshev.h"
#include "albedo/coordinates.h"
#include "albedo/directional_albedo.h"

namespace sheen::albedo {
namespace {

constexpr int nodes = 12;                  // a side of a patch
constexpr double patch_x = -branch_x / 2;  // so that the branch point is a border
constexpr double patch_y = 0.7;
constexpr int patches_x = 16;            // down to mu = 5e-5
constexpr int patches_y = 18;            // down to r = 3.4e-6, where E is negligible for every mu >= min_n_dot_v
constexpr double accepted_error = 3e-7;  // of E, relative or absolute, whichever is less

using Rule1D = Chebyshev<nodes>;
using Nodes = Rule1D::Nodes;

const Rule1D& chebyshev() {
  return Rule1D::instance();
}

struct Patch {
  std::once_flag made;
  bool usable = false;
  std::array<Nodes, nodes> h;  // [y][x]

  double at(double t_x, double t_y) const {
    const Nodes sx = chebyshev().shares(t_x), sy = chebyshev().shares(t_y);
    double value = 0;
    for (int j = 0; j < nodes; ++j) {
      double row = 0;
      for (int i = 0; i < nodes; ++i) {
        row += sx[i] * h[j][i];
      }
      value += sy[j] * row;
    }
    return value;
  }
};

}  // namespace

struct Interpolant::Impl {
  Visibility visibility;
  std::array<std::array<Patch, patches_x>, patches_y> patches;

  explicit Impl(Visibility v) : visibility(v) {}

  double direct(double x, double y) const {
    const double t = std::exp(std::min(x, 0.0)), r = std::exp(std::min(y, 0.0));
    return log_directional_albedo(visibility, cosine_of(t), r) + log_peak_drop(t, r);
  }

  void make(Patch& patch, int ix, int iy) const {
    const auto x_of = [ix](double t) { return -patch_x * (ix + (1 - t) / 2); };
    const auto y_of = [iy](double t) { return -patch_y * (iy + (1 - t) / 2); };
    for (int j = 0; j < nodes; ++j) {
      for (int i = 0; i < nodes; ++i) {
        patch.h[j][i] = direct(x_of(chebyshev().node[i]), y_of(chebyshev().node[j]));
      }
    }
    // The proof: the largest error of a Chebyshev interpolant lies between its outermost nodes and the border, or in the middle.
    patch.usable = true;
    for (const auto& [t_x, t_y] : {std::pair{0.99, 0.99}, {-0.99, -0.99}, {0.99, -0.99}, {-0.99, 0.99}, {0.0, 0.0}}) {
      const double x = x_of(t_x), y = y_of(t_y);
      const double exact = direct(x, y);
      const double e = std::exp(std::min(0.0, exact - log_peak_drop(std::exp(x), std::exp(y))));
      if (!(std::abs(std::expm1(patch.at(t_x, t_y) - exact)) * e <= accepted_error)) {
        patch.usable = false;
      }
    }
  }
};

Interpolant::Interpolant(Visibility visibility) : impl_(std::make_unique<Impl>(visibility)) {}
Interpolant::~Interpolant() = default;
Interpolant::Interpolant(Interpolant&&) noexcept = default;
Interpolant& Interpolant::operator=(Interpolant&&) noexcept = default;

double Interpolant::operator()(double n_dot_v, double sheen_roughness) const {
  const double t = half_elevation_tangent(std::min(std::max(n_dot_v, min_n_dot_v), 1.0));
  const double r = std::min(sheen_roughness, 1.0);
  if (!(r > 0)) {
    return 0;
  }
  const double drop = log_peak_drop(t, r);
  if (!(drop < negligible_drop)) {
    return 0;
  }
  const double u = std::log(t) / -patch_x, v = std::log(r) / -patch_y;  // in patches
  const int ix = std::min(static_cast<int>(u), patches_x - 1), iy = std::min(static_cast<int>(v), patches_y - 1);
  Patch& patch = impl_->patches[iy][ix];
  std::call_once(patch.made, [&] { impl_->make(patch, ix, iy); });
  if (!patch.usable) {
    return directional_albedo(impl_->visibility, cosine_of(t), r);
  }
  return std::exp(patch.at(1 - 2 * (u - ix), 1 - 2 * (v - iy)) - drop);
}

}  // namespace sheen::albedo
