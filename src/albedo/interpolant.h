#pragma once

#include <memory>

#include "albedo/curve.h"
#include "albedo/patch_places.h"
#include "albedo/sheen_model.h"

namespace sheen::albedo {

struct SheenCosine {
  PlaceInColumn<Curve::nodes, double> t;  ///< the tangent of half the elevation, see coordinates.h
  double log_peak;                        ///< ln(1 + T^2)
};
struct SheenRoughness {
  PlaceInRow<Curve::nodes> r;
  double p;  ///< 1 / (2 r^2)
};

/// E to 6e-7 (relative, or absolute where E < 1; half of it the quadrature's own) for any cosine and roughness, and to 2e-6 of itself for
/// cosines above 0.5 and roughness above 0.17, hundreds of times faster than quadrature: Chebyshev patches over (n_dot_v, sheen_roughness),
/// each made when first touched and held to quadrature at points between its nodes; a patch that misses is not used. Safe to call from many
/// threads.
class Interpolant {
 public:
  explicit Interpolant(Visibility visibility);
  ~Interpolant();
  Interpolant(Interpolant&&) noexcept;
  Interpolant& operator=(Interpolant&&) noexcept;

  /// E; arguments as for directional_albedo. Cosines below min_n_dot_v count as min_n_dot_v.
  double operator()(double n_dot_v, double sheen_roughness) const;

  /// The same, of places to be asked for again.
  double operator()(SheenCosine& n_dot_v, const SheenRoughness& sheen_roughness) const;
  static SheenCosine cosine(double n_dot_v);
  static SheenRoughness roughness(double sheen_roughness);

  /// The same at one roughness, for any number type. This must outlive it.
  Curve at_roughness(double sheen_roughness) const { return Curve(*this, sheen_roughness); }

 private:
  friend class Curve;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sheen::albedo
