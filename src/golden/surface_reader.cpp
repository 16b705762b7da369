#include "golden/surface_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "brdf/draft_sheen.h"

namespace sheen::golden {
namespace {

// The value at a hit of an attribute given at a primitive's vertices, in double.
template <class Wide, class Narrow>
Wide interpolate(const std::vector<Narrow>& values, const std::array<std::uint32_t, 3>& v, const glm::dvec3& weights) {
  return Wide(values[v[0]]) * weights.x + Wide(values[v[1]]) * weights.y + Wide(values[v[2]]) * weights.z;
}

// The unit vector along v, or `otherwise` where v has no direction.
glm::dvec3 unit_or(const glm::dvec3& v, const glm::dvec3& otherwise) {
  const double length2 = glm::dot(v, v);
  if (!(length2 > 1e-60) || !std::isfinite(length2)) {
    return otherwise;
  }
  return v / std::sqrt(length2);
}

// Whether one level of detail means the same to both, at the same coordinates.
bool have_same_levels(const Texture& a, const Texture& b) {
  return a.size() == b.size() && a.sampler.mag == b.sampler.mag && a.sampler.min == b.sampler.min && a.sampler.mip == b.sampler.mip;
}

Vec3<double> vec3(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}
brdf::Rgb<double> rgb(const glm::dvec3& c) {
  return {c.x, c.y, c.z};
}

}  // namespace

// How the triangle lies under the pixel and its neighbours: their weights on its plane, where textures need them.
struct SurfaceReader::Footprint {
  int count = 0;                      // 0: level 0 for all
  std::array<glm::dvec3, 3> ideal{};  // weights here, right and below
  bool ideal_beyond = false;          // a neighbour's ray never meets the plane: the coarsest level
  const Slot* varied = nullptr;       // the texture whose level is given
  double level = 0.0;
  glm::dvec2 nudge{0.0};
  const Ray* ray = nullptr;
};

SurfaceReader::SurfaceReader(const scene::Scene& scene, const Geometry& geometry, const RayGenerator& rays, bool environment,
                             brdf::Model model, double step)
    : geometry_(geometry), rays_(rays), model_(model), step_(step), materials_(scene.materials.size()) {
  TextureStore store(scene);
  std::vector<bool> used(scene.materials.size(), false);
  for (const scene::Instance& instance : scene.instances) {
    used[static_cast<std::size_t>(scene.primitives[static_cast<std::size_t>(instance.primitive)].material)] = true;
  }
  for (std::size_t i = 0; i < materials_.size(); ++i) {
    if (used[i]) {
      read_material(scene, store, static_cast<int>(i), environment);
    }
  }
}

void SurfaceReader::read_material(const scene::Scene& scene, TextureStore& store, int index, bool environment) {
  using scene::ColorSpace;
  const scene::Material& source = scene.materials[static_cast<std::size_t>(index)];
  Material& m = materials_[static_cast<std::size_t>(index)];
  m.source = &source;
  if (model_ != brdf::Model::Physical) {
    m.layers = {source.sheen.enabled(), source.clearcoat.enabled(), false};
  }
  const auto slot = [&](const scene::TextureInfo& info, ColorSpace space) {
    Slot s;
    if (!info.present()) {
      return s;
    }
    s.texture = store.get(info.texture, space);
    s.texcoord = info.texcoord;
    s.transform = info.transform;
    if (info.texcoord < 0 || info.texcoord > 1) {
      throw scene::Error(scene.file, "materials[" + std::to_string(index) + "]", "texCoord must be 0 or 1");
    }
    m.needs_lod = m.needs_lod || s.texture->needs_lod();
    return s;
  };
  m.base_color = slot(source.base_color_texture, ColorSpace::Srgb);
  m.metallic_roughness = slot(source.metallic_roughness_texture, ColorSpace::Linear);
  m.normal = slot(source.normal_texture, ColorSpace::Linear);
  if (environment) {
    m.occlusion = slot(source.occlusion_texture, ColorSpace::Linear);
  }
  m.emissive = slot(source.emissive_texture, ColorSpace::Srgb);
  m.specular = slot(source.specular.factor_texture, ColorSpace::Linear);
  m.specular_color = slot(source.specular.color_texture, ColorSpace::Srgb);
  if (m.layers.sheen) {
    m.sheen_color = slot(source.sheen.color_texture, ColorSpace::Srgb);
    if (model_ == brdf::Model::Ratified) {
      m.sheen_roughness = slot(source.sheen.roughness_texture, ColorSpace::Linear);
    }
  }
  if (m.layers.clearcoat) {
    m.clearcoat = slot(source.clearcoat.factor_texture, ColorSpace::Linear);
    m.clearcoat_roughness = slot(source.clearcoat.roughness_texture, ColorSpace::Linear);
    m.clearcoat_normal = slot(source.clearcoat.normal_texture, ColorSpace::Linear);
    m.layers.one_normal = !m.normal.texture && !m.clearcoat_normal.texture;
  }
  compare_slots(m);
}

void SurfaceReader::compare_slots(Material& m) {
  for (std::size_t i = 0; i < slot_count; ++i) {
    Slot& slot = m.*slots[i];
    slot.same_place = slot.same_levels = i;
    for (std::size_t k = i; k-- > 0;) {
      const Slot& other = slot_of(m, k);
      if (!slot.texture || !other.texture || other.texcoord != slot.texcoord || other.transform != slot.transform) {
        continue;
      }
      slot.same_place = k;
      if (have_same_levels(*slot.texture, *other.texture)) {
        slot.same_levels = k;
      }
    }
  }
}

// The weights where the ray so many pixels beside this one meets the hit's plane. Sets `beyond` where none does.
glm::dvec3 SurfaceReader::weights_beside(const Hit& hit, const Ray& ray, double dx, double dy, bool& beyond) const {
  const auto met = geometry_.meet(hit.triangle, rays_.through(ray.x + dx, ray.y + dy));
  if (!met || (rays_.camera().perspective && met->t <= 0.0)) {
    beyond = true;
    return glm::dvec3(0.0);
  }
  return met->weights;
}

SurfaceReader::Footprint SurfaceReader::footprint(const Hit& hit, const Ray& ray, LodChoice lod) const {
  Footprint f;
  f.nudge = lod.nudge;
  f.ray = &ray;
  if (!needs_lod(geometry_.placed(hit.triangle).material_index)) {
    return f;
  }
  f.count = 1;
  f.ideal = {hit.weights, weights_beside(hit, ray, 1.0, 0.0, f.ideal_beyond), weights_beside(hit, ray, 0.0, 1.0, f.ideal_beyond)};
  if (lod.level) {
    f.varied = &slot_of(materials_[static_cast<std::size_t>(geometry_.placed(hit.triangle).material_index)], lod.slot);
    f.level = *lod.level;
  }
  return f;
}

glm::dvec2 SurfaceReader::texcoord(const Slot& slot, const Hit& hit, const glm::dvec3& weights) const {
  const auto& texcoords = geometry_.placed(hit.triangle).primitive->texcoords[static_cast<std::size_t>(slot.texcoord)];
  const glm::dvec2 uv =
      texcoords.empty() ? glm::dvec2(0.0) : interpolate<glm::dvec2>(texcoords, geometry_.local_vertices(hit.triangle), weights);
  return {slot.transform * glm::dvec3(uv, 1.0)};
}

// Of 32-bit floats, in coordinates: a few roundings of the largest at the triangle's vertices, then of the transform. In perspective what
// is interpolated is their share of 1 / depth, of which the nearest point of the triangle has most.
glm::dvec2 SurfaceReader::coordinate_rounding(const Slot& slot, const Hit& hit) const {
  const auto& texcoords = geometry_.placed(hit.triangle).primitive->texcoords[static_cast<std::size_t>(slot.texcoord)];
  glm::dvec2 largest(0.0);
  for (const std::uint32_t vertex : geometry_.local_vertices(hit.triangle)) {
    largest = texcoords.empty() ? largest : glm::max(largest, glm::abs(glm::dvec2(texcoords[vertex])));
  }
  if (rays_.camera().perspective) {
    double nearest = hit.t;
    for (const std::uint32_t vertex : geometry_.vertices(hit.triangle)) {
      nearest = std::min(nearest, rays_.depth(geometry_.positions()[vertex]));
    }
    largest *= hit.t / std::max(nearest, rays_.camera().znear);
  }
  const glm::dmat3& m = slot.transform;
  const glm::dvec3 out = glm::abs(m[0]) * largest.x + glm::abs(m[1]) * largest.y + glm::abs(m[2]);
  return 0x1p-22 * glm::dvec2(out);
}

// In coordinates; infinite where the step leads beyond the plane.
glm::dvec2 SurfaceReader::moved_by_step(const Slot& slot, const Hit& hit, const Ray& ray) const {
  const glm::dvec2 here = texcoord(slot, hit, hit.weights);
  glm::dvec2 moved(0.0);
  for (const glm::dvec2& by : {glm::dvec2(step_, 0.0), glm::dvec2(0.0, step_)}) {
    const auto met = geometry_.meet(hit.triangle, rays_.through(ray.x + by.x, ray.y + by.y));
    moved += met ? glm::abs(texcoord(slot, hit, met->weights) - here) : glm::dvec2(std::numeric_limits<double>::infinity());
  }
  return moved;
}

TextureReach SurfaceReader::texture_reach(const Hit& hit, const Ray& ray) const {
  const Material& m = materials_[static_cast<std::size_t>(geometry_.placed(hit.triangle).material_index)];
  TextureReach reach;
  for (std::size_t i = 0; i < slot_count; ++i) {
    const Slot& slot = slot_of(m, i);
    if (!slot.texture) {
      continue;
    }
    const glm::dvec2 size = slot.texture->size();
    const glm::dvec2 rounding = coordinate_rounding(slot, hit) * size;
    const glm::dvec2 moved = moved_by_step(slot, hit, ray) * size;
    if (slot.texture->sampler.mip == scene::MipFilter::None) {
      reach.texels = std::max({reach.texels, moved.x + rounding.x, moved.y + rounding.y});
    }
    // The step is twice what a grid of that size does, so a little of the rest is in it.
    reach.beyond_the_step = reach.beyond_the_step || rounding.x > 0.125 * moved.x || rounding.y > 0.125 * moved.y;
  }
  return reach;
}

double SurfaceReader::level(const Slot& slot, const Hit& hit, const Footprint& footprint) const {
  if (footprint.count == 0 || !slot.texture->needs_lod()) {
    return -coarsest_level;
  }
  if (footprint.varied == &slot) {
    return footprint.level;
  }
  if (footprint.ideal_beyond) {
    return coarsest_level;
  }
  const auto texels = [&](std::size_t i) { return texcoord(slot, hit, footprint.ideal[i]) * slot.texture->size(); };
  return ideal_lod(texels(0), texels(1), texels(2));
}

glm::dvec4 SurfaceReader::read(const Slot& slot, const Hit& hit, const Footprint& footprint) const {
  if (!slot.texture) {
    return glm::dvec4(1.0);
  }
  glm::dvec2 uv = texcoord(slot, hit, hit.weights);
  if (footprint.nudge != glm::dvec2(0.0)) {
    uv += footprint.nudge * (coordinate_rounding(slot, hit) + moved_by_step(slot, hit, *footprint.ray));
  }
  return sample(*slot.texture, uv, level(slot, hit, footprint));
}

glm::dvec3 SurfaceReader::interpolated_normal(const Hit& hit) const {
  const Placed& placed = geometry_.placed(hit.triangle);
  const glm::dvec3 face = geometry_.face_normal(hit.triangle);
  if (placed.primitive->normals.empty()) {
    return face;
  }
  const auto local = interpolate<glm::dvec3>(placed.primitive->normals, geometry_.local_vertices(hit.triangle), hit.weights);
  return unit_or(placed.normal_matrix * local, face);
}

// glTF 2.0, section 3.7.2.1 (bitangent) and section 3.9.3 (normalTextureInfo.scale).
glm::dvec3 SurfaceReader::mapped_normal(const Slot& slot, double scale, const glm::dvec3& normal, const Hit& hit,
                                        const Footprint& footprint) const {
  const Placed& placed = geometry_.placed(hit.triangle);
  if (!slot.texture || placed.primitive->tangents.empty()) {
    return normal;
  }
  const auto tangent4 = interpolate<glm::dvec4>(placed.primitive->tangents, geometry_.local_vertices(hit.triangle), hit.weights);
  const glm::dvec3 tangent = unit_or(placed.linear * glm::dvec3(tangent4), glm::dvec3(0.0));
  if (tangent == glm::dvec3(0.0)) {
    return normal;
  }
  const glm::dvec3 bitangent = glm::cross(normal, tangent) * tangent4.w;
  const glm::dvec3 texel = glm::dvec3(read(slot, hit, footprint)) * 2.0 - 1.0;
  const glm::dvec3 bent = unit_or(glm::dvec3(texel.x * scale, texel.y * scale, texel.z), glm::dvec3(0.0, 0.0, 1.0));
  return unit_or(tangent * bent.x + bitangent * bent.y + normal * bent.z, normal);
}

// The normal by the map whose level is chosen.
glm::dvec3 SurfaceReader::mapped_normal(const Hit& hit, const Ray& ray, LodChoice lod) const {
  const Material& m = materials_[static_cast<std::size_t>(geometry_.placed(hit.triangle).material_index)];
  const Slot& slot = slot_of(m, lod.slot);
  const double scale = &slot == &m.normal ? m.source->normal_scale : m.source->clearcoat.normal_scale;
  return mapped_normal(slot, scale, interpolated_normal(hit), hit, footprint(hit, ray, lod));
}

// What one texture decides, whether it is there or not.
// @param normal  the interpolated one
void SurfaceReader::fill(Surface<double>& s, std::size_t slot, const glm::dvec3& normal, const Hit& hit, const Footprint& f) const {
  const Placed& placed = geometry_.placed(hit.triangle);
  const Material& m = materials_[static_cast<std::size_t>(placed.material_index)];
  const scene::Material& source = *m.source;
  const auto square = [](double x) { return x * x; };
  const double side = hit.front ? 1.0 : -1.0;
  if (&slot_of(m, slot) == &m.normal) {
    s.normal = vec3(mapped_normal(m.normal, source.normal_scale, normal, hit, f) * side);
  } else if (&slot_of(m, slot) == &m.clearcoat_normal) {
    s.coat_normal = vec3(mapped_normal(m.clearcoat_normal, source.clearcoat.normal_scale, normal, hit, f) * side);
  } else if (&slot_of(m, slot) == &m.base_color) {
    glm::dvec3 color = glm::dvec3(source.base_color_factor) * glm::dvec3(read(m.base_color, hit, f));
    if (!placed.primitive->colors.empty()) {
      color *= glm::dvec3(interpolate<glm::dvec4>(placed.primitive->colors, geometry_.local_vertices(hit.triangle), hit.weights));
    }
    s.base.color = rgb(color);
  } else if (&slot_of(m, slot) == &m.metallic_roughness) {
    const glm::dvec4 metallic_roughness = read(m.metallic_roughness, hit, f);
    s.base.metallic = source.metallic_factor * metallic_roughness.z;
    s.base.alpha = square(source.roughness_factor * metallic_roughness.y);
  } else if (&slot_of(m, slot) == &m.specular_color) {
    s.base.dielectric_f0 = brdf::dielectric_f0(source.ior, rgb(source.specular.color_factor * glm::dvec3(read(m.specular_color, hit, f))));
  } else if (&slot_of(m, slot) == &m.specular) {
    s.base.specular = source.specular.factor * read(m.specular, hit, f).w;
  } else if (&slot_of(m, slot) == &m.emissive) {
    s.emission = rgb(source.emissive_factor * glm::dvec3(read(m.emissive, hit, f)));
  } else if (&slot_of(m, slot) == &m.occlusion) {
    s.occlusion = 1.0 + (m.occlusion.texture ? source.occlusion_strength * (read(m.occlusion, hit, f).x - 1.0) : 0.0);
  } else if (&slot_of(m, slot) == &m.sheen_color && m.layers.sheen) {
    s.sheen_color = rgb(source.sheen.color_factor * glm::dvec3(read(m.sheen_color, hit, f)));
  } else if (&slot_of(m, slot) == &m.sheen_roughness && m.layers.sheen) {
    s.sheen_roughness = source.sheen.roughness_factor * read(m.sheen_roughness, hit, f).w;
  } else if (&slot_of(m, slot) == &m.clearcoat && m.layers.clearcoat) {
    s.clearcoat = source.clearcoat.factor * read(m.clearcoat, hit, f).x;
  } else if (&slot_of(m, slot) == &m.clearcoat_roughness && m.layers.clearcoat) {
    s.coat_alpha = square(source.clearcoat.roughness_factor * read(m.clearcoat_roughness, hit, f).y);
  }
}

Surface<double> SurfaceReader::surface(const Hit& hit, const Ray& ray, LodChoice lod) const {
  const Material& m = materials_[static_cast<std::size_t>(geometry_.placed(hit.triangle).material_index)];
  const Footprint f = footprint(hit, ray, lod);
  Surface<double> s{};
  s.position = vec3(interpolate<glm::dvec3>(geometry_.positions(), geometry_.vertices(hit.triangle), hit.weights));
  s.view = vec3(rays_.toward_camera(ray));
  const glm::dvec3 normal = interpolated_normal(hit);
  for (std::size_t slot = 0; slot < slot_count; ++slot) {
    fill(s, slot, normal, hit, f);
  }
  if (m.layers.sheen && model_ == brdf::Model::Draft2019) {
    s.sheen_color = brdf::draft_sheen_color(s.sheen_color, s.base.color, s.base.metallic);
    s.sheen_roughness = m.source->roughness_factor * read(m.metallic_roughness, hit, f).y;
  }
  return s;
}

Surface<double> SurfaceReader::varied(const Surface<double>& usual, const Hit& hit, const Ray& ray, LodChoice lod) const {
  if (!lod.level || model_ == brdf::Model::Draft2019) {  // whose sheen depends on the base's textures
    return surface(hit, ray, lod);
  }
  Footprint f;
  f.count = 1;
  f.ray = &ray;
  f.varied = &slot_of(materials_[static_cast<std::size_t>(geometry_.placed(hit.triangle).material_index)], lod.slot);
  f.level = *lod.level;
  Surface<double> s = usual;
  fill(s, lod.slot, interpolated_normal(hit), hit, f);
  return s;
}

double SurfaceReader::opacity(const Hit& hit, const Ray& ray, LodChoice lod) const {
  const Placed& placed = geometry_.placed(hit.triangle);
  const Material& m = materials_[static_cast<std::size_t>(placed.material_index)];
  double alpha = m.source->base_color_factor.w;
  if (m.base_color.texture) {
    alpha *= read(m.base_color, hit, footprint(hit, ray, lod)).w;
  }
  if (!placed.primitive->colors.empty()) {
    alpha *= interpolate<glm::dvec4>(placed.primitive->colors, geometry_.local_vertices(hit.triangle), hit.weights).w;
  }
  return std::clamp(alpha, 0.0, 1.0);
}

}  // namespace sheen::golden
