#include <algorithm>
#include <cstddef>
#include <iostream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "image/io.h"
#include "tools/errors.h"
#include "tools/files.h"
#include "tools/lut_grid.h"
#include "tools/options.h"
#include "tools/words.h"

namespace sheen::tools {
namespace {

/// Shortest text that reads back as the same double.
std::string csv(const LutGrid& grid) {
  std::string text = "sheen_roughness,n_dot_v,directional_albedo\n";
  for (std::size_t i = 0; i < grid.n_dot_v.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{},{},{}\n", grid.sheen_roughness[i], grid.n_dot_v[i], grid.directional_albedo[i]);
  }
  return text;
}

std::string header(const LutOptions& options, const std::vector<double>& stored) {
  std::string text = fmt::format(
      "// Directional albedo of the {} sheen lobe (KHR_materials_sheen), made by sheen-cts lut --layout {}.\n// {}\n"
      "#pragma once\n\ninline constexpr int sheen_albedo_size = {};\n"
      "/// Rows of rising sheen roughness, columns of rising cosine.\ninline constexpr float sheen_albedo[{}] = {{\n",
      word_of(visibility_words, options.visibility), word_of(lut_layout_words, options.layout), describe(options.layout), options.size,
      stored.size());
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const bool last_in_row = (i + 1) % static_cast<std::size_t>(options.size) == 0;
    fmt::format_to(std::back_inserter(text), "{:.9e}f,{}", static_cast<float>(stored[i]), last_in_row ? "\n" : " ");
  }
  return text + "};\n";
}

image::Image picture(const LutOptions& options, const std::vector<double>& stored) {
  image::Image image(options.size, options.size, {"R", "G", "B"});
  for (std::size_t i = 0; i < stored.size(); ++i) {
    std::fill_n(image.data.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, static_cast<float>(stored[i]));
  }
  return image;
}

}  // namespace

int lut(const LutOptions& options) {
  require_writable(options.output, {".csv", ".hpp", ".exr", ".hdr"});
  const std::string extension = extension_of(options.output);
  const bool is_picture = extension == ".exr" || extension == ".hdr";
  if (is_picture) {
    image::preload();
  }
  const LutGrid grid = lut_grid(options.visibility, options.layout, options.size);
  if (extension == ".csv") {
    write_text(options.output, csv(grid));
  } else {
    const std::vector<double> stored = stored_values(options.layout, grid);
    if (is_picture) {
      image::write(options.output, picture(options, stored));
    } else {
      write_text(options.output, header(options, stored));
    }
  }
  if (options.json) {
    std::cout << nlohmann::ordered_json{{"output", options.output.string()},
                                        {"visibility", word_of(visibility_words, options.visibility)},
                                        {"size", options.size},
                                        {"layout", word_of(lut_layout_words, options.layout)},
                                        {"description", describe(options.layout)},
                                        {"max_directional_albedo",
                                         *std::max_element(grid.directional_albedo.begin(), grid.directional_albedo.end())}}
                     .dump(2, ' ', false, nlohmann::json::error_handler_t::replace)
              << '\n';
  } else {
    fmt::print("{}: {} x {} {}, {}\n", options.output.string(), options.size, options.size, word_of(visibility_words, options.visibility),
               describe(options.layout));
  }
  return done;
}

}  // namespace sheen::tools
