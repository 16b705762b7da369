#include "golden/drawn_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numeric>

#include <glm/geometric.hpp>

#include "golden/bound_all.h"
#include "golden/bounded_albedo.h"
#include "golden/bounded_mediump.h"
#include "golden/direction_pool.h"
#include "golden/ggx_range.h"
#include "golden/sampling_goal.h"
#include "golden/sheen_range.h"
#include "number/bounded_functions.h"

namespace sheen::golden {
namespace {

using Color = brdf::Rgb<Bound>;

/// Directions that tell what all are off by on average.
constexpr int told_by = 64;

/// The step of a sample that is not displaced, in pixels: what a displaced one shows is found otherwise.
constexpr double undisplaced = 0x1p-30;

/// Numbers in (0, 1), floats, by SplitMix64's finalizer.
class Points {
 public:
  explicit Points(std::uint64_t stream) : stream_(mix(stream)) {}

  double number() { return (static_cast<double>(mix(stream_ + ++drawn_) >> 41) + 0.5) * 0x1p-23; }
  DrawnPoint<Bound> point() {
    const double x = number();
    const double phi = 2 * brdf::pi * number();
    const auto held = [](double value) { return Bound::within(value, std::abs(value) * 0x1p-24); };
    return {Bound(x), held(std::cos(phi)), held(std::sin(phi))};
  }

 private:
  std::uint64_t stream_;
  std::uint64_t drawn_ = 0;
};

/// What a shader holds of a surface, all of it independent of how directions are displaced.
Surface<Bound> undisplaced_surface(const Surface<Bound>& surface) {
  constexpr std::size_t numbers = sizeof(Surface<Bound>) / sizeof(Bound);
  std::array<Bound, numbers> each;
  std::memcpy(static_cast<void*>(each.data()), static_cast<const void*>(&surface), sizeof(surface));
  for (Bound& number : each) {
    number = number.is_bounded() ? Bound::within(number.center(), number.deviation()) : number;
  }
  Surface<Bound> out;
  std::memcpy(static_cast<void*>(&out), static_cast<const void*>(each.data()), sizeof(out));
  return out;
}

Vec3<Bound> exactly(const Vec3<double>& v) {
  return {Bound::within(v.x, 0), Bound::within(v.y, 0), Bound::within(v.z, 0)};
}

/// The numbers that a surface is about.
Surface<double> centers(const Surface<Bound>& surface) {
  constexpr std::size_t numbers = sizeof(Surface<Bound>) / sizeof(Bound);
  std::array<Bound, numbers> each;
  std::memcpy(static_cast<void*>(each.data()), static_cast<const void*>(&surface), sizeof(surface));
  std::array<double, numbers> of{};
  std::transform(each.begin(), each.end(), of.begin(), [](const Bound& x) { return x.center(); });
  Surface<double> out;
  static_assert(sizeof(out) == sizeof(of));
  std::memcpy(&out, of.data(), sizeof(out));
  return out;
}

/// The mean of what a picture is off by, so far.
struct Off {
  glm::dvec3 value{0.0};      // what the directions add up to
  glm::dvec3 deviation{0.0};  // and how far it may be off
  glm::dvec3 squares{0.0};

  void add(const Color& term, const glm::dvec3& more) {
    const glm::dvec3 off = glm::dvec3(term.r.deviation(), term.g.deviation(), term.b.deviation()) + more;
    value += glm::abs(glm::dvec3(term.r.center(), term.g.center(), term.b.center()));
    deviation += off;
    squares += off * off;
  }
};

/// f(direction) from where V is mirrored to the horizon beyond: on that way Schlick's weight grows, which is all that some lobes have.
template <class Function>
void for_directions_beyond(const LobeView<double>& lobe, const Function& f) {
  const glm::dvec3 n(lobe.n.x, lobe.n.y, lobe.n.z);
  const glm::dvec3 v(lobe.v.x, lobe.v.y, lobe.v.z);
  const glm::dvec3 mirrored = 2.0 * glm::dot(n, v) * n - v;
  glm::dvec3 along = mirrored - glm::dot(n, mirrored) * n;
  if (glm::length(along) < 1e-4) {
    along = glm::cross(n, std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0));
  }
  along = glm::normalize(along);
  for (double share = 1; share > 0.004; share *= 0.75) {
    const glm::dvec3 l = glm::normalize(share * mirrored + (1 - share) * along);
    f(Vec3<double>{l.x, l.y, l.z});
  }
}

/// What perfectly smooth layers mirror.
template <class Lobe>
Color mirrors(const Surface<Bound>& surface, Layers layers, const Lighting& lighting, const DrawnImage& image) {
  const Bound one(1);
  const auto mirrored = [&](const LobeView<Bound>& lobe) { return image.radiance(lobe.n * (dot(lobe.n, lobe.v) * Bound(2)) - lobe.v); };
  const Bound k = layers.clearcoat ? CoatLayer<Bound, Lobe>(surface, lighting).weight() : Bound(0.0);
  Color sum{Bound(0.0), Bound(0.0), Bound(0.0)};
  if (brdf::is_mirror(surface.base.alpha.center())) {
    const LobeView<Bound> lobe(surface.normal, surface.view);
    const Bound w = As<Bound>::number(brdf::schlick_weight(As<Lobe>::number(lobe.n_dot_v)));
    Bound scale = one;
    if (layers.sheen) {
      const SheenLayer<Bound, Lobe> sheen(surface, lobe, lighting);
      scale = sheen.scale(sheen.e_v());
    }
    const auto reflected = [&](const Bound& f0, const Bound& color) {
      const Bound dielectric = surface.base.specular * (f0 + (one - f0) * w);
      const Bound metal = color + (one - color) * w;
      return dielectric * (one - surface.base.metallic) + metal * surface.base.metallic;
    };
    const brdf::Base<Bound>& base = surface.base;
    const Color f{reflected(base.dielectric_f0.r, base.color.r), reflected(base.dielectric_f0.g, base.color.g),
                  reflected(base.dielectric_f0.b, base.color.b)};
    sum = f * mirrored(lobe) * (scale * (one - k));
  }
  if (layers.clearcoat && brdf::is_mirror(surface.coat_alpha.center())) {
    sum = sum + mirrored(LobeView<Bound>(surface.coat_normal, surface.view)) * k;
  }
  return sum;
}

}  // namespace

