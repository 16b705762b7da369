#include "golden/bounded_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "brdf/draft_sheen.h"
#include "golden/normal_levels.h"
#include "golden/texture_box.h"
#include "golden/varying.h"
#include "number/bounded_functions.h"

namespace sheen::golden {
namespace {

using Vector = Vec3<Bound>;
using Color = brdf::Rgb<Bound>;

Bound bound(const Varying& v) {
  return std::isfinite(v.radius) ? Bound::at_sample(v.value, v.shift_x, v.shift_y, 1.0, v.radius) : Bound::unbounded(v.value);
}

Color color_of(const glm::dvec3& c) {
  return {Bound(c.x), Bound(c.y), Bound(c.z)};
}

/// Four channels of a texture.
struct Texel {
  Bound r{1}, g{1}, b{1}, a{1};
};

Texel texel(const Spread& s) {
  const auto channel = [&s](int c) { return Bound::within(s.value[c], s.radius[c]); };
  return {channel(0), channel(1), channel(2), channel(3)};
}

Texel unbounded_texel() {
  const Bound none = Bound::unbounded(0.0);
  return {none, none, none, none};
}

}  // namespace

/// One hit, while its surface is read.
class BoundedSurfaceReader::At {
 public:
  /// @param triangle  the hit's
  At(const BoundedSurfaceReader& r, const TriangleInView& triangle, const Hit& hit, const Ray& ray, double step)
      : r_(r),
        triangle_(triangle),
        hit_(hit),
        ray_(ray),
        placed_(r.geometry_.placed(hit.triangle)),
        material_(r.reader_.material(placed_.material_index)),
        local_(r.geometry_.local_vertices(hit.triangle)),
        interpolate_(r.geometry_, r.rays_, triangle.edges, hit, ray, step) {}

  void read(BoundedSurface& out);
  Bound opacity() { return opacity(texture(material_.base_color)); }

 private:
  using Slot = SurfaceReader::Slot;

  /// Where a texture is read.
  struct Place {
    glm::dvec2 uv{0.0}, reach{0.0};
    bool is_bounded() const { return std::isfinite(reach.x) && std::isfinite(reach.y); }
  };

  struct Tangent {
    Vector along;
    Bound handedness;
  };
  /// The ideal level, and all that are allowed if that changes anything.
  struct Levels {
    double ideal = -coarsest_level;
    std::vector<LodInterval> pieces;
  };
  /// What was found last, which slots of the same number share.
  template <class T>
  struct Last {
    std::size_t number = SurfaceReader::slot_count;
    T found;
  };

  const Levels& levels(const Slot& slot);
  const std::array<Bound, 2>& texcoord(std::size_t set);
  const Place& place(const Slot& slot);
  Texel texture(const Slot& slot);
  static Bound texture_coordinate(const Slot& slot, const std::array<Bound, 2>& uv, int row);
  Vector interpolated(const TriangleInView::Vectors& vectors) const;
  Vector face_normal(const Vector& position) const;
  Vector normal(const Vector& position) const;
  const Tangent& tangent();
  Vector mapped_normal(std::size_t map, const Vector& normal, BoundedSurface::Maps& maps);
  Bound opacity(const Texel& base_color) const;
  Bound vertex_color(int channel) const;
  void read_base(Surface<Bound>& s, Bound& alpha);
  void read_layers(Surface<Bound>& s);

