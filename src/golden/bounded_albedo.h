#pragma once

#include <algorithm>
#include <cmath>

#include "albedo/ggx_table.h"
#include "albedo/table.h"
#include "golden/albedo_reader.h"
#include "golden/shade.h"
#include "number/bounded_conversion.h"

namespace sheen::golden {

/// Tabulated albedos on number::Bounded: value and slope at the centre, all that the arguments' ranges reach, and what a shader that reads
/// a table in highp is off. The albedos have no bend that matters over ranges as small as those of a rounding or of a sub-pixel step: what
/// is left of the slope is taken at the ranges' ends, each of which with each of the other's.
template <class Precision>
struct AlbedoReader<number::Bounded<Precision>> {
  using B = number::Bounded<Precision>;

  static B sheen(const albedo::Interpolant* albedo, const albedo::Curve*, const B& cosine, const B& sheen_roughness) {
    const auto e = [albedo](double c, double r) { return (*albedo)(c, r); };
    const auto error = [](double value, double c, double r) { return albedo::lookup_error(value, c, r); };
    return read(e, error, cosine, sheen_roughness);
  }

  /// E falls with its cosine from 0.008 up, for every visibility and roughness (KHR_materials_sheen leaves that unsaid;
  /// directional_albedo_test holds it).
  static bool is_smaller_for_light(const B& n_dot_l, const B& n_dot_v) {
    return n_dot_v.is_bounded() && n_dot_l.is_bounded() && n_dot_v.range().lower >= 0.008 && n_dot_l.range().lower >= n_dot_v.range().upper;
  }

  static brdf::LobeAlbedo<B> ggx(const albedo::GgxInterpolant& ggx, const B& cosine, const B& alpha) {
    return lobe([&ggx](double c, double a) { return ggx(c, a); }, cosine, alpha);
  }
  static brdf::LobeAlbedo<B> ggx_average(const albedo::GgxInterpolant& ggx, const B& alpha) {
    return lobe([&ggx](double, double a) { return ggx.average(a); }, B(1), alpha);
  }

 private:
  template <class Function, class Error>
  static B read(const Function& f, const Error& error, const B& x, const B& y) {
    if (!x.is_bounded() || !y.is_bounded()) {
      return B::unbounded(f(x.center(), y.center()));
    }
    const double value = f(x.center(), y.center());
    const double width = x.range().upper - x.range().lower;
    double lowest = value;
    double highest = value;
    double slope = 0;
    double remainder = 0;
    if (width > 0) {
      slope = (f(x.range().upper, y.center()) - f(x.range().lower, y.center())) / width;
    }
    const int columns = width > 0 ? 2 : 1;
    const int rows = y.is_exact() ? 1 : 2;
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns && (columns > 1 || rows > 1); ++column) {
        const double cosine = column == 0 ? x.range().lower : x.range().upper;
        const double there = f(cosine, rows == 1 ? y.center() : row == 0 ? y.range().lower : y.range().upper);
        lowest = std::min(lowest, there);
        highest = std::max(highest, there);
        remainder = std::max(remainder, std::abs(there - value - slope * (cosine - x.center())));
      }
    }
    const double off = error(highest, x.center(), y.center());
    return B::rounded({value, slope * x.shift_x(), slope * x.shift_y(), std::abs(slope) * x.radius() + remainder, {lowest, highest}},
                      B::Error::absolute(0, off), true);
  }

  template <class Albedo>
  static brdf::LobeAlbedo<B> lobe(const Albedo& albedo, const B& cosine, const B& alpha) {
    const auto loss = [&albedo](double c, double a) { return albedo(c, a).loss; };
    const auto bias = [&albedo](double c, double a) { return albedo(c, a).bias; };
    // The shader's table holds the logarithms of loss and scale; its bias is what they leave of 1.
    const auto of_loss = [](double value, double, double) { return albedo::ggx_table_error * value; };
    const auto of_bias = [](double, double, double) { return albedo::ggx_table_error; };
    return {read(loss, of_loss, cosine, alpha), read(bias, of_bias, cosine, alpha)};
  }
};

/// The golden's own shading tells it.
template <class Precision>
inline constexpr bool finds_lookup_error<number::Bounded<Precision>> = false;

}  // namespace sheen::golden
