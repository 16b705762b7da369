#include "albedo/ggx_interpolant.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <utility>

#include "albedo/chebyshev.h"
#include "albedo/coordinates.h"

// Over x = ln T, T = tan(elevation / 2), and y = ln alpha. The loss behaves like a power of either, but for a bend where T is about alpha /
// 2, so its logarithm is interpolated; the bias itself.

namespace sheen::albedo {
namespace {

constexpr int nodes = GgxCurve::nodes;  // a side of a patch
constexpr double patch_x = GgxCurve::patch_x;
constexpr double patch_y = 1.0;  // of ln alpha
constexpr int patches_x = GgxCurve::patches;
constexpr int patches_y = 19;      // down to alpha = 5.6e-9
constexpr double accepted = 3e-7;  // relative error of the loss, absolute error of the bias

using Rule1D = Chebyshev<nodes>;
using Nodes = Rule1D::Nodes;

struct Pair {
  double log_loss, bias;
};

Pair pair_of(const GgxAlbedo& albedo) {
  return {std::log(albedo.loss), albedo.bias};
}

GgxAlbedo albedo_of(const Pair& pair) {
  return {std::exp(pair.log_loss), pair.bias};
}

bool close(const Pair& ours, const Pair& exact) {
  return std::abs(std::expm1(ours.log_loss - exact.log_loss)) <= accepted && std::abs(ours.bias - exact.bias) <= accepted;
}

// Values at the nodes of one axis.
struct Line {
  Nodes log_loss, bias;

  Pair at(const Nodes& shares) const {
    Pair sum{0, 0};
    for (int i = 0; i < nodes; ++i) {
      sum.log_loss += shares[i] * log_loss[i];
      sum.bias += shares[i] * bias[i];
    }
    return sum;
  }
  void set(int i, const Pair& value) { log_loss[i] = value.log_loss, bias[i] = value.bias; }
};

struct Patch {
  std::once_flag made;
  bool usable = false;
  std::array<Line, nodes> rows;

  // Values at the nodes of x for one y.
  Line row(double t_y) const {
    const Nodes sy = Rule1D::instance().shares(t_y);
    Line values{};
    for (int j = 0; j < nodes; ++j) {
      for (int i = 0; i < nodes; ++i) {
        values.log_loss[i] += sy[j] * rows[j].log_loss[i];
        values.bias[i] += sy[j] * rows[j].bias[i];
      }
    }
    return values;
  }

  Pair at(double t_x, double t_y) const {
    const Nodes sx = Rule1D::instance().shares(t_x);
    Line column;
    for (int j = 0; j < nodes; ++j) {
      column.set(j, rows[j].at(sx));
    }
    return column.at(Rule1D::instance().shares(t_y));
  }
};

struct AveragePatch {
  std::once_flag made;
  bool usable = false;
  Line line;
};

// The largest error of a Chebyshev interpolant lies between its outermost nodes and the border, or in the middle.
constexpr double outside = 0.99;

// The coordinate of t in [-1, 1] in patch `index` of that length; rounding may carry it past 0.
double coordinate(double length, int index, double t) {
  return std::min(-length * (index + (1 - t) / 2), 0.0);
}

}  // namespace

struct GgxInterpolant::Impl {
  std::array<std::array<Patch, patches_x>, patches_y> patches;
  std::array<AveragePatch, patches_y> averages;

  static Pair direct(double x, double y) { return pair_of(ggx_albedo(cosine_of(std::exp(x)), std::exp(y))); }

  static void make(Patch& patch, int ix, int iy) {
    const auto exact = [&](double t_x, double t_y) { return direct(coordinate(patch_x, ix, t_x), coordinate(patch_y, iy, t_y)); };
    const Nodes& node = Rule1D::instance().node;
    for (int j = 0; j < nodes; ++j) {
      for (int i = 0; i < nodes; ++i) {
        patch.rows[j].set(i, exact(node[i], node[j]));
      }
    }
    patch.usable = true;
    for (const auto& [x, y] : {std::pair{outside, outside}, {-outside, -outside}, {outside, -outside}, {-outside, outside}, {0.0, 0.0}}) {
      patch.usable = patch.usable && close(patch.at(x, y), exact(x, y));
    }
  }

