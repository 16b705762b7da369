#pragma once

#include <algorithm>
#include <cmath>

#include "albedo/ggx_table.h"
#include "albedo/lookup_error.h"
#include "golden/albedo_reader.h"
#include "golden/bound_all.h"
#include "golden/shade.h"
#include "number/bounded_conversion.h"

namespace sheen::golden {

/// Tabulated albedos on number::Bounded: value and slope at the centre, all that the arguments' ranges reach, and what a shader that reads
/// a table in highp is off. The albedos have no bend that matters over ranges as small as those of a rounding or of a sub-pixel step: what
/// is left of the slope is taken at the ranges' ends, each of which with each of the other's and with its centre.
template <class Precision>
struct AlbedoReader<number::Bounded<Precision>> {
  using B = number::Bounded<Precision>;

  static B sheen(const SheenAlbedo& albedo, const B& cosine, const B& sheen_roughness) {
    const auto error = [](double value, double c, double r) { return albedo::lookup_error(value, c, r); };
    if (albedo.around != nullptr) {
      const auto curve = [&around = *albedo.around](double c, End roughness) {
        return (roughness == End::Center ? around.center : roughness == End::Lower ? around.lower : around.upper)(c);
      };
      return read(curve, error, cosine, sheen_roughness);
    }
    if (!cosine.is_bounded() || !sheen_roughness.is_bounded() || sheen_roughness.is_exact()) {
      return read(at_ends(*albedo.interpolant, sheen_roughness), error, cosine, sheen_roughness);
    }
    const auto three = [](const B& x) { return albedo::Interpolant::Triple{x.range().lower, x.center(), x.range().upper}; };
    const auto grid = albedo.interpolant->grid(three(cosine), three(sheen_roughness));
    const auto curve = [&](double c, End roughness) {
      const std::size_t column = c == cosine.center() ? 1 : c == cosine.range().lower ? 0 : 2;
      return grid.at(roughness == End::Center ? 1 : roughness == End::Lower ? 0 : 2).at(column);
    };
    return read(curve, error, cosine, sheen_roughness);
  }

  template <class Read>
  static B for_light(const B& e_v, const B& n_dot_l, const B& n_dot_v, const Read& read) {
    const bool smaller = n_dot_v.is_bounded() && n_dot_l.is_bounded() && n_dot_v.range().lower >= decreasing_from &&
                         n_dot_l.range().lower >= n_dot_v.range().upper;
    return smaller ? e_v : read();
  }

  static brdf::LobeAlbedo<B> ggx(const albedo::GgxInterpolant& ggx, const B& cosine, const B& alpha) {
    return lobe([&ggx](double c, double a) { return ggx(c, a); }, cosine, alpha);
  }
  static brdf::LobeAlbedo<B> ggx_average(const albedo::GgxInterpolant& ggx, const B& alpha) {
    return lobe([&ggx](double, double a) { return ggx.average(a); }, B(1), alpha);
  }

 private:
  enum class End { Lower, Center, Upper };

  /// f(x, y) with y given as the end of a range.
  template <class Function>
  static auto at_ends(const Function& f, const B& y) {
    return [&f, &y](double x, End end) {
      return f(x, end == End::Center ? y.center() : end == End::Lower ? y.range().lower : y.range().upper);
    };
  }

  template <class Function, class Error>
  static B read(const Function& f, const Error& error, const B& x, const B& y) {
    if (!x.is_bounded() || !y.is_bounded()) {
      return B::unbounded(0.0);  // their centres need not be numbers
    }
    const double value = f(x.center(), End::Center);
    const double width = x.range().upper - x.range().lower;
    double lowest = value;
    double highest = value;
    double slope = 0;
    double remainder = 0;
    const auto include = [&](double cosine, double there) {
      lowest = std::min(lowest, there);
      highest = std::max(highest, there);
      remainder = std::max(remainder, std::abs(there - value - slope * (cosine - x.center())));
    };
    const auto include_ends = [&](End end) {
      include(x.range().lower, f(x.range().lower, end));
      if (width > 0) {
        include(x.range().upper, f(x.range().upper, end));
      }
    };
    if (width > 0) {
      const double low = f(x.range().lower, End::Center);
      const double high = f(x.range().upper, End::Center);
      slope = (high - low) / width;
      include(x.range().lower, low);
      include(x.range().upper, high);
    }
    if (!y.is_exact()) {
      include_ends(End::Lower);
      include_ends(End::Upper);
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
    return {read(at_ends(loss, alpha), of_loss, cosine, alpha), read(at_ends(bias, alpha), of_bias, cosine, alpha)};
  }
};

/// The golden's own shading tells it.
template <class Precision>
inline constexpr bool finds_lookup_error<number::Bounded<Precision>> = false;

}  // namespace sheen::golden
