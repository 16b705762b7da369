#pragma once

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "conformance/function_spec.h"
#include "golden/vec3.h"
#include "number/bounded_conversion.h"

// What the lists of functions are written with.

namespace sheen::conformance {

template <class P>
NumberFormat format_of() {
  return {P::fraction_bits, P::min_exponent};
}

/// A promise of what `form` may give about its own exact value, which stands for `model`.
template <class P>
Promise promised(const number::Bounded<P>& form, double model) {
  return {form.center(), form.range(), model};
}
template <class P>
std::vector<Promise> promises(const number::Bounded<P>& form) {
  return {promised(form, form.center())};
}

/// Reads a function's arguments one after another as exact values of a precision.
template <class P>
class Reader {
 public:
  explicit Reader(const std::vector<double>& arguments) : arguments_(arguments) {}

  number::Bounded<P> scalar() { return number::Bounded<P>(arguments_.at(next_++)); }
  golden::Vec3<number::Bounded<P>> vector() {
    const auto x = scalar();
    const auto y = scalar();
    return {x, y, scalar()};
  }

 private:
  const std::vector<double>& arguments_;
  std::size_t next_ = 0;
};

/// Numbers one after another: vectors give three.
class Numbers {
 public:
  Numbers& operator<<(double x) {
    numbers_.push_back(x);
    return *this;
  }
  Numbers& operator<<(const glm::dvec3& v) { return *this << v.x << v.y << v.z; }
  operator std::vector<double>() const { return numbers_; }  // NOLINT(google-explicit-constructor): it is one

 private:
  std::vector<double> numbers_;
};

/// A unit vector that a turn of 0 leaves along z.
inline glm::dvec3 tilted_axis(double turn) {
  const double from_z = 0.17 * turn;
  const double about_z = 2.3 * turn;
  return {std::sin(from_z) * std::cos(about_z), std::sin(from_z) * std::sin(about_z), std::cos(from_z)};
}

/// A unit vector at an angle from the axis, at an azimuth about it.
inline glm::dvec3 at_angle(const glm::dvec3& axis, double angle, double azimuth) {
  const glm::dvec3 aside = std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 t = glm::normalize(aside - axis * glm::dot(axis, aside));
  const glm::dvec3 b = glm::cross(axis, t);
  return axis * std::cos(angle) + (t * std::cos(azimuth) + b * std::sin(azimuth)) * std::sin(angle);
}

}  // namespace sheen::conformance
