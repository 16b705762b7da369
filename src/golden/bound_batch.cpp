#include <algorithm>
#include <limits>
#include <optional>

#include "golden/batches.h"
#include "golden/bound_all.h"
#include "golden/bounded_batch_albedo.h"
#include "golden/eight.h"
#include "golden/range_vectors.h"
#include "number/affine_batch.h"
#include "number/bounded_batch_functions.h"
#include "number/range_batch.h"

namespace sheen::brdf {

/// As Exponents of Bounded.
template <>
struct Exponents<number::BoundedBatch<number::Mediump>> {
  using Narrow = number::BoundedBatch<number::Mediump>;
  using Type = number::BoundedBatch<number::Highp>;
  static Type widened(const Narrow& x) { return number::converted_to(x, static_cast<const Type*>(nullptr)); }
  static Narrow narrowed(const Type& x) { return number::converted_to(x, static_cast<const Narrow*>(nullptr)); }
};

/// Where the view may be along the normal, a form, the same to either side of its centre, reaches beyond where Lambda's curve has a value,
/// and takes it for anything. There ranges serve, which end at 1.
template <>
inline number::AffineBatch lambda_of_view(const LambdaCurve<number::AffineBatch>& curve, const number::AffineBatch& n_dot_v) {
  using number::FloatBatch;
  using Ranges = number::RangeBatch;
  number::AffineBatch lambda = curve.lambda(n_dot_v);
  const number::FloatMask head_on = FloatBatch(1.0F) - n_dot_v.center() <= n_dot_v.spread();
  if (xsimd::any(head_on)) {
    const auto range = [](const number::AffineBatch& x) {
      const FloatBatch reach = x.spread() + (xsimd::abs(x.center()) + x.spread()) * FloatBatch(0x1p-22F);
      return Ranges(x.center() - reach, x.center() + reach);
    };
    const LambdaCurve<Ranges> ranges(range(curve.a), range(curve.b), range(curve.c), range(curve.d), range(curve.e));
    const Ranges found = ranges.lambda(min(range(n_dot_v), Ranges(1.0)));
    lambda.take(head_on, number::AffineBatch(found.bounds(0), found.bounds(1)));
  }
  return lambda;
}

}  // namespace sheen::brdf