  const BoundedSurfaceReader& r_;
  const TriangleInView& triangle_;
  const Hit& hit_;
  const Ray& ray_;
  const Placed& placed_;
  const SurfaceReader::Material& material_;
  std::array<std::uint32_t, 3> local_;
  Interpolation interpolate_;
  // Once a texture needs them.
  std::optional<SurfaceReader::Neighbourhood> beside_;
  std::optional<Tangent> tangent_;
  std::array<std::optional<std::array<Bound, 2>>, 2> texcoords_;
  Last<Place> place_;
  Last<Levels> levels_;
};

// KHR_texture_transform as a matrix of floats, of which the shader takes two rows.
Bound BoundedSurfaceReader::At::texture_coordinate(const Slot& slot, const std::array<Bound, 2>& uv, int row) {
  const glm::dmat3& m = slot.transform;
  if (m == glm::dmat3(1.0)) {
    return uv.at(static_cast<std::size_t>(row));
  }
  return Bound(m[0][row]) * uv[0] + Bound(m[1][row]) * uv[1] + Bound(m[2][row]);
}

// TEXCOORD_0 or 1.
const std::array<Bound, 2>& BoundedSurfaceReader::At::texcoord(std::size_t set) {
  std::optional<std::array<Bound, 2>>& uv = texcoords_.at(set);
  if (!uv) {
    uv.emplace(std::array<Bound, 2>{Bound(0.0), Bound(0.0)});
    const auto& at = placed_.primitive->texcoords[set];
    for (int axis = 0; axis < 2 && !at.empty(); ++axis) {
      (*uv).at(static_cast<std::size_t>(axis)) = bound(interpolate_({at[local_[0]][axis], at[local_[1]][axis], at[local_[2]][axis]}, 0.0));
    }
  }
  return *uv;
}

const BoundedSurfaceReader::At::Place& BoundedSurfaceReader::At::place(const Slot& slot) {
  if (place_.number != slot.same_place) {
    const std::array<Bound, 2>& uv = texcoord(static_cast<std::size_t>(slot.texcoord));
    const Bound u = texture_coordinate(slot, uv, 0);
    const Bound v = texture_coordinate(slot, uv, 1);
    place_ = {slot.same_place, {{u.center(), v.center()}, {u.deviation(), v.deviation()}}};
  }
  return place_.found;
}

// The levels a driver may read a texture at.
const BoundedSurfaceReader::At::Levels& BoundedSurfaceReader::At::levels(const Slot& slot) {
  if (levels_.number == slot.same_levels) {
    return levels_.found;
  }
  levels_.number = slot.same_levels;
  Levels& out = levels_.found;
  out.ideal = -coarsest_level;
  out.pieces.clear();
  if (!slot.texture->needs_lod()) {
    return out;
  }
  if (!beside_) {
    beside_ = r_.reader_.neighbourhood(hit_, interpolate_.edge_functions());
  }
  const SurfaceReader::Lod lod = r_.reader_.lod(slot, hit_, *beside_);
  out.ideal = lod.ideal;
  out.pieces = straight_pieces(*slot.texture, lod.allowed);
  if (out.pieces.size() == 1 && out.pieces.front().low == out.pieces.front().high) {
    out.pieces.clear();  // the ideal one is read alike
  }
  return out;
}

// At the ideal level and at all others that are allowed.
Texel BoundedSurfaceReader::At::texture(const Slot& slot) {
  if (!slot.texture) {
    return {};
  }
  const Place& at = place(slot);
  if (!at.is_bounded()) {
    return unbounded_texel();
  }
  TextureBox box(*slot.texture, at.uv, at.reach);
  const Levels& l = levels(slot);
  Spread s = box(l.ideal);
  double last = std::numeric_limits<double>::quiet_NaN();
  for (const LodInterval& piece : l.pieces) {
    for (const double level : {piece.low, piece.high}) {
      if (level == last) {
        continue;  // two pieces share it
      }
      last = level;
      const Spread there = box(level);
      s.radius = glm::max(s.radius, glm::abs(there.value - s.value) + there.radius);
    }
  }
  return texel(s);
}

Vector BoundedSurfaceReader::At::interpolated(const TriangleInView::Vectors& vectors) const {
  const auto axis = [&](int k) { return bound(interpolate_(vectors.axis(k), vectors.rounding[k])); };
  return {axis(0), axis(1), axis(2)};
}

// Where a normal has no direction the shader takes the triangle's own, the cross product of how the position changes to the next pixel
// along x and along y: differences of two positions, each of them off by its rounding.
Vector BoundedSurfaceReader::At::face_normal(const Vector& position) const {
  const glm::dvec3 n = r_.rays_.view_from_world() * r_.geometry_.face_normal(hit_.triangle);
  const auto point = [&](double dx, double dy) {
    const Ray ray = r_.rays_.through(ray_.x + dx, ray_.y + dy);
    const std::optional<Hit> met = r_.geometry_.meet(hit_.triangle, ray);
    return met ? ray.origin + ray.direction * met->t : glm::dvec3(std::numeric_limits<double>::infinity());
  };
  const glm::dvec3 here = point(0.0, 0.0);
  const glm::dvec3 dx = point(1.0, 0.0) - here;
  const glm::dvec3 dy = point(0.0, 1.0) - here;
  const double error = 2.0 * (position.x.radius() + position.y.radius() + position.z.radius());
  const double off = (error * (glm::length(dx) + glm::length(dy)) + error * error) / glm::length(glm::cross(dx, dy)) + 8.0 * epsilon;
  const auto axis = [off](double x) { return std::isfinite(off) ? Bound::within(x, off) : Bound::unbounded(x); };
  return {axis(n.x), axis(n.y), axis(n.z)};
}

Vector BoundedSurfaceReader::At::normal(const Vector& position) const {
  // The face's is seldom needed.
  return triangle_.normal ? unit_or(interpolated(*triangle_.normal), [&] { return face_normal(position); }) : face_normal(position);
}

const BoundedSurfaceReader::At::Tangent& BoundedSurfaceReader::At::tangent() {
  if (!tangent_) {
    const auto& t = placed_.primitive->tangents;
    tangent_ = {interpolated(*triangle_.tangent), bound(interpolate_({t[local_[0]].w, t[local_[1]].w, t[local_[2]].w}, 0.0))};
  }
  return *tangent_;
}

// On the side that is seen; see BoundedSurface for `maps`.
Vector BoundedSurfaceReader::At::mapped_normal(std::size_t map, const Vector& normal, BoundedSurface::Maps& maps) {
  const bool of_coat = map == SurfaceReader::clearcoat_normal_slot;
  const Slot& slot = of_coat ? material_.clearcoat_normal : material_.normal;
  maps.is_open = false;
  maps.normal.clear();
  const Vector facing = hit_.front ? normal : Vector{-normal.x, -normal.y, -normal.z};
  // Where the shader finds no tangent it has no use for a map.
  if (!slot.texture || !triangle_.tangent) {
    return facing;
  }
  const Place& at = place(slot);
  TextureBox box(*slot.texture, at.uv, at.reach);
  const Bound scale(of_coat ? material_.source->clearcoat.normal_scale : material_.source->normal_scale);
  const Levels& l = levels(slot);
  const NormalLevels all = normal_levels(box, l.ideal, l.pieces, scale.center());
  maps.is_open = all.is_open;
  for (const Spread& spread : all.boxes) {
    const Texel read = at.is_bounded() ? texel(spread) : unbounded_texel();
    const Vector code{read.r, read.g, read.b};
    maps.normal.push_back({tangent().along, normal, tangent().handedness, code, scale, Bound(hit_.front ? 1.0 : -1.0)});
  }
  return facing;
}

Bound BoundedSurfaceReader::At::vertex_color(int channel) const {
  const auto& colors = placed_.primitive->colors;
  return bound(interpolate_({colors[local_[0]][channel], colors[local_[1]][channel], colors[local_[2]][channel]}, 0.0));
}

Bound BoundedSurfaceReader::At::opacity(const Texel& base_color) const {
  // The factor as a shader is given it, since at a mask the last digit decides.
  Bound alpha = Bound(static_cast<float>(material_.source->base_color_factor.w)) * base_color.a;
  if (!placed_.primitive->colors.empty()) {
    alpha = alpha * vertex_color(3);
  }
  return min(max(alpha, Bound(0.0)), Bound(1));
}

void BoundedSurfaceReader::At::read_base(Surface<Bound>& s, Bound& alpha) {
  const scene::Material& source = *material_.source;
  const Texel base = texture(material_.base_color);
  Color color = color_of(glm::dvec3(source.base_color_factor)) * Color{base.r, base.g, base.b};
  alpha = opacity(base);
  if (!placed_.primitive->colors.empty()) {
    color = color * Color{vertex_color(0), vertex_color(1), vertex_color(2)};
  }
  const Texel metallic_roughness = texture(material_.metallic_roughness);
  const Bound roughness = Bound(source.roughness_factor) * metallic_roughness.g;
  const Texel tint = texture(material_.specular_color);
  const double f0 = brdf::f0_from_ior(source.ior);
  const Color reflected = color_of(source.specular.color_factor) * Color{tint.r, tint.g, tint.b} * Bound(f0);
  s.base.color = color;
  s.base.metallic = Bound(source.metallic_factor) * metallic_roughness.b;
  s.base.alpha = roughness * roughness;
  s.base.dielectric_f0 = {min(reflected.r, Bound(1)), min(reflected.g, Bound(1)), min(reflected.b, Bound(1))};
  s.base.specular = Bound(source.specular.factor) * texture(material_.specular).a;
  if (material_.layers.sheen) {
    const Texel sheen = texture(material_.sheen_color);
    s.sheen_color = color_of(source.sheen.color_factor) * Color{sheen.r, sheen.g, sheen.b};
    s.sheen_roughness = Bound(source.sheen.roughness_factor) * texture(material_.sheen_roughness).a;
    if (r_.model_ == brdf::Model::Draft2019) {
      s.sheen_color = brdf::draft_sheen_color(s.sheen_color, color, s.base.metallic);
      s.sheen_roughness = roughness;
    }
  }
}

void BoundedSurfaceReader::At::read_layers(Surface<Bound>& s) {
  const scene::Material& source = *material_.source;
  const Texel emissive = texture(material_.emissive);
  s.emission = color_of(source.emissive_factor) * Color{emissive.r, emissive.g, emissive.b};
  if (material_.layers.clearcoat) {
    const Bound roughness = Bound(source.clearcoat.roughness_factor) * texture(material_.clearcoat_roughness).g;
    s.clearcoat = Bound(source.clearcoat.factor) * texture(material_.clearcoat).r;
    s.coat_alpha = roughness * roughness;
  }
  s.occlusion = Bound(1);
}

void BoundedSurfaceReader::At::read(BoundedSurface& out) {
  Surface<Bound>& s = out.surface;
  s.position = interpolated(triangle_.position);
  const Vector up{Bound(0.0), Bound(0.0), Bound(1)};
  const Vector toward{-s.position.x, -s.position.y, -s.position.z};
  s.view = r_.rays_.camera().perspective ? unit_or(toward, [&] { return up; }) : up;
  const Vector unmapped = normal(s.position);
  s.normal = mapped_normal(SurfaceReader::normal_slot, unmapped, out.normals);
  s.coat_normal = mapped_normal(SurfaceReader::clearcoat_normal_slot, unmapped, out.coat_normals);
  out.edge_on = interpolate_.is_edge_on();
  read_base(s, out.opacity);
  read_layers(s);
}

BoundedSurfaceReader::BoundedSurfaceReader(const Geometry& geometry, const RayGenerator& rays, const SurfaceReader& reader,
                                           brdf::Model model)
    : geometry_(geometry), rays_(rays), reader_(reader), model_(model) {
  roundings_.reserve(geometry.triangle_count());
  for (std::uint32_t triangle = 0; triangle < geometry.triangle_count(); ++triangle) {
    roundings_.emplace_back(geometry, rays, triangle);
  }
}

void BoundedSurfaceReader::read(const TriangleInView& triangle, const Hit& hit, const Ray& ray, double step, BoundedSurface& out) const {
  At(*this, triangle, hit, ray, step).read(out);
}

Bound BoundedSurfaceReader::opacity(const Hit& hit, const Ray& ray, double step) const {
  return At(*this, TriangleInView(geometry_, rays_, hit.triangle), hit, ray, step).opacity();
}

}  // namespace sheen::golden
