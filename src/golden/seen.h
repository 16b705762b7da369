#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "golden/geometry.h"

namespace sheen::golden {

/// What a ray sees.
struct Seen {
  std::optional<Hit> nearest;  ///< nearest opaque (or MASK, kept) surface within the clip range
  std::optional<Hit> tie;      ///< another surface at a depth that a depth buffer may not tell from the nearest one's
  /// Whether a depth buffer or the clip range may decide otherwise about a surface that matters: a BLEND one at the nearest one's depth, or
  /// one at either clip plane.
  bool ambiguous = false;
  std::vector<Hit> blended;  ///< BLEND surfaces in front of it, in drawing order
  std::vector<Hit> masked;   ///< MASK surfaces in front, kept or not; only if asked for

  void clear();
  bool empty() const { return !nearest && blended.empty(); }
  /// How many surfaces make up what is seen.
  std::uint32_t layers() const { return (nearest ? 1u : 0u) + static_cast<std::uint32_t>(blended.size()); }
  /// Calls f with the hit on each of them, back to front.
  template <class Function>
  void for_layers(const Function& f) const {
    if (nearest) {
      f(*nearest);
    }
    for (const Hit& hit : blended) {
      f(hit);
    }
  }
  /// Whether both meet the same sides of the same triangles.
  bool same_triangles(const Seen& other) const;
  /// Whether a triangle's side is among what is seen, or masks that were asked for.
  bool shows(std::uint32_t triangle, bool front) const;
};

}  // namespace sheen::golden
