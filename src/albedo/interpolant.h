#pragma once

#include <array>
#include <memory>

#include "albedo/curve.h"
#include "albedo/sheen_model.h"

namespace sheen::albedo {

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

  using Triple = std::array<double, 3>;
  /// The same at each of three cosines with each of three roughnesses, [roughness][cosine], to rounding; at the price of two or three, if
  /// they lie close together.
  std::array<Triple, 3> grid(const Triple& n_dot_v, const Triple& sheen_roughness) const;

  /// The same at one roughness, for any number type. This must outlive it.
  Curve at_roughness(double sheen_roughness) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sheen::albedo
