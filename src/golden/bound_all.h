#pragma once

#include <cstddef>
#include <cstdint>

#include "golden/bound.h"
#include "golden/mapped_normal.h"
#include "golden/parts.h"
#include "golden/shade.h"

namespace sheen::golden {

/// AlbedoReader of number::Bounded, in a translation unit that every processor runs: what number::BoundedBatch asks of single lanes.
template <class Precision>
struct OneAlbedo {
  using B = number::Bounded<Precision>;
  // What the others take of a roughness and of an alpha.
  static void find_roughnesses(const B& sheen_roughness, SheenRoughnesses& roughnesses);
  static void find_alphas(const B& alpha, GgxAlphas& alphas);
  static B sheen(const SheenAlbedo& albedo, const SheenRoughnesses& roughnesses, const B& cosine, const B& sheen_roughness);
  static brdf::LobeAlbedo<B> ggx(const BaseAlbedo& albedo, const GgxAlphas& alphas, const B& cosine, const B& alpha);
  static brdf::LobeAlbedo<B> ggx_average(const BaseAlbedo& albedo, const GgxAlphas& alphas, const B& alpha);
};
extern template struct OneAlbedo<number::Highp>;
extern template struct OneAlbedo<number::Mediump>;

/// Albedo of the GGX lobe about one alpha.
GgxAround ggx_around(const albedo::GgxInterpolant& ggx, const Bound& alpha);

/// Surfaces in view space whose radiance is wanted on number::Bounded; all have the same layers.
struct BoundJob {
  const Surface<Bound>* surfaces;
  const std::uint32_t* order;  ///< of `count` indices into surfaces and results
  std::size_t count;
  Layers layers;
  Precision lobes;  ///< of the lobes' and Fresnel terms' arithmetic
};
/// Likewise, of what shows a part of them alone.
struct CoatJob {
  const CoatSurface<Bound>* surfaces;
  const std::uint32_t* order;
  std::size_t count;
  Precision lobes;
};
struct BelowJob {
  const Surface<Bound>* surfaces;
  const BelowSurface<Bound>* below;
  const std::uint32_t* surface_of;  ///< of each of `below`, an index into surfaces
  const std::uint32_t* order;       ///< of `count` indices into `below` and results
  std::size_t count;
  Layers layers;
  Precision lobes;
};

/// Shades them into results at the same indices, eight at a time where the processor can.
void bound_all(const BoundJob& job, const Lighting& lighting, brdf::Rgb<Bound>* results);

/// The same, one at a time.
void bound_all_scalar(const BoundJob& job, const Lighting& lighting, brdf::Rgb<Bound>* results);

/// The same on number::BoundedBatch. Only where number::has_batch().
void bound_all_batch(const BoundJob& job, const Lighting& lighting, brdf::Rgb<Bound>* results);

/// What parts of surfaces add up to; of which the range alone is to be made use of, see number::RangeBatch.
void bound_coats(const CoatJob& job, const Lighting& lighting, CoatSum<Bound>* results);
void bound_coats_scalar(const CoatJob& job, const Lighting& lighting, CoatSum<Bound>* results);
void bound_coats_batch(const CoatJob& job, const Lighting& lighting, CoatSum<Bound>* results);
void bound_below(const BelowJob& job, const Lighting& lighting, BelowSum<Bound>* results);
void bound_below_scalar(const BelowJob& job, const Lighting& lighting, BelowSum<Bound>* results);
void bound_below_batch(const BelowJob& job, const Lighting& lighting, BelowSum<Bound>* results);

/// bent() of all, four at a time where the processor can; and one at a time; and on number::BoundedBatch.
void bend_all(const MappedNormal<Bound>* maps, std::size_t count, Vec3<Bound>* normals);
void bend_all_scalar(const MappedNormal<Bound>* maps, std::size_t count, Vec3<Bound>* normals);
void bend_all_batch(const MappedNormal<Bound>* maps, std::size_t count, Vec3<Bound>* normals);
/// Likewise, where their ranges alone are to be made use of, eight at a time; see number::RangeBatch.
void bend_ranges(const MappedNormal<Bound>* maps, std::size_t count, Vec3<Bound>* normals);
void bend_ranges_batch(const MappedNormal<Bound>* maps, std::size_t count, Vec3<Bound>* normals);

}  // namespace sheen::golden
