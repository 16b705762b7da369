#include "golden/bound_all.h"

#include "golden/bounded_albedo.h"
#include "golden/bounded_mediump.h"
#include "number/bounded_functions.h"
#include "number/cpu.h"

namespace sheen::golden {

template <class Precision>
auto OneAlbedo<Precision>::sheen(const SheenAlbedo& albedo, const B& cosine, const B& sheen_roughness) -> B {
  return AlbedoReader<B>::sheen(albedo, cosine, sheen_roughness);
}

template <class Precision>
auto OneAlbedo<Precision>::ggx(const albedo::GgxInterpolant& ggx, const B& cosine, const B& alpha) -> brdf::LobeAlbedo<B> {
  return AlbedoReader<B>::ggx(ggx, cosine, alpha);
}

template <class Precision>
auto OneAlbedo<Precision>::ggx_average(const albedo::GgxInterpolant& ggx, const B& alpha) -> brdf::LobeAlbedo<B> {
  return AlbedoReader<B>::ggx_average(ggx, alpha);
}

template struct OneAlbedo<number::Highp>;
template struct OneAlbedo<number::Mediump>;

AlbedoAround albedo_around(const albedo::Interpolant& albedo, const Bound& sheen_roughness) {
  const auto at = [&albedo](double roughness) -> AlbedoAround::Curve {
    const albedo::Curve curve = albedo.at_roughness(roughness);
    return {curve, albedo::peak_of(curve, 16)};
  };
  return {at(sheen_roughness.range().lower), at(sheen_roughness.center()), at(sheen_roughness.range().upper)};
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

void bend_all_scalar(const MappedNormal<Bound>* maps, std::size_t count, Vec3<Bound>* normals) {
  for (std::size_t i = 0; i < count; ++i) {
    normals[i] = bent(maps[i]);
  }
}

void bound_all(const BoundJob& job, const Lighting& lighting, brdf::Rgb<Bound>* results) {
#if defined(__x86_64__) || defined(__i386__)
  if (number::has_batch()) {
    bound_all_batch(job, lighting, results);
    return;
  }
#endif
  bound_all_scalar(job, lighting, results);
}

void bend_all(const MappedNormal<Bound>* maps, std::size_t count, Vec3<Bound>* normals) {
#if defined(__x86_64__) || defined(__i386__)
  if (number::has_batch()) {
    bend_all_batch(maps, count, normals);
    return;
  }
#endif
  bend_all_scalar(maps, count, normals);
}

}  // namespace sheen::golden
