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

/// Tangents for a primitive without any, by MikkTSpace (glTF 2.0, section 3.7.2.1): unshares the vertices, since corners of one vertex may
/// get different tangents. `uv` is the normal map's; its texture coordinates are taken after KHR_texture_transform, because by these the
/// map is sampled: tangents of the coordinates as given would turn and mirror the map's directions wherever the transform does. Where
/// MikkTSpace defines no direction, the tangent is some vector of the normal's plane: the X axis projected into it, unless normal and axis
/// nearly agree.
void make_tangents(Primitive& primitive, const TextureInfo& uv);

/// Replaces what interpolation could not use: normals of length zero by the mean of the adjacent triangles' normals, tangents of length
/// zero by some vector of the normal's plane, a tangent's w by its sign. Returns how many normals and tangents of length zero there were.
std::size_t repair_frames(Primitive& primitive);

}  // namespace sheen::scene
