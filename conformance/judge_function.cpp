#include "conformance/judge_function.h"

#include <exception>

#include "conformance/function_findings.h"
#include "conformance/function_samples.h"
#include "conformance/shading_words.h"
#include "image/io.h"

namespace sheen::conformance {
namespace {

void judge_values(const FunctionCase& one, const FunctionSamples& samples, const Answer& answer, CaseResult& result) {
  const image::Image measured = image::read(answer.image);
  if (measured.width != one.width || measured.height != one.height || measured.channels.size() < 3) {
    result.message = "the result is not " + std::to_string(one.width) + " x " + std::to_string(one.height) + " of R G B";
    return;
  }
  const std::vector<SampleError> errors = hold_to_promises(samples, measured);
  result.verdict = judge_samples(samples, errors, one.width);
  result.status = result.verdict->status;
  result.message = result.verdict->message;
  result.findings = std::make_shared<const FunctionFindings>(find(one, samples, errors));
}

}  // namespace

CaseResult judge_function(const FunctionCase& one, const std::function<Answer(const FunctionRequest&)>& evaluate, const Hello& hello,
                          const std::filesystem::path& images) {
  CaseResult result;
  result.name = one.name;
  result.model = describe(one);
  result.width = one.width;
  result.height = one.height;
  if (!hello.evaluates_functions()) {
    result.status = Status::Unsupported;
    result.message = "the viewer draws scenes and evaluates no function alone";
    return result;
  }
  try {
    const FunctionSamples samples = make_samples(one);
    const std::filesystem::path arguments = images / (one.name + ".arguments.exr");
    image::write(arguments, argument_picture(samples, one.width, one.height));
    result.scene_file = arguments;
    const Answer answer = evaluate({one.function, arguments, one.width, one.height, images / (one.name + ".candidate.exr"),
                                    to_string(one.precision), to_string(one.formulation)});
    result.seconds = answer.seconds;
    if (answer.status != AnswerStatus::Rendered) {
      result.status = status_of(answer.status);
      result.message = answer.message.empty() ? "the viewer says so" : answer.message;
      return result;
    }
    judge_values(one, samples, answer, result);
  } catch (const std::exception& error) {
    result.status = Status::Invalid;
    result.message = error.what();
  }
  return result;
}

}  // namespace sheen::conformance
