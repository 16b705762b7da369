#include "golden/golden.h"

#include <chrono>
#include <cstdint>
#include <iostream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "conformance/json_text.h"
#include "image/io.h"
#include "tools/errors.h"
#include "tools/files.h"
#include "tools/golden_image.h"
#include "tools/options.h"
#include "tools/progress.h"
#include "tools/scene_input.h"
#include "tools/words.h"

namespace sheen::tools {

image::Image golden_image(const scene::Scene& scene, const SceneOptions& options, const GoldenRequest& request) {
  const std::int64_t pixels = std::int64_t{options.view.width} * options.view.height;
  Progress progress("golden", "pixels", pixels);
  golden::Settings settings;
  settings.view = options.view;
  settings.sheen = options.sheen;
  settings.subpixel_bits = request.subpixel_bits;
  settings.precision = request.precision;
  settings.environment = request.environment;
  settings.sampling = request.sampling;
  settings.bounds = request.bounds;
  settings.drawn_directions = request.drawn_directions;
  settings.progress = [&progress, pixels](double share) {
    progress.update(static_cast<std::int64_t>(share * static_cast<double>(pixels)));
  };
  return golden::render(scene, settings);
}

int golden(const GoldenOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  require_writable(options.output, {".exr", ".hdr", ".pfm", ".png"});
  const auto [scene, environment] = load_input(options);
  GoldenRequest request;
  request.environment = environment ? &*environment : nullptr;
  request.sampling.seed = static_cast<std::uint64_t>(options.seed);
  if (options.samples) {
    request.sampling.samples = static_cast<std::uint32_t>(*options.samples);
    request.sampling.error = 0.0;
  }
  request.sampling.error = options.error.value_or(request.sampling.error);
  // Other files than .exr have no room for bounds.
  request.bounds = extension_of(options.output) == ".exr";
  const image::Image picture = golden_image(scene, options, request);
  image::write(options.output, picture);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (options.json) {
    std::cout << conformance::json_text(nlohmann::ordered_json{{"output", options.output.string()},
                                                               {"width", picture.width},
                                                               {"height", picture.height},
                                                               {"channels", request.bounds ? picture.channels
                                                                            : extension_of(options.output) == ".png"
                                                                                ? std::vector<std::string>{"R", "G", "B", "A"}
                                                                                : std::vector<std::string>{"R", "G", "B"}},
                                                               {"model", word_of(model_words, options.sheen.model)},
                                                               {"visibility", word_of(visibility_words, options.sheen.visibility)},
                                                               {"albedo_scaling", word_of(albedo_scaling_words, options.sheen.scaling)},
                                                               {"formula_version", golden::formula_version},
                                                               {"subpixel_bits", golden::Settings().subpixel_bits},
                                                               {"seconds", seconds}},
                                        2)
              << '\n';
  } else {
    fmt::print("{}: {} x {}, {:.2f} s\n", options.output.string(), picture.width, picture.height, seconds);
  }
  return done;
}

}  // namespace sheen::tools
