#include "golden/tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

#include <embree3/rtcore.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scene/view.h"

namespace sheen::golden {
namespace {

// Embree's depth is single precision and its vertices are rounded to it: hits closer than this share of the depth are told apart in double.
constexpr double depth_rounding = 1e-5;
// Four steps of a 24-bit depth buffer: two to round either depth, two for its interpolation.
constexpr double depth_buffer_step = 4.0 / (1 << 24);
// Weights this close to 0 are on an edge, where a neighbour is no second surface.
constexpr double on_edge = 1e-6;

struct DeviceRelease {
  void operator()(RTCDevice d) const { rtcReleaseDevice(d); }
};
struct SceneRelease {
  void operator()(RTCScene s) const { rtcReleaseScene(s); }
};
using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, DeviceRelease>;
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneRelease>;

void check(RTCDevice device, const char* doing) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE) {
    throw std::runtime_error(std::string("Embree failed while ") + doing + " (error " + std::to_string(static_cast<int>(error)) + ")");
  }
}

bool nearer(const Hit& a, const Hit& b) {
  return a.t != b.t ? a.t < b.t : a.triangle < b.triangle;
}

// The hit moved to the nearest point of its triangle, for rays that pass it by less than single precision shows.
Hit pulled_inside(Hit hit) {
  hit.weights = glm::max(hit.weights, glm::dvec3(0.0));
  hit.weights /= hit.weights.x + hit.weights.y + hit.weights.z;
  return hit;
}

}  // namespace

struct Tracer::Impl {
  const Geometry& geometry;
  const SurfaceReader& reader;
  const RayGenerator& rays;
  glm::dvec3 centre{0.0};                 // subtracted before rounding to float, so that large coordinates keep their digits
  std::vector<std::uint32_t> blend_rank;  // by triangle: its place in scene::blend_order
  Device device;
  EmbreeScene scene;

  struct Query;
  static void filter(const RTCFilterFunctionNArguments* args);
  void build();
  double depth_tolerance(double t) const;
  std::optional<Hit> visible(std::uint32_t triangle, const Ray& ray) const;
  bool is_clipped(const Hit& hit) const;
  bool is_at_clip_plane(const Hit& hit) const;
  bool kept_by_mask(const Hit& hit, Query& query) const;
  bool consider(const Hit& hit, Query& query) const;
  std::optional<Hit> neighbour(const Hit& hit, const Ray& ray) const;
  void settle_nearest(std::vector<Hit>& candidates, const Ray& ray, const Hit* also, Seen& seen) const;
  void settle_blended(const Ray& ray, Seen& seen) const;
};

// One ray on its way; Embree hands its address back to the filter.
struct Tracer::Impl::Query {
  RTCIntersectContext context;  // must be first
  const Impl* impl;
  const Ray* ray;
  Seen* seen;
  bool with_masked;
  const Hit* also;
  double limit;  // beyond it nothing matters
  double best;   // depth of the nearest opaque hit so far
  double nearest_at_clip_plane;
  std::vector<Hit> candidates;
};

// Depths this close may be the same to a depth buffer, or the other way round.
double Tracer::Impl::depth_tolerance(double t) const {
  const scene::Camera& camera = rays.camera();
  double window = 0.0;  // of window depth, by d t / d depth
  if (!camera.perspective) {
    window = std::isfinite(camera.zfar) ? camera.zfar - camera.znear : 0.0;
  } else {
    const double near = camera.znear;
    window = t * t / near * (std::isfinite(camera.zfar) ? (camera.zfar - near) / camera.zfar : 1.0);
  }
  return std::max(1e-7 * std::abs(t), depth_buffer_step * window);
}

std::optional<Hit> Tracer::Impl::visible(std::uint32_t triangle, const Ray& ray) const {
  std::optional<Hit> hit = geometry.meet(triangle, ray);
  const bool shows = hit && (hit->front || geometry.placed(triangle).material->double_sided);
  return shows ? hit : std::nullopt;
}

bool Tracer::Impl::is_clipped(const Hit& hit) const {
  return !(hit.t >= rays.camera().znear && hit.t <= rays.camera().zfar);
}

bool Tracer::Impl::is_at_clip_plane(const Hit& hit) const {
  const double tolerance = depth_tolerance(hit.t);
  return std::abs(hit.t - rays.camera().znear) <= tolerance || std::abs(hit.t - rays.camera().zfar) <= tolerance;
}