DrawnLight::DrawnLight(const PixelBound& bound) : bound_(bound), triangles_(bound.frame().geometry, bound.frame().rays) {}

template <class Lobe>
DrawnLight::Open DrawnLight::open(const Surface<Bound>& surface, Layers layers, const Lighting& lighting, const DrawnImage& image,
                                  const WayCounts& counts, int drawn, std::uint64_t stream) {
  // Whatever surface a shader holds, it draws and divides by that very surface.
  const Surface<double> center = centers(surface);
  const DrawnDirections<Bound, Lobe> directions(spread<Bound>(center), layers, counts);
  const Shading<Bound, Lobe> shading(surface, layers, lighting);
  const Shading<double, double> about(center, layers, lighting);
  const auto of_image = static_cast<double>(counts[index_of(Way::Image)]);
  const Color white{Bound(1), Bound(1), Bound(1)};
  Points points(stream);
  Off off;
  glm::dvec3 largest(0.0);
  // What a direction adds, if it lights anything.
  const auto add = [&](const Vec3<Bound>& direction, const Bound* image_density, bool counts_as_drawn) {
    Color none{Bound(0.0), Bound(0.0), Bound(0.0)};
    const LightPart<Bound> part = shading.light({direction, white}, false, none);
    if (!part.lit) {
      return;
    }
    const DrawnImage::Seen there = image.look_up(direction);
    const Bound density = directions.density(direction) + Bound(of_image) * (image_density != nullptr ? *image_density : there.density);
    const Color light = with_light({Bound(0.0), Bound(0.0), Bound(0.0)}, layers, part.sheen, part.base, part.coat) * there.radiance;
    const Color term{light.r / density, light.g / density, light.b / density};
    largest = glm::max(largest, glm::abs(glm::dvec3(term.r.center(), term.g.center(), term.b.center())));
    if (!counts_as_drawn) {
      return;
    }
    brdf::Rgb<double> missed{0, 0, 0};  // by a shader that reads E once, see Shaded
    about.light({{direction.x.center(), direction.y.center(), direction.z.center()}, {1, 1, 1}}, false, missed);
    const glm::dvec3 of_lookup = glm::dvec3(missed.r, missed.g, missed.b) *
                                 glm::dvec3(there.radiance.r.center(), there.radiance.g.center(), there.radiance.b.center());
    off.add(term, of_lookup / density.center());
  };
  for (std::size_t k = 0; k < way_count; ++k) {
    for (int i = 0; i < counts[k]; ++i) {
      if (static_cast<Way>(k) == Way::Image) {
        const DrawnImage::Drawn drawn_there = image.draw(points.number(), points.number());
        add(displaced(drawn_there.direction), &drawn_there.density, true);
      } else {
        add(displaced(directions.draw(static_cast<Way>(k), points.point())), nullptr, true);
      }
    }
  }
  // Where one may bring more than those: toward the brightest of the image, and where a lobe is highest.
  for (const Vec3<double>& bright : image.brightest()) {
    add(exactly(bright), nullptr, false);
  }
  const auto add_of_lobe = [&](const Vec3<double>& normal) {
    const LobeView<double> lobe(normal, center.view);
    add(exactly(lobe.n), nullptr, false);
    for_directions_beyond(lobe, [&](const Vec3<double>& l) { add(exactly(l), nullptr, false); });
  };
  add_of_lobe(center.normal);
  if (layers.clearcoat) {
    add_of_lobe(center.coat_normal);
  }
  // However the directions fall: the variance of a sum of independent numbers is below the sum of their squares.
  const glm::dvec3 of_directions = off.deviation + standard_errors * glm::sqrt(off.squares);
  Off all;
  all.add(mirrors<Lobe>(surface, layers, lighting, image), of_directions);
  all.value += off.value;
  // They are added up one by one; then occlusion weighs the sum.
  const double roundings = (drawn + static_cast<double>(way_count) + 2) * epsilon;
  const Bound& occlusion = surface.occlusion;
  const double told = std::accumulate(counts.begin(), counts.end(), 0.0);
  return {(all.deviation + roundings * all.value) * occlusion.range().magnitude() + all.value * occlusion.deviation(),
          largest * (told / drawn * occlusion.range().magnitude())};
}

