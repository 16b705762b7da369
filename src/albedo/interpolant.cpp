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

double between(const Nodes& values, const Nodes& shares) {
  double sum = 0;
  for (int i = 0; i < nodes; ++i) {
    sum += shares[i] * values[i];
  }
  return sum;
}

struct Patch {
  std::once_flag made;
  bool usable = false;
  std::array<Nodes, nodes> h;  // [x][y]

  // The values at the nodes of y for one x.
  Nodes column(const Nodes& shares_x) const {
    Nodes values{};
    for (int i = 0; i < nodes; ++i) {
      for (int j = 0; j < nodes; ++j) {
        values[j] += shares_x[i] * h[i][j];
      }
    }
    return values;
  }

  // The values at the nodes of x for one y.
  Nodes row(const Nodes& shares_y) const {
    Nodes values;
    for (int i = 0; i < nodes; ++i) {
      values[i] = between(h[i], shares_y);
    }
    return values;
  }

  double at(double t_x, double t_y) const { return between(column(chebyshev().shares(t_x)), chebyshev().shares(t_y)); }
};

double tangent_of(double n_dot_v) {
  return half_elevation_tangent(std::min(std::max(n_dot_v, min_n_dot_v), 1.0));
}

SheenCosine cosine_at(double t, double log_peak) {
  SheenCosine of;
  of.t.value = t;
  of.log_peak = log_peak;
  if (!std::isnan(t)) {
    const double u = std::log(t) / -patch_x;  // in patches
    of.t.column = Curve::patch_at(u);
    of.t.shares = chebyshev().shares(1 - 2 * (u - Curve::start_of(of.t.column)) / Curve::length_of(of.t.column));
  }
  return of;
}

}  // namespace

struct Interpolant::Impl {
  Visibility visibility;
  std::array<std::array<Patch, patches_x>, patches_y> patches;
  std::mutex making_curves;

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
        patch.h[i][j] = direct(x_of(chebyshev().node[i]), y_of(chebyshev().node[j]));
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

SheenCosine Interpolant::cosine(double n_dot_v) {
  const double t = tangent_of(n_dot_v);
  return cosine_at(t, std::log1p(t * t));
}

SheenRoughness Interpolant::roughness(double sheen_roughness) {
  SheenRoughness of;
  const double r = std::min(sheen_roughness, 1.0);
  of.r.value = r;
  of.p = 0.5 / (r * r);
  if (r > 0) {
    const double v = std::log(r) / -patch_y;  // in patches
    of.r.row = v < patches_y ? static_cast<int>(v) : patches_y - 1;
    of.r.shares = chebyshev().shares(1 - 2 * (v - of.r.row));
  }
  return of;
}

double Interpolant::operator()(SheenCosine& n_dot_v, const SheenRoughness& sheen_roughness) const {
  const double drop = sheen_roughness.p * n_dot_v.log_peak;
  if (!(sheen_roughness.r.value > 0) || !(drop < negligible_drop)) {
    return 0;
  }
  auto& t = n_dot_v.t;
  const auto& column = t.in(sheen_roughness.r.row, [&](bool& usable, Nodes& values) {
    const Patch& patch = impl_->patch(t.column, sheen_roughness.r.row);
    usable = patch.usable;
    values = patch.column(t.shares);
  });
  if (!column.usable) {
    return directional_albedo(impl_->visibility, cosine_of(t.value), sheen_roughness.r.value);
  }
  return std::exp(between(column.values, sheen_roughness.r.shares) - drop);
}

double Interpolant::operator()(double n_dot_v, double sheen_roughness) const {
  const double t = tangent_of(n_dot_v);
  const double log_peak = std::log1p(t * t);
  const double r = std::min(sheen_roughness, 1.0);
  // Much of what narrow peaks are asked for is nothing, which no place need be found for.
  if (!(r > 0) || !(0.5 / (r * r) * log_peak < negligible_drop)) {
    return 0;
  }
  SheenCosine one = cosine_at(t, log_peak);
  return (*this)(one, roughness(r));
}

Curve::Curve(const Interpolant& interpolant, double sheen_roughness)
    : interpolant_(&interpolant), sheen_roughness_(std::min(sheen_roughness, 1.0)), place_(Interpolant::roughness(sheen_roughness).r) {}

Curve::State Curve::make(int patch) const {
  // The least T of the patch: where the drop is least. If E is negligible there, it is throughout, and powers of 0 do.
  const double least = std::exp(-patch_x * (start_of(patch) + length_of(patch)));
  const bool is_needed = log_peak_drop(least, sheen_roughness_) < negligible_drop;
  const Patch* of = is_needed ? &interpolant_->impl_->patch(patch, place_.row) : nullptr;
  const State state = of == nullptr || of->usable ? State::Usable : State::Unusable;
  Nodes powers{};
  if (of != nullptr) {
    const Nodes values = of->row(place_.shares);
    for (int power = 0; power < nodes; ++power) {
      for (int i = 0; i < nodes; ++i) {
        powers[power] += chebyshev().powers[power][i] * values[i];
      }
    }
  }
  const std::lock_guard lock(interpolant_->impl_->making_curves);
  if (state_[patch].load(std::memory_order_relaxed) == State::Unmade) {
    std::copy(std::begin(powers), std::end(powers), std::begin(powers_[patch]));
  }
  state_[patch].store(state, std::memory_order_release);
  return state;
}

double Curve::slowly(double n_dot_v) const {
  return (*interpolant_)(n_dot_v, sheen_roughness_);
}

}  // namespace sheen::albedo
