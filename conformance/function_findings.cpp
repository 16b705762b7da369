#include "conformance/function_findings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "image/io.h"

namespace sheen::conformance {
namespace {

constexpr int bins = 48;
constexpr double panel_width = 210;
constexpr double panel_height = 96;
constexpr double panel_step = 236;
constexpr double row_step = 122;
constexpr double left_margin = 44;
constexpr std::size_t panels_a_row = 4;

/// Of all samples that fall in a bin of a parameter's axis, the one with the largest error, or the one furthest outside its bound if any
/// is; in units of the plot.
struct Bin {
  bool filled = false;
  double ratio = 0, error = 0, bound = 0;

  bool is_worse_than(const Bin& other) const { return std::max(ratio, other.ratio) > 1 ? ratio > other.ratio : error > other.error; }
};

std::array<Bin, bins> fill_bins(const FunctionSamples& samples, const std::vector<SampleError>& errors, std::size_t parameter) {
  std::array<Bin, bins> filled{};
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const SampleError& one = errors[i];
    if (!one.compared || !std::isfinite(one.ratio)) {
      continue;
    }
    const double share = samples.spec.parameters[parameter].share(samples.values[i][parameter]);
    Bin& bin = filled.at(static_cast<std::size_t>(std::min(static_cast<int>(share * bins), bins - 1)));
    const Bin sample{true, one.ratio, in_plot_units(samples.spec, one.value, one.error), in_plot_units(samples.spec, one.value, one.bound)};
    if (!bin.filled || sample.is_worse_than(bin)) {
      bin = sample;
    }
  }
  return filled;
}

std::string text_of(const char* format, double a, double b = 0) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, a, b);
  return text.data();
}

/// A logarithmic axis of whole decades that holds every bound and the errors down to a millionth of the largest.
struct Decades {
  double low, high;

  explicit Decades(const std::vector<std::array<Bin, bins>>& panels) {
    double largest = 1e-30;
    double smallest = 1e30;
    for (const auto& panel : panels) {
      for (const Bin& bin : panel) {
        largest = std::max({largest, bin.error, bin.bound});
        smallest = bin.error > 0 ? std::min(smallest, bin.error) : smallest;
      }
    }
    high = std::ceil(std::log10(largest));
    low = std::max(std::floor(std::log10(std::min(smallest, largest))), high - 8);
    low = std::min(low, high - 1);
  }
  double y(double value) const {
    const double share = value > 0 ? (std::log10(value) - low) / (high - low) : 0;
    return panel_height * (1 - std::clamp(share, 0.0, 1.0));
  }
};

std::string polyline(const std::array<Bin, bins>& panel, const Decades& decades, double Bin::*member, const char* style) {
  std::string points;
  for (std::size_t i = 0; i < bins; ++i) {
    if (panel.at(i).filled) {
      points += text_of("%.1f,%.1f ", panel_width * (static_cast<double>(i) + 0.5) / bins, decades.y(panel.at(i).*member));
    }
  }
  return std::string("<polyline class=") + style + " points=\"" + points + "\"/>";
}

/// The decades' ends and the unit, left of a row of panels.
std::string scale_svg(const Decades& decades, const char* unit, double y) {
  const auto text = [](double at, const std::string& words) {
    return "<text x=\"40\" y=\"" + text_of("%.0f", at) + "\" text-anchor=end>" + words + "</text>";
  };
  return text(y + 12, "1e" + text_of("%.0f", decades.high)) + text(y + 57, unit) + text(y + 102, "1e" + text_of("%.0f", decades.low));
}

std::string panel_svg(const Parameter& parameter, const std::array<Bin, bins>& panel, const Decades& decades, double x, double y) {
  std::string svg = "<g transform=\"translate(" + text_of("%.0f,%.0f", x, y) + ")\">";
  svg += "<rect width=\"" + text_of("%.0f\" height=\"%.0f", panel_width, panel_height) + "\"/>";
  svg += polyline(panel, decades, &Bin::bound, "bound") + polyline(panel, decades, &Bin::error, "error");
  svg += "<text y=\"110\">" + parameter.low + "</text><text y=\"110\" text-anchor=middle x=\"105\">" + parameter.name +
         "</text><text y=\"110\" text-anchor=end x=\"210\">" + parameter.high + "</text></g>";
  return svg;
}

