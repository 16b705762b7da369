#pragma once

#include <cstddef>
#include <cstdint>

#include "golden/bound.h"
#include "golden/mapped_normal.h"
#include "golden/shade.h"

namespace sheen::golden {

/// AlbedoReader of number::Bounded, in a translation unit that every processor runs: what number::BoundedBatch asks of single lanes.
template <class Precision>
struct OneAlbedo {
  using B = number::Bounded<Precision>;
  static B sheen(const SheenAlbedo& albedo, const B& cosine, const B& sheen_roughness);
  static brdf::LobeAlbedo<B> ggx(const albedo::GgxInterpolant& ggx, const B& cosine, const B& alpha);
  static brdf::LobeAlbedo<B> ggx_average(const albedo::GgxInterpolant& ggx, const B& alpha);
};
extern template struct OneAlbedo<number::Highp>;
extern template struct OneAlbedo<number::Mediump>;

/// E about one roughness.
AlbedoAround albedo_around(const albedo::Interpolant& albedo, const Bound& sheen_roughness);

/// Surfaces in view space whose radiance is wanted on number::Bounded; all have the same layers.
struct BoundJob {
  const Surface<Bound>* surfaces;
  const std::uint32_t* order;  ///< of `count` indices into surfaces and results
  std::size_t count;
  Layers layers;
  Precision lobes;            ///< of the lobes' and Fresnel terms' arithmetic
  bool ranges_alone = false;  ///< how far the results reach will do, whatever moves them; see number::RangeBatch
};

/// Shades them into results at the same indices, eight at a time where the processor can.
void bound_all(const BoundJob& job, const Lighting& lighting, brdf::Rgb<Bound>* results);

/// The same, one at a time.
void bound_all_scalar(const BoundJob& job, const Lighting& lighting, brdf::Rgb<Bound>* results);

/// The same on number::BoundedBatch. Only where number::has_batch().
void bound_all_batch(const BoundJob& job, const Lighting& lighting, brdf::Rgb<Bound>* results);

/// bent() of all, four at a time where the processor can; and one at a time; and on number::BoundedBatch.
void bend_all(const MappedNormal<Bound>* maps, std::size_t count, Vec3<Bound>* normals);
void bend_all_scalar(const MappedNormal<Bound>* maps, std::size_t count, Vec3<Bound>* normals);
void bend_all_batch(const MappedNormal<Bound>* maps, std::size_t count, Vec3<Bound>* normals);

}  // namespace sheen::golden
