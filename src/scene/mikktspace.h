#pragma once

#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace sheen::scene {

/// Tangents by MikkTSpace with its default angular threshold of 180 degrees, which glTF 2.0, section 3.7.2.1, asks for where a file gives
/// none: Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited", and mikktspace.com. In float and in the
/// reference's order of operations, so that what a baker decided by rounding is decided alike here.
///
/// A corner's tangent is the mean of dp/du, projected into the plane of its normal, over the triangles of its group, weighted by their
/// angles there. A group is what can be reached from a triangle over edges at one vertex (equal in position, normal and uv) without a
/// change of the uv's orientation. Triangles without area in uv join any group and add nothing; those with two equal positions take no part
/// and copy the tangents of others at their vertices. The reference leaves the edges of its last vertex unsorted and so may miss neighbours
/// there, where more than two triangles meet; here they are found.
///
/// Handedness: MikkTSpace's sign s is +1 where det(duv) > 0, and s cross(normal, tangent) points toward growing v. In glTF v grows down the
/// image while a normal map's green axis points up (sections 3.8.3 and 3.9.3), so w = -s. Passing (u, 1 - v) and keeping s would be the
/// same: the sign of det turns, and with it that of dp/du's numerator, so the tangent stays. three.js and gltf-transform negate s too. The
/// sign comes from the uv alone: it does not ask whether the normals face the triangle's front.
///
/// @param positions, normals, uvs  one each a corner, three corners a triangle, of equal length; normals are unit
/// @return one a corner: xyz unit and perpendicular to the normal, w = +1 or -1 with bitangent = cross(normal, xyz) * w. xyz is zero where
///   the method defines no direction: no triangle of the vertex has area, dp/du is parallel to the normal, or a float overflows or
///   underflows (the reference then gives (1, 0, 0), zero, NaN or any length). Where dp/du is parallel to the normal but for its rounding,
///   that rounding is the direction, as in the reference.
/// Time is linear but for sorting, and quadratic in the triangles of one vertex where some are exactly opposite. Throws
/// std::invalid_argument when the lengths differ or are no multiple of 3.
std::vector<glm::vec4> mikktspace(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals, std::span<const glm::vec2> uvs);

}  // namespace sheen::scene
