#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "scene/scene.h"

namespace sheen::scene {

/// Gives every triangle vertices of its own, so that attributes may jump at its edges: indices become 0, 1, 2, ...
void unshare_vertices(Primitive& primitive);

/// Flat normals for a primitive without normals: unshares the vertices, gives each triangle its geometric normal (counter-clockwise is the
/// front; +Z for a triangle without area) and drops tangents (glTF 2.0, section 3.7.2.1: then the tangents given MUST be ignored).
void make_flat_normals(Primitive& primitive);

/// Tangents for a primitive without any: unshares the vertices and gives each triangle the direction in which the u of `uv` grows, in the
/// plane of each corner's normal, with w such that cross(normal, tangent) * w points toward decreasing v, the normal map's green axis (glTF
/// 2.0, sections 3.7.2.1 and 3.9.3: v grows downwards in the image). The texture coordinates are those after KHR_texture_transform, by
/// which the map is sampled, so tangent and map agree under rotation and mirroring. A triangle whose uv has no area gets some vector of the
/// normal's plane.
void make_tangents(Primitive& primitive, const TextureInfo& uv);

/// Replaces what interpolation could not use: normals of length zero by the mean of the adjacent triangles' normals, tangents of length
/// zero by some vector of the normal's plane, a tangent's w by its sign. Returns how many normals and tangents of length zero there were.
std::size_t repair_frames(Primitive& primitive);

}  // namespace sheen::scene
