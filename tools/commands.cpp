#include "tools/commands.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include <CLI/CLI.hpp>

#include "golden/sampling_goal.h"
#include "tools/errors.h"
#include "tools/lut_grid.h"
#include "tools/options.h"
#include "tools/scene_input.h"
#include "tools/words.h"

namespace sheen::tools {
namespace {

/// Largest width, height and table size: the picture of a golden with bounds then still fits 8 GB.
constexpr int max_size = 16384;
constexpr int max_table_size = 4096;

/// What CLI::Range allows but NaN, which passes its comparisons.
CLI::Validator within(double least, double most) {
  const auto number = [](const std::string& text) {
    return std::string(std::isnan(std::strtod(text.c_str(), nullptr)) ? "must be a number" : "");
  };
  return CLI::Range(least, most) & CLI::Validator(number, "");
}

void add_json(CLI::App& app, Common& options) {
  app.add_flag("--json", options.json, "Print one JSON object on stdout, messages on stderr");
}

/// A flag whose value is one of a few words.
template <class Value, std::size_t N>
void add_word(CLI::App& app, const std::string& flag, Value& target, const std::array<Word<Value>, N>& words, const std::string& help) {
  app.add_option_function<std::string>(
         flag, [&target, &words](const std::string& text) { target = value_of(words, text).value(); }, help)
      ->check(CLI::IsMember(texts(words)))
      ->type_name("WORD")
      ->default_str(word_of(words, target));
}

/// A flag of the command line's contract that this version cannot honour: it says so, instead of being ignored. Not shown by --help.
void add_not_yet(CLI::App& app, const std::string& flag, int values) {
  app.add_option_function<std::vector<std::string>>(
         flag, [flag](const std::vector<std::string>&) { throw UsageError(flag + ": not yet available in this version"); }, "")
      ->expected(values)
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->group("");
}

CLI::Option* add_path(CLI::App& app, const std::string& flag, std::filesystem::path& target, const std::string& help) {
  return app
      .add_option_function<std::string>(
          flag, [&target](const std::string& text) { target = text; }, help)
      ->type_name("FILE");
}

/// SCENE and what says how it is seen; shared by render, golden and explain.
void add_scene(CLI::App& app, SceneOptions& options) {
  add_path(app, "SCENE", options.scene, "glTF 2.0 scene, .gltf or .glb")->required();
  app.add_option("--width", options.view.width, "Width of the image in pixels")->check(CLI::Range(1, max_size))->capture_default_str();
  app.add_option("--height", options.view.height, "Height of the image in pixels")->check(CLI::Range(1, max_size))->capture_default_str();
  app.add_option("--camera", options.view.camera, "Index of the scene's camera (the first, else one that frames the scene)")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()))
      ->type_name("INT");
  add_word(app, "--visibility", options.sheen.visibility, visibility_words, "Visibility term of the sheen lobe");
  add_word(app, "--albedo-scaling", options.sheen.scaling, albedo_scaling_words, "How the base under the sheen is dimmed");
  app.add_option_function<std::vector<std::string>>(
         "--light",
         [&options](const std::vector<std::string>& texts) {
           for (const std::string& text : texts) {
             options.lights.push_back(parse_light(text));
           }
         },
         "directional:X,Y,Z:LUX, (X,Y,Z) toward the light; replaces the scene's own lights; repeatable")
      ->type_name("LIGHT")
      ->allow_extra_args(false)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_word(app, "--model", options.sheen.model, model_words,
           "The text that is followed: the ratified one, sheen as its draft of 2019 had it, or the base layer alone, conserving energy");
  app.add_option("--seed", options.seed, "Seed of the directions drawn toward an environment")
      ->check(CLI::Range(std::int64_t{0}, std::numeric_limits<std::int64_t>::max()))
      ->type_name("INT");
  app.add_option("--environment", options.environment,
                 "uniform:R,G,B (radiance), or an equirect .hdr or .exr; lights beside the scene's lights")
      ->type_name("LIGHT");
  app.add_option("--environment-rotation", options.environment_rotation, "Degrees counter-clockwise about +Y")
      ->check(within(-1e6, 1e6))
      ->capture_default_str();
  app.add_flag("--background", options.background, "Show the environment where no surface is");
  add_json(app, options);
}