template DrawnLight::Open DrawnLight::open<Bound>(const Surface<Bound>&, Layers, const Lighting&, const DrawnImage&, const WayCounts&, int,
                                                  std::uint64_t);
template DrawnLight::Open DrawnLight::open<number::Bounded<number::Mediump>>(const Surface<Bound>&, Layers, const Lighting&,
                                                                             const DrawnImage&, const WayCounts&, int, std::uint64_t);

// Of a normal map's levels, that of the golden: what another level changes counts elsewhere. As a map that bends a normal by one level
// would, it errs by the normal's roundings in each of three axes and some 24 of its own.
Surface<Bound> DrawnLight::read(const Hit& hit, const Ray& ray, const Surface<double>& truth) {
  bound_.reader().read(triangles_.at(hit.triangle), hit, ray, undisplaced, read_);
  Surface<Bound> surface = read_.surface;
  const auto held = [&](const BoundedSurface::Maps& maps, const Vec3<double>& normal, Vec3<Bound>& out) {
    if (maps.normal.empty()) {
      return;
    }
    const double off = 3 * std::max({out.x.deviation(), out.y.deviation(), out.z.deviation()}) + 24 * epsilon;
    const glm::dvec3 n = bound_.frame().rays.view_from_world() * dvec3({normal.x, normal.y, normal.z});
    out = {Bound::within(n.x, off), Bound::within(n.y, off), Bound::within(n.z, off)};
  };
  held(read_.normals, truth.normal, surface.normal);
  held(read_.coat_normals, truth.coat_normal, surface.coat_normal);
  // Bilinear in two levels, decoded, mixed: 20 roundings at the most.
  surface.occlusion = Bound::within(truth.occlusion, 20 * epsilon);
  return undisplaced_surface(surface);
}

// As shaders/background.frag finds the direction of a fragment, whose rows are counted from below.
DrawnLight::Open DrawnLight::open_background(const Ray& ray) const {
  const scene::View& view = bound_.frame().settings.view;
  const scene::Camera& camera = bound_.frame().rays.camera();
  const double up = camera.perspective ? std::tan(0.5 * camera.yfov) : 0.0;
  const auto of_window = [](double at, double size) { return Bound(at) / Bound(size) * Bound(2) - Bound(1); };
  const double height = view.height;
  const double width = view.width;
  const Vec3<Bound> direction = unit_along(
      Vec3<Bound>{of_window(ray.x, width) * Bound(up * width / height), of_window(height - ray.y, height) * Bound(up), Bound(-1)});
  const Color seen = bound_.drawn_image()->radiance(displaced(direction));
  return {{seen.r.deviation(), seen.g.deviation(), seen.b.deviation()}, glm::dvec3(0.0)};
}

DrawnLight::Open DrawnLight::open(const Seen& seen, const Ray& ray, const Surface<double>* surfaces, const double* opacities,
                                  const Open& behind, std::uint64_t stream) {
  const Frame& frame = bound_.frame();
  Open sum = behind;
  std::size_t layer = 0;
  seen.for_layers([&](const Hit& hit) {
    const int material = frame.geometry.placed(hit.triangle).material_index;
    const Surface<Bound> surface = read(hit, ray, surfaces[layer]);
    const bool mediump = frame.settings.precision == Precision::Mediump;
    const auto of = mediump ? &DrawnLight::open<number::Bounded<number::Mediump>> : &DrawnLight::open<Bound>;
    const Layers layers = frame.reader.layers(material);
    const WayCounts counts = drawn_counts(surfaces[layer], layers, bound_.drawn_image()->has_image(), told_by);
    const Open light =
        of(surface, layers, bound_.lighting(material), *bound_.drawn_image(), counts, frame.settings.drawn_directions, stream * 64 + layer);
    const double a = opacities[layer];
    sum = {light.off * a + sum.off * (1.0 - a), light.largest * a + sum.largest * (1.0 - a)};
    ++layer;
  });
  return sum;
}

}  // namespace sheen::golden
