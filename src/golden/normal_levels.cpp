#include "golden/normal_levels.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace sheen::golden {
namespace {

/// How far, in radians, the normals of one box may lie from its centre for more levels to be put into it. Boxes cost a shading each; lobes
/// narrower than a box are enclosed by little.
constexpr double widest_box = 0.025;
/// A piece of levels is cut, at the price of shading once more, where it turns farther than this.
constexpr double widest_turn = 0.05;

/// The direction that a code stands for, before it is made unit.
glm::dvec3 direction(const glm::dvec4& code, double scale) {
  return (glm::dvec3(code) * 2.0 - 1.0) * glm::dvec3(scale, scale, 1.0);
}

double turn(const Spread& a, const Spread& b, double scale) {
  const glm::dvec3 from = direction(a.value, scale);
  const glm::dvec3 to = direction(b.value, scale);
  return std::atan2(glm::length(glm::cross(from, to)), glm::dot(from, to));
}

// Its length's reach counts like its direction's: what becomes of it when it is made unit is enclosed apart.
bool is_small(const Spread& s, double scale) {
  const glm::dvec3 reach = 2.0 * glm::dvec3(s.radius) * glm::abs(glm::dvec3(scale, scale, 1.0));
  return glm::length(reach) <= widest_box * glm::length(direction(s.value, scale));
}

// About the centre of `s`, what either holds.
Spread widened(Spread s, const Spread& by) {
  s.radius = glm::max(s.radius, glm::abs(by.value - s.value) + by.radius);
  return s;
}

// The smallest box of both.
Spread hull(const Spread& a, const Spread& b) {
  const glm::dvec4 low = glm::min(a.value - a.radius, b.value - b.radius);
  const glm::dvec4 high = glm::max(a.value + a.radius, b.value + b.radius);
  return {0.5 * (low + high), (0.5 + 0x1p-50) * (high - low) + 0x1p-50 * glm::abs(low + high)};
}

// One piece, in one box or two.
void add_piece(TextureBox& box, const LodInterval& piece, double scale, std::vector<Spread>& all) {
  const Spread from = box(piece.low);
  if (piece.high == piece.low) {
    all.push_back(from);
    return;
  }
  const Spread to = box(piece.high);
  if (turn(from, to, scale) <= widest_turn) {
    all.push_back(hull(from, to));
    return;
  }
  const Spread between = box(0.5 * (piece.low + piece.high));
  all.push_back(hull(from, between));
  all.push_back(hull(between, to));
}

}  // namespace

NormalLevels normal_levels(TextureBox& box, double ideal, const std::vector<LodInterval>& pieces, double scale) {
  NormalLevels out;
  out.ideal = box(ideal);
  std::vector<Spread> all;
  for (const LodInterval& piece : pieces) {
    add_piece(box, piece, scale, all);
  }
  Spread around = out.ideal;
  for (const Spread& s : all) {
    around = widened(around, s);
  }
  if (is_small(around, scale) || around.radius == out.ideal.radius) {
    out.ideal = around;
    return out;
  }
  for (const Spread& s : all) {
    if (!out.others.empty()) {
      if (const Spread both = hull(out.others.back(), s); is_small(both, scale)) {
        out.others.back() = both;
        continue;
      }
    }
    out.others.push_back(s);
  }
  return out;
}

}  // namespace sheen::golden
