#pragma once

#include <vector>

#include "conformance/relation.h"
#include "conformance/verdict.h"
#include "image/image.h"

namespace sheen::conformance {

/// More than this share of what is looked at left out, and the rest proves nothing.
inline constexpr double most_left_out = 0.5;

/// What is known of the viewer that drew the pictures.
struct RelationRules {
  bool srgb8 = false;  ///< its pictures came as 8-bit sRGB codes: each holds every value within half a code, and nothing above 1
  bool tone_mapped =
      false;              ///< it says that it maps tones: of a linear relation only the order is left that radiance has for being positive
  bool ours = false;      ///< held to relations that are exact
  int subpixel_bits = 4;  ///< of its rasteriser
};

/// Judges the pictures of a relation's scenes, in the order of the scenes. A pure function.
///
/// Every demand is made of a weighted sum s = sum of w_i picture_i, in each of R, G and B (and of A where it must vanish and all have it)
/// of each pixel of the region. Its tolerance is t = sum of |w_i| t_i with t_i = relative |picture_i| + absolute, more by half a code where
/// the picture came as codes and, where the scenes are `moved`, by 2 x 2^-subpixel_bits times the largest difference to a neighbour (each
/// axis of a sample may be off by a step; without coverage no edge is known, and the step is a whole pixel).
/// - Equal, Linear: |s| <= t everywhere. Differs: |s| > t in at least `share` of the pixels.
/// - Brighter: s <= t everywhere for the next picture less this one, and s > t in `share` of the pixels for this one less the next.
/// Left out are, where `moved`, the pixels at an edge of the coverage and, of Linear, those where a code is the largest (it may stand for
/// anything above). A NaN or Inf anywhere fails.
///
/// In the verdict, bound_ratio is the largest of |s| / t, or for what must exceed t the reverse, at the pixel that ranks at the share; at
/// most 1 passes. max_abs, max_rel and p99_rel are of |s|, relative to the first picture. Unsupported where a linear law leaves no order.
/// Invalid where sizes differ, channels lack, or every picture is empty.
Verdict relate(const Relation& relation, const std::vector<image::Image>& pictures, const RelationRules& rules);

/// |s| / t of every pixel, row by row, the largest of its channels and of all demands: what a report paints. -1 where nothing is judged,
/// infinity where a picture is not finite. All 0 when the pictures cannot be compared.
std::vector<double> relation_map(const Relation& relation, const std::vector<image::Image>& pictures, const RelationRules& rules);

}  // namespace sheen::conformance
