#include <algorithm>
#include <cstring>
#include <optional>

#include "albedo/lookup_error.h"
#include "golden/batches.h"
#include "golden/bound_all.h"
#include "number/affine_batch.h"
#include "number/bounded_batch_functions.h"

namespace sheen::brdf {

/// As Exponents of Bounded.
template <>
struct Exponents<number::BoundedBatch<number::Mediump>> {
  using Narrow = number::BoundedBatch<number::Mediump>;
  using Type = number::BoundedBatch<number::Highp>;
  static Type widened(const Narrow& x) { return number::converted_to(x, static_cast<const Type*>(nullptr)); }
  static Narrow narrowed(const Type& x) { return number::converted_to(x, static_cast<const Narrow*>(nullptr)); }
};

}  // namespace sheen::brdf

namespace sheen::golden {

using number::Batch;

/// As of Bounded; lane by lane, and in a translation unit that every processor runs, what is not of one roughness.
template <class Precision>
struct AlbedoReader<number::BoundedBatch<Precision>> {
  using B = number::BoundedBatch<Precision>;
  using One = number::Bounded<Precision>;

  static B sheen(const SheenAlbedo& albedo, const B& cosine, const B& sheen_roughness) {
    B e(0.0);
    number::BatchMask open(true);
    if (albedo.around != nullptr) {
      read(*albedo.around, cosine, sheen_roughness, e);
      open = cosine.is_unbounded();
    }
    for (std::size_t i = 0; i < B::lanes; ++i) {
      if (open.get(i)) {
        e.set_lane(i, OneAlbedo<Precision>::sheen(albedo, cosine.template lane<One>(i), sheen_roughness.template lane<One>(i)));
      }
    }
    return e;
  }

  template <class Read>
  static B for_light(const B& e_v, const B& n_dot_l, const B& n_dot_v, const Read& read) {
    const number::BatchMask smaller = (n_dot_v.lower() >= Batch(decreasing_from)) & (n_dot_l.lower() >= n_dot_v.upper()) &
                                      ~n_dot_v.is_unbounded() & ~n_dot_l.is_unbounded();
    if (xsimd::all(smaller)) {
      return e_v;
    }
    B e = read();
    e.take(smaller, e_v);
    return e;
  }

  static brdf::LobeAlbedo<B> ggx(const albedo::GgxInterpolant& ggx, const B& cosine, const B& alpha) {
    return each([&ggx](const One& c, const One& a) { return OneAlbedo<Precision>::ggx(ggx, c, a); }, cosine, alpha);
  }
  static brdf::LobeAlbedo<B> ggx_average(const albedo::GgxInterpolant& ggx, const B& alpha) {
    return each([&ggx](const One&, const One& a) { return OneAlbedo<Precision>::ggx_average(ggx, a); }, alpha, alpha);
  }

 private:
  template <class Read>
  static brdf::LobeAlbedo<B> each(const Read& read, const B& cosine, const B& alpha) {
    brdf::LobeAlbedo<B> albedo;
    for (std::size_t i = 0; i < B::lanes; ++i) {
      const brdf::LobeAlbedo<One> one = read(cosine.template lane<One>(i), alpha.template lane<One>(i));
      albedo.loss.set_lane(i, one.loss);
      albedo.bias.set_lane(i, one.bias);
    }
    return albedo;
  }

