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

glm::dmat3 rotation_into_view(const scene::Camera& camera) {
  return glm::transpose(glm::dmat3(camera.world_from_camera));
}

}  // namespace

/// One hit, while its surface is read.
class BoundedSurfaceReader::At {
 public:
  At(const BoundedSurfaceReader& r, const Hit& hit, const Ray& ray, double step)
      : r_(r),
        hit_(hit),
        ray_(ray),
        placed_(r.geometry_.placed(hit.triangle)),
        material_(r.reader_.material(placed_.material_index)),
        local_(r.geometry_.local_vertices(hit.triangle)),
        interpolate_(r.geometry_, r.rays_, hit, ray, step) {}

  void read(BoundedSurface& out) const;
  Bound opacity() const { return opacity(texture(material_.base_color)); }

 private:
  using Slot = SurfaceReader::Slot;

  /// Where a texture is read.
  struct Place {
    glm::dvec2 uv, reach;
    bool is_bounded() const { return std::isfinite(reach.x) && std::isfinite(reach.y); }
  };

  struct Tangent {
    bool exists = false;
    Vector along;
    Bound handedness;
  };
  /// The ideal level, and all that are allowed if that changes anything.
  struct Levels {
    double ideal;
    std::vector<LodInterval> pieces;
  };

  Levels levels(const Slot& slot) const;
  const std::array<Bound, 2>& texcoord(std::size_t set) const;
  Place place(const Slot& slot) const;
  Texel texture(const Slot& slot) const;
  Bound texture_coordinate(const Slot& slot, const std::array<Bound, 2>& uv, int row) const;
  Vector position() const;
  Vector face_normal(const Vector& position) const;
  Vector transformed(const std::array<glm::dvec3, 3>& directions, const glm::dmat3& view_from_local) const;
  Vector normal(const Vector& position) const;
  Tangent tangent() const;
  Vector mapped_normal(std::size_t map, const Vector& normal, BoundedSurface::Maps& maps) const;
  Bound opacity(const Texel& base_color) const;
  Bound vertex_color(int channel) const;
  void read_base(Surface<Bound>& s, Bound& alpha) const;
  void read_layers(Surface<Bound>& s) const;

  const BoundedSurfaceReader& r_;
  const Hit& hit_;
  const Ray& ray_;
  const Placed& placed_;
  const SurfaceReader::Material& material_;
  std::array<std::uint32_t, 3> local_;
  Interpolation interpolate_;
  // Once a texture needs them.
  mutable std::optional<SurfaceReader::Neighbourhood> beside_;
  mutable std::optional<Tangent> tangent_;
  mutable std::array<std::optional<std::array<Bound, 2>>, 2> texcoords_;
};

// KHR_texture_transform as a matrix of floats, of which the shader takes two rows.
Bound BoundedSurfaceReader::At::texture_coordinate(const Slot& slot, const std::array<Bound, 2>& uv, int row) const {
  const glm::dmat3& m = slot.transform;
  if (m == glm::dmat3(1.0)) {
    return uv.at(static_cast<std::size_t>(row));
  }
  return Bound(m[0][row]) * uv[0] + Bound(m[1][row]) * uv[1] + Bound(m[2][row]);
}

