#include "albedo/interpolant.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "albedo/chebyshev.h"
#include "albedo/coordinates.h"
#include "albedo/directional_albedo.h"

namespace sheen::albedo {
namespace {

constexpr int nodes = Curve::nodes;  // a side of a patch
constexpr double patch_x = Curve::patch_x;
constexpr double patch_y = 0.7;
constexpr int patches_x = Curve::patches;
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

  // The values at the nodes of x for one y.
  Nodes row(double t_y) const {
    const Nodes sy = chebyshev().shares(t_y);
    Nodes values{};
    for (int j = 0; j < nodes; ++j) {
      for (int i = 0; i < nodes; ++i) {
        values[i] += sy[j] * h[j][i];
      }
    }
    return values;
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

  const Patch& patch(int ix, int iy) {
    Patch& patch = patches[iy][ix];
    std::call_once(patch.made, [&] { make(patch, ix, iy); });
    return patch;
  }

  void make(Patch& patch, int ix, int iy) const {
    const auto x_of = [ix](double t) { return -patch_x * (Curve::start_of(ix) + Curve::length_of(ix) * (1 - t) / 2); };
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
  const int ix = Curve::patch_at(u), iy = std::min(static_cast<int>(v), patches_y - 1);
  const Patch& patch = impl_->patch(ix, iy);
  if (!patch.usable) {
    return directional_albedo(impl_->visibility, cosine_of(t), r);
  }
  return std::exp(patch.at(1 - 2 * (u - Curve::start_of(ix)) / Curve::length_of(ix), 1 - 2 * (v - iy)) - drop);
}

std::array<Interpolant::Triple, 3> Interpolant::grid(const Triple& n_dot_v, const Triple& sheen_roughness) const {
  std::array<Triple, 3> e{};
  const double least_r = *std::min_element(sheen_roughness.begin(), sheen_roughness.end());
  const double largest_r = std::min(*std::max_element(sheen_roughness.begin(), sheen_roughness.end()), 1.0);
  Triple t{}, log_peak{};
  for (std::size_t i = 0; i < 3; ++i) {
    t[i] = half_elevation_tangent(std::min(std::max(n_dot_v[i], min_n_dot_v), 1.0));
    log_peak[i] = log_peak_drop(t[i], 1.0);
  }
  if (!(largest_r > 0) || !(*std::min_element(log_peak.begin(), log_peak.end()) < negligible_drop * largest_r * largest_r)) {
    return e;
  }
  Triple place_x{}, place_y{};
  for (std::size_t i = 0; i < 3; ++i) {
    place_x[i] = std::log(t[i]) / -patch_x;
    place_y[i] = least_r > 0 ? std::log(std::min(sheen_roughness[i], 1.0)) / -patch_y : 0;
  }
  const auto same = [](int a, int b, int c) { return a == b && b == c; };
  const auto row_at = [](double v) { return v < patches_y ? static_cast<int>(v) : patches_y - 1; };
  const int ix = Curve::patch_at(place_x[0]), iy = row_at(place_y[0]);
  const Patch* patch = nullptr;
  if (least_r > 0 && same(ix, Curve::patch_at(place_x[1]), Curve::patch_at(place_x[2])) &&
      same(iy, row_at(place_y[1]), row_at(place_y[2]))) {
    patch = &impl_->patch(ix, iy);
  }
  if (patch == nullptr || !patch->usable) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t i = 0; i < 3; ++i) {
        e[j][i] = (*this)(n_dot_v[i], sheen_roughness[j]);
      }
    }
    return e;
  }
  std::array<Nodes, 3> rows;
  for (std::size_t j = 0; j < 3; ++j) {
    rows[j] = patch->row(1 - 2 * (place_y[j] - iy));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const Nodes shares = chebyshev().shares(1 - 2 * (place_x[i] - Curve::start_of(ix)) / Curve::length_of(ix));
    for (std::size_t j = 0; j < 3; ++j) {
      const double r = std::min(sheen_roughness[j], 1.0);
      const double drop = log_peak[i] * (1 / (r * r));
      double h = 0;
      for (int k = 0; k < nodes; ++k) {
        h += shares[k] * rows[j][k];
      }
      e[j][i] = drop < negligible_drop ? std::exp(h - drop) : 0;
    }
  }
  return e;
}

Curve Interpolant::at_roughness(double sheen_roughness) const {
  const double r = std::min(sheen_roughness, 1.0);
  Curve curve(*this, r);
  if (!(r > 0)) {
    return curve;
  }
  const double v = std::log(r) / -patch_y;
  const int iy = std::min(static_cast<int>(v), patches_y - 1);
  for (int ix = 0; ix < patches_x; ++ix) {
    // The least T of the patch: where the drop is least.
    if (!(log_peak_drop(std::exp(-patch_x * (Curve::start_of(ix) + Curve::length_of(ix))), r) < negligible_drop)) {
      continue;
    }
    const Patch& patch = impl_->patch(ix, iy);
    curve.usable_ = curve.usable_ && patch.usable;
    const Nodes values = patch.row(1 - 2 * (v - iy));
    for (int power = 0; power < nodes; ++power) {
      for (int i = 0; i < nodes; ++i) {
        curve.powers_[ix][power] += chebyshev().powers[power][i] * values[i];
      }
    }
  }
  return curve;
}

double Curve::slowly(double n_dot_v) const {
  return (*interpolant_)(n_dot_v, sheen_roughness_);
}

}  // namespace sheen::albedo
