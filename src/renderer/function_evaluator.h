#pragma once

#include <memory>
#include <string>

#include "gles/context.h"
#include "image/image.h"
#include "renderer/renderer.h"

namespace sheen::renderer {

/// Evaluates functions of shaders/ one by one, outside any picture. Programs and tables are made when first needed and kept.
class FunctionEvaluator {
 public:
  /// The context must stay alive; it is made current by every call.
  explicit FunctionEvaluator(gles::Context& context);
  ~FunctionEvaluator();

  /// What a function of renderer/functions.h gives at every pixel's arguments: channels R G B A, those that it does not fill 0 and A 1.
  /// @param arguments  channels R G B A; `rows` rows for every four numbers of a pixel's arguments, the first four first
  /// @param settings   precision and formulation are followed
  /// Throws std::invalid_argument for an unknown function or arguments of another size than it takes, gles::Error.
  image::Image evaluate(const std::string& function, const image::Image& arguments, int rows, const Settings& settings);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sheen::renderer
