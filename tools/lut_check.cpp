#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "albedo/table_check.h"
#include "conformance/json_text.h"
#include "tools/errors.h"
#include "tools/options.h"
#include "tools/table_file.h"
#include "tools/words.h"

namespace sheen::tools {
namespace {

using albedo::TableAxis;
using albedo::TableCheck;
using albedo::TableEncoding;
using albedo::TableForm;
using albedo::TableReading;
using albedo::TableTexels;
using nlohmann::ordered_json;

/// A whole number where it is one, so that a shift of 1 is not printed as 1.0.
ordered_json number(double value) {
  return value == std::round(value) ? ordered_json(static_cast<int>(value)) : ordered_json(value);
}

const char* holds(const TableReading& reading) {
  if (reading.form == TableForm::WarpedTimesRoughness) {
    return "E * r";
  }
  return reading.clamped ? "min(E, 1)" : "E";
}

ordered_json to_json(const TableReading& reading) {
  ordered_json flipped = ordered_json::array();
  if (reading.n_dot_v_flipped) {
    flipped.push_back("n_dot_v");
  }
  if (reading.roughness_flipped) {
    flipped.push_back("roughness");
  }
  return {{"visibility", word_of(visibility_words, reading.visibility)},
          {"axis", reading.axis == TableAxis::Alpha ? "alpha" : "roughness"},
          {"texels", reading.texels == TableTexels::Edge ? "edge" : "centre"},
          {"row_shift", number(reading.row_shift)},
          {"column_shift", number(reading.column_shift)},
          {"transposed", reading.transposed},
          {"flipped", flipped},
          {"clamped", reading.clamped},
          {"layout", reading.form == TableForm::Plain ? "plain" : "warped"},
          {"holds", holds(reading)}};
}

ordered_json to_json(const LutOptions& options, const image::Image& image, const TableCheck& check) {
  ordered_json report{{"file", options.check.string()}, {"width", image.width}, {"height", image.height}};
  if (!check.reading) {
    for (const char* field : {"visibility", "axis", "texels", "row_shift", "transposed", "flipped", "channel", "max_error"}) {
      report[field] = nullptr;
    }
    report["message"] = check.why;
    report["misfit"] = check.misfit;
    return report;
  }
  report.update(to_json(*check.reading));
  report["channel"] = check.channels.front();
  report["equal_channels"] = std::vector<std::string>(check.channels.begin() + 1, check.channels.end());
  report["encoding"] = check.encoding == TableEncoding::Srgb ? "srgb" : "linear";
  report["max_error"] = check.max_error;
  report["max_error_at"] = {{"column", check.worst_column},   {"row", check.worst_row},
                            {"n_dot_v", check.worst.n_dot_v}, {"sheen_roughness", check.worst.sheen_roughness},
                            {"value", check.worst_value},     {"truth", check.worst_truth}};
  report["max_relative_error"] = check.max_relative_error;
  report["rms_error"] = check.rms_error;
  report["max_error_read_as_it_stands"] = check.as_is_error;
  report["compared_texels"] = check.compared;
  report["left_out_texels"] = check.left_out;
  report["nonfinite_texels"] = check.nonfinite;
  report["misfit"] = check.misfit;
  report["margin"] = check.margin;
  report["runner_up"] = check.runner_up ? to_json(*check.runner_up) : ordered_json(nullptr);
  report["undecided"] = check.undecided;
  return report;
}

/// The reading in words, without what it holds of which visibility.
std::string layout_in_words(const TableReading& reading) {
  std::string text = reading.axis == TableAxis::Alpha ? "alpha = roughness^2" : "roughness";
  if (reading.form != TableForm::Plain) {
    text += ", the warped layout";
  }
  text += reading.texels == TableTexels::Edge ? ", corner-aligned nodes" : ", texel centres";
  if (reading.transposed) {
    text += ", transposed (N.V runs down the columns)";
  }
  if (reading.n_dot_v_flipped) {
    text += ", N.V flipped (falling)";
  }
  if (reading.roughness_flipped) {
    text += ", roughness flipped (falling)";
  }
  if (reading.row_shift != 0) {
    text += fmt::format(", rows {} texel{} too {}", std::abs(reading.row_shift), std::abs(reading.row_shift) == 1 ? "" : "s",
                        reading.row_shift > 0 ? "rough" : "smooth");
  }
  if (reading.column_shift != 0) {
    text += fmt::format(", columns {} texels too {}", std::abs(reading.column_shift), reading.column_shift > 0 ? "frontal" : "grazing");
  }
  return text;
}

std::string in_words(const TableReading& reading) {
  return fmt::format("{} of {} over N.V and {}", holds(reading), word_of(visibility_words, reading.visibility), layout_in_words(reading));
}

void print(const LutOptions& options, const image::Image& image, const TableCheck& check) {
  if (!check.reading) {
    fmt::print("{}: not known as a table of directional albedo: {}\n", options.check.string(), check.why);
    return;
  }
  fmt::print("{}: {} x {}, channel {}{}\n  {}\n", options.check.string(), image.width, image.height, check.channels.front(),
             check.encoding == TableEncoding::Srgb ? " (sRGB codes)" : "", in_words(*check.reading));
  fmt::print("  largest error {:.3g} at column {}, row {} (N.V {:.4g}, roughness {:.4g}): {:.6g} for {:.6g}; rms {:.3g}\n", check.max_error,
             check.worst_column, check.worst_row, check.worst.n_dot_v, check.worst.sheen_roughness, check.worst_value, check.worst_truth,
             check.rms_error);
  fmt::print("  read as it stands, texel centres of (N.V, roughness), it is off by up to {:.3g}\n", check.as_is_error);
  if (check.runner_up) {
    fmt::print("  next best, fitting {:.3g} times worse: {}\n", check.margin, in_words(*check.runner_up));
  }
  for (const std::string& field : check.undecided) {
    fmt::print("  {}: other values fit as well\n", field);
  }
}

}  // namespace

int lut_check(const LutOptions& options) {
  const TableFile table = read_table(options.check);
  const TableCheck check = albedo::check_table(table.image, table.from_codes, albedo::AlbedoSource());
  if (options.json) {
    std::cout << conformance::json_text(to_json(options, table.image, check), 2) << '\n';
  } else {
    print(options, table.image, check);
  }
  return check.reading ? done : failed;
}

}  // namespace sheen::tools
