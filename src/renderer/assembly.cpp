#include "renderer/assembly.h"

#include <stdexcept>

#include "renderer/shader_sources.h"

namespace sheen::renderer {
namespace {

const std::string& file_text(const std::string& name, const Settings& settings) {
  if (settings.shader_files != nullptr) {
    const auto stand_in = settings.shader_files->find(name);
    if (stand_in != settings.shader_files->end()) {
      return stand_in->second;
    }
  }
  const auto found = shader_sources().find(name);
  if (found == shader_sources().end()) {
    throw std::logic_error("no shader file " + name);
  }
  return found->second;
}

std::string header(const ShaderPlan& plan) {
  std::string text = "#version 300 es\nprecision highp float;\nprecision highp int;\nprecision highp sampler2D;\n";
  for (const std::string& define : plan.defines) {
    const std::size_t equals = define.find('=');
    text.append("#define ").append(define, 0, equals);
    if (equals != std::string::npos) {
      text.append(1, ' ').append(define, equals + 1);
    }
    text.append(1, '\n');
  }
  return text;
}

}  // namespace

ShaderText assemble(const ShaderPlan& plan, const Settings& settings) {
  ShaderText text{header(plan) + file_text(plan.vertex_file, settings), header(plan)};
  bool mediump = false;
  for (const ShaderFile& file : plan.fragment_files) {
    const bool wanted = file.shading && settings.precision == Precision::Mediump;
    if (wanted != mediump) {
      text.fragment += wanted ? "precision mediump float;\n" : "precision highp float;\n";
    }
    mediump = wanted;
    text.fragment += "// " + file.name + "\n" + file_text(file.name, settings);
  }
  return text;
}

}  // namespace sheen::renderer
