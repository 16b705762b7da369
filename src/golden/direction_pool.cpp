#include "golden/direction_pool.h"

#include <cmath>
#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

namespace sheen::golden {

std::uint64_t mix(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

namespace {

// Blocks of a sequence that are kept; what lies beyond is made anew each time. 2,048 directions cost 32 MiB an image over all sequences,
// and few pixels need more.
constexpr std::uint32_t kept_blocks = 64;

std::uint32_t reversed(std::uint32_t x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0F0F0F0Fu) | ((x & 0x0F0F0F0Fu) << 4);
  x = ((x >> 8) & 0x00FF00FFu) | ((x & 0x00FF00FFu) << 8);
  return (x >> 16) | (x << 16);
}

// Each bit of the result depends on the bits of x below it alone: an Owen scrambling of the reversed number.
std::uint32_t laine_karras(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3D20ADEAu;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526C56u;
  return x ^ (x * 0x53A22864u);
}

struct Bits {
  std::uint32_t x, y;
};

// The first two dimensions of Sobol's sequence: van der Corput's, and that of the polynomial x + 1. Reversed, as scrambling wants them.
Bits reversed_sobol(std::uint32_t index) {
  std::uint32_t y = 0;
  std::uint32_t row = 1u << 31;
  for (std::uint32_t i = index; i != 0; i >>= 1, row ^= row >> 1) {
    y ^= (i & 1u) != 0 ? row : 0u;
  }
  return {index, reversed(y)};
}

struct Unit {
  double u, v;  // (0, 1)
};

class Sequence {
 public:
  explicit Sequence(std::uint64_t seed) : seed_(seed), scramble_(mix(seed)), shift_(mix(seed + 1)) {}

  Unit point(std::uint32_t index) const {
    const Bits bits = reversed_sobol(index);
    const std::uint64_t fine = mix(seed_ ^ (std::uint64_t{index} << 20));
    return {unit(reversed(laine_karras(bits.x, low(scramble_))) ^ low(shift_), low(fine)),
            unit(reversed(laine_karras(bits.y, high(scramble_))) ^ high(shift_), high(fine))};
  }

 private:
  static std::uint32_t low(std::uint64_t x) { return static_cast<std::uint32_t>(x); }
  static std::uint32_t high(std::uint64_t x) { return static_cast<std::uint32_t>(x >> 32); }
  // Digits beyond the 32nd at random: the smallest texel of a large image gets its due.
  static double unit(std::uint32_t bits, std::uint32_t fine) {
    return (static_cast<double>(bits) + (static_cast<double>(fine >> 12) + 0.5) * 0x1p-20) * 0x1p-32;
  }

  std::uint64_t seed_, scramble_, shift_;
};

// The blocks of all sequences, each made when first asked for.
template <class Block>
class Store {
 public:
  Store() : slots_(static_cast<std::size_t>(DirectionPool::sequences) * kept_blocks) {}

  template <class Make>
  const Block& get(std::uint32_t sequence, std::uint32_t number, Block& scratch, const Make& make) {
    if (number >= kept_blocks) {
      make(scratch);
      return scratch;
    }
    Slot& slot = slots_[static_cast<std::size_t>(sequence) * kept_blocks + number];
    std::call_once(slot.made, [&] {
      auto made = std::make_unique<Block>();
      make(*made);
      slot.block = std::move(made);
    });
    return *slot.block;
  }

 private:
  struct Slot {
    std::once_flag made;
    std::unique_ptr<const Block> block;
  };
  std::vector<Slot> slots_;
};

}  // namespace

struct DirectionPool::Impl {
  const EnvironmentLight& light;
  std::uint64_t seed;
  Store<LightBlock> soft, bright;
  Store<LobeBlock> lobe;

  Impl(const EnvironmentLight& light_in, std::uint64_t seed_in) : light(light_in), seed(mix(seed_in)) {}

  const LightPoint* points(const ImageLight& image, Store<LightBlock>& store, std::uint32_t id, std::uint32_t begin,
                           LightBlock& scratch) const {
    const std::uint32_t first = begin - begin % block;
    const LightBlock& found = store.get(id, begin / block, scratch, [&](LightBlock& out) {
      const Sequence sequence(seed ^ mix(id));
      for (std::uint32_t i = 0; i < block; ++i) {
        const Unit p = sequence.point(first + i);
        out.points[i] = image.sample(p.u, p.v);
      }
    });
    return found.points + (begin - first);
  }
};

DirectionPool::DirectionPool(const EnvironmentLight& light, std::uint64_t seed) : impl_(std::make_unique<Impl>(light, seed)) {}
DirectionPool::~DirectionPool() = default;

const LightPoint* DirectionPool::soft(std::uint32_t sequence, std::uint32_t begin, LightBlock& scratch) const {
  return impl_->points(impl_->light.soft(), impl_->soft, sequence, begin, scratch);
}

const LightPoint* DirectionPool::bright(std::uint32_t sequence, std::uint32_t begin, LightBlock& scratch) const {
  return impl_->points(impl_->light.bright(), impl_->bright, sequence, begin, scratch);
}

LobePoints DirectionPool::lobe(std::uint32_t sequence, std::uint32_t begin, LobeBlock& scratch) const {
  const std::uint32_t first = begin - begin % block;
  const LobeBlock& found = impl_->lobe.get(sequence, begin / block, scratch, [&](LobeBlock& out) {
    const Sequence made(impl_->seed ^ mix(sequence));
    for (std::uint32_t i = 0; i < block; ++i) {
      const Unit p = made.point(first + i);
      out.u[i] = p.u;
      out.cosine[i] = std::cos(2.0 * brdf::pi * p.v);
      out.sine[i] = std::sin(2.0 * brdf::pi * p.v);
    }
  });
  const std::uint32_t at = begin - first;
  return {found.u + at, found.cosine + at, found.sine + at};
}

}  // namespace sheen::golden
