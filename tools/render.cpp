#include <chrono>
#include <cstdint>
#include <future>
#include <iostream>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "conformance/goldens.h"
#include "conformance/json_text.h"
#include "conformance/judge.h"
#include "conformance/replicas.h"
#include "conformance/verdict.h"
#include "gles/context.h"
#include "image/io.h"
#include "renderer/renderer.h"
#include "tools/errors.h"
#include "tools/files.h"
#include "tools/golden_image.h"
#include "tools/options.h"
#include "tools/scene_input.h"
#include "tools/tone_map.h"
#include "tools/words.h"

namespace sheen::tools {
namespace {

nlohmann::ordered_json describe(const RenderOptions& options, const gles::ContextInfo& info, double seconds) {
  return {{"output", options.output.string()},
          {"width", options.view.width},
          {"height", options.view.height},
          {"model", word_of(model_words, options.sheen.model)},
          {"visibility", word_of(visibility_words, options.sheen.visibility)},
          {"albedo_scaling", word_of(albedo_scaling_words, options.sheen.scaling)},
          {"precision", word_of(precision_words, options.precision)},
          {"formulation", word_of(formulation_words, options.formulation)},
          {"albedo_source", word_of(albedo_source_words, options.albedo_source)},
          {"tone_map", word_of(tone_map_words, options.tone_map)},
          {"exposure", options.exposure},
          {"context",
           {{"kind", word_of(context_words, options.context)},
            {"renderer", info.renderer},
            {"version", info.version},
            {"subpixel_bits", info.subpixel_bits},
            {"mediump_bits", info.mediump_bits}}},
          {"seconds", seconds}};
}

nlohmann::ordered_json describe(const conformance::Verdict& verdict) {
  return {{"status", conformance::to_string(verdict.status)},
          {"bound_ratio", verdict.bound_ratio},
          {"max_abs", verdict.max_abs},
          {"max_rel", verdict.max_rel},
          {"p99_rel", verdict.p99_rel},
          {"worst_pixel", {verdict.worst_x, verdict.worst_y}},
          {"compared_pixels", verdict.compared_pixels},
          {"excluded_pixels", verdict.excluded_pixels},
          {"vague_pixels", verdict.vague_pixels},
          {"nonfinite_pixels", verdict.nonfinite_pixels},
          {"message", verdict.message}};
}

}  // namespace

int render(const RenderOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  require_writable(options.output, {".exr", ".hdr", ".pfm", ".png"});
  // The driver starts while the scene is read.
  std::future<std::unique_ptr<gles::Context>> started =
      std::async(std::launch::async, [&] { return gles::Context::create(options.context); });
  const auto [scene, environment] = load_input(options);
  const std::unique_ptr<gles::Context> context = started.get();
  renderer::Renderer renderer(*context, conformance::default_cache() / "environments");
  renderer::Settings settings = options.settings(environment);
  if (options.verify && environment && settings.environment_samples == 0) {
    // Filtered beforehand its light is an approximation, which no bound holds.
    settings.environment_samples = conformance::environment_directions;
    fmt::print(stderr, "--verify draws {} directions of the environment a pixel\n", settings.environment_samples);
  }
  // What directions leave by chance, replicas tell.
  const bool replicas = options.verify && environment;
  if (replicas) {
    settings.environment_samples = conformance::directions_of_replica(settings.environment_samples);
  }
  const auto draw = [&, &drawn_scene = scene](std::uint64_t seed) {
    settings.seed = seed;
    return renderer.render(drawn_scene, settings);
  };
  image::Image picture =
      replicas ? conformance::with_standard_errors(conformance::draw_replicas(draw, conformance::environment_replicas, settings.seed))
               : renderer.render(scene, settings);
  std::optional<conformance::Verdict> verdict;
  if (options.verify) {
    GoldenRequest request;
    request.environment = environment ? &*environment : nullptr;
    request.subpixel_bits = context->info().subpixel_bits;
    request.drawn_directions = replicas ? settings.environment_samples : 0;
    request.precision = options.precision == renderer::Precision::Mediump ? golden::Precision::Mediump : golden::Precision::Highp;
    verdict = conformance::judge(picture, golden_image(scene, options, request),
                                 conformance::own_rules(request.precision, settings.sheen.scaling, environment.has_value()));
  }
  apply_display(picture, options.tone_map, options.exposure);
  image::write(options.output, picture);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (options.json) {
    nlohmann::ordered_json report = describe(options, context->info(), seconds);
    if (verdict) {
      report["verify"] = describe(*verdict);
    }
    std::cout << conformance::json_text(report, 2) << '\n';
  } else {
    fmt::print("{}: {} x {}, {}, {:.2f} s\n", options.output.string(), picture.width, picture.height, context->info().renderer, seconds);
    if (verdict) {
      fmt::print("{}: largest error {:.3g} of its bound at pixel ({}, {}); {} pixels compared, {} excluded{}{}\n",
                 conformance::to_string(verdict->status), verdict->bound_ratio, verdict->worst_x, verdict->worst_y,
                 verdict->compared_pixels, verdict->excluded_pixels, verdict->message.empty() ? "" : "; ", verdict->message);
    }
  }
  return !verdict || verdict->status == conformance::Status::Pass ? done : failed;
}

}  // namespace sheen::tools
