#pragma once

#include <vector>

#include "golden/surface_reader.h"
#include "golden/texture_box.h"

namespace sheen::golden {

/// What a normal map may give, codes in [0, 1], at all levels of detail that a driver may read it at.
struct NormalLevels {
  /// Whether that is more than a small box about what it is at the ideal level, which alone is there otherwise.
  bool is_open = false;
  std::vector<Spread> boxes;  ///< together, all of it; as few as stay small
};

/// @param ideal   the specification's level
/// @param pieces  straight_pieces() of the levels that are allowed; none where the level changes nothing
/// @param scale   normalTextureInfo.scale
NormalLevels normal_levels(TextureBox& box, double ideal, const std::vector<LodInterval>& pieces, double scale);

}  // namespace sheen::golden
