#include "conformance/relate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "conformance/code_rounding.h"
#include "conformance/demands.h"
#include "conformance/nearest_rank.h"

namespace sheen::conformance {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// One channel of one pixel.
struct Sample {
  double counted = 0;
  double tolerance = 0;
  double reference = 0;  ///< of the first picture

  double ratio() const { return counted == 0 ? 0 : tolerance > 0 ? counted / tolerance : infinity; }
  double relative() const { return counted / std::max(std::abs(reference), 1e-3); }
};

image::Image turned(const image::Image& picture) {
  image::Image made = picture;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      for (int c = 0; c < static_cast<int>(picture.channels.size()); ++c) {
        made.at(x, y, c) = picture.at(picture.width - 1 - x, y, c);
      }
    }
  }
  return made;
}

/// The pictures, and which channels of them are looked at.
class Comparison {
 public:
  Comparison(const Relation& relation, std::vector<image::Image> pictures, const RelationRules& rules)
      : relation_(relation), rules_(rules), pictures_(std::move(pictures)) {
    for (std::size_t i = 1; i < pictures_.size() && relation.mirrored; ++i) {
      pictures_[i] = turned(pictures_[i]);
    }
    for (const image::Image& picture : pictures_) {
      channels_.push_back({picture.channel("R"), picture.channel("G"), picture.channel("B"), picture.channel("A")});
    }
    all_have_alpha_ = std::all_of(channels_.begin(), channels_.end(), [](const auto& c) { return c[3] >= 0; });
    left_ = static_cast<int>(std::floor(relation.region[0] * width()));
    top_ = static_cast<int>(std::floor(relation.region[1] * height()));
    right_ = static_cast<int>(std::ceil(relation.region[2] * width()));
    bottom_ = static_cast<int>(std::ceil(relation.region[3] * height()));
  }

  int width() const { return pictures_.front().width; }
  int height() const { return pictures_.front().height; }
  bool looks_at(int x, int y) const { return x >= left_ && x < right_ && y >= top_ && y < bottom_; }

  /// Why the pictures cannot be compared; empty when they can.
  std::string problem() const {
    const Case& asked = relation_.scenes.front();
    bool empty = true;
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
      const image::Image& picture = pictures_[i];
      if (picture.width != asked.width || picture.height != asked.height) {
        return "the picture of '" + relation_.labels[i] + "' is " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
               ", asked for was " + std::to_string(asked.width) + " x " + std::to_string(asked.height);
      }
      if (channels_[i][0] < 0 || channels_[i][1] < 0 || channels_[i][2] < 0) {
        return "the picture of '" + relation_.labels[i] + "' lacks one of R, G, B";
      }
      empty = empty && std::all_of(picture.data.begin(), picture.data.end(), [](float v) { return v == 0; });
    }
    return empty ? "every picture is empty" : "";
  }
  bool finite(int x, int y) const {
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
      for (const int c : channels_[i]) {
        if (c >= 0 && !std::isfinite(pictures_[i].at(x, y, c))) {
          return false;
        }
      }
    }
    return true;
  }
  bool left_out(int x, int y) const {
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
      if ((relation_.moved && at_edge(i, x, y)) || (rules_.srgb8 && relation_.kind == RelationKind::Linear && saturated(i, x, y))) {
        return true;
      }
    }
    return false;
  }
  std::size_t channel_count(const Demand& demand) const {
    return all_have_alpha_ && demand.must == Must::Vanish && relation_.kind == RelationKind::Equal ? 4 : 3;
  }
  double value(std::size_t i, int x, int y, std::size_t c) const { return pictures_[i].at(x, y, channels_[i].at(c)); }

  Sample sample(const Demand& demand, int x, int y, std::size_t c) const {
    Sample made;
    double sum = 0;
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
      if (demand.weights[i] != 0) {
        sum += demand.weights[i] * value(i, x, y, c);
        made.tolerance += std::abs(demand.weights[i]) * tolerance(i, x, y, c);
      }
    }
    made.counted = demand.counted(sum);
    made.reference = value(0, x, y, c);
    if (relation_.exact && rules_.ours) {
      made.tolerance = 0;
    }
    return made;
  }
  double ratio(const Demand& demand, int x, int y) const {
    double largest = 0;
    for (std::size_t c = 0; c < channel_count(demand); ++c) {
      largest = std::max(largest, sample(demand, x, y, c).ratio());
    }
    return largest;
  }

 private:
  double alpha(std::size_t i, int x, int y) const { return channels_[i][3] >= 0 ? static_cast<double>(value(i, x, y, 3)) : 1.0; }

  double tolerance(std::size_t i, int x, int y, std::size_t c) const {
    const double v = value(i, x, y, c);
    double t = relation_.relative * std::abs(v) + relation_.absolute;
    if (rules_.srgb8) {
      t += c < 3 ? color_rounding(v, alpha(i, x, y)) : alpha_rounding;
    }
    if (relation_.moved) {
      const double step = channels_[i][3] >= 0 ? 2 * std::exp2(-rules_.subpixel_bits) : 1.0;
      t += step * largest_step(i, x, y, c);
    }
    return t;
  }
  /// Calls `use` with the pixels around (x, y) that the picture has.
  template <class Use>
  void for_neighbours(int x, int y, const Use& use) const {
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height() - 1); ++j) {
      for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width() - 1); ++i) {
        use(i, j);
      }
    }
  }
  double largest_step(std::size_t i, int x, int y, std::size_t c) const {
    const double here = value(i, x, y, c);
    double largest = 0;
    for_neighbours(x, y, [&](int nx, int ny) {
      const double there = value(i, nx, ny, c);
      largest = std::isfinite(there) ? std::max(largest, std::abs(there - here)) : largest;
    });
    return largest;
  }
  bool at_edge(std::size_t i, int x, int y) const {
    bool edge = false;
    for_neighbours(x, y, [&](int nx, int ny) { edge = edge || alpha(i, nx, ny) != alpha(i, x, y); });
    return edge;
  }
  bool saturated(std::size_t i, int x, int y) const {
    const double full = alpha(i, x, y) * (1 - 1e-6);
    return full > 0 && (value(i, x, y, 0) >= full || value(i, x, y, 1) >= full || value(i, x, y, 2) >= full);
  }

  const Relation& relation_;
  RelationRules rules_;
  std::vector<image::Image> pictures_;
  std::vector<std::array<int, 4>> channels_;
  bool all_have_alpha_ = false;
  int left_ = 0, top_ = 0, right_ = 0, bottom_ = 0;
};