namespace sheen::golden {

/// unit_or() of mapped_normal.h in every lane.
template <class Precision, class Otherwise>
Vec3<number::BoundedBatch<Precision>> unit_or(const Vec3<number::BoundedBatch<Precision>>& v, const Otherwise& otherwise) {
  using Batch = number::BoundedBatch<Precision>;
  using One = typename Batch::One;
  const Batch squared = dot(v, v);
  Vec3<Batch> unit = v * inversesqrt(squared);
  const number::BatchMask has_direction = (squared.lower() > number::Batch(smallest_length_squared)) & ~squared.is_unbounded();
  for (std::size_t i = 0; i < Batch::lanes; ++i) {
    if (!has_direction.get(i)) {
      const auto lane = [i](const Vec3<Batch>& w) { return Vec3<One>{w.x.lane(i), w.y.lane(i), w.z.lane(i)}; };
      const Vec3<One> one = unit_or(lane(v), [&] { return lane(otherwise()); });
      unit.x.set_lane(i, one.x);
      unit.y.set_lane(i, one.y);
      unit.z.set_lane(i, one.z);
    }
  }
  return unit;
}

/// The same by ranges; a lane without a certain direction is lost.
template <class Otherwise>
Vec3<number::RangeBatch> unit_or(const Vec3<number::RangeBatch>& v, const Otherwise& /*otherwise*/) {
  using Ranges = number::RangeBatch;
  const Ranges squared = dot(v, v);
  const number::FloatMask has_direction = squared.lower() > number::FloatBatch(static_cast<float>(smallest_length_squared));
  const number::FloatBatch none(std::numeric_limits<float>::quiet_NaN());
  Ranges inverse = inversesqrt(squared);
  inverse.take(~has_direction, Ranges(none, none));
  return v * inverse;
}

namespace {

/// f(first, count) of groups of lanes.
template <class Function>
void by_lanes(std::size_t lanes, std::size_t count, const Function& f) {
  for (std::size_t i = 0; i < count; i += lanes) {
    f(i, std::min(count - i, lanes));
  }
}

using Forms = number::AffineBatch;
using Ranges = number::RangeBatch;
using Lobes = number::BoundedBatch<number::Mediump>;

brdf::Rgb<Forms> forms_of(const brdf::Rgb<Ranges>& c) {
  const auto form = [](const Ranges& x) { return Forms(x.bounds(0), x.bounds(1)); };
  return {form(c.r), form(c.g), form(c.b)};
}

/// Takes the other's channels in those of the lanes where they are narrower.
void take_narrower(brdf::Rgb<Forms>& c, const number::FloatMask& lanes, const brdf::Rgb<Forms>& other) {
  const auto take = [&lanes](Forms& x, const Forms& y) { x.take(lanes & ~(x.spread() <= y.spread()), y); };
  take(c.r, other.r);
  take(c.g, other.g);
  take(c.b, other.b);
}

/// Whether a normal map leaves a normal open, by more than narrow lobes care for and far more than a displaced sample moves it and the
/// view; or textures a roughness or a colour, by a good part of it.
number::FloatMask is_wide(const Surface<Forms>& surface, Layers layers) {
  using number::FloatBatch;
  constexpr float narrow = 0.005F;  // radians
  constexpr float part = 0.25F;
  const auto moved = [](const Vec3<Forms>& v) { return v.x.displacement() + v.y.displacement() + v.z.displacement(); };
  const auto open = [](const Vec3<Forms>& v) { return v.x.radius() + v.y.radius() + v.z.radius(); };
  const FloatBatch view = moved(surface.view);
  const auto opens = [&](const Vec3<Forms>& n) { return open(n) > xsimd::max(FloatBatch(narrow), FloatBatch(4.0F) * (moved(n) + view)); };
  const auto is_vague = [](const Forms& x) { return x.spread() > FloatBatch(part) * xsimd::abs(x.center()); };
  const auto is_vague_color = [&](const brdf::Rgb<Forms>& c) { return is_vague(c.r) | is_vague(c.g) | is_vague(c.b); };
  number::FloatMask wide = opens(surface.normal) | is_vague(surface.base.alpha) | is_vague_color(surface.base.color);
  if (layers.sheen) {
    wide = wide | is_vague_color(surface.sheen_color);
  }
  if (layers.clearcoat) {
    wide = wide | opens(surface.coat_normal) | is_vague(surface.coat_alpha);
  }
  return wide;
}

/// Whether a light adds more uncertainty than there is light with it, in some channel; or a lane is lost by it. Not where it is as good as
/// nothing of the light that arrives: what a division by highp's rules may make of 0. Nor where none arrives (beyond its range, outside its
/// cone) but for numbers too small for a float, which an intensity magnifies.
number::FloatMask is_open(const brdf::Rgb<Forms>& before, const brdf::Rgb<Forms>& after, const brdf::Rgb<Forms>& irradiance) {
  using number::FloatBatch;
  constexpr float nothing = 0x1p-64F;
  const auto opens = [](const Forms& x, const Forms& y, const Forms& e) {
    const FloatBatch none(0.0F);
    const number::FloatMask is_dark = (e.center() == none) & (e.spread() <= FloatBatch(nothing));
    const FloatBatch of_light = xsimd::select(is_dark, e.spread(), FloatBatch(nothing) * xsimd::abs(e.center()));
    const FloatBatch enough = xsimd::max(xsimd::abs(y.center()), of_light);
    return ~x.is_lost() & (y.is_lost() | ~(y.spread() - x.spread() <= enough));
  };
  return opens(before.r, after.r, irradiance.r) | opens(before.g, after.g, irradiance.g) | opens(before.b, after.b, irradiance.b);
}

/// What `careful` gives of a half where one of its lanes is among these, else the sum's.
template <class Careful>
brdf::Rgb<Forms> instead_of(const brdf::Rgb<Forms>& sum, const number::FloatMask& lanes, const Careful& careful) {
  if (!xsimd::any(lanes)) {
    return sum;
  }
  const auto half = [&](std::size_t i) { return any_of_half(lanes, i) ? careful(i) : half_of(sum, i); };
  const brdf::Rgb<Many> first = half(0);
  const brdf::Rgb<Many> last = half(1);
  return {Forms(first.r, last.r), Forms(first.g, last.g), Forms(first.b, last.b)};
}

/// shade() of surfaces each under the same lights (not Lighting::distant): light by light without ranges where that holds all lanes of a
/// half, else with them.
brdf::Rgb<Forms> shade_by_forms(const EightOf<Surface>& surfaces, Layers layers, const Lighting& lighting) {
  const Surface<Forms> forms = surfaces.all<Forms>();
  const Shading<Forms, Forms> quick(forms, layers, lighting);
  std::optional<Shading<Many, Many>> made[2];
  const auto careful = [&](std::size_t half) -> const Shading<Many, Many>& {
    return made[half] ? *made[half] : made[half].emplace(surfaces.half(half), layers, lighting);
  };
  const number::FloatMask wide = is_wide(forms, layers);
  std::optional<Surface<Ranges>> ranges;
  std::optional<Shading<Ranges, Ranges>> coarse;
  if (xsimd::any(wide)) {
    coarse.emplace(ranges.emplace(surfaces.all<Ranges>()), layers, lighting);
  }
  const auto with = [layers](const auto& sum, const auto& part) { return with_light(sum, layers, part.sheen, part.base, part.coat); };
  const brdf::Rgb<Forms> emitted = quick.emission();
  brdf::Rgb<Forms> radiance = instead_of(emitted, lost(emitted), [&](std::size_t half) { return careful(half).emission(); });
  brdf::Rgb<Forms> no_lookup;
  brdf::Rgb<Many> none;
  brdf::Rgb<Ranges> no_ranges;
  bool forms_serve = true;
  for (std::size_t i = 0; i < lighting.light_count; ++i) {
    brdf::Rgb<Forms> sum = radiance;
    number::FloatMask open = wide;
    if (forms_serve) {
      const Arriving<Forms> light = arriving(lighting.lights[i], forms.position);
      const auto part = quick.light(light, false, no_lookup);
      if (!part.lit) {
        continue;
      }
      sum = with(radiance, part);
      open = is_open(radiance, sum, light.irradiance);
    }
    if (xsimd::any(open & wide)) {
      const auto part = coarse->light(arriving(lighting.lights[i], ranges->position), false, no_ranges);
      const brdf::Rgb<Forms> by_ranges = with_light(radiance, layers, forms_of(part.sheen), forms_of(part.base), forms_of(part.coat));
      if (forms_serve) {
        forms_serve = !xsimd::all(wide & lost(sum));  // else they are not asked for the lights to come
        take_narrower(sum, open & wide, by_ranges);
      } else {
        sum = by_ranges;
      }
      open = open & (~wide | lost(sum));
    }
    radiance = instead_of(sum, open, [&](std::size_t half) {
      const auto part = careful(half).light(arriving(lighting.lights[i], surfaces.half(half).position), false, none);
      return with(half_of(radiance, half), part);
    });
  }
  return radiance;
}

/// Results of ranges to where they belong; those of lanes that are lost once more one by one, by careful(index).
template <template <class> class Result, class Careful>
void scatter_ranges(const Result<Ranges>& made, const std::uint32_t* order, std::size_t count, Result<Bound>* results,
                    const Careful& careful) {
  scatter_eight(made, order, count, results);
  const number::FloatMask are_lost = lost(made);
  for (std::size_t lane = 0; lane < count && xsimd::any(are_lost); ++lane) {
    if (are_lost.get(lane)) {
      careful(order[lane]);
    }
  }
}

}  // namespace

void bound_all_batch(const BoundJob& job, const Lighting& lighting, brdf::Rgb<Bound>* results) {
  if (job.lobes == Precision::Mediump) {
    by_lanes(Many::lanes, job.count, [&](std::size_t i, std::size_t here) {
      const auto surfaces = gather<Surface<Many>>(job.surfaces, job.order + i, here);
      scatter(shade_with<Lobes>(surfaces, job.layers, lighting, NoListener{}).radiance, job.order + i, here, results);
    });
    return;
  }
  by_lanes(eight, job.count, [&](std::size_t i, std::size_t here) {
    const EightOf<Surface> surfaces(job.surfaces, job.order + i, here);
    scatter_eight(shade_by_forms(surfaces, job.layers, lighting), job.order + i, here, results);
  });
}

void bend_all_batch(const MappedNormal<Bound>* maps, std::size_t count, Vec3<Bound>* normals) {
  constexpr std::uint32_t order[Many::lanes] = {0, 1, 2, 3};
  by_lanes(Many::lanes, count, [&](std::size_t i, std::size_t here) {
    scatter(bent(gather<MappedNormal<Many>>(maps + i, order, here)), order, here, normals + i);
  });
}

void bend_ranges_batch(const MappedNormal<Bound>* maps, std::size_t count, Vec3<Bound>* normals) {
  constexpr std::uint32_t order[eight] = {0, 1, 2, 3, 4, 5, 6, 7};
  by_lanes(eight, count, [&](std::size_t i, std::size_t here) {
    const auto careful = [&](std::uint32_t lane) { bend_all_scalar(maps + i + lane, 1, normals + i + lane); };
    scatter_ranges(bent(gather_ranges(maps + i, order, here)), order, here, normals + i, careful);
  });
}

void bound_coats_batch(const CoatJob& job, const Lighting& lighting, CoatSum<Bound>* results) {
  if (job.lobes == Precision::Mediump) {
    by_lanes(Many::lanes, job.count, [&](std::size_t i, std::size_t here) {
      const auto surfaces = gather<CoatSurface<Many>>(job.surfaces, job.order + i, here);
      scatter(coat_sum<Lobes>(surfaces, lighting), job.order + i, here, results);
    });
    return;
  }
  by_lanes(eight, job.count, [&](std::size_t i, std::size_t here) {
    const auto careful = [&](std::uint32_t index) { bound_coats_scalar({job.surfaces, &index, 1, job.lobes}, lighting, results); };
    scatter_ranges(coat_sum<Ranges>(gather_ranges(job.surfaces, job.order + i, here), lighting), job.order + i, here, results, careful);
  });
}

void bound_below_batch(const BelowJob& job, const Lighting& lighting, BelowSum<Bound>* results) {
  const bool mediump = job.lobes == Precision::Mediump;
  by_lanes(mediump ? Many::lanes : eight, job.count, [&](std::size_t i, std::size_t here) {
    const std::uint32_t* order = job.order + i;
    std::uint32_t surfaces[eight];
    for (std::size_t lane = 0; lane < here; ++lane) {
      surfaces[lane] = job.surface_of[order[lane]];
    }
    if (mediump) {
      const auto of = gather<Surface<Many>>(job.surfaces, surfaces, here);
      scatter(below_sum<Lobes>(of, gather<BelowSurface<Many>>(job.below, order, here), job.layers, lighting), order, here, results);
      return;
    }
    const auto careful = [&](std::uint32_t index) {
      bound_below_scalar({job.surfaces, job.below, job.surface_of, &index, 1, job.layers, job.lobes}, lighting, results);
    };
    const auto of = gather_ranges(job.surfaces, surfaces, here);
    scatter_ranges(below_sum<Ranges>(of, gather_ranges(job.below, order, here), job.layers, lighting), order, here, results, careful);
  });
}

}  // namespace sheen::golden
