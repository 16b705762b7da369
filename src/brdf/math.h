#pragma once

#include <algorithm>
#include <cmath>

namespace sheen::brdf {

// What a formula may call. For double these are the standard ones; another number type brings its own, found by argument-dependent lookup.
using std::abs;
using std::exp;
using std::log;
using std::log1p;
using std::max;
using std::min;
using std::pow;
using std::sqrt;

/// a where the condition holds, else b: formulas choose by value, not by jump, so that a batch can choose lane by lane.
inline double select(bool condition, double a, double b) {
  return condition ? a : b;
}
inline float select(bool condition, float a, float b) {
  return condition ? a : b;
}
inline long double select(bool condition, long double a, long double b) {
  return condition ? a : b;
}

/// The number type in which a formula takes exponents and logarithms that a shader of low precision keeps in high precision; its own,
/// unless specialised, and the ways there and back.
template <class Real>
struct Exponents {
  using Type = Real;
  static const Real& widened(const Real& x) { return x; }
  static const Real& narrowed(const Type& x) { return x; }
};

/// Whether a condition may hold: in any lane of a batch, for anything that an uncertain value may be.
inline bool any(bool condition) {
  return condition;
}

/// select() of what two functions give: a single value needs but one of them.
template <class A, class B>
auto select_of(bool condition, const A& a, const B& b) {
  return condition ? a() : b();
}
template <class Condition, class A, class B>
auto select_of(const Condition& condition, const A& a, const B& b) {
  return select(condition, a(), b());
}

/// x (1 - t) + y t of two constants. A number type may bring its own, which knows that it is one t.
template <class Real>
Real mix(double x, double y, const Real& t) {
  return Real(x) * (Real(1) - t) + Real(y) * t;
}

/// x^y for y > 0 and x >= 0, which is 0 at x = 0. Apart from pow, since GLSL derives pow from log2 and promises nothing at 0: shaders
/// branch there, and a number type that knows of it brings its own.
template <class Real>
Real pow_from_zero(const Real& x, const Real& y) {
  return pow(x, y);
}

/// 1 / sqrt(x), x > 0. A number type may bring its own, as GLSL has a function for it.
template <class Real>
Real inversesqrt(const Real& x) {
  return Real(1) / sqrt(x);
}

template <class Real>
Real square(const Real& x) {
  return x * x;
}

inline constexpr double pi = 3.14159265358979323846;

/// A linear colour, or a factor a colour channel.
template <class Real>
struct Rgb {
  Real r, g, b;

  friend Rgb operator+(const Rgb& x, const Rgb& y) { return {x.r + y.r, x.g + y.g, x.b + y.b}; }
  friend Rgb operator*(const Rgb& x, const Rgb& y) { return {x.r * y.r, x.g * y.g, x.b * y.b}; }
  friend Rgb operator*(const Rgb& x, const Real& s) { return {x.r * s, x.g * s, x.b * s}; }
};

/// The largest channel (KHR_materials_sheen, "Albedo-scaling technique").
template <class Real>
Real max3(const Rgb<Real>& c) {
  return max(max(c.r, c.g), c.b);
}

}  // namespace sheen::brdf