/// Where a demand is met worst, or what must exceed exceeds most.
struct Finding {
  double ratio = 0;
  int x = -1, y = -1;
  const Demand* demand = nullptr;
};

std::string triple(const Comparison& comparison, std::size_t i, const Finding& at) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "%.4g %.4g %.4g", comparison.value(i, at.x, at.y, 0), comparison.value(i, at.x, at.y, 1),
                comparison.value(i, at.x, at.y, 2));
  return text.data();
}

std::string number(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

/// "'with' and 'without' differ at pixel 3, 4 (0.1 0.1 0.1 against 0.2 0.2 0.2) by 12 times the tolerance".
std::string describe(const Relation& relation, const Comparison& comparison, const Finding& worst) {
  std::string names;
  std::string values;
  for (std::size_t i = 0; i < worst.demand->weights.size(); ++i) {
    const double weight = worst.demand->weights[i];
    if (weight != 0) {
      const bool plain = relation.kind != RelationKind::Linear || std::abs(weight) == 1;
      names += (names.empty() ? "" : " and ") + (plain ? "" : number(std::abs(weight)) + " x ") + "'" + relation.labels[i] + "'";
      values += (values.empty() ? "" : " against ") + triple(comparison, i, worst);
    }
  }
  const std::string place = "at pixel " + std::to_string(worst.x) + ", " + std::to_string(worst.y) + " (" + values + ")";
  const std::string share = number(100 * relation.share) + " % of the pixels";
  switch (worst.demand->must) {
    case Must::Vanish:
      return names +
             (std::isfinite(worst.ratio) ? " are off by " + number(worst.ratio) + " times the tolerance "
                                         : " are not the same to the bit ") +
             place;
    case Must::NotBePositive:
      return names + ": the first is brighter by " + number(worst.ratio) + " times the tolerance, and must not be, " + place;
    case Must::Differ:
      return names + " must differ in " + share + ", and do not; they differ most " + place;
    case Must::BePositive:
      break;
  }
  return names + ": the first must be brighter in " + share + ", and is not; it is most so " + place;
}

/// Looks at every pixel; returns the finding that decides.
Finding measure(const Relation& relation, const Comparison& comparison, const std::vector<Demand>& demands, Verdict& verdict) {
  std::vector<double> relative;
  Finding worst;
  for (const Demand& demand : demands) {
    Finding here{0, -1, -1, &demand};
    std::vector<double> ratios;
    verdict.compared_pixels = 0;
    verdict.excluded_pixels = 0;
    for (int y = 0; y < comparison.height(); ++y) {
      for (int x = 0; x < comparison.width(); ++x) {
        if (!comparison.looks_at(x, y) || !comparison.finite(x, y)) {
          continue;
        }
        if (comparison.left_out(x, y)) {
          ++verdict.excluded_pixels;
          continue;
        }
        ++verdict.compared_pixels;
        for (std::size_t c = 0; c < comparison.channel_count(demand); ++c) {
          const Sample sample = comparison.sample(demand, x, y, c);
          verdict.max_abs = std::max(verdict.max_abs, sample.counted);
          verdict.max_rel = std::max(verdict.max_rel, sample.relative());
          relative.push_back(sample.relative());
        }
        ratios.push_back(comparison.ratio(demand, x, y));
        if (ratios.back() > here.ratio || here.x < 0) {
          here.ratio = ratios.back();
          here.x = x;
          here.y = y;
        }
      }
    }
    if (!demand.holds_everywhere()) {
      // The share of the pixels that differ most: the least of them must still be over its tolerance.
      const double reached = nearest_rank(ratios, 1 - relation.share);
      here.ratio = reached > 0 ? 1 / reached : infinity;
    }
    if (here.ratio > worst.ratio || worst.demand == nullptr) {
      worst = here;
    }
  }
  verdict.p99_rel = nearest_rank(relative, 0.99);
  return worst;
}

void decide(const Relation& relation, const Comparison& comparison, const Finding& worst, Verdict& verdict) {
  verdict.bound_ratio = worst.ratio;
  verdict.worst_x = worst.x;
  verdict.worst_y = worst.y;
  const auto looked_at = static_cast<double>(verdict.compared_pixels + verdict.excluded_pixels);
  if (verdict.nonfinite_pixels > 0) {
    verdict.status = Status::Fail;
    verdict.message = std::to_string(verdict.nonfinite_pixels) + " pixels are NaN or Inf";
  } else if (verdict.compared_pixels == 0 || static_cast<double>(verdict.excluded_pixels) > most_left_out * looked_at) {
    verdict.message = std::to_string(verdict.excluded_pixels) + " pixels are left out, more than may be";
  } else if (!(worst.ratio <= 1)) {
    verdict.status = Status::Fail;
    verdict.message = describe(relation, comparison, worst);
  } else {
    verdict.status = Status::Pass;
  }
}

}  // namespace

