#pragma once

#include <glm/vec3.hpp>

#include "brdf/math.h"

namespace sheen::golden {

/// A direction or point of any number type; glm's vectors take arithmetic types alone.
template <class Real>
struct Vec3 {
  Real x, y, z;

  friend Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator*(const Vec3& a, const Real& s) { return {a.x * s, a.y * s, a.z * s}; }
};

template <class Real>
Real dot(const Vec3<Real>& a, const Vec3<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Real>
Vec3<Real> cross(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A colour as glm has it.
inline glm::dvec3 dvec3(const brdf::Rgb<double>& c) {
  return {c.r, c.g, c.b};
}

/// The same point with every lane equal.
template <class Real>
Vec3<Real> broadcast(const glm::dvec3& v) {
  return {Real(v.x), Real(v.y), Real(v.z)};
}

}  // namespace sheen::golden
