#include "golden/normal_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

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

bool turns_far(const Spread& a, const Spread& b, double scale) {
  const glm::dvec3 from = direction(a.value, scale);
  const glm::dvec3 to = direction(b.value, scale);
  static const double most = std::tan(widest_turn);
  return !(glm::length(glm::cross(from, to)) <= most * glm::dot(from, to));
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

/// Boxes of one piece after the other.
class Pieces {
 public:
  Pieces(TextureBox& box, double scale) : box_(box), scale_(scale) {}

  // In one box or two.
  void add(const LodInterval& piece, std::vector<Spread>& all) {
    const Spread from = piece.low == end_ ? at_end_ : box_(piece.low);
    if (piece.high == piece.low) {
      all.push_back(from);
      return;
    }
    const Spread to = box_(piece.high);
    if (turns_far(from, to, scale_)) {
      const Spread between = box_(0.5 * (piece.low + piece.high));
      all.push_back(hull(from, between));
      all.push_back(hull(between, to));
    } else {
      all.push_back(hull(from, to));
    }
    end_ = piece.high;
    at_end_ = to;
  }

 private:
  TextureBox& box_;
  double scale_;
  // Of the last piece, where the next mostly begins.
  double end_ = std::numeric_limits<double>::quiet_NaN();
  Spread at_end_;
};

}  // namespace

NormalLevels normal_levels(TextureBox& box, double ideal, const std::vector<LodInterval>& pieces, double scale) {
  NormalLevels out;
  if (pieces.empty()) {
    out.boxes.push_back(box(ideal));
    return out;
  }
  Pieces read(box, scale);
  std::vector<Spread> all;
  for (const LodInterval& piece : pieces) {
    read.add(piece, all);
  }
  const Spread whole = std::accumulate(all.begin() + 1, all.end(), all.front(), hull);
  if (is_small(whole, scale)) {
    const Spread around = widened(box(ideal), whole);
    if (is_small(around, scale)) {
      out.boxes.push_back(around);
      return out;
    }
  }
  out.is_open = true;
  for (const Spread& s : all) {
    if (!out.boxes.empty()) {
      if (const Spread both = hull(out.boxes.back(), s); is_small(both, scale)) {
        out.boxes.back() = both;
        continue;
      }
    }
    out.boxes.push_back(s);
  }
  return out;
}

}  // namespace sheen::golden
