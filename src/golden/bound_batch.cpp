#include <algorithm>
#include <cstring>
#include <optional>

#include "golden/batches.h"
#include "golden/bound_all.h"
#include "golden/bounded_batch_albedo.h"
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

}  // namespace sheen::brdf

namespace sheen::golden {

/// unit_or() of mapped_normal.h in every lane.
template <class Precision, class Otherwise>
Vec3<number::BoundedBatch<Precision>> unit_or(const Vec3<number::BoundedBatch<Precision>>& v, const Otherwise& otherwise) {
  using Many = number::BoundedBatch<Precision>;
  using One = typename Many::One;
  const Many squared = dot(v, v);
  Vec3<Many> unit = v * inversesqrt(squared);
  const number::BatchMask has_direction = (squared.lower() > number::Batch(smallest_length_squared)) & ~squared.is_unbounded();
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
using Forms = number::AffineBatch;
using Ranges = number::RangeBatch;
constexpr std::size_t eight = 2 * Many::lanes;

/// Two surfaces of four lanes as one of eight.
template <class Eight>
Surface<Eight> joined(const Surface<Many>& first, const Surface<Many>& last) {
  constexpr std::size_t numbers = sizeof(Surface<Many>) / sizeof(Many);
  static_assert(sizeof(Surface<Eight>) == numbers * sizeof(Eight));
  const auto number_of = [](const Surface<Many>& surface, std::size_t i) {
    Many one;
    std::memcpy(static_cast<void*>(&one), reinterpret_cast<const char*>(&surface) + i * sizeof(Many), sizeof(one));
    return one;
  };
  Surface<Eight> out;
  for (std::size_t i = 0; i < numbers; ++i) {
    const Eight both(number_of(first, i), number_of(last, i));
    std::memcpy(reinterpret_cast<char*>(&out) + i * sizeof(Eight), static_cast<const void*>(&both), sizeof(both));
  }
  return out;
}

template <class Eight>
brdf::Rgb<Many> half_of(const brdf::Rgb<Eight>& c, std::size_t half) {
  return {c.r.bounds(half), c.g.bounds(half), c.b.bounds(half)};
}

template <class Eight>
number::FloatMask lost(const brdf::Rgb<Eight>& c) {
  return c.r.is_lost() | c.g.is_lost() | c.b.is_lost();
}

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
/// view.
number::FloatMask is_wide(const Surface<Forms>& surface, Layers layers) {
  using number::FloatBatch;
  constexpr float narrow = 0.005F;  // radians
  const auto moved = [](const Vec3<Forms>& v) { return v.x.displacement() + v.y.displacement() + v.z.displacement(); };
  const auto open = [](const Vec3<Forms>& v) { return v.x.radius() + v.y.radius() + v.z.radius(); };
  const FloatBatch view = moved(surface.view);
  const auto opens = [&](const Vec3<Forms>& n) { return open(n) > xsimd::max(FloatBatch(narrow), FloatBatch(4.0F) * (moved(n) + view)); };
  return layers.clearcoat ? opens(surface.normal) | opens(surface.coat_normal) : opens(surface.normal);
}

/// Whether a light adds more uncertainty than there is light with it, in some channel; or a lane is lost by it.
number::FloatMask is_open(const brdf::Rgb<Forms>& before, const brdf::Rgb<Forms>& after) {
  const auto opens = [](const Forms& x, const Forms& y) { return ~x.is_lost() & ~(y.spread() - x.spread() <= xsimd::abs(y.center())); };
  return opens(before.r, after.r) | opens(before.g, after.g) | opens(before.b, after.b);
}

/// What `careful` gives of a half where one of its lanes is among these, else the sum's.
template <class Careful>
brdf::Rgb<Forms> instead_of(const brdf::Rgb<Forms>& sum, const number::FloatMask& lanes, const Careful& careful) {
  if (!xsimd::any(lanes)) {
    return sum;
  }
  const auto half = [&](std::size_t i) {
    bool keeps = true;
    for (std::size_t lane = i * Many::lanes; lane < (i + 1) * Many::lanes; ++lane) {
      keeps = keeps && !lanes.get(lane);
    }
    return keeps ? half_of(sum, i) : careful(i);
  };
  const brdf::Rgb<Many> first = half(0);
  const brdf::Rgb<Many> last = half(1);
  return {Forms(first.r, last.r), Forms(first.g, last.g), Forms(first.b, last.b)};
}

/// Eight surfaces of a job; short of them, the last again.
class Surfaces {
 public:
  /// @param first  in the job's order
  Surfaces(const BoundJob& job, std::size_t first) : order_(job.order + first), count_(std::min(job.count - first, eight)) {
    for (std::size_t half = 0; half < 2; ++half) {
      const std::size_t from = std::min(half * Many::lanes, count_ - 1);
      halves_[half] = gather<Surface<Many>>(job.surfaces, order_ + from, std::min(count_ - from, Many::lanes));
    }
  }

  std::size_t count() const { return count_; }
  const Surface<Many>& half(std::size_t i) const { return halves_[i]; }
  template <class Eight>
  Surface<Eight> all() const {
    return joined<Eight>(halves_[0], halves_[1]);
  }

  template <class Eight>
  void scatter_radiance(const brdf::Rgb<Eight>& radiance, brdf::Rgb<Bound>* results) const {
    for (std::size_t half = 0; half * Many::lanes < count_; ++half) {
      const std::size_t from = half * Many::lanes;
      scatter(half_of(radiance, half), order_ + from, std::min(count_ - from, Many::lanes), results);
    }
  }

 private:
  const std::uint32_t* order_;
  std::size_t count_;
  Surface<Many> halves_[2];
};

/// shade() of surfaces each under the same lights (not Lighting::distant): light by light without ranges where that holds all lanes of a
/// half, else with them.
brdf::Rgb<Forms> shade_by_forms(const Surfaces& surfaces, Layers layers, const Lighting& lighting) {
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
  for (std::size_t i = 0; i < lighting.light_count; ++i) {
    brdf::Rgb<Forms> sum = with(radiance, quick.light(arriving(lighting.lights[i], forms.position), false, no_lookup));
    number::FloatMask open = is_open(radiance, sum);
    if (xsimd::any(open & wide)) {
      const auto part = coarse->light(arriving(lighting.lights[i], ranges->position), false, no_ranges);
      take_narrower(sum, open & wide, with_light(radiance, layers, forms_of(part.sheen), forms_of(part.base), forms_of(part.coat)));
      open = open & (~wide | lost(sum));
    }
    radiance = instead_of(sum, open, [&](std::size_t half) {
      const auto part = careful(half).light(arriving(lighting.lights[i], surfaces.half(half).position), false, none);
      return with(half_of(radiance, half), part);
    });
  }
  return radiance;
}

void bound_by_forms(const BoundJob& job, const Lighting& lighting, brdf::Rgb<Bound>* results) {
  for (std::size_t i = 0; i < job.count; i += eight) {
    const Surfaces surfaces(job, i);
    surfaces.scatter_radiance(shade_by_forms(surfaces, job.layers, lighting), results);
  }
}

/// Lanes that are lost are done by forms.
void bound_by_ranges(const BoundJob& job, const Lighting& lighting, brdf::Rgb<Bound>* results) {
  for (std::size_t i = 0; i < job.count; i += eight) {
    const Surfaces surfaces(job, i);
    const auto radiance = shade_with<Ranges>(surfaces.all<Ranges>(), job.layers, lighting, NoListener{}).radiance;
    surfaces.scatter_radiance(radiance, results);
    const number::FloatMask are_lost = lost(radiance);
    BoundJob again = job;
    std::uint32_t order[eight];
    again.order = order;
    again.count = 0;
    for (std::size_t lane = 0; lane < surfaces.count(); ++lane) {
      if (are_lost.get(lane)) {
        order[again.count++] = job.order[i + lane];
      }
    }
    bound_by_forms(again, lighting, results);
  }
}

}  // namespace

void bound_all_batch(const BoundJob& job, const Lighting& lighting, brdf::Rgb<Bound>* results) {
  using Lobes = number::BoundedBatch<number::Mediump>;
  if (job.lobes == Precision::Mediump) {
    for (std::size_t i = 0; i < job.count; i += Many::lanes) {
      const std::size_t here = std::min(job.count - i, Many::lanes);
      const auto surfaces = gather<Surface<Many>>(job.surfaces, job.order + i, here);
      scatter(shade_with<Lobes>(surfaces, job.layers, lighting, NoListener{}).radiance, job.order + i, here, results);
    }
  } else if (job.ranges_alone) {
    bound_by_ranges(job, lighting, results);
  } else {
    bound_by_forms(job, lighting, results);
  }
}

}  // namespace sheen::golden