/// Resolves the model's choices. Throws UsageError where one that it does not have is asked for.
void resolve_model(const CLI::App& app, SceneOptions& options) {
  const albedo::SheenModel asked = options.sheen;
  options.sheen = albedo::resolved(asked);
  const std::string model = "--model " + word_of(model_words, asked.model);
  for (const auto& [flag, differs] : {std::pair{"--visibility", options.sheen.visibility != asked.visibility},
                                      std::pair{"--albedo-scaling", options.sheen.scaling != asked.scaling}}) {
    if (app.get_option(flag)->count() == 0) {
      continue;
    }
    if (asked.model == albedo::Model::Physical) {
      throw UsageError(std::string(flag) + ": " + model + " has no sheen");
    }
    if (differs) {
      throw UsageError(std::string(flag) + ": " + model + " has the visibility ashikhmin and the albedo scaling none");
    }
  }
}

/// How far an image that lights is sampled.
void add_sampling(CLI::App& app, GoldenOptions& options) {
  app.add_option("--error", options.error,
                 "Draw directions toward an image until 99 % of the covered pixels have, in every channel, a relative standard error "
                 "below this, and no direction that may bring more (0.01)")
      ->check(within(1e-6, 1.0))
      ->type_name("REL");
  app.add_option(
         "--samples", options.samples,
         "At most so many directions for each surface that a pixel shows, and no fewer than half of them unless --error is met first "
         "(1048576)")
      ->check(CLI::Range(std::int64_t{golden::least_samples}, std::int64_t{1} << 30))
      ->type_name("INT");
}

/// What chooses the shader; shared by render and explain.
void add_shader(CLI::App& app, RenderOptions& options) {
  add_word(app, "--precision", options.precision, precision_words, "Precision of the shading");
  add_word(app, "--formulation", options.formulation, formulation_words,
           "The specification's printed code, or a form that keeps its digits");
  add_word(app, "--albedo-source", options.albedo_source, albedo_source_words, "Where the shader takes the directional albedo from");
  app.add_option("--environment-samples", options.environment_samples,
                 "Draw that many directions a pixel to integrate the environment; 0: filter it beforehand, the real-time way")
      ->check(CLI::Range(0, renderer::most_environment_samples))
      ->capture_default_str();
  add_not_yet(app, "--max-error", 1);
}

void check_shader(const RenderOptions& options) {
  if (options.albedo_source == renderer::AlbedoSource::Fit && options.sheen.visibility == albedo::Visibility::Refined) {
    throw UsageError("--albedo-source fit: there is no fit for --visibility refined");
  }
}

Action declare_render(CLI::App& app) {
  auto options = std::make_shared<RenderOptions>();
  add_scene(app, *options);
  add_path(app, "-o,--output", options->output, ".exr, .hdr or .pfm: linear; .png: sRGB")->required();
  add_word(app, "--context", options->context, context_words, "Kind of offscreen GL context");
  add_shader(app, *options);
  app.add_flag("--verify", options->verify, "Then compute the golden and judge the image; exit 1 when a pixel is outside its bound");
  add_word(app, "--tone-map", options->tone_map, tone_map_words, "Curve applied to what is written");
  app.add_option("--exposure", options->exposure, "EV: the radiance written is multiplied by 2^EV")
      ->check(within(-100.0, 100.0))
      ->capture_default_str();
  return [options, &app] {
    resolve_model(app, *options);
    check_shader(*options);
    return render(*options);
  };
}

