#pragma once

#include <cstdint>

#include "image/image.h"

namespace sheen::image {

/// How far a candidate is from a reference, over every channel of R, G, B, A that both have and the pixels that either covers (alpha > 0;
/// an image without A covers what the other one covers, and all its pixels where neither has A). Relative = error / max(|reference|, 1e-3).
struct Comparison {
  double max_abs = 0, mean_abs = 0, p99_abs = 0;
  double max_rel = 0, mean_rel = 0, p99_rel = 0;
  double psnr = 0;                    ///< dB, peak 1; infinity for equal images
  double flip = 0;                    ///< mean FLIP: LDR (Andersson 2020) for images within [0, 1], else HDR (Andersson 2021)
  std::int64_t nonfinite_pixels = 0;  ///< NaN or Inf in either image, covered or not; counted here and in no other figure
  std::int64_t compared_pixels = 0;
  int worst_x = -1, worst_y = -1;  ///< pixel of max_rel, the first of equals in reading order; -1 where nothing was compared
};

/// Whether to compute FLIP, by far the dearest of the figures.
enum class Flip { Compute, Skip };

/// p99 is the nearest-rank percentile: the smallest value that at least 99 % of the values do not exceed. FLIP is of R, G, B over black,
/// its map computed over the whole picture with what is not finite as 0, its mean taken over the compared pixels. Throws image::Error when
/// sizes differ or no channel is common.
Comparison compare(const Image& candidate, const Image& reference, Flip flip = Flip::Compute);

/// A picture (R G B) of the relative error per pixel (largest channel), black to white by Green's cubehelix map; `full_scale` is white,
/// what neither covers is black, what is not finite is magenta. Throws image::Error as compare() does, and for a full_scale that is not
/// over 0.
Image heatmap(const Image& candidate, const Image& reference, double full_scale);

}  // namespace sheen::image
