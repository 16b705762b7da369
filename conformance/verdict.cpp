#include "conformance/verdict.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include "conformance/code_rounding.h"
#include "conformance/nearest_rank.h"
#include "conformance/replicas.h"

namespace sheen::conformance {
namespace {

/// Index of Verdict::excluded_by.
constexpr std::size_t unpromised_pixels = 4;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Channel indices, found once.
struct Channels {
  std::array<int, 4> candidate{};  // R G B A; A may be -1
  std::array<int, 4> golden{};
  std::array<int, 4> bound{};
  std::array<int, 3> standard_error{};  // of the candidate
  std::array<int, 3> direction{};       // of the golden
  int excluded = -1;
  int mirrored = -1;

  Channels(const image::Image& candidate_image, const image::Image& golden_image) {
    const std::array<const char*, 4> names = {"R", "G", "B", "A"};
    const std::array<const char*, 4> bounds = {"bound.R", "bound.G", "bound.B", "bound.A"};
    const std::array<const char*, 3> errors = {"standard_error.R", "standard_error.G", "standard_error.B"};
    const std::array<const char*, 3> directions = {"direction.R", "direction.G", "direction.B"};
    for (std::size_t c = 0; c < 3; ++c) {
      standard_error.at(c) = candidate_image.channel(errors.at(c));
      direction.at(c) = golden_image.channel(directions.at(c));
    }
    for (std::size_t c = 0; c < 4; ++c) {
      candidate.at(c) = candidate_image.channel(names.at(c));
      golden.at(c) = golden_image.channel(names.at(c));
      bound.at(c) = golden_image.channel(bounds.at(c));
    }
    excluded = golden_image.channel("excluded");
    mirrored = golden_image.channel("mirrored");
  }
  bool candidate_complete() const { return candidate[0] >= 0 && candidate[1] >= 0 && candidate[2] >= 0; }
  bool golden_complete() const {
    return std::all_of(golden.begin(), golden.end(), [](int c) { return c >= 0; }) &&
           std::all_of(bound.begin(), bound.end(), [](int c) { return c >= 0; }) && excluded >= 0;
  }
};

/// One channel of one pixel, ready to be judged.
struct Sample {
  double error = 0;
  double bound = 0;
  double reference = 0;

  /// An error of 0 is within any bound; an error that is not a number is within none, and a bound that is not finite forgives nothing.
  double ratio() const {
    if (error == 0) {
      return 0;
    }
    return std::isfinite(error) && std::isfinite(bound) && bound > 0 ? error / bound : infinity;
  }
  double relative() const { return error / std::max(std::abs(reference), 1e-3); }
};

class Judge {
 public:
  Judge(const image::Image& candidate, const image::Image& golden, const VerdictRules& rules)
      : candidate_(candidate), golden_(golden), rules_(rules), channels_(candidate, golden) {}

  const Channels& channels() const { return channels_; }

  bool covered(int x, int y) const {
    return golden_.at(x, y, channels_.golden[3]) > 0 || (channels_.candidate[3] >= 0 && candidate_.at(x, y, channels_.candidate[3]) > 0);
  }
  bool excluded(int x, int y) const { return golden_.at(x, y, channels_.excluded) > 0; }
  bool mirrored(int x, int y) const {
    return rules_.leave_out_mirrored && channels_.mirrored >= 0 && golden_.at(x, y, channels_.mirrored) > 0;
  }
  bool finite(int x, int y) const {
    return std::all_of(channels_.candidate.begin(), channels_.candidate.end(),
                       [&](int c) { return c < 0 || std::isfinite(candidate_.at(x, y, c)); });
  }
  bool negative(int x, int y) const {
    for (std::size_t c = 0; c < 3; ++c) {
      const bool expected = rules_.may_be_negative && (excluded(x, y) || sample(x, y, c).reference < sample(x, y, c).bound);
      if (candidate_.at(x, y, channels_.candidate.at(c)) < 0 && golden_.at(x, y, channels_.golden.at(c)) >= 0 && !expected) {
        return true;
      }
    }
    return false;
  }
  std::size_t exclusion(int x, int y) const {
    return static_cast<std::size_t>(std::clamp(golden_.at(x, y, channels_.excluded), 0.0F, 4.0F));
  }
  /// The brightest channel of the golden, and its bound.
  Sample brightest(int x, int y) const {
    std::array<Sample, 3> colors = {sample(x, y, 0), sample(x, y, 1), sample(x, y, 2)};
    return *std::max_element(colors.begin(), colors.end(), [](const Sample& a, const Sample& b) { return a.reference < b.reference; });
  }
  std::size_t channel_count() const { return channels_.candidate[3] >= 0 ? 4 : 3; }