bool Tracer::Impl::kept_by_mask(const Hit& hit, Query& query) const {
  if (query.with_masked) {
    query.seen->masked.push_back(hit);
  }
  return reader.opacity(hit, *query.ray) >= geometry.placed(hit.triangle).material->alpha_cutoff;
}

void Tracer::Impl::filter(const RTCFilterFunctionNArguments* args) {
  if (args->valid[0] == 0) {
    return;
  }
  args->valid[0] = 0;
  auto& query = *reinterpret_cast<Query*>(args->context);
  const Impl& impl = *query.impl;
  const std::uint32_t triangle = RTCHitN_primID(args->hit, args->N, 0);
  if (query.also != nullptr && query.also->triangle == triangle) {
    return;
  }
  const std::optional<Hit> hit = impl.visible(triangle, *query.ray);
  if (!hit || !impl.consider(*hit, query)) {
    return;
  }
  // Accepting shortens the ray to its new end, which is a little beyond this hit, so that what ties with it is still visited.
  RTCRayN_tfar(args->ray, args->N, 0) = static_cast<float>(query.limit);
  args->valid[0] = -1;
}

// Takes note of a hit. Whether it hides what lies behind it.
bool Tracer::Impl::consider(const Hit& hit, Query& query) const {
  if (is_at_clip_plane(hit)) {
    query.nearest_at_clip_plane = std::min(query.nearest_at_clip_plane, hit.t);
  }
  if (is_clipped(hit) || hit.t > query.limit) {
    return false;
  }
  const scene::Material& material = *geometry.placed(hit.triangle).material;
  if (material.alpha_mode == scene::AlphaMode::Blend) {
    query.seen->blended.push_back(hit);
    return false;
  }
  if (material.alpha_mode == scene::AlphaMode::Mask && !kept_by_mask(hit, query)) {
    return false;
  }
  query.candidates.push_back(hit);
  query.best = std::min(query.best, hit.t);
  query.limit = query.best + std::max(depth_rounding * std::abs(query.best), depth_tolerance(query.best));
  return true;
}

void Tracer::Impl::build() {
  device.reset(rtcNewDevice(nullptr));
  if (device == nullptr) {
    check(nullptr, "starting");
  }
  scene.reset(rtcNewScene(device.get()));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  RTCGeometry mesh = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  const auto& positions = geometry.positions();
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               std::max<std::size_t>(positions.size(), 1)));
  const std::size_t count = geometry.triangle_count();
  auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                                      3 * sizeof(std::uint32_t), std::max<std::size_t>(count, 1)));
  check(device.get(), "taking memory for the triangles");
  if (positions.empty()) {
    std::fill_n(vertices, 3, 0.0f);
  }
  if (count == 0) {
    std::fill_n(indices, 3, 0u);
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      vertices[3 * i + static_cast<std::size_t>(k)] = static_cast<float>(positions[i][k] - centre[k]);
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    const auto& v = geometry.vertices(static_cast<std::uint32_t>(i));
    std::copy(v.begin(), v.end(), indices + 3 * i);
  }
  rtcSetGeometryIntersectFilterFunction(mesh, &Impl::filter);
  rtcCommitGeometry(mesh);
  rtcAttachGeometry(scene.get(), mesh);
  rtcReleaseGeometry(mesh);
  rtcCommitScene(scene.get());
  check(device.get(), "building its acceleration structure");
}

namespace {

struct NeighbourQuery {
  const Geometry* geometry;
  const Ray* ray;
  std::uint32_t first;  // triangles of the same instance: [first, last)
  std::uint32_t last;
  std::optional<Hit> found;
};

// Keeps the triangle that the exact ray passes through; the lowest of several, so that the answer depends on no order of visits.
bool consider_neighbour(RTCPointQueryFunctionArguments* args) {
  auto& query = *static_cast<NeighbourQuery*>(args->userPtr);
  if (args->primID < query.first || args->primID >= query.last) {
    return false;
  }
  const std::optional<Hit> hit = query.geometry->meet(args->primID, *query.ray);
  if (hit && hit->smallest_weight() >= 0.0 && (!query.found || hit->triangle < query.found->triangle)) {
    query.found = hit;
  }
  return false;
}

}  // namespace

