#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "albedo/sheen_model.h"
#include "conformance/child_process.h"

namespace sheen::conformance {

/// How a viewer writes its pictures: linear floats (EXR or PFM), or 8-bit sRGB codes (PNG).
enum class Encoding { LinearFloat, Srgb8 };

/// What a viewer says of itself in its first line.
struct Hello {
  std::string name;
  std::string version;
  std::vector<std::string> capabilities;
  Encoding encoding = Encoding::LinearFloat;
  std::string renderer;         ///< of its GL context; empty when it does not say
  std::string context_version;  ///< GL_VERSION; empty when it does not say
  std::optional<int> mediump_bits;
  int subpixel_bits = 4;  ///< what OpenGL ES 3.0.6 promises at least, when it does not say

  /// Whether it is our own, which is held to derived bounds alone.
  bool is_ours() const { return name == "sheen-cts"; }
  /// Whether it takes the form of the model from a request's `settings`.
  bool takes_settings() const;
  /// Whether it says that its pictures went through a tone mapping.
  bool maps_tones() const;
  /// Whether it evaluates functions alone.
  bool evaluates_functions() const;

 private:
  bool can(const std::string& capability) const;
};

/// One picture to ask for.
struct Request {
  std::filesystem::path scene;
  int camera = 0;
  int width = 0;
  int height = 0;
  std::filesystem::path output;
  albedo::SheenModel model;
  std::string precision{};              ///< "highp", "mediump"; empty: the viewer's own
  std::filesystem::path environment{};  ///< an equirect; empty: none
  int environment_samples = 0;          ///< for a viewer that takes settings
  int environment_replicas = 0;         ///< for our own; 0: none is asked for
};

/// A function to be evaluated by a viewer that can: one of renderer/functions.h.
struct FunctionRequest {
  std::string function;
  std::filesystem::path arguments;  ///< as renderer::FunctionEvaluator takes them
  int width = 0;                    ///< of the result, in pixels
  int height = 0;
  std::filesystem::path output;
  std::string precision;    ///< "highp", "mediump"
  std::string formulation;  ///< "literal", "stable"
};

enum class AnswerStatus { Rendered, Unsupported, Failed, Crash, Timeout, Invalid };

struct Answer {
  AnswerStatus status = AnswerStatus::Invalid;
  std::filesystem::path image;  ///< when rendered
  double seconds = 0;           ///< as the viewer measured, else as the client did
  std::string message;          ///< the viewer's own, or what went wrong with it
};

struct ViewerLimits {
  double start_seconds = 60;
  double case_seconds = 30;
};

/// A viewer under test, reached through the viewer protocol (README). One that dies, hangs or answers out of turn is ended and started
/// again for the next request.
class Viewer {
 public:
  /// Starts it and reads its first line. Throws ViewerUnavailable (conformance/run.h).
  Viewer(std::vector<std::string> command, const ViewerLimits& limits);
  ~Viewer();

  const Hello& hello() const { return hello_; }
  Answer draw(const Request& request);
  Answer evaluate(const FunctionRequest& request);
  /// Ends it in order: its input is closed and it is given a few seconds.
  void finish();

 private:
  void start();
  Answer ask(nlohmann::json request, const std::filesystem::path& output);
  Answer exchange(const nlohmann::json& request, const std::string& id, const std::filesystem::path& output);
  Answer interpret(const std::string& line, const std::string& id, const std::filesystem::path& output, double seconds);
  Answer lost(AnswerStatus status, const std::string& what, double grace_seconds, double seconds);

  std::vector<std::string> command_;
  ViewerLimits limits_;
  Hello hello_;
  std::unique_ptr<ChildProcess> child_;
  unsigned long serial_ = 0;
  int failed_starts_ = 0;
};

/// Reads a hello line. Throws std::runtime_error saying what is wrong with it.
Hello parse_hello(const std::string& line);

}  // namespace sheen::conformance