  Sample sample(int x, int y, std::size_t c) const {
    const double value = candidate_.at(x, y, channels_.candidate.at(c));
    Sample s;
    s.reference = golden_.at(x, y, channels_.golden.at(c));
    s.bound = golden_.at(x, y, channels_.bound.at(c));
    if (c < 3) {
      s.bound += rules_.relative_tolerance * std::abs(s.reference) + rules_.absolute_tolerance;
      s.bound += rules_.environment_tolerance * std::max(std::abs(s.reference), 1e-3);
      if (rules_.standard_errors > 0 && channels_.standard_error.at(c) >= 0) {
        const double shown = rules_.standard_errors * candidate_.at(x, y, channels_.standard_error.at(c));
        const int direction = channels_.direction.at(c);
        s.bound += direction < 0 ? shown : granted_to_chance(shown, s.reference, golden_.at(x, y, direction) / environment_replicas);
      }
    }
    if (rules_.golden_is_pxr24) {
      s.bound += std::abs(s.reference) * 0x1p-16;
    }
    if (rules_.candidate_is_srgb8) {
      s.reference = std::min(s.reference, 1.0);
      s.bound += c < 3 ? color_rounding(value, alpha(x, y)) : alpha_rounding;
    }
    s.error = std::abs(value - s.reference);
    return s;
  }

 private:
  double alpha(int x, int y) const {
    return channels_.candidate[3] >= 0 ? static_cast<double>(candidate_.at(x, y, channels_.candidate[3])) : 1.0;
  }

  const image::Image& candidate_;
  const image::Image& golden_;
  VerdictRules rules_;
  Channels channels_;
};

std::string size_of(const image::Image& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height);
}

Verdict invalid(const std::string& message) {
  Verdict verdict;
  verdict.message = message;
  return verdict;
}

bool covers_any(const image::Image& image, int alpha) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.at(x, y, alpha) > 0) {
        return true;
      }
    }
  }
  return false;
}

std::int64_t count_vague(const Judge& judge, const image::Image& golden) {
  double sum = 0;
  std::vector<Sample> compared;
  for (int y = 0; y < golden.height; ++y) {
    for (int x = 0; x < golden.width; ++x) {
      if (judge.covered(x, y) && !judge.excluded(x, y) && !judge.mirrored(x, y)) {
        compared.push_back(judge.brightest(x, y));
        sum += compared.back().reference;
      }
    }
  }
  // GLSL ES 3.00.6, section 4.5.1: values below the least normal number may be flushed to zero, so nothing that small shows.
  const double shows = std::max(0.1 * sum / static_cast<double>(std::max<std::size_t>(compared.size(), 1)), 0x1p-126);
  return std::count_if(compared.begin(), compared.end(), [&](const Sample& s) { return s.bound > s.reference && s.bound > shows; });
}

void measure(const Judge& judge, const image::Image& golden, Verdict& verdict) {
  std::vector<double> relative;
  std::vector<double> bounds;
  for (int y = 0; y < golden.height; ++y) {
    for (int x = 0; x < golden.width; ++x) {
      const bool finite = judge.finite(x, y);
      if (!finite) {
        ++verdict.nonfinite_pixels;
      }
      if (judge.negative(x, y)) {
        ++verdict.negative_pixels;
      }
      if (!judge.covered(x, y)) {
        continue;
      }
      if (judge.excluded(x, y)) {
        ++verdict.excluded_pixels;
        ++verdict.excluded_by.at(judge.exclusion(x, y));
        continue;
      }
      if (judge.mirrored(x, y)) {
        ++verdict.mirrored_pixels;
        continue;
      }
      ++verdict.compared_pixels;
      if (!finite) {
        continue;
      }
      for (std::size_t c = 0; c < judge.channel_count(); ++c) {
        const Sample sample = judge.sample(x, y, c);
        verdict.max_abs = std::max(verdict.max_abs, sample.error);
        verdict.max_rel = std::max(verdict.max_rel, sample.relative());
        relative.push_back(sample.relative());
        if (c < 3) {
          bounds.push_back(sample.bound / std::max(std::abs(sample.reference), 1e-3));
        }
        if (sample.ratio() > verdict.bound_ratio || verdict.worst_x < 0) {
          verdict.bound_ratio = sample.ratio();
          verdict.worst_x = x;
          verdict.worst_y = y;
        }
      }
    }
  }
  verdict.p99_rel = nearest_rank(relative, 0.99);
  verdict.median_bound = nearest_rank(bounds, 0.5);
  verdict.vague_pixels = count_vague(judge, golden);
}

/// "1205 of 4096 covered pixels are excluded, more than may be: 1200 ..."
std::string too_many_excluded(const Verdict& verdict, std::int64_t covered) {
  std::string text =
      std::to_string(verdict.excluded_pixels) + " of " + std::to_string(covered) + " covered pixels are excluded, more than may be";
  constexpr std::array<const char*, 5> reasons = {nullptr, "at edges", "where an alpha mask may fall either way",
                                                  "where a texture without mipmaps under an environment is seen from too far",
                                                  "where the rules of GLSL ES promise nothing"};
  std::string parts;
  for (std::size_t reason = 1; reason < reasons.size(); ++reason) {
    if (verdict.excluded_by.at(reason) > 0) {
      parts += (parts.empty() ? ": " : ", ") + std::to_string(verdict.excluded_by.at(reason)) + " " + reasons.at(reason);
    }
  }
  return text + parts;
}