// TEXCOORD_0 or 1.
const std::array<Bound, 2>& BoundedSurfaceReader::At::texcoord(std::size_t set) const {
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

BoundedSurfaceReader::At::Place BoundedSurfaceReader::At::place(const Slot& slot) const {
  const std::array<Bound, 2>& uv = texcoord(static_cast<std::size_t>(slot.texcoord));
  const Bound u = texture_coordinate(slot, uv, 0);
  const Bound v = texture_coordinate(slot, uv, 1);
  return {{u.center(), v.center()}, {u.deviation(), v.deviation()}};
}

// The levels a driver may read a texture at.
BoundedSurfaceReader::At::Levels BoundedSurfaceReader::At::levels(const Slot& slot) const {
  if (!slot.texture->needs_lod()) {
    return {-coarsest_level, {}};
  }
  if (!beside_) {
    beside_ = r_.reader_.neighbourhood(hit_, ray_);
  }
  Levels out{r_.reader_.level(slot, hit_, *beside_), straight_pieces(*slot.texture, r_.reader_.lod_interval(slot, hit_, *beside_))};
  if (out.pieces.size() == 1 && out.pieces.front().low == out.pieces.front().high) {
    out.pieces.clear();  // the ideal one is read alike
  }
  return out;
}

// At the ideal level and at all others that are allowed.
Texel BoundedSurfaceReader::At::texture(const Slot& slot) const {
  if (!slot.texture) {
    return {};
  }
  const Place at = place(slot);
  if (!at.is_bounded()) {
    return unbounded_texel();
  }
  TextureBox box(*slot.texture, at.uv, at.reach);
  const Levels l = levels(slot);
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

// In view space.
Vector BoundedSurfaceReader::At::position() const {
  const glm::dvec3 roundings = transform_roundings * epsilon * r_.rounding(hit_.triangle).largest_magnitude();
  std::array<glm::dvec3, 3> p;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3& world = r_.geometry_.positions()[r_.geometry_.vertices(hit_.triangle).at(i)];
    p.at(i) = r_.view_from_world_ * (world - glm::dvec3(r_.rays_.camera().world_from_camera[3]));
  }
  const auto axis = [&](int k) { return bound(interpolate_({p[0][k], p[1][k], p[2][k]}, roundings[k])); };
  return {axis(0), axis(1), axis(2)};
}

// Where a normal has no direction the shader takes the triangle's own, the cross product of how the position changes to the next pixel
// along x and along y: differences of two positions, each of them off by its rounding.
Vector BoundedSurfaceReader::At::face_normal(const Vector& position) const {
  const glm::dvec3 n = r_.view_from_world_ * r_.geometry_.face_normal(hit_.triangle);
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

// A matrix of floats times the vectors at the vertices.
Vector BoundedSurfaceReader::At::transformed(const std::array<glm::dvec3, 3>& directions, const glm::dmat3& view_from_local) const {
  const glm::dmat3 magnitudes(glm::abs(view_from_local[0]), glm::abs(view_from_local[1]), glm::abs(view_from_local[2]));
  std::array<glm::dvec3, 3> d;
  glm::dvec3 largest(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    d.at(i) = view_from_local * directions.at(i);
    largest = glm::max(largest, magnitudes * glm::abs(directions.at(i)));
  }
  const auto axis = [&](int k) { return bound(interpolate_({d[0][k], d[1][k], d[2][k]}, transform_roundings * epsilon * largest[k])); };
  return {axis(0), axis(1), axis(2)};
}

Vector BoundedSurfaceReader::At::normal(const Vector& position) const {
  if (placed_.primitive->normals.empty()) {
    return face_normal(position);
  }
  // Scaled to lengths near 1, as a shader's matrix has it: the length goes, but what has none must not.
  glm::dmat3 m = r_.view_from_world_ * placed_.normal_matrix;
  const double scale = std::max({glm::length(m[0]), glm::length(m[1]), glm::length(m[2])});
  m = scale > 0.0 ? m * (1.0 / scale) : m;
  const auto& normals = placed_.primitive->normals;
  const Vector n = transformed({glm::dvec3(normals[local_[0]]), glm::dvec3(normals[local_[1]]), glm::dvec3(normals[local_[2]])}, m);
  // The face's is seldom needed.
  return unit_or(n, [&] { return face_normal(position); });
}

// Where the shader finds no tangent it has no use for a map.
BoundedSurfaceReader::At::Tangent BoundedSurfaceReader::At::tangent() const {
  const auto& t = placed_.primitive->tangents;
  const std::array<glm::dvec3, 3> along{glm::dvec3(t[local_[0]]), glm::dvec3(t[local_[1]]), glm::dvec3(t[local_[2]])};
  const glm::dmat3 m = r_.view_from_world_ * placed_.linear;
  if (m * along[0] == glm::dvec3(0.0) && m * along[1] == glm::dvec3(0.0) && m * along[2] == glm::dvec3(0.0)) {
    return {};
  }
  return {true, transformed(along, m), bound(interpolate_({t[local_[0]].w, t[local_[1]].w, t[local_[2]].w}, 0.0))};
}

// On the side that is seen; see BoundedSurface for `maps`.
Vector BoundedSurfaceReader::At::mapped_normal(std::size_t map, const Vector& normal, BoundedSurface::Maps& maps) const {
  const bool of_coat = map == SurfaceReader::clearcoat_normal_slot;
  const Slot& slot = of_coat ? material_.clearcoat_normal : material_.normal;
  maps.is_open = false;
  maps.normal.clear();
  const Vector facing = hit_.front ? normal : Vector{-normal.x, -normal.y, -normal.z};
  if (!slot.texture || placed_.primitive->tangents.empty()) {
    return facing;
  }
  if (!tangent_) {
    tangent_ = tangent();
  }
  if (!tangent_->exists) {
    return facing;
  }
  const Place at = place(slot);
  TextureBox box(*slot.texture, at.uv, at.reach);
  const Bound scale(of_coat ? material_.source->clearcoat.normal_scale : material_.source->normal_scale);
  const Levels l = levels(slot);
  const NormalLevels all = normal_levels(box, l.ideal, l.pieces, scale.center());
  maps.is_open = all.is_open;
  for (const Spread& spread : all.boxes) {
    const Texel read = at.is_bounded() ? texel(spread) : unbounded_texel();
    const Vector code{read.r, read.g, read.b};
    maps.normal.push_back({tangent_->along, normal, tangent_->handedness, code, scale, Bound(hit_.front ? 1.0 : -1.0)});
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

void BoundedSurfaceReader::At::read_base(Surface<Bound>& s, Bound& alpha) const {
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

void BoundedSurfaceReader::At::read_layers(Surface<Bound>& s) const {
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

void BoundedSurfaceReader::At::read(BoundedSurface& out) const {
  Surface<Bound>& s = out.surface;
  s.position = position();
  const Vector up{Bound(0.0), Bound(0.0), Bound(1)};
  const Vector toward{-s.position.x, -s.position.y, -s.position.z};
  s.view = r_.rays_.camera().perspective ? unit_or(toward, [&] { return up; }) : up;
  const Vector interpolated = normal(s.position);
  s.normal = mapped_normal(SurfaceReader::normal_slot, interpolated, out.normals);
  s.coat_normal = mapped_normal(SurfaceReader::clearcoat_normal_slot, interpolated, out.coat_normals);
  out.edge_on = interpolate_.is_edge_on();
  read_base(s, out.opacity);
  read_layers(s);
}

BoundedSurfaceReader::BoundedSurfaceReader(const Geometry& geometry, const RayGenerator& rays, const SurfaceReader& reader,
                                           brdf::Model model)
    : geometry_(geometry), rays_(rays), reader_(reader), model_(model), view_from_world_(rotation_into_view(rays.camera())) {
  roundings_.reserve(geometry.triangle_count());
  for (std::uint32_t triangle = 0; triangle < geometry.triangle_count(); ++triangle) {
    roundings_.emplace_back(geometry, rays, triangle);
  }
}

void BoundedSurfaceReader::read(const Hit& hit, const Ray& ray, double step, BoundedSurface& out) const {
  At(*this, hit, ray, step).read(out);
}

Bound BoundedSurfaceReader::opacity(const Hit& hit, const Ray& ray, double step) const {
  return At(*this, hit, ray, step).opacity();
}

}  // namespace sheen::golden
