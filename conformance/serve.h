#pragma once

#include <functional>
#include <iosfwd>
#include <string>

namespace sheen::scene {
struct Scene;
}
namespace sheen::renderer {
struct Settings;
}

namespace sheen::conformance {

struct ServeOptions {
  std::string context = "osmesa";   ///< "osmesa" or "egl"
  std::string precision = "highp";  ///< "highp" or "mediump": what a request that does not say gets
  /// Called before each picture is drawn, with the scene as read and the settings as asked for: how a test makes a viewer that errs on
  /// purpose. Empty: they stay as they are.
  std::function<void(scene::Scene&, renderer::Settings&)> alter{};
};

/// Our renderer as a viewer (README, "Viewer protocol"): writes the hello line, then answers each request line until `in` ends. A
/// request that cannot be drawn is answered `failed` with the reason and the loop goes on. Beyond the protocol, a request may hold
/// `settings` {model, visibility, albedo_scaling, precision, formulation, environment_samples (a number; 0: filtered beforehand),
/// environment_replicas (so many pictures of as many directions each, see draw_replicas(); 0: one)}, and the
/// hello line holds `context` {renderer, version, mediump_bits, subpixel_bits}. A request with `function` in the place of `scene` names a
/// function of renderer/functions.h and, as `arguments`, a picture of what it takes (FunctionEvaluator); it is answered with what it gives.
/// Throws gles::Unavailable when there is no such context
/// (before the hello line), std::invalid_argument for an unknown option.
void serve(std::istream& in, std::ostream& out, const ServeOptions& options);

}  // namespace sheen::conformance
