#include "conformance/viewer.h"

#include <algorithm>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "conformance/case.h"
#include "conformance/json_text.h"
#include "conformance/run.h"
#include "scene/scene.h"

namespace sheen::conformance {
namespace {

using nlohmann::json;

/// A viewer that cannot be started this often in a row is not tried again.
constexpr int most_failed_starts = 3;

std::string shorten(std::string text) {
  constexpr std::size_t longest = 160;
  if (text.size() > longest) {
    text = text.substr(0, longest) + "...";
  }
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c >= 0x7f; }, '?');
  return text;
}

/// The last lines of what it wrote to standard error, as the end of a message.
std::string with_last_words(const std::string& message, const std::string& words) {
  std::string tail = words;
  while (!tail.empty() && (tail.back() == '\n' || tail.back() == '\r')) {
    tail.pop_back();
  }
  return tail.empty() ? message : message + "; its last words: " + scene::legible(tail);
}

std::string text_member(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

std::optional<int> integer_member(const json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number_integer()) {
    return std::nullopt;
  }
  return found->get<int>();
}

}  // namespace

bool Hello::takes_settings() const {
  return can("settings");
}

bool Hello::maps_tones() const {
  return can("tone-mapped");
}

bool Hello::evaluates_functions() const {
  return can("functions");
}

bool Hello::can(const std::string& capability) const {
  return std::find(capabilities.begin(), capabilities.end(), capability) != capabilities.end();
}

Hello parse_hello(const std::string& line) {
  const json root = json::parse(line, nullptr, false);
  if (root.is_discarded() || !root.is_object()) {
    throw std::runtime_error("its first line is no JSON object: " + shorten(line));
  }
  Hello hello;
  hello.name = text_member(root, "viewer");
  if (hello.name.empty()) {
    throw std::runtime_error("its first line names no viewer: " + shorten(line));
  }
  hello.version = root.contains("version") && root["version"].is_number() ? json_text(root["version"]) : text_member(root, "version");
  if (root.contains("capabilities") && root["capabilities"].is_array()) {
    for (const json& one : root["capabilities"]) {
      if (one.is_string()) {
        hello.capabilities.push_back(one.get<std::string>());
      }
    }
  }
  const std::string encoding = text_member(root, "encoding");
  if (encoding == "srgb-8bit") {
    hello.encoding = Encoding::Srgb8;
  } else if (encoding != "linear-float") {
    throw std::runtime_error("its encoding is neither linear-float nor srgb-8bit: " + shorten(line));
  }
  const json context = root.value("context", json::object());
  if (context.is_object()) {
    hello.renderer = text_member(context, "renderer");
    hello.context_version = text_member(context, "version");
    hello.mediump_bits = integer_member(context, "mediump_bits");
    // Fewer bits than the standard's least would buy tolerance that no conformant driver needs.
    hello.subpixel_bits = std::clamp(integer_member(context, "subpixel_bits").value_or(4), 4, 16);
  }
  return hello;
}

Viewer::Viewer(std::vector<std::string> command, const ViewerLimits& limits) : command_(std::move(command)), limits_(limits) {
  start();
}

Viewer::~Viewer() = default;

void Viewer::start() {
  std::unique_ptr<ChildProcess> child;
  const std::string who = "viewer '" + (command_.empty() ? std::string() : command_.front()) + "' ";
  try {
    child = std::make_unique<ChildProcess>(command_);
  } catch (const std::runtime_error& error) {
    throw ViewerUnavailable(std::string("viewer did not start: ") + error.what());
  }
  std::string line;
  switch (child->read_line(line, deadline_in(limits_.start_seconds))) {
    case ChildProcess::ReadStatus::Line:
      break;
    case ChildProcess::ReadStatus::Timeout:
      child->finish(0);
      throw ViewerUnavailable(with_last_words(who + "did not start: it said nothing within its time limit", child->last_words()));
    default: {
      const std::string ending = child->finish(2);
      throw ViewerUnavailable(with_last_words(who + "did not start: it " + ending + " before its first line", child->last_words()));
    }
  }
  try {
    hello_ = parse_hello(line);
  } catch (const std::runtime_error& error) {
    child->finish(0);
    throw ViewerUnavailable(with_last_words(who + "did not start: " + error.what(), child->last_words()));
  }
  child_ = std::move(child);
}

