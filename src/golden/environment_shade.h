#pragma once

#include <array>
#include <cstdint>

#include "golden/curve_cache.h"
#include "golden/image_sum.h"
#include "golden/shade.h"

namespace sheen::golden {

/// A mean with its standard error, each a radiance.
struct Estimate {
  brdf::Rgb<double> mean{0, 0, 0}, standard_error{0, 0, 0};
  brdf::Rgb<double> largest{0, 0, 0};  ///< the most of it that one direction brings, of those toward the brightest of the image
};

/// What lights every surface of a picture. Pointers outlive their use.
struct ImageLighting {
  Lighting lighting;
  const EnvironmentLight* light = nullptr;
  const DirectionPool* pool = nullptr;
};

/// Radiance toward the camera that an image sends by way of a surface, without emission: the integral itself, by directions drawn from the
/// image and from every lobe together (see image_sum), each a distant light for the same shading as punctual lights get. Points are
/// Sobol's, scrambled anew in each of 16 replicas, which are independent of each other, and twice as many after each refine(). What varies
/// slowly over the directions is integrated without drawing, as far as the replicas show that to help (see ControlledMean); what they then
/// differ by is the standard error.
class EnvironmentEstimate {
 public:
  static constexpr std::uint32_t replicas = 16;

  /// @param stream  a number that no other surface has that should differ by chance from this one
  EnvironmentEstimate(const Surface<double>& surface, Layers layers, const ImageLighting& lighting, std::uint64_t stream);

  /// Draws as many directions again, at first `first_points` times each strategy's weight in each replica, or fewer if so many pass the
  /// limit. False, and nothing drawn, if that passes the limit.
  bool refine(const Surface<double>& surface, CurveCache& curves, std::uint32_t most_directions);

  std::uint32_t directions() const { return points_ * directions_a_point_; }

  /// Mean, and the standard error of each channel, widened so that three of it hold the truth of all three channels as often as three of a
  /// known one hold a number, 99.73 %: by Student's distribution of 14 degrees of freedom that takes 4.195 of one found from 16 replicas
  /// (Bonferroni: each channel may miss a third as often).
  Estimate value() const;

 private:
  static constexpr std::uint32_t first_points = 4;

  const ImageLighting* lighting_;
  Layers layers_;
  LobeSampling sampling_;
  brdf::Rgb<double> mirrored_;
  double occlusion_;
  std::uint64_t stream_;
  std::uint32_t directions_a_point_;
  std::uint32_t points_ = 0;
  ControlVariate control_;
  brdf::Rgb<double> known_{0, 0, 0};    // its integral
  brdf::Rgb<double> largest_{0, 0, 0};  // times points and replicas
  std::array<ImageSums, replicas> sums_{};
};

/// The same from few directions, fewer than any estimate has: enough to tell what a slightly different surface would send, when both take
/// the same stream.
brdf::Rgb<double> coarse_environment(const Surface<double>& surface, Layers layers, const ImageLighting& lighting, std::uint64_t stream,
                                     CurveCache& curves);

}  // namespace sheen::golden
