#include "conformance/serve.h"

#include <chrono>
#include <cstdint>
#include <istream>
#include <ostream>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "conformance/case.h"
#include "conformance/environment_input.h"
#include "conformance/goldens.h"
#include "conformance/json_text.h"
#include "conformance/replicas.h"
#include "conformance/shading_words.h"
#include "gles/context.h"
#include "image/io.h"
#include "renderer/function_evaluator.h"
#include "renderer/renderer.h"
#include "scene/gltf.h"

namespace sheen::conformance {
namespace {

using nlohmann::json;

constexpr int most_replicas = 64;

gles::ContextKind parse_context(const std::string& word) {
  if (word == "osmesa") {
    return gles::ContextKind::OsMesa;
  }
  if (word == "egl") {
    return gles::ContextKind::Egl;
  }
  throw std::invalid_argument("unknown context '" + word + "'; known: osmesa, egl");
}

/// @param replicas  where how many pictures of their own directions are asked for goes; may be null, of what has no picture
renderer::Settings read_settings(const json& request, renderer::Precision precision, int* replicas = nullptr) {
  renderer::Settings settings;
  settings.precision = precision;
  settings.view.width = request.at("width").get<int>();
  settings.view.height = request.at("height").get<int>();
  if (settings.view.width < 1 || settings.view.height < 1) {
    throw std::invalid_argument("width and height must be at least 1");
  }
  if (request.contains("camera") && !request["camera"].is_null()) {
    settings.view.camera = request["camera"].get<int>();
  }
  if (!request.contains("settings") || request["settings"].is_null()) {
    return settings;
  }
  for (const auto& [key, value] : request["settings"].items()) {
    if (key == "environment_samples") {
      settings.environment_samples = value.get<int>();
      if (settings.environment_samples < 0 || settings.environment_samples > renderer::most_environment_samples) {
        throw std::invalid_argument("environment_samples must be from 0 to " + std::to_string(renderer::most_environment_samples));
      }
      continue;
    }
    if (key == "environment_replicas" && replicas != nullptr) {
      *replicas = value.get<int>();
      if (*replicas < 0 || *replicas == 1 || *replicas > most_replicas) {
        throw std::invalid_argument("environment_replicas must be 0 or from 2 to " + std::to_string(most_replicas));
      }
      continue;
    }
    const std::string word = value.get<std::string>();
    if (key == "visibility") {
      settings.sheen.visibility = parse_visibility(word);
    } else if (key == "albedo_scaling") {
      settings.sheen.scaling = parse_albedo_scaling(word);
    } else if (key == "model") {
      settings.sheen.model = parse_model(word);
    } else if (key == "precision") {
      settings.precision = parse_precision(word);
    } else if (key == "formulation") {
      settings.formulation = parse_formulation(word);
    } else {
      throw std::invalid_argument("unknown setting '" + key + "'");
    }
  }
  return settings;
}

/// The environment that the last request named: a suite asks for the same one many times.
class LastEnvironment {
 public:
  /// Null for a request without one.
  const scene::Environment* of(const json& request) {
    if (!request.contains("environment") || request["environment"].is_null()) {
      return nullptr;
    }
    const std::string text = request["environment"].get<std::string>();
    if (text != text_) {
      text_.clear();
      environment_ = read_environment(text);
      text_ = text;
    }
    return &environment_;
  }

 private:
  std::string text_;
  scene::Environment environment_;
};

/// What answers requests: drawing scenes, evaluating functions.
struct Server {
  Server(gles::Context& context, renderer::Precision precision_, const ServeOptions& options_)
      : precision(precision_), options(options_), renderer(context, default_cache() / "environments"), evaluator(context) {}

  image::Image draw(const json& request) {
    int replicas = 0;
    renderer::Settings settings = read_settings(request, precision, &replicas);
    settings.environment = last.of(request);
    scene::Scene scene = scene::load_gltf(request.at("scene").get<std::string>());
    if (options.alter) {
      options.alter(scene, settings);
    }
    if (replicas == 0) {
      return renderer.render(scene, settings);
    }
    const auto one = [&](std::uint64_t seed) {
      settings.seed = seed;
      return renderer.render(scene, settings);
    };
    return draw_replicas(one, replicas, settings.seed);
  }
  image::Image evaluate(const json& request) {
    renderer::Settings settings = read_settings(request, precision);
    if (options.alter) {
      scene::Scene none;
      options.alter(none, settings);
    }
    const image::Image arguments = image::read(request.at("arguments").get<std::string>());
    image::Image result = evaluator.evaluate(request["function"].get<std::string>(), arguments, settings.view.height, settings);
    if (result.width != settings.view.width) {
      throw std::invalid_argument("width must be that of the arguments, " + std::to_string(result.width));
    }
    return result;
  }

  renderer::Precision precision;
  const ServeOptions& options;
  renderer::Renderer renderer;
  renderer::FunctionEvaluator evaluator;
  LastEnvironment last;
};

/// Does what the request asks for and fills the answer in.
void answer_request(const json& request, Server& server, json& answer) {
  const auto begin = std::chrono::steady_clock::now();
  const std::string output = request.at("output").get<std::string>();
  image::write(output, request.contains("function") ? server.evaluate(request) : server.draw(request));
  answer["status"] = "rendered";
  answer["image"] = output;
  answer["seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

void serve(std::istream& in, std::ostream& out, const ServeOptions& options) {
  const renderer::Precision precision = parse_precision(options.precision);
  const gles::ContextKind kind = parse_context(options.context);
  const std::unique_ptr<gles::Context> context = gles::Context::create(kind);
  const gles::ContextInfo& info = context->info();
  Server server(*context, precision, options);
  const json hello = {
      {"viewer", "sheen-cts"},
      {"version", SHEEN_CTS_VERSION},
      {"capabilities",
       {"KHR_lights_punctual", "KHR_texture_transform", "KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_materials_specular",
        "KHR_materials_sheen", "KHR_materials_clearcoat", "environment", "settings", "functions"}},
      {"encoding", "linear-float"},
      {"context",
       {{"renderer", info.renderer},
        {"version", info.version},
        {"mediump_bits", info.mediump_bits},
        {"subpixel_bits", info.subpixel_bits}}}};
  out << hello.dump() << std::endl;
  std::string line;
  while (std::getline(in, line)) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) {
      continue;
    }
    json answer = {{"id", nullptr}, {"status", "failed"}, {"image", nullptr}, {"seconds", 0.0}, {"message", ""}};
    try {
      const json request = json::parse(line);
      answer["id"] = request.at("id");
      answer_request(request, server, answer);
    } catch (const std::exception& error) {
      answer["status"] = "failed";
      answer["message"] = error.what();
    }
    out << json_text(answer) << std::endl;
  }
}

}  // namespace sheen::conformance
