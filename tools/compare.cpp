#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iostream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "conformance/json_text.h"
#include "image/io.h"
#include "image/metrics.h"
#include "tools/errors.h"
#include "tools/files.h"
#include "tools/options.h"
#include "tools/tolerance.h"

namespace sheen::tools {
namespace {

/// What white stands for in the heat map: all but the worst hundredth of the values keep their shades apart.
double heatmap_scale(const image::Comparison& figures) {
  if (figures.p99_rel > 0.0) {
    return figures.p99_rel;
  }
  return figures.max_rel > 0.0 ? figures.max_rel : 1.0;
}

}  // namespace

int compare(const CompareOptions& options) {
  if (!options.heatmap.empty()) {
    require_writable(options.heatmap, {".png", ".exr", ".hdr", ".pfm"});
  }
  const image::Image candidate = image::read(options.candidate);
  const image::Image reference = image::read(options.reference);
  if (candidate.width != reference.width || candidate.height != reference.height) {
    throw InputError(fmt::format("{}: size: {} x {} cannot be compared with {} x {} of {}", options.candidate.string(), candidate.width,
                                 candidate.height, reference.width, reference.height, options.reference.string()));
  }
  const image::Comparison figures = image::compare(candidate, reference);
  nlohmann::ordered_json report{{"max_abs", figures.max_abs},
                                {"mean_abs", figures.mean_abs},
                                {"p99_abs", figures.p99_abs},
                                {"max_rel", figures.max_rel},
                                {"mean_rel", figures.mean_rel},
                                {"p99_rel", figures.p99_rel},
                                {"psnr", figures.psnr},
                                {"flip", figures.flip},
                                {"nonfinite_pixels", figures.nonfinite_pixels},
                                {"compared_pixels", figures.compared_pixels},
                                {"worst_pixel", {figures.worst_x, figures.worst_y}}};
  if (!options.heatmap.empty()) {
    const double scale = heatmap_scale(figures);
    image::write(options.heatmap, image::heatmap(candidate, reference, scale));
    report["heatmap"] = options.heatmap.string();
    report["heatmap_full_scale"] = scale;
  }
  bool within = true;
  if (options.tolerance) {
    const std::int64_t outside = values_outside(candidate, reference, *options.tolerance);
    within = outside == 0;
    report["values_outside_tolerance"] = outside;
    report["within_tolerance"] = within;
  }
  if (options.json) {
    std::cout << conformance::json_text(report, 2) << '\n';
  } else {
    for (const auto& [name, value] : report.items()) {
      fmt::print("{:<24} {}\n", name, value.is_null() ? "inf" : conformance::json_text(value));
    }
  }
  return within ? done : failed;
}

}  // namespace sheen::tools
