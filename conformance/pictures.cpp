#include "conformance/pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <stdexcept>

namespace sheen::conformance {
namespace {

constexpr double tau = 2 * std::numbers::pi;

using Texel = std::array<double, 4>;

double wave(double x) {
  return 0.5 + 0.5 * std::sin(tau * x);
}

Texel channels_texel(double u, double v) {
  return {0.1 + 0.8 * wave(u), 0.15 + 0.8 * wave(v + 0.1), 0.1 + 0.85 * wave(0.35 * std::cos(tau * u) + 0.35 * std::cos(tau * v)),
          0.2 + 0.75 * wave(u + 2 * v)};
}

/// Two threads that cross over and under each other, in colours whose sRGB codes lie far from their linear values.
Texel weave_texel(double u, double v) {
  const double over = wave(4 * u) * wave(4 * v + 0.25);
  const double warp = 0.5 + 0.5 * std::cos(tau * (2 * u + v));
  return {0.25 + 0.55 * over, 0.3 + 0.45 * warp, 0.65 - 0.4 * over + 0.2 * warp, 0.35 + 0.6 * wave(2 * u - v)};
}

/// A tangent-space normal as a code: n/2 + 1/2; slopes are those of the height map times `strength`. v runs down, green points up.
Texel normal_texel(double slope_u, double slope_v, double strength) {
  const double x = -strength * slope_u;
  const double y = strength * slope_v;
  const double length = std::sqrt(x * x + y * y + 1);
  return {0.5 + 0.5 * x / length, 0.5 + 0.5 * y / length, 0.5 + 0.5 / length, 1.0};
}

Texel bumps_texel(double u, double v) {
  // Height sin(3 tau u) sin(3 tau v).
  const double f = 3 * tau;
  return normal_texel(std::cos(f * u) * std::sin(f * v), std::sin(f * u) * std::cos(f * v), 0.45);
}

Texel ripples_texel(double u, double v) {
  // Height sin(tau (2 u + 5 v)): its slopes stand in the ratio 2 to 5, so swapped axes show.
  const double slope = std::cos(tau * (2 * u + 5 * v));
  return normal_texel(0.4 * slope, slope, 0.3);
}

/// Height sin(5 tau v): the same all along u. No code of 8 bits means a slope of 0; of the two nearest, `code` / 255.
Texel steps_texel(double v, int code) {
  Texel texel = normal_texel(0.0, std::cos(5 * tau * v), 0.3);
  texel[0] = code / 255.0;
  return texel;
}

Texel flat_texel(double, double) {
  return {0.2, 0.4, 0.6, 0.8};
}

struct Recipe {
  int width, height, channels, bits;
  std::function<Texel(double, double)> texel;
};

const std::map<std::string, Recipe>& recipes() {
  static const std::map<std::string, Recipe> all = {
      {"channels", {64, 64, 4, 8, channels_texel}},
      {"weave", {64, 64, 4, 8, weave_texel}},
      {"weave16", {64, 64, 4, 16, weave_texel}},
      {"flat", {4, 4, 4, 8, flat_texel}},
      {"odd", {37, 23, 4, 8, channels_texel}},
      {"bumps", {64, 64, 3, 8, bumps_texel}},
      {"ripples", {64, 64, 3, 8, ripples_texel}},
      {"steps", {64, 64, 3, 8, [](double, double v) { return steps_texel(v, 128); }}},
      {"steps_back", {64, 64, 3, 8, [](double, double v) { return steps_texel(v, 127); }}},
  };
  return all;
}

/// A picture's name taken apart: that of its recipe, and which channels are kept.
struct PictureName {
  std::string recipe;
  std::string kept = "rgba";
};

std::optional<PictureName> parse_picture_name(const std::string& name) {
  const std::size_t dot = name.find('.');
  PictureName parsed{name.substr(0, dot)};
  if (dot != std::string::npos) {
    parsed.kept = name.substr(dot + 1);
  }
  if (!recipes().contains(parsed.recipe) || parsed.kept.empty() || parsed.kept.find_first_not_of("rgba") != std::string::npos) {
    return std::nullopt;
  }
  return parsed;
}

const std::map<std::string, SamplerChoice>& samplers() {
  static const std::map<std::string, SamplerChoice> all = {
      {"", {}},
      {"linear", {9729, 9729, 10497, 10497}},
      {"nearest", {9728, 9728, 10497, 10497}},
      {"clamp", {9729, 9729, 33071, 33071}},
      {"mirror", {9729, 9729, 33648, 33648}},
      {"bilinear_mips", {9729, 9985, 10497, 10497}},
  };
  return all;
}

}  // namespace

std::optional<TextureName> parse_texture_name(const std::string& name) {
  const std::size_t slash = name.find('/');
  TextureName parsed{name.substr(0, slash), slash == std::string::npos ? "" : name.substr(slash + 1)};
  if (!parse_picture_name(parsed.picture) || !samplers().contains(parsed.sampler)) {
    return std::nullopt;
  }
  return parsed;
}

SamplerChoice make_sampler(const std::string& name) {
  const auto found = samplers().find(name);
  if (found == samplers().end()) {
    throw std::invalid_argument("unknown sampler '" + name + "'");
  }
  return found->second;
}

std::string picture_names() {
  std::string names;
  for (const auto& [name, recipe] : recipes()) {
    names += (names.empty() ? "" : ", ") + name;
  }
  return names;
}

ProceduralPicture make_picture(const std::string& name) {
  const std::optional<PictureName> parsed = parse_picture_name(name);
  if (!parsed) {
    throw std::invalid_argument("unknown picture '" + name + "'; known: " + picture_names());
  }
  const Recipe& recipe = recipes().at(parsed->recipe);
  ProceduralPicture picture{recipe.width, recipe.height, recipe.channels, recipe.bits, {}};
  const double top = (1 << recipe.bits) - 1;
  for (int y = 0; y < recipe.height; ++y) {
    for (int x = 0; x < recipe.width; ++x) {
      const Texel texel = recipe.texel((x + 0.5) / recipe.width, (y + 0.5) / recipe.height);
      for (int c = 0; c < recipe.channels; ++c) {
        const auto channel = static_cast<std::size_t>(c);
        const bool kept = parsed->kept.find("rgba"[channel]) != std::string::npos;
        const double value = kept ? std::clamp(texel.at(channel), 0.0, 1.0) : 0.5;
        picture.codes.push_back(static_cast<std::uint16_t>(std::floor(value * top + 0.5)));
      }
    }
  }
  return picture;
}

}  // namespace sheen::conformance
