#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <string_view>
#include <type_traits>
#include <vector>

#include "number/batch_operands_test.h"
#include "number/bounded_batch_functions.h"

namespace sheen::number::test {

/// An operation of a type that is eight lanes wide, of number::BoundedBatch and of exact numbers.
template <class Eight>
struct Operation {
  const char* name;
  bool may_lose;  ///< of operands that are close to their centres too
  double ulps;    ///< that a shader may be off, of two numbers that are not exact: 1 of what is rounded correctly, 0 of what is not checked
  std::function<Eight(const Eight&, const Eight&)> eight;
  std::function<BoundedBatch<Highp>(const BoundedBatch<Highp>&, const BoundedBatch<Highp>&)> bounds;
  std::function<double(double, double)> exact;
};

template <class Eight>
std::vector<Operation<Eight>> operations() {
  const auto operation = [](const char* name, bool may_lose, auto f, auto exact) {
    const std::string_view n = name;
    const bool is_rounded = n == "a + b" || n == "a - b" || n == "a b" || n == "a a";
    // GLSL ES 3.00.6, 4.5.1; sqrt is the reciprocal of an inversesqrt.
    const double ulps = is_rounded ? 1 : n == "a / b" ? 2.5 : n == "inversesqrt" ? 2 : n == "sqrt" ? 4.4 : 0;
    return Operation<Eight>{name, may_lose, ulps, f, f, exact};
  };
  const auto constant = [](const auto& like, double value) { return std::remove_cvref_t<decltype(like)>(value); };
  return {
      operation(
          "-a", false, [](const auto& a, const auto&) { return -a; }, [](double a, double) { return -a; }),
      operation(
          "a + b", false, [](const auto& a, const auto& b) { return a + b; }, [](double a, double b) { return a + b; }),
      operation(
          "a - b", false, [](const auto& a, const auto& b) { return a - b; }, [](double a, double b) { return a - b; }),
      operation(
          "a b", false, [](const auto& a, const auto& b) { return a * b; }, [](double a, double b) { return a * b; }),
      operation(
          "a a", false, [](const auto& a, const auto&) { return a * a; }, [](double a, double) { return a * a; }),
      operation(
          "a / b", false, [](const auto& a, const auto& b) { return a / b; }, [](double a, double b) { return a / b; }),
      operation(
          "max", false, [](const auto& a, const auto& b) { return max(a, b); }, [](double a, double b) { return std::max(a, b); }),
      operation(
          "min", false, [](const auto& a, const auto& b) { return min(a, b); }, [](double a, double b) { return std::min(a, b); }),
      operation(
          "abs", false, [](const auto& a, const auto&) { return abs(a); }, [](double a, double) { return std::abs(a); }),
      operation(
          "select <", true, [](const auto& a, const auto& b) { return select(a < b, a, b); },
          [](double a, double b) { return a < b ? a : b; }),
      operation(
          "select >=", true, [](const auto& a, const auto& b) { return select(a >= b, a, b); },
          [](double a, double b) { return a >= b ? a : b; }),
      operation(
          "a constant", false, [constant](const auto& a, const auto&) { return constant(a, 0.1) * a; },
          [](double a, double) { return 0.1 * a; }),
      operation(
          "a power of two", false, [constant](const auto& a, const auto&) { return constant(a, 0.5) * a; },
          [](double a, double) { return 0.5 * a; }),
      operation(
          "nothing", false, [constant](const auto& a, const auto& b) { return constant(a, 0) * a + b; },
          [](double, double b) { return b; }),
      operation(
          "the rest", false, [constant](const auto& a, const auto&) { return constant(a, 1) - a; }, [](double a, double) { return 1 - a; }),
      operation(
          "mix", false, [](const auto& a, const auto&) { return mix(0.3, -2.1, a); },
          [](double a, double) { return 0.3 * (1 - a) - 2.1 * a; }),
      operation(
          "inversesqrt", true, [](const auto& a, const auto&) { return inversesqrt(a); },
          [](double a, double) { return 1 / std::sqrt(a); }),
      operation(
          "sqrt", true, [](const auto& a, const auto&) { return sqrt(a); }, [](double a, double) { return std::sqrt(a); }),
      operation(
          "exp", true, [](const auto& a, const auto&) { return exp(a); }, [](double a, double) { return std::exp(a); }),
      operation(
          "log", true, [](const auto& a, const auto&) { return log(a); }, [](double a, double) { return std::log(a); }),
      operation(
          "log1p", true, [](const auto& a, const auto&) { return log1p(-a); }, [](double a, double) { return std::log1p(-a); }),
      operation(
          "pow", true, [](const auto& a, const auto& b) { return pow(a, b); }, [](double a, double b) { return std::pow(a, b); }),
      operation(
          "pow_from_zero", true, [](const auto& a, const auto& b) { return pow_from_zero(a, b); },
          [](double a, double b) { return std::pow(std::max(a, 0.0), b); }),
  };
}

/// Eight operands of every kind, as two batches.
struct Operands {
  BoundedBatch<Highp> halves[2];

  template <class Random>
  explicit Operands(Random& random) {
    for (BoundedBatch<Highp>& half : halves) {
      half = BoundedBatch<Highp>(0.0);
      for (std::size_t lane = 0; lane < Batch::size; ++lane) half.set_lane(lane, operand<Highp>(random));
    }
  }
  template <class Eight>
  Eight as() const {
    return Eight(halves[0], halves[1]);
  }
};

inline bool is_close(const One<Highp>& x) {
  return x.is_bounded() && x.deviation() <= 1e-3 * std::abs(x.center()) && std::abs(x.center()) > 1e-30 && std::abs(x.center()) < 1e30;
}

}  // namespace sheen::number::test