// The triangle of the same instance that the ray does pass through, next to one that it passes by.
std::optional<Hit> Tracer::Impl::neighbour(const Hit& hit, const Ray& ray) const {
  const glm::dvec3 at = ray.origin + ray.direction * hit.t - centre;
  RTCPointQuery sphere{};
  sphere.x = static_cast<float>(at.x);
  sphere.y = static_cast<float>(at.y);
  sphere.z = static_cast<float>(at.z);
  sphere.time = 0.0f;
  const double radius = depth_rounding * glm::length(ray.direction) * std::abs(hit.t);
  sphere.radius = static_cast<float>(radius);
  const Placed& placed = geometry.placed(hit.triangle);
  const auto triangles = static_cast<std::uint32_t>(placed.primitive->indices.size() / 3);
  NeighbourQuery query{&geometry, &ray, placed.first_triangle, placed.first_triangle + triangles, std::nullopt};
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene.get(), &sphere, &context, &consider_neighbour, &query);
  if (!query.found || query.found->front != hit.front || std::abs(query.found->t - hit.t) > 10.0 * depth_rounding * std::abs(hit.t)) {
    return std::nullopt;
  }
  return query.found;
}

void Tracer::Impl::settle_nearest(std::vector<Hit>& candidates, const Ray& ray, const Hit* also, Seen& seen) const {
  if (candidates.empty()) {
    return;
  }
  std::sort(candidates.begin(), candidates.end(), nearer);
  const Hit first = candidates.front();
  const double reach = first.t + depth_rounding * std::abs(first.t);
  const auto inside =
      std::find_if(candidates.begin(), candidates.end(), [&](const Hit& h) { return h.smallest_weight() >= 0.0 && h.t <= reach; });
  // What was asked for is shown, too, if a depth buffer may not tell it from what is nearest.
  const auto asked = std::find_if(candidates.begin(), candidates.end(), [&](const Hit& h) {
    return also != nullptr && h.triangle == also->triangle && h.t - first.t <= std::max(reach - first.t, depth_tolerance(first.t));
  });
  if (asked != candidates.end()) {
    seen.nearest = *asked;
  } else if (inside != candidates.end()) {
    seen.nearest = *inside;
  } else {
    const std::optional<Hit> other = neighbour(first, ray);
    seen.nearest = other ? *other : pulled_inside(first);
  }
  const double tolerance = depth_tolerance(seen.nearest->t);
  // Several triangles at one depth, to the last digits, are a tie that the first in the file wins.
  for (const Hit& h : candidates) {
    const bool strictly_inside = h.smallest_weight() > on_edge && seen.nearest->smallest_weight() > on_edge;
    if (h.triangle == seen.nearest->triangle || !strictly_inside || std::abs(h.t - seen.nearest->t) > tolerance) {
      continue;
    }
    const bool wins = asked == candidates.end() && h.triangle < seen.nearest->triangle;
    if (wins && std::abs(h.t - seen.nearest->t) <= 1e-12 * std::abs(h.t)) {
      seen.tie = seen.nearest;
      seen.nearest = h;
    } else if (!seen.tie || nearer(h, *seen.tie)) {
      seen.tie = h;
    }
  }
}

void Tracer::Impl::settle_blended(const Ray& ray, Seen& seen) const {
  for (Hit& hit : seen.blended) {
    if (hit.smallest_weight() >= 0.0) {
      continue;
    }
    const std::optional<Hit> other = neighbour(hit, ray);
    hit = other ? *other : pulled_inside(hit);
  }
  seen.ambiguous = std::any_of(seen.blended.begin(), seen.blended.end(), [&](const Hit& h) {
    return seen.nearest && std::abs(h.t - seen.nearest->t) <= depth_tolerance(seen.nearest->t);
  });
  const auto hidden = [&](const Hit& h) { return seen.nearest && h.t >= seen.nearest->t; };
  seen.blended.erase(std::remove_if(seen.blended.begin(), seen.blended.end(), hidden), seen.blended.end());
  const auto rank = [&](const Hit& h) { return blend_rank[h.triangle]; };
  std::sort(seen.blended.begin(), seen.blended.end(), [&](const Hit& a, const Hit& b) { return rank(a) < rank(b); });
  // A sample exactly on an edge that two triangles share is covered by one of them.
  const auto same = [this](const Hit& a, const Hit& b) {
    const bool on_one_edge = a.smallest_weight() <= 0.0 && b.smallest_weight() <= 0.0 && a.front == b.front &&
                             &geometry.placed(a.triangle) == &geometry.placed(b.triangle) && std::abs(a.t - b.t) <= 1e-12 * std::abs(a.t);
    return a.triangle == b.triangle || on_one_edge;
  };
  std::vector<Hit> covering;
  for (const Hit& hit : seen.blended) {
    if (std::none_of(covering.begin(), covering.end(), [&](const Hit& other) { return same(other, hit); })) {
      covering.push_back(hit);
    }
  }
  seen.blended.swap(covering);
}