Verdict relate(const Relation& relation, const std::vector<image::Image>& pictures, const RelationRules& rules) {
  Verdict verdict;
  const Comparison comparison(relation, pictures, rules);
  verdict.message = comparison.problem();
  if (!verdict.message.empty()) {
    return verdict;
  }
  for (int y = 0; y < comparison.height(); ++y) {
    for (int x = 0; x < comparison.width(); ++x) {
      verdict.nonfinite_pixels += comparison.finite(x, y) ? 0 : 1;
    }
  }
  const std::vector<Demand> demands = demands_of(relation, rules.tone_mapped);
  if (demands.empty() && verdict.nonfinite_pixels == 0) {
    verdict.status = Status::Unsupported;
    verdict.message = "a law of radiance, and this viewer maps tones";
    return verdict;
  }
  const Finding worst = measure(relation, comparison, demands, verdict);
  decide(relation, comparison, worst, verdict);
  return verdict;
}

std::vector<double> relation_map(const Relation& relation, const std::vector<image::Image>& pictures, const RelationRules& rules) {
  const Comparison comparison(relation, pictures, rules);
  const Case& asked = relation.scenes.front();
  std::vector<double> map(static_cast<std::size_t>(asked.width) * static_cast<std::size_t>(asked.height), 0.0);
  if (!comparison.problem().empty()) {
    return map;
  }
  const std::vector<Demand> demands = demands_of(relation, rules.tone_mapped);
  for (int y = 0; y < asked.height; ++y) {
    for (int x = 0; x < asked.width; ++x) {
      double& ratio = map[static_cast<std::size_t>(y) * static_cast<std::size_t>(asked.width) + static_cast<std::size_t>(x)];
      if (!comparison.finite(x, y)) {
        ratio = infinity;
      } else if (!comparison.looks_at(x, y) || comparison.left_out(x, y)) {
        ratio = -1;
      } else {
        for (const Demand& demand : demands) {
          ratio = std::max(ratio, comparison.ratio(demand, x, y));
        }
      }
    }
  }
  return map;
}

}  // namespace sheen::conformance
