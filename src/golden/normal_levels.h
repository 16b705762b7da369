#pragma once

#include <vector>

#include "golden/surface_reader.h"
#include "golden/texture_box.h"

namespace sheen::golden {

/// What a normal map may give, codes in [0, 1], at all levels of detail that a driver may read it at, in as few boxes as stay small.
struct NormalLevels {
  Spread ideal;                ///< at the ideal level; where there are no others, of all levels
  std::vector<Spread> others;  ///< together, all levels
};

/// @param ideal   the specification's level
/// @param pieces  straight_pieces() of the levels that are allowed; none where the level changes nothing
/// @param scale   normalTextureInfo.scale
NormalLevels normal_levels(TextureBox& box, double ideal, const std::vector<LodInterval>& pieces, double scale);

}  // namespace sheen::golden