Tracer::Tracer(const scene::Scene& scene, const Geometry& geometry, const SurfaceReader& reader, const RayGenerator& rays)
    : impl_(new Impl{geometry, reader, rays, {}, {}, {}, {}}) {
  const bool blends = std::any_of(scene.instances.begin(), scene.instances.end(), [&](const scene::Instance& i) {
    const int material = scene.primitives[static_cast<std::size_t>(i.primitive)].material;
    return scene.materials[static_cast<std::size_t>(material)].alpha_mode == scene::AlphaMode::Blend;
  });
  if (blends) {
    impl_->blend_rank.assign(geometry.triangle_count(), 0);
    std::uint32_t rank = 0;
    for (const scene::BlendTriangle& t : scene::blend_order(scene, rays.camera())) {
      impl_->blend_rank[geometry.global_triangle(t.instance, t.triangle)] = rank++;
    }
  }
  impl_->centre = glm::dvec3(rays.camera().world_from_camera[3]);
  impl_->build();
}

Tracer::~Tracer() = default;

void Tracer::trace(const Ray& ray, bool with_masked, Seen& seen, const Hit* also) const {
  seen.clear();
  Impl::Query query{};
  rtcInitIntersectContext(&query.context);
  query.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  query.impl = impl_.get();
  query.ray = &ray;
  query.seen = &seen;
  query.with_masked = with_masked;
  query.also = also;
  query.limit = impl_->rays.camera().zfar;
  query.best = std::numeric_limits<double>::infinity();
  query.nearest_at_clip_plane = std::numeric_limits<double>::infinity();
  if (also != nullptr) {
    impl_->consider(*also, query);
  }
  RTCRayHit cast{};
  const glm::dvec3 origin = ray.origin - impl_->centre;
  cast.ray.org_x = static_cast<float>(origin.x);
  cast.ray.org_y = static_cast<float>(origin.y);
  cast.ray.org_z = static_cast<float>(origin.z);
  cast.ray.dir_x = static_cast<float>(ray.direction.x);
  cast.ray.dir_y = static_cast<float>(ray.direction.y);
  cast.ray.dir_z = static_cast<float>(ray.direction.z);
  // The exact clip is made on the recomputed depth.
  cast.ray.tnear = static_cast<float>(impl_->rays.camera().znear * (1.0 - depth_rounding));
  cast.ray.tfar = static_cast<float>(query.limit * (1.0 + depth_rounding));
  cast.ray.mask = ~0u;
  cast.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene.get(), &query.context, &cast);
  impl_->settle_nearest(query.candidates, ray, also, seen);
  impl_->settle_blended(ray, seen);
  const bool clip_decides = std::isfinite(query.nearest_at_clip_plane) && (!seen.nearest || query.nearest_at_clip_plane <= seen.nearest->t);
  seen.ambiguous = seen.ambiguous || clip_decides;
  // Only what is in front was certainly visited, and only that matters.
  std::erase_if(seen.masked, [&](const Hit& hit) { return seen.nearest && hit.t > seen.nearest->t; });
}

double Tracer::depth_tolerance(double depth) const {
  return impl_->depth_tolerance(depth);
}

std::optional<Hit> Tracer::trace_alone(std::uint32_t triangle, const Ray& ray) const {
  const std::optional<Hit> hit = impl_->visible(triangle, ray);
  const bool is_plain = hit && hit->smallest_weight() > on_edge && !impl_->is_clipped(*hit) && !impl_->is_at_clip_plane(*hit) &&
                        impl_->geometry.placed(triangle).material->alpha_mode == scene::AlphaMode::Opaque;
  return is_plain ? hit : std::nullopt;
}

}  // namespace sheen::golden
