#pragma once

#include "brdf/ashikhmin.h"
#include "brdf/charlie.h"

namespace sheen::brdf {

/// Which visibility term the sheen lobe has: the specification's own, its named alternative, or the Enterprise PBR refinement.
enum class Visibility { Charlie, Ashikhmin, Refined };
inline constexpr Visibility visibilities[] = {Visibility::Charlie, Visibility::Ashikhmin, Visibility::Refined};

/// The sheen lobe of one material point, with what does not depend on the light found once.
template <class Real>
class SheenLobe {
 public:
  /// @param sheen_roughness  the user's parameter, [0, 1]; alpha_g is its square
  /// @param n_dot_v          (0, 1]
  SheenLobe(Visibility visibility, Real sheen_roughness, Real n_dot_v)
      : visibility_(visibility),
        alpha_g_(Wide::widened(sheen_roughness) * Wide::widened(sheen_roughness)),
        exponent_(charlie_exponent(alpha_g_)),
        n_dot_v_(n_dot_v),
        lambda_v_(Real(0)) {
    if (visibility_ != Visibility::Ashikhmin) {
      const Real alpha_g = sheen_roughness * sheen_roughness;
      curve_ = visibility_ == Visibility::Charlie ? charlie_lambda_curve(alpha_g) : refined_lambda_curve(alpha_g);
      lambda_v_ = lambda_of_view(curve_, n_dot_v);
    }
  }

  /// D, in 1/sr; see charlie_distribution.
  Real distribution(Real n_dot_h, Real sin2_theta_h) const {
    const auto cos2 = Wide::widened(n_dot_h * n_dot_h);
    return Wide::narrowed(charlie_distribution_of_squares(alpha_g_, exponent_, cos2, Wide::widened(sin2_theta_h)));
  }

  /// V times N.L, in 1/sr. @param n_dot_l  [0, 1]
  Real visibility_times_n_dot_l(Real n_dot_l) const {
    if (visibility_ == Visibility::Ashikhmin) {
      return ashikhmin_visibility(n_dot_l, n_dot_v_) * n_dot_l;
    }
    return charlie_visibility_times_n_dot_l(lambda_v_, curve_.lambda(n_dot_l), n_dot_v_);
  }

  /// D V N.L with a white sheenColor, in 1/sr: what the albedo E integrates over the hemisphere.
  Real value_times_n_dot_l(Real n_dot_l, Real n_dot_h, Real sin2_theta_h) const {
    return distribution(n_dot_h, sin2_theta_h) * visibility_times_n_dot_l(n_dot_l);
  }

 private:
  using Wide = Exponents<Real>;

  Visibility visibility_;
  typename Wide::Type alpha_g_, exponent_;
  Real n_dot_v_;
  LambdaCurve<Real> curve_{};
  Real lambda_v_;
};

}  // namespace sheen::brdf