Action declare_golden(CLI::App& app) {
  auto options = std::make_shared<GoldenOptions>();
  add_scene(app, *options);
  add_path(app, "-o,--output", options->output, ".exr (with the channels bound.R, bound.G, bound.B and excluded), .hdr, .pfm or .png")
      ->required();
  add_sampling(app, *options);
  return [options, &app] {
    resolve_model(app, *options);
    return golden(*options);
  };
}

Action declare_compare(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  add_path(app, "CANDIDATE", options->candidate, "Image to judge")->required();
  add_path(app, "REFERENCE", options->reference, "Image to judge it by")->required();
  add_path(app, "--heatmap", options->heatmap, "Write a picture of the relative error");
  app.add_option_function<std::string>(
         "--tolerance", [options](const std::string& text) { options->tolerance = parse_tolerance(text); },
         "Exit 1 when a compared value is off by more than max(ABS, REL * reference)")
      ->type_name("REL,ABS");
  add_json(app, *options);
  return [options] { return compare(*options); };
}

Action declare_lut(CLI::App& app) {
  auto options = std::make_shared<LutOptions>();
  add_path(app, "-o,--output", options->output, ".csv, .exr, .hdr or .hpp (C++ header)");
  add_word(app, "--table", options->table, lut_table_words,
           "sheen: the directional albedo E; ggx: scale and bias of f0 of the GGX split sum; all: scale, bias and E as R, G and B");
  add_word(app, "--visibility", options->visibility, visibility_words, "Visibility term of the sheen lobe");
  app.add_option("--size", options->size, "Nodes along each side")->check(CLI::Range(1, max_table_size))->capture_default_str();
  add_word(app, "--layout", options->layout, lut_layout_words,
           "plain: texel centres of (N.V, roughness); warped: nodes crowded toward grazing (sheen alone)");
  CLI::Option* check = add_path(app, "--check", options->check, "Say what a table of E is: .exr, .hdr, .pfm, .png, .jpg or .csv");
  for (const char* flag : {"--output", "--table", "--visibility", "--size", "--layout"}) {
    check->excludes(app.get_option(flag));
  }
  add_json(app, *options);
  const CLI::Option* visibility = app.get_option("--visibility");
  return [options, visibility_given = [visibility] { return visibility->count() > 0; }] {
    if (!options->check.empty()) {
      return lut_check(*options);
    }
    if (options->output.empty()) {
      throw UsageError("lut: --output or --check is needed");
    }
    if (options->table != LutTable::Sheen && options->layout == LutLayout::Warped) {
      throw UsageError("--layout warped: only for --table sheen");
    }
    if (options->table == LutTable::Ggx && visibility_given()) {
      throw UsageError("--visibility: --table ggx has no sheen");
    }
    if (options->layout == LutLayout::Warped && options->size < 2) {
      throw UsageError("--size: a warped table has at least 2 nodes a side");
    }
    return lut(*options);
  };
}

Action declare_explain(CLI::App& app) {
  auto options = std::make_shared<RenderOptions>();
  add_scene(app, *options);
  add_shader(app, *options);
  return [options, &app] {
    resolve_model(app, *options);
    check_shader(*options);
    return explain(*options);
  };
}

void add_cases(CLI::App& app, ListOptions& options) {
  app.add_option("--suite", options.suite, "Suite of cases")->capture_default_str();
  app.add_option("--filter", options.filter, "Cases by name: globs separated by ':', those after '-' left out")
      ->type_name("GLOB")
      ->capture_default_str();
  add_json(app, options);
}

Action declare_list(CLI::App& app) {
  auto options = std::make_shared<ListOptions>();
  add_cases(app, *options);
  return [options] { return list(*options); };
}

