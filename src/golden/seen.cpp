#include "golden/seen.h"

#include <algorithm>

namespace sheen::golden {

void Seen::clear() {
  nearest.reset();
  tie.reset();
  ambiguous = false;
  blended.clear();
  masked.clear();
}

bool Seen::same_triangles(const Seen& other) const {
  if (nearest.has_value() != other.nearest.has_value() || blended.size() != other.blended.size()) {
    return false;
  }
  const auto same = [](const Hit& a, const Hit& b) { return a.triangle == b.triangle && a.front == b.front; };
  return (!nearest || same(*nearest, *other.nearest)) && std::equal(blended.begin(), blended.end(), other.blended.begin(), same);
}

bool Seen::shows(std::uint32_t triangle, bool front) const {
  const auto is_it = [=](const Hit& hit) { return hit.triangle == triangle && hit.front == front; };
  return (nearest && is_it(*nearest)) || (tie && is_it(*tie)) || std::any_of(blended.begin(), blended.end(), is_it) ||
         std::any_of(masked.begin(), masked.end(), is_it);
}

}  // namespace sheen::golden