  const Patch& patch(int ix, int iy) {
    Patch& patch = patches[iy][ix];
    std::call_once(patch.made, [&] { make(patch, ix, iy); });
    return patch;
  }

  static void make(AveragePatch& patch, int iy) {
    const auto exact = [&](double t) { return pair_of(ggx_average_albedo(std::exp(coordinate(patch_y, iy, t)))); };
    for (int i = 0; i < nodes; ++i) {
      patch.line.set(i, exact(Rule1D::instance().node[i]));
    }
    patch.usable = true;
    for (const double t : {outside, -outside, 0.0}) {
      patch.usable = patch.usable && close(patch.line.at(Rule1D::instance().shares(t)), exact(t));
    }
  }
};

GgxInterpolant::GgxInterpolant() : impl_(std::make_unique<Impl>()) {}
GgxInterpolant::~GgxInterpolant() = default;
GgxInterpolant::GgxInterpolant(GgxInterpolant&&) noexcept = default;
GgxInterpolant& GgxInterpolant::operator=(GgxInterpolant&&) noexcept = default;

GgxAlbedo GgxInterpolant::operator()(double n_dot_v, double alpha) const {
  const double mu = std::min(std::max(n_dot_v, min_n_dot_v), 1.0);
  if (!(alpha > mirror_alpha)) {
    return ggx_albedo(mu, 0);
  }
  if (std::isnan(mu)) {
    return {mu, mu};
  }
  const double u = std::log(half_elevation_tangent(mu)) / -patch_x, v = std::log(std::min(alpha, 1.0)) / -patch_y;  // in patches
  const int ix = std::min(static_cast<int>(u), patches_x - 1), iy = std::min(static_cast<int>(v), patches_y - 1);
  const Patch& patch = impl_->patch(ix, iy);
  return patch.usable ? albedo_of(patch.at(1 - 2 * (u - ix), 1 - 2 * (v - iy))) : ggx_albedo(mu, alpha);
}

GgxCurve GgxInterpolant::at_alpha(double alpha) const {
  GgxCurve curve(*this, alpha);
  if (!(alpha > mirror_alpha)) {
    curve.usable_ = false;  // it is simple enough
    return curve;
  }
  const double v = std::log(std::min(alpha, 1.0)) / -patch_y;
  const int iy = std::min(static_cast<int>(v), patches_y - 1);
  for (int ix = 0; ix < patches_x; ++ix) {
    const Patch& patch = impl_->patch(ix, iy);
    curve.usable_ = curve.usable_ && patch.usable;
    const Line values = patch.row(1 - 2 * (v - iy));
    for (int power = 0; power < nodes; ++power) {
      for (int i = 0; i < nodes; ++i) {
        curve.log_loss_[ix][power] += Rule1D::instance().powers[power][i] * values.log_loss[i];
        curve.bias_[ix][power] += Rule1D::instance().powers[power][i] * values.bias[i];
      }
    }
  }
  return curve;
}

GgxAlbedo GgxCurve::slowly(double n_dot_v) const {
  return (*interpolant_)(n_dot_v, alpha_);
}

GgxAlbedo GgxInterpolant::average(double alpha) const {
  if (!(alpha > mirror_alpha)) {
    return ggx_average_albedo(0);
  }
  const double v = std::log(std::min(alpha, 1.0)) / -patch_y;
  const int iy = std::min(static_cast<int>(v), patches_y - 1);
  AveragePatch& patch = impl_->averages[iy];
  std::call_once(patch.made, [&] { Impl::make(patch, iy); });
  return patch.usable ? albedo_of(patch.line.at(Rule1D::instance().shares(1 - 2 * (v - iy)))) : ggx_average_albedo(alpha);
}

}  // namespace sheen::albedo
