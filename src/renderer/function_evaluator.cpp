#include "renderer/function_evaluator.h"

#include <map>
#include <stdexcept>
#include <vector>

#include "gles/objects.h"
#include "renderer/assembly.h"
#include "renderer/functions.h"
#include "renderer/program.h"
#include "renderer/target.h"
#include "renderer/textures.h"

namespace sheen::renderer {
namespace {

std::vector<glm::vec4> texels_of(const image::Image& arguments) {
  std::vector<glm::vec4> texels;
  texels.reserve(arguments.data.size() / 4);
  for (std::size_t i = 0; i < arguments.data.size(); i += 4) {
    texels.emplace_back(arguments.data[i], arguments.data[i + 1], arguments.data[i + 2], arguments.data[i + 3]);
  }
  return texels;
}

void check_arguments(const ShaderFunction& function, const image::Image& arguments, int rows) {
  if (arguments.channels != std::vector<std::string>{"R", "G", "B", "A"}) {
    throw std::invalid_argument("the arguments of " + function.name + " must have the channels R G B A");
  }
  const int texels = (function.scalars() + 3) / 4;
  if (rows < 1 || arguments.height != rows * texels) {
    throw std::invalid_argument(function.name + " takes " + std::to_string(function.scalars()) +
                                " numbers a pixel: " + std::to_string(texels) + " rows of texels for each of " + std::to_string(rows) +
                                ", not " + std::to_string(arguments.height));
  }
}

}  // namespace

struct FunctionEvaluator::Impl {
  explicit Impl(gles::Context& context_) : context(context_) {}

  const Program& program(const ShaderFunction& function, const Settings& settings) {
    ShaderText text = assemble(plan_function(function, settings), settings);
    text.fragment += function_main(function, settings);
    const auto found = programs.find(text.fragment);
    return found != programs.end() ? found->second : programs.emplace(text.fragment, Program(context.gl(), text)).first->second;
  }

  GLuint table(albedo::Visibility visibility) {
    auto found = tables.find(visibility);
    if (found == tables.end()) {
      found = tables.emplace(visibility, upload_table(context.gl(), albedo::build_table(visibility))).first;
    }
    return found->second.name();
  }

  gles::Context& context;
  std::map<std::string, Program> programs;
  std::map<albedo::Visibility, gles::Texture> tables;
};

FunctionEvaluator::FunctionEvaluator(gles::Context& context) : impl_(std::make_unique<Impl>(context)) {}

FunctionEvaluator::~FunctionEvaluator() {
  try {
    const gles::CurrentScope scope(impl_->context);
    impl_.reset();
  } catch (const gles::Error&) {
    // A context that can no longer be made current has taken its objects with it.
  }
}

image::Image FunctionEvaluator::evaluate(const std::string& name, const image::Image& arguments, int rows, const Settings& settings) {
  const ShaderFunction& function = shader_function(name);
  check_arguments(function, arguments, rows);
  const gles::CurrentScope scope(impl_->context);
  const gles::Functions& gl = impl_->context.gl();
  const Program& program = impl_->program(function, settings);
  const GLuint table = function.table ? impl_->table(*function.table) : 0;
  const gles::Texture texture = upload_floats(gl, "the arguments of " + name, arguments.width, arguments.height, texels_of(arguments));
  const Target target(impl_->context, arguments.width, rows);
  target.begin();
  gl.Disable(GL_DEPTH_TEST);
  gl.Disable(GL_CULL_FACE);
  gl.Disable(GL_BLEND);
  program.use();
  gl.ActiveTexture(GL_TEXTURE0);
  gl.BindTexture(GL_TEXTURE_2D, texture.name());
  program.set("u_arguments", 0);
  program.set("u_rows", rows);
  if (table != 0) {
    gl.ActiveTexture(GL_TEXTURE0 + 1);
    gl.BindTexture(GL_TEXTURE_2D, table);
    program.set("u_sheen_albedo", 1);
  }
  const gles::VertexArray nothing(gl);
  gl.BindVertexArray(nothing.name());
  gl.DrawArrays(GL_TRIANGLES, 0, 3);
  gles::check(gl, "evaluating " + name);
  return target.read();
}

}  // namespace sheen::renderer
