#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "golden/frame.h"

namespace sheen::golden {

/// A triangle that does not cover a pixel's centre, but may once a driver has moved its vertices; or one that covers it, but may then do so
/// the other way round.
struct NearMiss {
  std::uint64_t pixel;  ///< y width + x
  std::uint32_t triangle;
  double reach;  ///< how far along either axis its vertices may be moved, pixels
};

/// The near misses of all pixels of a picture, for triangles that show the side that is drawn, or may. However narrow they are: a few rays
/// around a pixel's centre would pass by them.
class NearMisses {
 public:
  static constexpr double near_steps = 2;

  explicit NearMisses(const Frame& frame);

  /// Of a pixel: [begin(), end()).
  struct Range {
    const NearMiss* first;
    const NearMiss* last;
    const NearMiss* begin() const { return first; }
    const NearMiss* end() const { return last; }
  };
  Range at(int x, int y) const;

  /// Whether at most one triangle comes within near_steps times displacement() of a pixel's centre, along both axes, and then covers it,
  /// and lies between the clip planes for certain.
  bool has_one_triangle(int x, int y) const;

 private:
  void add(const Frame& frame, std::uint32_t triangle, std::vector<NearMiss>& misses);
  void note_missed(int y, int first, int last);
  bool note_covered(std::uint64_t pixel);
  void note_covered(int y, int first, int last);
  bool note_at_clip_plane(const Frame& frame, std::uint32_t triangle);

  int width_;
  RayGenerator beyond_;             // of a camera whose clip planes lie farther apart, by what a depth buffer may take them for
  static constexpr int block = 16;  // pixels of a row
  int blocks_;                      // of a row, the last one perhaps not whole
  std::vector<std::atomic<std::uint8_t>> seen_;  // by pixel, bits
  std::vector<std::atomic<bool>> settled_;       // by block: whether what covers its pixels too changes nothing
  std::vector<NearMiss> misses_;                 // by pixel
};

}  // namespace sheen::golden