Answer Viewer::draw(const Request& request) {
  json line = {{"scene", request.scene.string()},
               {"environment", request.environment.empty() ? json(nullptr) : json(request.environment.string())},
               {"camera", request.camera},
               {"width", request.width},
               {"height", request.height},
               {"output", request.output.string()},
               {"settings", {{"visibility", to_string(request.model.visibility)}, {"albedo_scaling", to_string(request.model.scaling)}}}};
  if (!request.precision.empty()) {
    line["settings"]["precision"] = request.precision;
  }
  if (!request.environment.empty()) {
    line["settings"]["environment_samples"] = request.environment_samples;
    if (request.environment_replicas > 0) {
      line["settings"]["environment_replicas"] = request.environment_replicas;
    }
  }
  return ask(std::move(line), request.output);
}

Answer Viewer::evaluate(const FunctionRequest& request) {
  return ask({{"function", request.function},
              {"arguments", request.arguments.string()},
              {"width", request.width},
              {"height", request.height},
              {"output", request.output.string()},
              {"settings", {{"precision", request.precision}, {"formulation", request.formulation}}}},
             request.output);
}

Answer Viewer::ask(json request, const std::filesystem::path& output) {
  if (!child_) {
    if (failed_starts_ >= most_failed_starts) {
      return {AnswerStatus::Crash, {}, 0, "the viewer could not be started again"};
    }
    try {
      start();
      failed_starts_ = 0;
    } catch (const ViewerUnavailable& error) {
      ++failed_starts_;
      return {AnswerStatus::Crash, {}, 0, std::string("the viewer could not be started again: ") + error.what()};
    }
  }
  // A picture left from before must not be judged in the place of one that was not drawn.
  std::error_code ignored;
  std::filesystem::remove(output, ignored);
  const std::string id = std::to_string(++serial_);
  request["id"] = id;
  return exchange(request, id, output);
}

Answer Viewer::exchange(const json& request, const std::string& id, const std::filesystem::path& output) {
  const auto begin = std::chrono::steady_clock::now();
  const auto elapsed = [begin] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(); };
  const Deadline deadline = deadline_in(limits_.case_seconds);
  const bool written = child_->write_line(json_text(request), deadline);
  std::string answer;
  // A viewer that closed its input may still have said why.
  switch (child_->read_line(answer, written ? deadline : deadline_in(1))) {
    case ChildProcess::ReadStatus::Line:
      return interpret(answer, id, output, elapsed());
    case ChildProcess::ReadStatus::Timeout:
      return lost(AnswerStatus::Timeout, "no answer within " + json_text(json(limits_.case_seconds)) + " s", 0, elapsed());
    case ChildProcess::ReadStatus::TooLong:
      return lost(AnswerStatus::Invalid, "an answer without end", 0, elapsed());
    case ChildProcess::ReadStatus::Closed:
      break;
  }
  return lost(AnswerStatus::Crash, "", 1, elapsed());
}

/// Gives the viewer up; the next request starts it again.
Answer Viewer::lost(AnswerStatus status, const std::string& what, double grace_seconds, double seconds) {
  const std::string ending = child_->finish(grace_seconds);
  const std::string message = what.empty() ? "the viewer ended its output and " + ending : what;
  Answer answer{status, {}, seconds, with_last_words(message, child_->last_words())};
  child_.reset();
  return answer;
}

Answer Viewer::interpret(const std::string& line, const std::string& id, const std::filesystem::path& output, double seconds) {
  const json root = json::parse(line, nullptr, false);
  if (root.is_discarded() || !root.is_object()) {
    return lost(AnswerStatus::Invalid, "the answer is no JSON object: " + shorten(line), 0, seconds);
  }
  const auto found = root.find("id");
  const std::string answered = found == root.end() ? "" : found->is_string() ? found->get<std::string>() : json_text(*found);
  if (answered != id) {
    return lost(AnswerStatus::Invalid, "the answer is to request '" + shorten(answered) + "', not to '" + id + "'", 0, seconds);
  }
  Answer answer;
  answer.message = scene::legible(text_member(root, "message"));
  answer.seconds = root.contains("seconds") && root["seconds"].is_number() ? root["seconds"].get<double>() : seconds;
  const std::string status = text_member(root, "status");
  if (status == "rendered") {
    answer.status = AnswerStatus::Rendered;
    const std::string image = text_member(root, "image");
    answer.image = image.empty() ? output : std::filesystem::path(image);
  } else if (status == "unsupported") {
    answer.status = AnswerStatus::Unsupported;
  } else if (status == "failed") {
    answer.status = AnswerStatus::Failed;
  } else {
    answer.message = "the answer's status is none of rendered, unsupported, failed: " + shorten(line);
  }
  return answer;
}

void Viewer::finish() {
  if (child_) {
    child_->finish(5);
  }
  child_.reset();
}

}  // namespace sheen::conformance
