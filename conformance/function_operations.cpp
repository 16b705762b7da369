#include <cmath>

#include "conformance/function_forms.h"
#include "conformance/function_vectors.h"

// The operations of GLSL that the bounds stand on, each held to its own rule (number/precision.h).

namespace sheen::conformance {
namespace {

using number::Bounded;
using Values = std::vector<double>;

/// Ends of the ranges over which operands are tried: beyond them lie overflow and underflow, where nothing is promised.
struct Ends {
  double exp_low, exp_high, smallest, largest, product_smallest, product_largest;
};

template <class P>
Ends ends() {
  const double ln2 = std::log(2.0);
  const double lowest = P::min_exponent;
  const double highest = P::max_exponent;
  return {(lowest + 1) * ln2,
          highest * ln2,
          number::smallest_normal<P>,
          std::ldexp(1.0, P::max_exponent),
          std::exp2(std::ceil(lowest / 2)),
          std::exp2(std::floor(highest / 2))};
}

/// Powers of two, their neighbours, and the ends of the interval in which logarithms have an absolute error.
Values special_magnitudes(const NumberFormat& format) {
  const double up = format.ulp_above_1();
  const double down = format.ulp_below_1();
  return {1, 1 + up, 1 - down, 0.5,  0.5 * (1 - down),        0.5 * (1 + up), 2, 2 * (1 + up), 2 * (1 - down),
          4, 3,      1.5,      0.75, format.smallest_normal()};
}

Values with_signs(Values values) {
  const std::size_t count = values.size();
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(-values[i]);
  }
  return values;
}

template <class P, class Function>
FunctionSpec unary(const char* name, Parameter x, Function f) {
  return {name,
          format_of<P>(),
          {std::move(x)},
          [](const Values& v) { return v; },
          1,
          false,
          [f](const Values& a, renderer::Formulation) { return promises(f(Bounded<P>(a[0]))); }};
}

template <class P, class Function>
FunctionSpec binary(const char* name, Parameter x, Parameter y, Function f) {
  return {name,
          format_of<P>(),
          {std::move(x), std::move(y)},
          [](const Values& v) { return v; },
          1,
          false,
          [f](const Values& a, renderer::Formulation) { return promises(f(Bounded<P>(a[0]), Bounded<P>(a[1]))); }};
}

template <class P>
void add_scalar(std::vector<FunctionSpec>& all) {
  using B = Bounded<P>;
  const NumberFormat format = format_of<P>();
  const Ends e = ends<P>();
  const Values special = special_magnitudes(format);
  const Values exponents = with_signs({0, format.smallest_normal(), 1e-3, 0.25, 0.5, 1, 1.5, 2, e.exp_high, e.exp_low});
  const auto magnitude = [&](const char* name) { return magnitude_parameter(name, e.smallest, e.largest, false, special); };
  all.push_back(unary<P>("exp", operand_parameter("x", e.exp_low, e.exp_high, exponents), [](const B& x) { return exp(x); }));
  all.push_back(
      unary<P>("exp2", operand_parameter("x", P::min_exponent + 1, P::max_exponent, exponents), [](const B& x) { return exp2(x); }));
  all.push_back(unary<P>("log", magnitude("x"), [](const B& x) { return log(x); }));
  all.push_back(unary<P>("log2", magnitude("x"), [](const B& x) { return log2(x); }));
  all.push_back(unary<P>("sqrt", magnitude("x"), [](const B& x) { return sqrt(x); }));
  all.push_back(unary<P>("inversesqrt", magnitude("x"), [](const B& x) { return inversesqrt(x); }));

  Values signed_special = with_signs(special);
  signed_special.push_back(0);
  const auto factor = [&](const char* name) {
    return magnitude_parameter(name, e.product_smallest, e.product_largest, true, signed_special);
  };
  all.push_back(binary<P>("add", factor("x"), factor("y"), [](const B& x, const B& y) { return x + y; }));
  all.push_back(binary<P>("multiply", factor("x"), factor("y"), [](const B& x, const B& y) { return x * y; }));
  all.push_back(binary<P>("divide", factor("x"), factor("y"), [](const B& x, const B& y) { return x / y; }));
  all.push_back(binary<P>("pow", magnitude_parameter("x", e.product_smallest, 4, false, special),
                          magnitude_parameter("y", std::exp2(-6), std::exp2(10), true, signed_special),
                          [](const B& x, const B& y) { return pow(x, y); }));
  all.push_back({"mix",
                 format,
                 {factor("x"), factor("y"), cosine_parameter("a", format)},
                 [](const Values& v) { return v; },
                 1,
                 false,
                 [](const Values& a, renderer::Formulation) { return promises(forms::mix(B(a[0]), B(a[1]), B(a[2]))); }});
}

template <class P>
void add_geometric(std::vector<FunctionSpec>& all) {
  using B = Bounded<P>;
  const NumberFormat format = format_of<P>();
  const Parameter length = magnitude_parameter("length", std::exp2(-5), std::exp2(5), false, {1, 0.25, 3});
  const std::vector<Parameter> two{angle_parameter("angle"), turn_parameter("turn"), length};
  const auto place = [](const Values& v) -> Values {
    const glm::dvec3 axis = tilted_axis(v[1]);
    return Numbers() << axis << at_angle(axis, v[0], v[1]) * v[2];
  };
  all.push_back({"dot", format, two, place, 1, false, [](const Values& a, renderer::Formulation) {
                   Reader<P> in(a);
                   const auto x = in.vector();
                   return promises(forms::dot_in_any_order(x, in.vector()));
                 }});
  all.push_back({"cross", format, two, place, 3, false, [](const Values& a, renderer::Formulation) {
                   Reader<P> in(a);
                   const auto x = in.vector();
                   const auto c = cross(x, in.vector());
                   return std::vector<Promise>{promised(c.x, c.x.center()), promised(c.y, c.y.center()), promised(c.z, c.z.center())};
                 }});
  all.push_back({"normalize",
                 format,
                 {length, turn_parameter("turn"), angle_parameter("angle")},
                 [](const Values& v) -> Values { return Numbers() << at_angle(tilted_axis(v[1]), v[2], v[1]) * v[0]; },
                 3,
                 false,
                 // GLSL ES 3.00.6, section 8.4: x / length(x), length(x) = sqrt of the sum of squares.
                 [](const Values& a, renderer::Formulation) {
                   const auto v = Reader<P>(a).vector();
                   const B size = sqrt(forms::squared_length(v));
                   const auto one = [&size](const B& x) { return promised(x / size, (x / size).center()); };
                   return std::vector<Promise>{one(v.x), one(v.y), one(v.z)};
                 }});
}

}  // namespace

void add_operation_specs(renderer::Precision precision, std::vector<FunctionSpec>& all) {
  const std::size_t first = all.size();
  if (precision == renderer::Precision::Highp) {
    add_scalar<number::Highp>(all);
    add_geometric<number::Highp>(all);
  } else {
    add_scalar<number::Mediump>(all);
    add_geometric<number::Mediump>(all);
  }
  for (std::size_t i = first; i < all.size(); ++i) {
    all[i].is_operation = true;
  }
}

}  // namespace sheen::conformance
