#pragma once

#include <memory>

#include "albedo/ggx_albedo.h"
#include "albedo/ggx_curve.h"
#include "albedo/patch_places.h"

namespace sheen::albedo {

/// What GgxInterpolant runs polynomials through.
struct GgxNode {
  double log_loss, bias;
};

using GgxCosine = PlaceInColumn<GgxCurve::nodes, GgxNode>;
using GgxAlpha = PlaceInRow<GgxCurve::nodes>;

/// ggx_albedo and ggx_average_albedo for any cosine and alpha, many times faster than quadrature and within 1e-6 of it: relative for the
/// loss, absolute for the bias. Chebyshev patches over logarithms of both, each made when first touched and held to quadrature at points
/// between its nodes; a patch that misses is not used. Safe to call from many threads.
class GgxInterpolant {
 public:
  GgxInterpolant();
  ~GgxInterpolant();
  GgxInterpolant(GgxInterpolant&&) noexcept;
  GgxInterpolant& operator=(GgxInterpolant&&) noexcept;

  /// ggx_albedo; cosines below min_n_dot_v count as min_n_dot_v, of light and of view alike, so that what is built of it stays reciprocal.
  /// Of what is no number it makes none.
  GgxAlbedo operator()(double n_dot_v, double alpha) const;
  /// The same, of places to be asked for again.
  GgxAlbedo operator()(GgxCosine& n_dot_v, const GgxAlpha& alpha) const;
  static GgxCosine cosine(double n_dot_v);
  static GgxAlpha alpha(double alpha);
  /// The same at one alpha, for any number type. This must outlive it.
  GgxCurve at_alpha(double alpha) const;
  /// ggx_average_albedo.
  GgxAlbedo average(double alpha) const;
  GgxAlbedo average(const GgxAlpha& alpha) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sheen::albedo