void decide(const VerdictRules& rules, Verdict& verdict) {
  const std::int64_t covered = verdict.compared_pixels + verdict.excluded_pixels + verdict.mirrored_pixels;
  const std::int64_t unpromised = rules.leave_out_unpromised ? verdict.excluded_by[unpromised_pixels] : 0;
  if (verdict.nonfinite_pixels > 0) {
    verdict.status = Status::Fail;
    verdict.message = std::to_string(verdict.nonfinite_pixels) + " pixels are NaN or Inf";
  } else if (verdict.negative_pixels > 0) {
    verdict.status = Status::Fail;
    verdict.message = std::to_string(verdict.negative_pixels) + " pixels are negative where the golden is not";
  } else if (!(verdict.bound_ratio <= 1)) {
    verdict.status = Status::Fail;
    verdict.message = "the pixel at " + std::to_string(verdict.worst_x) + ", " + std::to_string(verdict.worst_y) + " is off by " +
                      (std::isfinite(verdict.bound_ratio) ? std::to_string(verdict.bound_ratio) + " times" : "more than any multiple of") +
                      " its bound";
  } else if (covered == 0) {
    verdict.message = "neither image covers a pixel";
  } else if (verdict.compared_pixels == 0 && unpromised == 0) {
    verdict.message = "every covered pixel is left out of the comparison: " + too_many_excluded(verdict, covered);
  } else if (static_cast<double>(verdict.excluded_pixels - unpromised) > rules.most_excluded * static_cast<double>(covered)) {
    verdict.message = too_many_excluded(verdict, covered);
  } else if (static_cast<double>(verdict.vague_pixels) > rules.most_vague * static_cast<double>(verdict.compared_pixels)) {
    verdict.message = "at " + std::to_string(verdict.vague_pixels) + " of " + std::to_string(verdict.compared_pixels) +
                      " compared pixels the bound would let black pass: this scene leaves too much to the driver to judge by it";
  } else {
    verdict.status = Status::Pass;
    if (unpromised > 0) {
      verdict.message = "of " + percent(static_cast<double>(unpromised) / static_cast<double>(covered)) +
                        " of the covered pixels the rules of GLSL ES promise no more than that they be finite and not negative";
    }
  }
}

}  // namespace

std::string to_string(Status status) {
  switch (status) {
    case Status::Pass:
      return "pass";
    case Status::Approximation:
      return "approximation";
    case Status::Fail:
      return "fail";
    case Status::Unsupported:
      return "unsupported";
    case Status::Crash:
      return "crash";
    case Status::Timeout:
      return "timeout";
    case Status::Invalid:
      break;
  }
  return "invalid";
}

std::string percent(double share) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g %%", 100.0 * share);
  return text.data();
}

Verdict judge(const image::Image& candidate, const image::Image& golden, const VerdictRules& rules) {
  if (candidate.width != golden.width || candidate.height != golden.height) {
    return invalid("the picture is " + size_of(candidate) + ", asked for was " + size_of(golden));
  }
  const Judge judge(candidate, golden, rules);
  if (!judge.channels().candidate_complete()) {
    return invalid("the picture lacks one of R, G, B");
  }
  if (!judge.channels().golden_complete()) {
    return invalid("the golden lacks a channel");
  }
  if (!std::all_of(golden.data.begin(), golden.data.end(), [](float v) { return std::isfinite(v); })) {
    return invalid("the golden or its bound is NaN or Inf somewhere");
  }
  Verdict verdict;
  measure(judge, golden, verdict);
  if (!covers_any(golden, judge.channels().golden[3])) {
    verdict.message = "the golden covers no pixel";
    return verdict;
  }
  decide(rules, verdict);
  return verdict;
}

std::vector<double> ratio_map(const image::Image& candidate, const image::Image& golden, const VerdictRules& rules) {
  std::vector<double> map(static_cast<std::size_t>(golden.width) * static_cast<std::size_t>(golden.height), 0.0);
  const Judge judge(candidate, golden, rules);
  if (candidate.width != golden.width || candidate.height != golden.height || !judge.channels().candidate_complete() ||
      !judge.channels().golden_complete()) {
    return map;
  }
  for (int y = 0; y < golden.height; ++y) {
    for (int x = 0; x < golden.width; ++x) {
      double& ratio = map[static_cast<std::size_t>(y) * static_cast<std::size_t>(golden.width) + static_cast<std::size_t>(x)];
      if (!judge.finite(x, y)) {
        ratio = infinity;
      } else if (judge.covered(x, y) && (judge.excluded(x, y) || judge.mirrored(x, y))) {
        ratio = -1;
      } else if (judge.covered(x, y)) {
        for (std::size_t c = 0; c < judge.channel_count(); ++c) {
          ratio = std::max(ratio, judge.sample(x, y, c).ratio());
        }
      }
    }
  }
  return map;
}

}  // namespace sheen::conformance