  /// AlbedoReader<One>::read, in lanes that are bounded.
  static void read(const AlbedoAround& around, const B& cosine, const B& roughness, B& e) {
    const Batch c = cosine.center();
    const Batch value = around.center(c);
    const Batch width = cosine.upper() - cosine.lower();
    const Batch low = around.center(cosine.lower());
    const Batch high = around.center(cosine.upper());
    const Batch slope = select(width > Batch(0.0), (high - low) / width, Batch(0.0));
    Batch lowest = xsimd::min(value, xsimd::min(low, high));
    Batch highest = xsimd::max(value, xsimd::max(low, high));
    const auto left = [&](const Batch& there, const Batch& at) { return xsimd::abs(there - value - slope * (at - c)); };
    Batch remainder = xsimd::max(left(low, cosine.lower()), left(high, cosine.upper()));
    if (!xsimd::all(roughness.is_exact())) {
      for (const albedo::Curve* curve : {&around.lower, &around.upper}) {
        const Batch at_lower = (*curve)(cosine.lower());
        const Batch at_upper = (*curve)(cosine.upper());
        lowest = xsimd::min(lowest, xsimd::min(at_lower, at_upper));
        highest = xsimd::max(highest, xsimd::max(at_lower, at_upper));
        remainder = xsimd::max(remainder, xsimd::max(left(at_lower, cosine.lower()), left(at_upper, cosine.upper())));
      }
    }
    const Batch off = albedo::lookup_error(highest, c, roughness.center());
    const Batch radius = xsimd::abs(slope) * cosine.radius() + remainder;
    e.round({value, slope * cosine.shift_x(), slope * cosine.shift_y(), radius, lowest, highest}, B::Error::absolute(0, off), true);
  }
};

template <class Precision>
inline constexpr bool finds_lookup_error<number::BoundedBatch<Precision>> = false;

/// Of forms without ranges: BoundedBatch's, less the range.
template <class Precision>
struct AlbedoReader<number::AffineBatch<Precision>> {
  using A = number::AffineBatch<Precision>;
  using Bounds = AlbedoReader<number::BoundedBatch<Precision>>;

  static A sheen(const SheenAlbedo& albedo, const A& cosine, const A& sheen_roughness) {
    return A(Bounds::sheen(albedo, cosine.bounds(), sheen_roughness.bounds()));
  }
  template <class Read>
  static A for_light(const A& e_v, const A& n_dot_l, const A& n_dot_v, const Read& read) {
    const number::BatchMask smaller = (n_dot_v.lower() >= Batch(decreasing_from)) & (n_dot_l.lower() >= n_dot_v.upper());
    if (xsimd::all(smaller)) {
      return e_v;
    }
    A e = read();
    e.take(smaller, e_v);
    return e;
  }
  static brdf::LobeAlbedo<A> ggx(const albedo::GgxInterpolant& ggx, const A& cosine, const A& alpha) {
    return form(Bounds::ggx(ggx, cosine.bounds(), alpha.bounds()));
  }
  static brdf::LobeAlbedo<A> ggx_average(const albedo::GgxInterpolant& ggx, const A& alpha) {
    return form(Bounds::ggx_average(ggx, alpha.bounds()));
  }

