#include "renderer/functions.h"

#include <algorithm>
#include <stdexcept>

#include "renderer/feature_words.h"
#include "renderer/shading.h"

namespace sheen::renderer {
namespace {

using albedo::Visibility;
using Words = std::vector<std::string>;

int components(const std::string& declaration) {
  return declaration.starts_with("vec3 ") ? 3 : 1;
}

void add_operations(std::vector<ShaderFunction>& all) {
  for (const char* name : {"exp", "exp2", "log", "log2", "sqrt", "inversesqrt"}) {
    all.push_back({name, {"float x"}, name + std::string("(x)"), 1, {}, {}, {}});
  }
  all.push_back({"add", {"float x", "float y"}, "x + y", 1, {}, {}, {}});
  all.push_back({"multiply", {"float x", "float y"}, "x * y", 1, {}, {}, {}});
  all.push_back({"divide", {"float x", "float y"}, "x / y", 1, {}, {}, {}});
  all.push_back({"pow", {"float x", "float y"}, "pow(x, y)", 1, {}, {}, {}});
  all.push_back({"mix", {"float x", "float y", "float a"}, "mix(x, y, a)", 1, {}, {}, {}});
  all.push_back({"dot", {"vec3 x", "vec3 y"}, "dot(x, y)", 1, {}, {}, {}});
  all.push_back({"cross", {"vec3 x", "vec3 y"}, "cross(x, y)", 3, {}, {}, {}});
  all.push_back({"normalize", {"vec3 x"}, "normalize(x)", 3, {}, {}, {}});
}

void add_base(std::vector<ShaderFunction>& all) {
  all.push_back({"normalize_or", {"vec3 v"}, "normalize_or(v, vec3(0.0, 0.0, 1.0))", 3, {}, {}, {}, true});
  all.push_back({"fresnel_weight", {"float VdotH"}, "fresnel_weight(VdotH)", 1, {"fresnel.glsl"}, {}, {}});
  all.push_back({"ggx_distribution", {"vec3 N", "vec3 H", "float alpha"}, "D_GGX(N, H, alpha)", 1, {"specular_ggx.glsl"}, {}, {}});
  all.push_back({"smith_visibility",
                 {"float NdotL", "float NdotV", "float alpha"},
                 "V_GGX_times_NdotL(NdotL, NdotV, alpha)",
                 1,
                 {"specular_ggx.glsl"},
                 {},
                 {}});
  all.push_back({"specular_ggx",
                 {"vec3 N", "vec3 H", "float NdotL", "float NdotV", "float alpha"},
                 "specular_ggx(N, H, NdotL, NdotV, alpha)",
                 1,
                 {"specular_ggx.glsl"},
                 {},
                 {}});
  all.push_back({"base",
                 {"vec3 N", "vec3 V", "vec3 H", "float NdotL", "float NdotV", "vec3 baseColor", "float metallic", "float alpha"},
                 "base_times_NdotL(BaseMaterial(baseColor, metallic, alpha), N, V, H, NdotL, NdotV)",
                 3,
                 {"fresnel.glsl", "specular_ggx.glsl", "base.glsl"},
                 {},
                 {}});
  all.push_back({"clearcoat_weight",
                 {"float clearcoat", "float NcdotV"},
                 "clearcoat_weight(clearcoat, NcdotV)",
                 1,
                 {"fresnel.glsl", "clearcoat.glsl"},
                 {},
                 {}});
}

Words joined(Words first, const Words& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

void add_sheen(std::vector<ShaderFunction>& all) {
  const Words lobe{"SHEEN", smallest_sheen_roughness_define};
  all.push_back({"sheen_distribution",
                 {"vec3 N", "vec3 H", "float sheenRoughness"},
                 "sheen_distribution(N, H, sheenRoughness)",
                 1,
                 {"sheen_distribution.glsl"},
                 lobe,
                 {}});
  for (const Visibility visibility : {Visibility::Charlie, Visibility::Refined, Visibility::Ashikhmin}) {
    const std::string name = visibility_name(visibility);
    const Words files = sheen_visibility_files(visibility);
    const Words defines = joined(lobe, {"VISIBILITY_" + upper(name)});
    const std::string of_view = "sheen_visibility_of_view(NdotV, sheenRoughness)";
    if (visibility != Visibility::Ashikhmin) {
      all.push_back({"sheen_lambda_" + name,
                     {"float cos_theta", "float alpha_g"},
                     "lambda_sheen(cos_theta, sheen_coefficients(alpha_g))",
                     1,
                     files,
                     defines,
                     {}});
    }
    all.push_back({"sheen_visibility_" + name,
                   {"float NdotL", "float NdotV", "float sheenRoughness"},
                   "sheen_visibility_times_NdotL(" + of_view + ", NdotL)",
                   1,
                   files,
                   defines,
                   {}});
    all.push_back({"sheen_" + name,
                   {"vec3 N", "vec3 H", "float NdotL", "float NdotV", "vec3 sheenColor", "float sheenRoughness"},
                   "sheen_times_NdotL(SheenMaterial(sheenColor, sheenRoughness, " + of_view + "), N, H, NdotL)",
                   3,
                   joined(joined({"sheen_distribution.glsl"}, files), {"sheen.glsl"}),
                   defines,
                   {}});
    const Words of_albedo{"float NdotX", "float sheenRoughness"};
    const std::string albedo = "sheen_directional_albedo(NdotX, sheenRoughness)";
    all.push_back({"sheen_albedo_" + name, of_albedo, albedo, 1, {"sheen_albedo.glsl"}, defines, visibility, true});
    if (visibility != Visibility::Refined) {
      all.push_back({"sheen_albedo_fit_" + name, of_albedo, albedo, 1, {"sheen_albedo_fit.glsl"}, defines, {}, true});
    }
  }
}

void add_scaling(std::vector<ShaderFunction>& all) {
  for (const albedo::AlbedoScaling scaling : {albedo::AlbedoScaling::Full, albedo::AlbedoScaling::View, albedo::AlbedoScaling::Literal}) {
    const std::string name = scaling_name(scaling);
    const bool view = scaling == albedo::AlbedoScaling::View;
    all.push_back({"albedo_scaling_" + name,
                   {"vec3 sheenColor", "float sheenRoughness", "float NdotL", "float NdotV"},
                   view ? "sheen_albedo_scaling(sheenColor, sheenRoughness, NdotV)"
                        : "sheen_albedo_scaling(sheenColor, sheenRoughness, NdotL, NdotV)",
                   1,
                   {"sheen_albedo.glsl", "albedo_scaling.glsl"},
                   {"ALBEDO_SCALING_" + upper(name)},
                   Visibility::Charlie,
                   true});
  }
}

/// A point under one light with every layer, of smooth normals: the coat sees the geometry's.
void add_whole(std::vector<ShaderFunction>& all) {
  Words files{"layer_view.glsl", "fresnel.glsl", "specular_ggx.glsl", "base.glsl", "sheen_distribution.glsl"};
  files = joined(joined(std::move(files), sheen_visibility_files(Visibility::Charlie)),
                 {"sheen.glsl", "sheen_albedo.glsl", "albedo_scaling.glsl", "clearcoat.glsl", "layers.glsl"});
  all.push_back({"reflected_light",
                 {"vec3 N", "vec3 V", "vec3 L", "vec3 baseColor", "float metallic", "float roughness", "vec3 sheenColor",
                  "float sheenRoughness", "float clearcoat", "float clearcoatRoughness"},
                 "reflected_light(Surface(layer_view(N, V), BaseMaterial(baseColor, metallic, roughness * roughness), roughness, "
                 "SheenMaterial(sheenColor, sheenRoughness, sheen_visibility_of_view(layer_view(N, V).NdotV, sheenRoughness)), "
                 "layer_view(N, V), clearcoat_weight(clearcoat, layer_view(N, V).NdotV), clearcoatRoughness, "
                 "clearcoatRoughness * clearcoatRoughness), L)",
                 3,
                 std::move(files),
                 {"SHEEN", smallest_sheen_roughness_define, "VISIBILITY_CHARLIE", "ALBEDO_SCALING_FULL", "CLEARCOAT"},
                 Visibility::Charlie,
                 true});
}

}  // namespace

int ShaderFunction::scalars() const {
  int count = 0;
  for (const std::string& declaration : arguments) {
    count += components(declaration);
  }
  return count;
}

const std::vector<ShaderFunction>& shader_functions() {
  static const std::vector<ShaderFunction> all = [] {
    std::vector<ShaderFunction> made;
    add_operations(made);
    add_base(made);
    add_sheen(made);
    add_scaling(made);
    add_whole(made);
    return made;
  }();
  return all;
}

const ShaderFunction& shader_function(const std::string& name) {
  const auto& all = shader_functions();
  const auto found = std::find_if(all.begin(), all.end(), [&](const ShaderFunction& f) { return f.name == name; });
  if (found == all.end()) {
    throw std::invalid_argument("unknown function '" + name + "'");
  }
  return *found;
}

ShaderPlan plan_function(const ShaderFunction& function, const Settings& settings) {
  ShaderPlan plan;
  plan.vertex_file = "fullscreen.vert";
  plan.defines = shading_limits(settings.precision);
  plan.defines.emplace_back(formulation_define(settings.formulation));
  plan.defines.insert(plan.defines.end(), function.defines.begin(), function.defines.end());
  plan.sheen_albedo_table = function.table.has_value();
  plan.fragment_files.push_back(shader_file("common.glsl"));
  for (const std::string& file : function.files) {
    plan.fragment_files.push_back(shader_file(file));
  }
  return plan;
}

std::string function_main(const ShaderFunction& function, const Settings& settings) {
  std::string text = R"(precision highp float;
uniform sampler2D u_arguments;
uniform int u_rows;
layout(location = 0) out vec4 out_value;

float argument(int i) {
    ivec2 pixel = ivec2(gl_FragCoord.x, u_rows - 1 - int(gl_FragCoord.y));
    return texelFetch(u_arguments, pixel + ivec2(0, u_rows * (i >> 2)), 0)[i & 3];
}

)";
  const bool mediump = settings.precision == Precision::Mediump && !function.highp_call;
  text += std::string(mediump ? "precision mediump float;\n" : "") + "void main() {\n";
  int next = 0;
  for (const std::string& declaration : function.arguments) {
    const int count = components(declaration);
    text += "    " + declaration + " = " + (count == 3 ? "vec3(" : "float(");
    for (int i = 0; i < count; ++i) {
      text += std::string(i == 0 ? "" : ", ") + "argument(" + std::to_string(next++) + ")";
    }
    text += ");\n";
  }
  const std::string rest = function.channels == 3 ? ", 1.0);\n}\n" : ", 0.0, 0.0, 1.0);\n}\n";
  return text + "    out_value = vec4(" + function.call + rest;
}

}  // namespace sheen::renderer
