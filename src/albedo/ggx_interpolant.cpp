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

GgxNode node_of(const GgxAlbedo& albedo) {
  return {std::log(albedo.loss), albedo.bias};
}

GgxAlbedo albedo_of(const GgxNode& node) {
  return {std::exp(node.log_loss), node.bias};
}

bool close(const GgxNode& ours, const GgxNode& exact) {
  return std::abs(std::expm1(ours.log_loss - exact.log_loss)) <= accepted && std::abs(ours.bias - exact.bias) <= accepted;
}

// Values at the nodes of one axis.
using Line = std::array<GgxNode, nodes>;

GgxNode between(const Line& line, const Nodes& shares) {
  GgxNode sum{0, 0};
  for (int i = 0; i < nodes; ++i) {
    sum.log_loss += shares[i] * line[i].log_loss;
    sum.bias += shares[i] * line[i].bias;
  }
  return sum;
}

struct Patch {
  std::once_flag made;
  bool usable = false;
  std::array<Line, nodes> columns;  // [x][y]

  // Values at the nodes of x for one y.
  Line row(const Nodes& shares_y) const {
    Line values;
    for (int i = 0; i < nodes; ++i) {
      values[i] = between(columns[i], shares_y);
    }
    return values;
  }

  // Values at the nodes of y for one x.
  Line column(const Nodes& shares_x) const {
    Line values{};
    for (int i = 0; i < nodes; ++i) {
      for (int j = 0; j < nodes; ++j) {
        values[j].log_loss += shares_x[i] * columns[i][j].log_loss;
        values[j].bias += shares_x[i] * columns[i][j].bias;
      }
    }
    return values;
  }

  GgxNode at(double t_x, double t_y) const { return between(column(Rule1D::instance().shares(t_x)), Rule1D::instance().shares(t_y)); }
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

  static GgxNode direct(double x, double y) { return node_of(ggx_albedo(cosine_of(std::exp(x)), std::exp(y))); }

  static void make(Patch& patch, int ix, int iy) {
    const auto exact = [&](double t_x, double t_y) { return direct(coordinate(patch_x, ix, t_x), coordinate(patch_y, iy, t_y)); };
    const Nodes& node = Rule1D::instance().node;
    for (int j = 0; j < nodes; ++j) {
      for (int i = 0; i < nodes; ++i) {
        patch.columns[i][j] = exact(node[i], node[j]);
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
    const auto exact = [&](double t) { return node_of(ggx_average_albedo(std::exp(coordinate(patch_y, iy, t)))); };
    for (int i = 0; i < nodes; ++i) {
      patch.line[i] = exact(Rule1D::instance().node[i]);
    }
    patch.usable = true;
    for (const double t : {outside, -outside, 0.0}) {
      patch.usable = patch.usable && close(between(patch.line, Rule1D::instance().shares(t)), exact(t));
    }
  }
};

GgxInterpolant::GgxInterpolant() : impl_(std::make_unique<Impl>()) {}
GgxInterpolant::~GgxInterpolant() = default;
GgxInterpolant::GgxInterpolant(GgxInterpolant&&) noexcept = default;
GgxInterpolant& GgxInterpolant::operator=(GgxInterpolant&&) noexcept = default;

GgxCosine GgxInterpolant::cosine(double n_dot_v) {
  GgxCosine of;
  of.value = std::min(std::max(n_dot_v, min_n_dot_v), 1.0);
  if (!std::isnan(of.value)) {
    const double u = std::log(half_elevation_tangent(of.value)) / -patch_x;  // in patches
    of.column = std::min(static_cast<int>(u), patches_x - 1);
    of.shares = Rule1D::instance().shares(1 - 2 * (u - of.column));
  }
  return of;
}

GgxAlpha GgxInterpolant::alpha(double alpha) {
  GgxAlpha of;
  of.value = alpha;
  if (alpha > mirror_alpha) {
    const double v = std::log(std::min(alpha, 1.0)) / -patch_y;  // in patches
    of.row = std::min(static_cast<int>(v), patches_y - 1);
    of.shares = Rule1D::instance().shares(1 - 2 * (v - of.row));
  }
  return of;
}

GgxAlbedo GgxInterpolant::operator()(GgxCosine& n_dot_v, const GgxAlpha& alpha) const {
  if (!(alpha.value > mirror_alpha)) {
    return ggx_albedo(n_dot_v.value, 0);
  }
  if (std::isnan(n_dot_v.value)) {
    return {n_dot_v.value, n_dot_v.value};
  }
  const GgxCosine::Column& column = n_dot_v.in(alpha.row, [&](bool& usable, Line& values) {
    const Patch& patch = impl_->patch(n_dot_v.column, alpha.row);
    usable = patch.usable;
    values = patch.column(n_dot_v.shares);
  });
  return column.usable ? albedo_of(between(column.values, alpha.shares)) : ggx_albedo(n_dot_v.value, alpha.value);
}

GgxAlbedo GgxInterpolant::operator()(double n_dot_v, double alpha) const {
  GgxCosine one = cosine(n_dot_v);
  return (*this)(one, GgxInterpolant::alpha(alpha));
}

GgxCurve GgxInterpolant::at_alpha(double alpha) const {
  GgxCurve curve(*this, alpha);
  if (!(alpha > mirror_alpha)) {
    curve.usable_ = false;  // it is simple enough
    return curve;
  }
  const GgxAlpha place = GgxInterpolant::alpha(alpha);
  for (int ix = 0; ix < patches_x; ++ix) {
    const Patch& patch = impl_->patch(ix, place.row);
    curve.usable_ = curve.usable_ && patch.usable;
    const Line values = patch.row(place.shares);
    for (int power = 0; power < nodes; ++power) {
      for (int i = 0; i < nodes; ++i) {
        curve.log_loss_[ix][power] += Rule1D::instance().powers[power][i] * values[i].log_loss;
        curve.bias_[ix][power] += Rule1D::instance().powers[power][i] * values[i].bias;
      }
    }
  }
  return curve;
}

GgxAlbedo GgxCurve::slowly(double n_dot_v) const {
  return (*interpolant_)(n_dot_v, alpha_);
}

GgxAlbedo GgxInterpolant::average(double alpha) const {
  return average(GgxInterpolant::alpha(alpha));
}

GgxAlbedo GgxInterpolant::average(const GgxAlpha& alpha) const {
  if (!(alpha.value > mirror_alpha)) {
    return ggx_average_albedo(0);
  }
  AveragePatch& patch = impl_->averages[alpha.row];
  std::call_once(patch.made, [&] { Impl::make(patch, alpha.row); });
  return patch.usable ? albedo_of(between(patch.line, alpha.shares)) : ggx_average_albedo(alpha.value);
}

}  // namespace sheen::albedo