 private:
  static brdf::LobeAlbedo<A> form(const brdf::LobeAlbedo<number::BoundedBatch<Precision>>& albedo) {
    return {A(albedo.loss), A(albedo.bias)};
  }
};

template <class Precision>
inline constexpr bool finds_lookup_error<number::AffineBatch<Precision>> = false;

/// unit_or() of mapped_normal.h in every lane.
template <class Precision, class Otherwise>
Vec3<number::BoundedBatch<Precision>> unit_or(const Vec3<number::BoundedBatch<Precision>>& v, const Otherwise& otherwise) {
  using Many = number::BoundedBatch<Precision>;
  using One = typename Many::One;
  const Many squared = dot(v, v);
  Vec3<Many> unit = v * inversesqrt(squared);
  const number::BatchMask has_direction = (squared.lower() > Batch(smallest_length_squared)) & ~squared.is_unbounded();
  for (std::size_t i = 0; i < Many::lanes; ++i) {
    if (!has_direction.get(i)) {
      const auto lane = [i](const Vec3<Many>& w) { return Vec3<One>{w.x.lane(i), w.y.lane(i), w.z.lane(i)}; };
      const Vec3<One> one = unit_or(lane(v), [&] { return lane(otherwise()); });
      unit.x.set_lane(i, one.x);
      unit.y.set_lane(i, one.y);
      unit.z.set_lane(i, one.z);
    }
  }
  return unit;
}

void bend_all_batch(const MappedNormal<Bound>* maps, std::size_t count, Vec3<Bound>* normals) {
  using Many = number::BoundedBatch<number::Highp>;
  constexpr std::uint32_t order[Many::lanes] = {0, 1, 2, 3};
  for (std::size_t i = 0; i < count; i += Many::lanes) {
    const std::size_t here = std::min(count - i, Many::lanes);
    scatter(bent(gather<MappedNormal<Many>>(maps + i, order, here)), order, here, normals + i);
  }
}

namespace {

using Many = number::BoundedBatch<number::Highp>;
using Forms = number::AffineBatch<number::Highp>;

brdf::Rgb<Forms> forms_of(const brdf::Rgb<Many>& c) {
  return {Forms(c.r), Forms(c.g), Forms(c.b)};
}

const brdf::Rgb<Forms>& forms_of(const brdf::Rgb<Forms>& c) {
  return c;
}

Surface<Forms> forms_of(const Surface<Many>& surface) {
  constexpr std::size_t numbers = sizeof(Surface<Many>) / sizeof(Many);
  static_assert(sizeof(Surface<Forms>) == numbers * sizeof(Forms));
  Surface<Forms> out;
  for (std::size_t i = 0; i < numbers; ++i) {
    Many one;
    std::memcpy(static_cast<void*>(&one), reinterpret_cast<const char*>(&surface) + i * sizeof(Many), sizeof(one));
    const Forms form(one);
    std::memcpy(reinterpret_cast<char*>(&out) + i * sizeof(Forms), static_cast<const void*>(&form), sizeof(form));
  }
  return out;
}

bool is_lost(const brdf::Rgb<Forms>& c) {
  return xsimd::any(c.r.is_lost() | c.g.is_lost() | c.b.is_lost());
}

/// shade() of surfaces each under the same lights (not Lighting::distant): light by light without ranges where that holds all lanes, else
/// with them.
brdf::Rgb<Many> shade_by_forms(const Surface<Many>& surface, Layers layers, const Lighting& lighting) {
  const Surface<Forms> form = forms_of(surface);
  const Shading<Forms, Forms> quick(form, layers, lighting);
  std::optional<Shading<Many, Many>> made;
  const auto careful = [&]() -> const Shading<Many, Many>& { return made ? *made : made.emplace(surface, layers, lighting); };
  brdf::Rgb<Forms> radiance = quick.emission();
  if (is_lost(radiance)) {
    radiance = forms_of(careful().emission());
  }
  const auto with = [&](const auto& part) {
    return with_light(radiance, layers, forms_of(part.sheen), forms_of(part.base), forms_of(part.coat));
  };
  brdf::Rgb<Forms> no_lookup;
  brdf::Rgb<Many> none;
  for (std::size_t i = 0; i < lighting.light_count; ++i) {
    const brdf::Rgb<Forms> lit = with(quick.light(arriving(lighting.lights[i], form.position), false, no_lookup));
    radiance = is_lost(lit) ? with(careful().light(arriving(lighting.lights[i], surface.position), false, none)) : lit;
  }
  return {radiance.r.bounds(), radiance.g.bounds(), radiance.b.bounds()};
}

}  // namespace

void bound_all_batch(const BoundJob& job, const Lighting& lighting, brdf::Rgb<Bound>* results) {
  using Lobes = number::BoundedBatch<number::Mediump>;
  for (std::size_t i = 0; i < job.count; i += Many::lanes) {
    const std::size_t here = std::min(job.count - i, Many::lanes);
    const auto surfaces = gather<Surface<Many>>(job.surfaces, job.order + i, here);
    const brdf::Rgb<Many> radiance = job.lobes == Precision::Mediump
                                         ? shade_with<Lobes>(surfaces, job.layers, lighting, NoListener{}).radiance
                                         : shade_by_forms(surfaces, job.layers, lighting);
    scatter(radiance, job.order + i, here, results);
  }
}

}  // namespace sheen::golden
