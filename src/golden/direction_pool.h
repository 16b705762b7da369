#pragma once

#include <cstdint>
#include <memory>

#include "golden/environment_light.h"

namespace sheen::golden {

/// Points that a lobe's directions are drawn from: u in (0, 1), and an angle's cosine and sine.
struct LobePoints {
  const double *u, *cosine, *sine;
};

/// Sequences of directions, each an independent randomisation of Sobol's first two dimensions (Sobol 1967) by Owen's scrambling (Owen 1997;
/// the hash of Laine and Karras 2011, as Burley 2020 uses it, with Vegdahl's constants) and a digital shift, which makes every point
/// uniform whatever the quality of the hash. Every pixel draws its own choice of them, so that what does not depend on the surface is found
/// once: where the image's directions lie and what arrives from there. Safe to call from many threads; the same for a given seed.
class DirectionPool {
 public:
  static constexpr std::uint32_t sequences = 256;
  /// Points come in blocks: this many at most, and none that crosses a multiple of it.
  static constexpr std::uint32_t block = 32;

  struct LightBlock {
    LightPoint points[block];
  };
  struct LobeBlock {
    double u[block], cosine[block], sine[block];
  };

  /// The light must outlive this.
  DirectionPool(const EnvironmentLight& light, std::uint64_t seed);
  ~DirectionPool();
  DirectionPool(const DirectionPool&) = delete;
  DirectionPool& operator=(const DirectionPool&) = delete;

  /// The points from `begin`, up to the end of its block, of a sequence in [0, sequences); in `scratch` or for as long as this lives.
  const LightPoint* soft(std::uint32_t sequence, std::uint32_t begin, LightBlock& scratch) const;
  const LightPoint* bright(std::uint32_t sequence, std::uint32_t begin, LightBlock& scratch) const;
  LobePoints lobe(std::uint32_t sequence, std::uint32_t begin, LobeBlock& scratch) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// splitmix64 (Steele, Lea and Flood 2014): a hash of 64 bits.
std::uint64_t mix(std::uint64_t x);

}  // namespace sheen::golden
