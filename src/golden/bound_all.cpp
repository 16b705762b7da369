#include "golden/bound_all.h"

#include <algorithm>

#include "golden/bounded_albedo.h"
#include "golden/bounded_mediump.h"
#include "golden/ggx_range.h"
#include "golden/sheen_range.h"
#include "number/bounded_functions.h"
#include "number/cpu.h"

namespace sheen::golden {

template <class Precision>
void OneAlbedo<Precision>::find_roughnesses(const B& sheen_roughness, SheenRoughnesses& roughnesses) {
  SheenRange<B>::find(sheen_roughness, roughnesses);
}

template <class Precision>
auto OneAlbedo<Precision>::sheen(const SheenAlbedo& albedo, const SheenRoughnesses& roughnesses, const B& cosine, const B& sheen_roughness)
    -> B {
  return SheenRange<B>::at(albedo, roughnesses, cosine, sheen_roughness);
}

template <class Precision>
void OneAlbedo<Precision>::find_alphas(const B& alpha, GgxAlphas& alphas) {
  GgxRange<B>::find(alpha, alphas);
}

template <class Precision>
auto OneAlbedo<Precision>::ggx(const BaseAlbedo& albedo, const GgxAlphas& alphas, const B& cosine, const B& alpha) -> brdf::LobeAlbedo<B> {
  return GgxRange<B>::at(albedo, alphas, cosine, alpha);
}

template <class Precision>
auto OneAlbedo<Precision>::ggx_average(const BaseAlbedo& albedo, const GgxAlphas& alphas, const B& alpha) -> brdf::LobeAlbedo<B> {
  return GgxRange<B>::average(albedo, alphas, alpha);
}

template struct OneAlbedo<number::Highp>;
template struct OneAlbedo<number::Mediump>;

const albedo::Peak& AlbedoAround::Curve::peak() const {
  std::call_once(found_, [this] { peak_ = albedo::peak_of(e, 16); });
  return peak_;
}

GgxAround ggx_around(const albedo::GgxInterpolant& ggx, const Bound& alpha) {
  const albedo::GgxCurve at = ggx.at_alpha(alpha.center());
  constexpr double negligible = 1e-8;
  return {at, albedo::turns_of([&at](double c) { return at(c).loss; }, negligible),
          albedo::turns_of([&at](double c) { return at(c).bias; }, negligible), alpha,
          AlbedoReader<Bound>::Ggx({&ggx, nullptr}, alpha).average()};
}

void bound_all_scalar(const BoundJob& job, const Lighting& lighting, brdf::Rgb<Bound>* results) {
  for (std::size_t i = 0; i < job.count; ++i) {
    const Surface<Bound>& surface = job.surfaces[job.order[i]];
    results[job.order[i]] =
        (job.lobes == Precision::Mediump ? shade_with<number::Bounded<number::Mediump>>(surface, job.layers, lighting, NoListener{})
                                         : shade(surface, job.layers, lighting, NoListener{}))
            .radiance;
  }
}

void bound_coats_scalar(const CoatJob& job, const Lighting& lighting, CoatSum<Bound>* results) {
  for (std::size_t i = 0; i < job.count; ++i) {
    const CoatSurface<Bound>& surface = job.surfaces[job.order[i]];
    results[job.order[i]] = job.lobes == Precision::Mediump ? coat_sum<number::Bounded<number::Mediump>>(surface, lighting)
                                                            : coat_sum<Bound>(surface, lighting);
  }
}

void bound_below_scalar(const BelowJob& job, const Lighting& lighting, BelowSum<Bound>* results) {
  for (std::size_t i = 0; i < job.count; ++i) {
    const std::uint32_t index = job.order[i];
    const Surface<Bound>& surface = job.surfaces[job.surface_of[index]];
    results[index] = job.lobes == Precision::Mediump
                         ? below_sum<number::Bounded<number::Mediump>>(surface, job.below[index], job.layers, lighting)
                         : below_sum<Bound>(surface, job.below[index], job.layers, lighting);
  }
}

void bend_all_scalar(const MappedNormal<Bound>* maps, std::size_t count, Vec3<Bound>* normals) {
  for (std::size_t i = 0; i < count; ++i) {
    normals[i] = bent(maps[i]);
  }
}

namespace {

struct Functions {
  decltype(&bound_all_scalar) all;
  decltype(&bound_coats_scalar) coats;
  decltype(&bound_below_scalar) below;
  decltype(&bend_all_scalar) bend, bend_ranges;
};

/// Those of batches where the processor can.
const Functions& functions() {
  static constexpr Functions scalar{bound_all_scalar, bound_coats_scalar, bound_below_scalar, bend_all_scalar, bend_all_scalar};
#if defined(__x86_64__) || defined(__i386__)
  static constexpr Functions batch{bound_all_batch, bound_coats_batch, bound_below_batch, bend_all_batch, bend_ranges_batch};
  return number::has_batch() ? batch : scalar;
#else
  return scalar;
#endif
}

}  // namespace

void bound_all(const BoundJob& job, const Lighting& lighting, brdf::Rgb<Bound>* results) {
  functions().all(job, lighting, results);
}

void bound_coats(const CoatJob& job, const Lighting& lighting, CoatSum<Bound>* results) {
  functions().coats(job, lighting, results);
}

void bound_below(const BelowJob& job, const Lighting& lighting, BelowSum<Bound>* results) {
  functions().below(job, lighting, results);
}

void bend_all(const MappedNormal<Bound>* maps, std::size_t count, Vec3<Bound>* normals) {
  functions().bend(maps, count, normals);
}

void bend_ranges(const MappedNormal<Bound>* maps, std::size_t count, Vec3<Bound>* normals) {
  functions().bend_ranges(maps, count, normals);
}

}  // namespace sheen::golden
