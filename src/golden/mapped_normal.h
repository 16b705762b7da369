#pragma once

#include "golden/vec3.h"
#include "number/bounded.h"

namespace sheen::golden {

/// A normal map under one point, as a shader has read it; numbers only, as Surface is.
template <class Real>
struct MappedNormal {
  Vec3<Real> tangent;  ///< as interpolated, of any length
  Vec3<Real> normal;   ///< unit but for roundings
  Real handedness;     ///< TANGENT.w
  Vec3<Real> code;     ///< of the texture, [0, 1]
  Real scale;          ///< normalTextureInfo.scale
  Real side;           ///< -1 on a back face, else 1
};

/// Of floats: what is shorter has no direction.
inline constexpr double smallest_length_squared = 1e-30;

/// The unit vector along v, what `otherwise` gives where v certainly has no direction, and no bound where it may have none.
template <class Precision, class Otherwise>
Vec3<number::Bounded<Precision>> unit_or(const Vec3<number::Bounded<Precision>>& v, const Otherwise& otherwise) {
  using B = number::Bounded<Precision>;
  const B squared = dot(v, v);
  if (squared.is_bounded() && squared.range().lower > smallest_length_squared) {
    return v * inversesqrt(squared);
  }
  if (squared.is_bounded() && squared.range().upper <= smallest_length_squared) {
    return otherwise();
  }
  const B none = B::unbounded(0.0);
  return {none, none, none};
}

/// The unit normal that a map makes (glTF 2.0, sections 3.7.2.1 and 3.9.3).
template <class Real>
Vec3<Real> bent(const MappedNormal<Real>& m) {
  const auto coded = [](const Real& x) { return x * Real(2) - Real(1); };
  const auto up = [] { return Vec3<Real>{Real(0.0), Real(0.0), Real(1)}; };
  const auto normal = [&m] { return m.normal; };
  const Vec3<Real> tangent = unit_or(m.tangent, normal);
  const Vec3<Real> bitangent = cross(m.normal, tangent) * m.handedness;
  const Vec3<Real> n = unit_or(Vec3<Real>{coded(m.code.x) * m.scale, coded(m.code.y) * m.scale, coded(m.code.z)}, up);
  return unit_or(tangent * n.x + bitangent * n.y + m.normal * n.z, normal) * m.side;
}

}  // namespace sheen::golden
