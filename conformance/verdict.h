#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "image/image.h"

namespace sheen::conformance {

enum class Status { Pass, Approximation, Fail, Unsupported, Crash, Timeout, Invalid };

/// The word of results.json: "pass", "approximation", ...
std::string to_string(Status status);

/// What a comparison of a candidate with its golden came to.
struct Verdict {
  Status status = Status::Invalid;
  double max_abs = 0;       ///< largest absolute error of a compared channel
  double max_rel = 0;       ///< largest error / max(|golden|, 1e-3)
  double p99_rel = 0;       ///< 99th percentile (nearest rank) of the relative errors of all compared channels
  double bound_ratio = 0;   ///< largest error over its bound: at most 1 passes
  double median_bound = 0;  ///< median of the bounds of all compared channels but coverage, over max(|golden|, 1e-3)
  int worst_x = -1;         ///< the pixel of bound_ratio, rows from the top; -1 when nothing was compared
  int worst_y = -1;
  std::int64_t compared_pixels = 0;
  std::int64_t excluded_pixels = 0;  ///< covered by either image, and left out since rasterisation may rightly differ there
  /// Those left out by the golden's reason: [1] another surface or none, [2] an alpha mask that may fall either way, [3] under an
  /// environment, a texture without mipmaps seen from too far, [4] an operation for which the rules of GLSL ES promise nothing.
  std::array<std::int64_t, 5> excluded_by{};
  /// Compared, but black and twice the golden would both pass, and it shows: its bound is above the brightest channel of the pixel and
  /// above a tenth of what the picture's pixels have on average and above the least normal number.
  std::int64_t vague_pixels = 0;
  std::int64_t mirrored_pixels = 0;   ///< covered, and left out since the normal faces away (foreign viewers alone)
  std::int64_t negative_pixels = 0;   ///< compared or not, with a channel below 0 where the golden has none
  std::int64_t nonfinite_pixels = 0;  ///< NaN or Inf in the candidate, anywhere in the image
  std::string message;                ///< why it is not a pass
};

/// What may widen a bound, or leave out a pixel, for reasons that lie in how the pictures came here.
struct VerdictRules {
  /// The golden's RGBA were stored as PXR24 (24-bit floats with 15 fraction bits: OpenEXR, "Technical Introduction", PXR24), which rounds a
  /// value by at most 2^-16 of it.
  bool golden_is_pxr24 = false;
  /// The candidate came as 8-bit sRGB codes: each holds every value within half a code, and nothing above 1.
  bool candidate_is_srgb8 = false;
  /// Whether radiance may be below zero wherever the bound reaches there, and at excluded pixels, whose bound says nothing of what another
  /// surface shows: of a model that does not clamp its scale. Of others it never may.
  bool may_be_negative = false;
  /// Leave out the pixels of the golden's channel "mirrored" (N.V <= 0, where the choice taken binds our own viewer alone).
  bool leave_out_mirrored = false;
  /// Granted beyond the bound, a share of the value and an absolute one: to viewers of others, whose formulas, precision and targets need
  /// not be those that the bound is derived for.
  double relative_tolerance = 0;
  double absolute_tolerance = 0;
  /// Light from everywhere of another's viewer was sampled or filtered: this share of a value (at least of 1e-3) is granted beyond the
  /// bound.
  double environment_tolerance = 0;
  /// So many of the standard errors that the candidate's replicas show (replicas.h) are granted; without any, nothing. And no more than
  /// what they may be (granted_to_chance), where the golden tells what one direction brings: they are the candidate's own word.
  double standard_errors = 0;
  /// A golden with more than this share of its covered pixels excluded judges nothing.
  double most_excluded = 0.02;
  /// Whether pixels for which the rules promise nothing (excluded for reason 4) are left out however many they are. They still must be
  /// finite and not negative.
  bool leave_out_unpromised = false;
  /// A golden with more than this share of its compared pixels vague judges nothing either.
  double most_vague = 0.2;
};

/// A share as people read it: "2.51 %".
std::string percent(double share);

/// Judges a candidate against its golden. A pure function.
///
/// Compared are the pixels that either image covers (alpha > 0; a candidate without A covers what the golden covers) and the golden does
/// not exclude. Passes if and only if every channel of every compared pixel lies within its bound, no pixel of the candidate is NaN or Inf,
/// the sizes agree, at least one pixel was compared, at most `most_excluded` of the covered ones were excluded and at most `most_vague` of
/// the compared ones are vague. A candidate or golden that cannot be judged is Invalid.
/// @param candidate  R G B and perhaps A
/// @param golden     R G B A bound.R bound.G bound.B excluded, and perhaps mirrored
Verdict judge(const image::Image& candidate, const image::Image& golden, const VerdictRules& rules);

/// Error over bound of every pixel, row by row, the largest of its channels, as judge() takes it: what a report paints. 0 where neither
/// image covers, -1 where the pixel is left out, infinity where the candidate is not finite. All 0 when the two cannot be compared.
std::vector<double> ratio_map(const image::Image& candidate, const image::Image& golden, const VerdictRules& rules);

}  // namespace sheen::conformance
