#include <algorithm>
#include <cstddef>
#include <iostream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "conformance/json_text.h"
#include "image/io.h"
#include "tools/errors.h"
#include "tools/files.h"
#include "tools/lut_grid.h"
#include "tools/options.h"
#include "tools/words.h"

namespace sheen::tools {
namespace {

constexpr const char* split_sum_description = "scale and bias of f0 at texel centres (n_dot_v, roughness)";

/// What is written: texels by rows; a table that is not asked for is empty.
struct Lut {
  LutGrid sheen;
  std::vector<double> stored;  ///< what a picture holds of `sheen`
  std::vector<albedo::SplitSum> ggx;
};

Lut made(const LutOptions& options) {
  Lut lut;
  if (options.table != LutTable::Ggx) {
    lut.sheen = lut_grid(options.visibility, options.layout, options.size);
    lut.stored = stored_values(options.layout, lut.sheen);
  }
  if (options.table != LutTable::Sheen) {
    lut.ggx = split_sum_grid(options.size);
  }
  return lut;
}

/// Shortest text that reads back as the same double.
std::string csv(const LutOptions& options, const Lut& lut) {
  std::string text = lut.ggx.empty() ? "sheen_roughness,n_dot_v,directional_albedo\n" : "roughness,n_dot_v,scale,bias";
  if (lut.ggx.empty()) {
    for (std::size_t i = 0; i < lut.stored.size(); ++i) {
      fmt::format_to(std::back_inserter(text), "{},{},{}\n", lut.sheen.sheen_roughness[i], lut.sheen.n_dot_v[i],
                     lut.sheen.directional_albedo[i]);
    }
    return text;
  }
  text += lut.stored.empty() ? "\n" : ",directional_albedo\n";
  const auto size = static_cast<std::size_t>(options.size);
  const auto centre = [&](std::size_t k) { return (static_cast<double>(k) + 0.5) / options.size; };
  for (std::size_t i = 0; i < lut.ggx.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{},{},{},{}", centre(i / size), centre(i % size), lut.ggx[i].scale, lut.ggx[i].bias);
    text += lut.stored.empty() ? "\n" : fmt::format(",{}\n", lut.sheen.directional_albedo[i]);
  }
  return text;
}

/// The initialiser of an array, a row of the table a line; a row has `row_length` numbers.
std::string initialiser(const std::vector<double>& values, std::size_t row_length) {
  std::string text = "{\n";
  for (std::size_t i = 0; i < values.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{:.9e}f,{}", static_cast<float>(values[i]), (i + 1) % row_length == 0 ? "\n" : " ");
  }
  return text + "};\n";
}

std::string header(const LutOptions& options, const Lut& lut) {
  const auto size = static_cast<std::size_t>(options.size);
  std::string text, arrays;
  if (!lut.stored.empty()) {
    text += fmt::format("// Directional albedo of the {} sheen lobe (KHR_materials_sheen), made by sheen-cts lut --layout {}.\n// {}\n",
                        word_of(visibility_words, options.visibility), word_of(lut_layout_words, options.layout), describe(options.layout));
    arrays += fmt::format(
        "\ninline constexpr int sheen_albedo_size = {};\n"
        "/// Rows of rising sheen roughness, columns of rising cosine.\ninline constexpr float sheen_albedo[{}] = {}",
        options.size, lut.stored.size(), initialiser(lut.stored, size));
  }
  if (!lut.ggx.empty()) {
    std::vector<double> pairs;
    for (const albedo::SplitSum& sum : lut.ggx) {
      pairs.insert(pairs.end(), {sum.scale, sum.bias});
    }
    text += fmt::format(
        "// Split sum of GGX with height-correlated Smith shadowing and alpha = roughness^2 (glTF 2.0 Appendix B), made by sheen-cts lut.\n"
        "// {}: the directional albedo is f0 * scale + bias.\n",
        split_sum_description);
    arrays += fmt::format(
        "\ninline constexpr int ggx_split_sum_size = {0};\n"
        "/// Rows of rising roughness, columns of rising cosine; a texel is two numbers, scale and bias. That of n_dot_v = (i + 0.5) / "
        "{0},\n"
        "/// roughness = (j + 0.5) / {0} begins at 2 * (j * {0} + i).\ninline constexpr float ggx_split_sum[{1}] = {2}",
        options.size, pairs.size(), initialiser(pairs, 2 * size));
  }
  return text + "#pragma once\n" + arrays;
}

/// E in every channel, or scale, bias and E (0 where there is none).
image::Image picture(const LutOptions& options, const Lut& lut) {
  image::Image image(options.size, options.size, {"R", "G", "B"});
  for (std::size_t i = 0; i < image.data.size() / 3; ++i) {
    const float e = lut.stored.empty() ? 0.0f : static_cast<float>(lut.stored[i]);
    image.data[3 * i] = lut.ggx.empty() ? e : static_cast<float>(lut.ggx[i].scale);
    image.data[3 * i + 1] = lut.ggx.empty() ? e : static_cast<float>(lut.ggx[i].bias);
    image.data[3 * i + 2] = e;
  }
  return image;
}

std::string described(const LutOptions& options) {
  const std::string sheen = fmt::format("{}, {}", word_of(visibility_words, options.visibility), describe(options.layout));
  switch (options.table) {
    case LutTable::Sheen:
      return sheen;
    case LutTable::Ggx:
      return std::string("GGX, ") + split_sum_description;
    case LutTable::All:
      break;
  }
  return std::string("GGX, ") + split_sum_description + "; " + sheen;
}

nlohmann::ordered_json report(const LutOptions& options, const Lut& lut) {
  nlohmann::ordered_json json{{"output", options.output.string()}};
  if (!lut.stored.empty()) {
    json["visibility"] = word_of(visibility_words, options.visibility);
  }
  json["table"] = word_of(lut_table_words, options.table);
  json["size"] = options.size;
  json["layout"] = word_of(lut_layout_words, options.layout);
  json["description"] = options.table == LutTable::Sheen ? describe(options.layout) : described(options);
  if (!lut.stored.empty()) {
    const std::vector<double>& e = lut.sheen.directional_albedo;
    json["max_directional_albedo"] = *std::max_element(e.begin(), e.end());
  }
  return json;
}

}  // namespace

int lut(const LutOptions& options) {
  require_writable(options.output, {".csv", ".hpp", ".exr", ".hdr"});
  const std::string extension = extension_of(options.output);
  const bool is_picture = extension == ".exr" || extension == ".hdr";
  const Lut lut = made(options);
  if (is_picture) {
    image::write(options.output, picture(options, lut));
  } else {
    write_text(options.output, extension == ".csv" ? csv(options, lut) : header(options, lut));
  }
  if (options.json) {
    std::cout << conformance::json_text(report(options, lut), 2) << '\n';
  } else {
    fmt::print("{}: {} x {} {}\n", options.output.string(), options.size, options.size, described(options));
  }
  return done;
}

}  // namespace sheen::tools
