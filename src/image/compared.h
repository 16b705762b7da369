#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "image/image.h"

namespace sheen::image {

/// What a pixel of two pictures is to a comparison.
enum class Standing { Uncovered, Compared, Nonfinite };

/// The channels and pixels over which two pictures are compared: those of R, G, B, A that both have, where either picture covers (alpha
/// over 0). A picture without A covers what the other one covers, or every pixel where neither has it. A NaN or Inf in a compared channel
/// counts wherever it stands.
class Compared {
 public:
  /// Keeps references to both. Throws Error when sizes differ, a picture's data does not fit its size, or no channel is common.
  Compared(const Image& candidate, const Image& reference);

  Standing standing(int x, int y) const;
  /// Indices of each compared channel in candidate and reference.
  const std::vector<std::pair<int, int>>& channels() const { return channels_; }
  /// |candidate - reference| of a pair of channels().
  double error(int x, int y, std::pair<int, int> channel) const;
  /// error / max(|reference|, 1e-3).
  double relative_error(int x, int y, std::pair<int, int> channel) const;

 private:
  const Image& candidate_;
  const Image& reference_;
  std::vector<std::pair<int, int>> channels_;
  int candidate_alpha_, reference_alpha_;
};

}  // namespace sheen::image
