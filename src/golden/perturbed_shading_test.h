#pragma once

#include <cstddef>

#include "brdf/math.h"
#include "golden/albedo_reader.h"
#include "number/lanes.h"
#include "number/perturbed_test.h"

// Shading on number::test::Perturbed: a shader each of whose operations is off by what GLSL ES grants it. E is read without an error.

namespace sheen::number {

template <class Precision>
struct Lanes<test::Perturbed<Precision>> {
  static constexpr std::size_t count = 1;
  static test::Perturbed<Precision> load(const double* values) { return test::Perturbed<Precision>(*values); }
};

namespace test {

template <class Precision>
Perturbed<Precision> pow_from_zero(const Perturbed<Precision>& x, const Perturbed<Precision>& y) {
  if (x.value() > 0 && x.value() < smallest_normal<Precision>) {
    // Of a driver that finds it greater than 0 in a wider format, and raises it there.
    using Wider = Perturbed<Highp>;
    return Perturbed<Precision>::rounded(pow(Wider::held(x.value()), Wider::held(y.value())).value());
  }
  return x.value() > 0 ? pow(x, y) : Perturbed<Precision>::held(0);
}
template <class To, class From>
Perturbed<To> converted_to(const Perturbed<From>& x, const Perturbed<To>*) {
  return Perturbed<To>(x.value());
}

}  // namespace test
}  // namespace sheen::number

namespace sheen::brdf {

template <>
struct Exponents<number::test::Perturbed<number::Mediump>> {
  using Type = number::test::Perturbed<number::Highp>;
  static Type widened(const number::test::Perturbed<number::Mediump>& x) { return Type::held(x.value()); }
  static number::test::Perturbed<number::Mediump> narrowed(const Type& x) { return number::test::Perturbed<number::Mediump>(x.value()); }
};

}  // namespace sheen::brdf

namespace sheen::golden {

template <class Precision>
struct AlbedoReader<number::test::Perturbed<Precision>> {
  using P = number::test::Perturbed<Precision>;
  struct Sheen {
    Sheen(const SheenAlbedo& albedo, const P& roughness) : interpolant(*albedo.interpolant), at(roughness.value()) {}
    P operator()(const P& cosine) const { return P(interpolant(cosine.value(), at)); }

    const albedo::Interpolant& interpolant;
    double at;
  };
  template <class Read>
  static P for_light(const P&, const P&, const P&, const Read& read) {
    return read();
  }
  struct Ggx {
    Ggx(const BaseAlbedo&, const P&) {}
    brdf::LobeAlbedo<P> operator()(const P&) const { return {}; }
    brdf::LobeAlbedo<P> average() const { return {}; }
  };
};

}  // namespace sheen::golden