std::string draw_plots(const FunctionSamples& samples, const std::vector<SampleError>& errors) {
  std::vector<std::size_t> shown;
  std::vector<std::array<Bin, bins>> panels;
  for (std::size_t k = 0; k < samples.spec.parameters.size(); ++k) {
    const auto differs = [&](const std::vector<double>& values) { return values[k] != samples.values.front()[k]; };
    // A parameter that only takes what lies beyond 1 has no axis.
    if (samples.spec.parameters[k].at(0) != samples.spec.parameters[k].at(1) &&
        std::any_of(samples.values.begin(), samples.values.end(), differs)) {
      shown.push_back(k);
      panels.push_back(fill_bins(samples, errors, k));
    }
  }
  const Decades decades(panels);
  const std::size_t columns = std::min(shown.size(), panels_a_row);
  const double width = left_margin + panel_step * static_cast<double>(columns);
  const double height = row_step * std::ceil(static_cast<double>(shown.size()) / static_cast<double>(panels_a_row));
  std::string svg =
      "<svg class=plots viewBox=\"0 0 " + text_of("%.0f %.0f", width, height) + "\" style=\"max-width:" + text_of("%.0f", width) + "px\">";
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const double x = left_margin + panel_step * static_cast<double>(i % panels_a_row);
    const std::size_t row = i / panels_a_row;
    const double y = row_step * static_cast<double>(row);
    if (i % panels_a_row == 0) {
      svg += scale_svg(decades, samples.spec.is_operation ? "ulp" : "rel", y);
    }
    svg += panel_svg(samples.spec.parameters[shown[i]], panels[i], decades, x, y + 6);
  }
  return svg + "</svg>";
}

/// Codes of 8 bits: dark blue at an error of 1e-7 over green at 1e-4 to yellow at 1e-1 and above; magenta for NaN, white for Inf.
std::array<std::uint16_t, 3> map_color(const SampleError& one) {
  if (one.nan) {
    return {224, 32, 192};
  }
  if (one.infinite) {
    return {255, 255, 255};
  }
  const double heat = one.off_model > 0 ? std::clamp((std::log10(one.off_model) + 7) / 6, 0.0, 1.0) : 0;
  const auto code = [](double x) { return static_cast<std::uint16_t>(std::lround(255 * std::clamp(x, 0.0, 1.0))); };
  return {code(2 * heat - 1), code(0.12 + 0.8 * heat), code(0.42 - 0.3 * heat)};
}

std::vector<std::uint8_t> draw_map(const FunctionCase& one, const std::vector<SampleError>& errors) {
  std::vector<std::uint16_t> codes;
  for (const SampleError& sample : errors) {
    const auto color = map_color(sample);
    codes.insert(codes.end(), color.begin(), color.end());
  }
  return image::encode_png_codes(one.width, one.height, 3, 8, codes);
}

}  // namespace

FunctionFindings find(const FunctionCase& one, const FunctionSamples& samples, const std::vector<SampleError>& errors) {
  FunctionFindings findings;
  findings.tested = one;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    findings.nan_samples += errors[i].nan ? 1 : 0;
    findings.infinite_samples += !errors[i].nan && errors[i].infinite ? 1 : 0;
    if (errors[i].off_model > findings.largest_error) {
      findings.largest_error = errors[i].off_model;
      findings.largest_at = describe_sample(samples, i);
    }
  }
  findings.plots = draw_plots(samples, errors);
  findings.legend = std::string("the largest error (green) at each place and the bound (red) of the same sample, ") +
                    (samples.spec.is_operation ? "in ulp" : "relative to max(|value|, 1e-3)");
  if (one.arguments == ArgumentSet::Dense && samples.spec.parameters.size() > 1) {
    findings.map = draw_map(one, errors);
    findings.map_axes = samples.spec.parameters[1].name + " over " + samples.spec.parameters[0].name;
  }
  return findings;
}

}  // namespace sheen::conformance