Action declare_run(CLI::App& app) {
  auto options = std::make_shared<RunOptions>();
  add_cases(app, *options);
  app.add_option("--viewer", options->viewer, "Our own renderer, or the command that starts a viewer speaking the protocol")
      ->type_name("COMMAND")
      ->capture_default_str();
  add_word(app, "--context", options->context, context_words, "Kind of offscreen GL context of our own viewer");
  add_word(app, "--precision", options->precision, precision_words, "Precision of the shading of our own viewer");
  add_path(app, "--report", options->report, "Folder of the report (sheen-cts-report/SUITE)")->type_name("DIR");
  add_path(app, "--goldens", options->goldens, "Folder of the committed goldens (those that came with this program)")->type_name("DIR");
  app.add_flag("--strict", options->strict, "Approximations count as failures");
  app.add_option("--case-limit", options->case_limit_seconds, "Seconds that a viewer has for one picture before its case is a timeout")
      ->check(within(0.001, 86400.0))
      ->type_name("SECONDS")
      ->capture_default_str();
  app.add_option("--environment-samples", options->environment_samples,
                 "Directions a pixel that our own viewer draws toward an environment; 0: the real-time way")
      ->check(CLI::Range(0, renderer::most_environment_samples))
      ->capture_default_str();
  return [options] { return run(*options); };
}

Action declare_join(CLI::App& app) {
  auto options = std::make_shared<JoinOptions>();
  app.add_option("RUN", options->runs,
                 "Report folder of a run, as DIR or NAME=DIR; runs of several suites on one driver, or its shards, share a NAME")
      ->type_name("DIR")
      ->required();
  add_path(app, "-o,--output", options->output, "Folder of the joint report")->type_name("DIR")->required();
  add_json(app, *options);
  return [options] { return join(*options); };
}

template <int (*operation)(const GoldensOptions&)>
Action declare_goldens(CLI::App& app) {
  auto options = std::make_shared<GoldensOptions>();
  app.add_option("--suite", options->suite, "Suite of cases")->capture_default_str();
  add_path(app, "--goldens", options->goldens, "Folder of the goldens (those that came with this program)")->type_name("DIR");
  add_json(app, *options);
  return [options] { return operation(*options); };
}

Action declare_serve(CLI::App& app) {
  auto options = std::make_shared<ServeOptions>();
  add_word(app, "--context", options->context, context_words, "Kind of offscreen GL context");
  add_word(app, "--precision", options->precision, precision_words, "Precision of the shading");
  app.add_flag("--json", options->json, "Print what this viewer says of itself, one JSON object, and end");
  return [options] { return serve(*options); };
}

}  // namespace

std::vector<Command> commands() {
  return {
      {"render", "Draw a scene offscreen with the GL ES 3 renderer", "render cloth.glb -o cloth.exr --light directional:1,1,1:3 --verify",
       declare_render},
      {"golden", "Compute the same image in double on the CPU, with a bound on every pixel",
       "golden cloth.glb -o golden.exr --light directional:1,1,1:3", declare_golden},
      {"compare", "Measure how far an image is from a reference", "compare cloth.exr golden.exr --tolerance 1e-3,2e-5 --heatmap error.png",
       declare_compare},
      {"list", "List the cases of a suite", "list --suite core --filter 'sheen.*'", declare_list},
      {"run", "Run a suite against a viewer and write a report", "run --suite core --report report", declare_run},
      {"join", "Lay runs of a suite on several drivers side by side", "join llvmpipe=report/llvmpipe softpipe=report/softpipe -o report",
       declare_join},
      {"goldens",
       "Make or check the committed goldens",
       nullptr,
       nullptr,
       {{"generate", "Compute every golden of a suite and write them", "goldens generate --goldens goldens",
         declare_goldens<goldens_generate>},
        {"verify", "Compute every golden again and hold the files to it", "goldens verify", declare_goldens<goldens_verify>}}},
      {"lut", "Write a table of the sheen lobe's directional albedo, or say what one is", "lut -o sheen_albedo.exr --size 128",
       declare_lut},
      {"explain", "Say what a scene requires of the renderer", "explain cloth.glb --json", declare_explain},
      {"serve", "Be a viewer: answer requests on stdin by the viewer protocol", "serve --context egl", declare_serve},
  };
}

}  // namespace sheen::tools
