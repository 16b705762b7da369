#include "albedo/table_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <tbb/parallel_for.h>

#include "image/srgb.h"

namespace sheen::albedo {
namespace {

constexpr int min_side = 4;                 // below, a table has too few texels to tell readings apart
constexpr double min_variance = 1e-6;       // of compressed values; below, every texel is alike
constexpr double max_misfit = 0.16;         // noise of a sixth of the spread; other pictures stay above 0.22 (table_check_test.cpp)
constexpr double sure = 4;                  // standard errors by which a reading must be better than its rival
constexpr double alike = 2;                 // standard errors within which the simpler of two readings is taken
constexpr double tied_loss = 40;            // a rival is weighed where its loss is below 1 + 40 / sqrt(texels sampled) times the best's
constexpr int judged_sides[] = {128, 384};  // texels a side of the samples that settle near ties

/// One channel in one encoding.
struct Variant {
  std::vector<std::string> channels;
  TableEncoding encoding = TableEncoding::Linear;
  TablePlane plane;
  std::vector<ScoredReading> found;  ///< best first
  double misfit = std::numeric_limits<double>::infinity();
};

TablePlane plane_of(const image::Image& image, int channel) {
  TablePlane plane{image.width, image.height, {}};
  plane.values.reserve(image.data.size() / image.channels.size());
  for (auto i = static_cast<std::size_t>(channel); i < image.data.size(); i += image.channels.size()) {
    plane.values.push_back(image.data[i]);
  }
  return plane;
}

/// Every channel once, colour decoded from codes also as the plain codes, without what alpha was multiplied in.
std::vector<Variant> variants_of(const image::Image& image, bool from_codes) {
  std::vector<Variant> all;
  const int alpha = image.channel("A");
  for (int c = 0; c < static_cast<int>(image.channels.size()); ++c) {
    TablePlane plane = plane_of(image, c);
    const std::string& name = image.channels[static_cast<std::size_t>(c)];
    const auto same = std::find_if(all.begin(), all.end(), [&](const Variant& v) { return v.plane.values == plane.values; });
    if (same != all.end()) {
      same->channels.push_back(name);
    } else {
      all.push_back({{name}, TableEncoding::Linear, std::move(plane), {}});
    }
  }
  if (!from_codes) {
    return all;
  }
  const std::size_t linear = all.size();
  for (std::size_t v = 0; v < linear; ++v) {
    if (all[v].channels[0] == "A") {
      continue;
    }
    Variant codes = all[v];
    all[v].encoding = TableEncoding::Srgb;
    for (std::size_t i = 0; i < codes.plane.values.size(); ++i) {
      double& decoded = all[v].plane.values[i];
      if (alpha >= 0) {
        const double coverage = image.data[i * image.channels.size() + static_cast<std::size_t>(alpha)];
        decoded = coverage > 0 ? decoded / coverage : 0;
      }
      codes.plane.values[i] = image::linear_to_srgb(decoded);
    }
    all.push_back(std::move(codes));
  }
  return all;
}

/// How far a reading is from a table as it should be: half texels are odder than whole ones.
double oddness(const TableReading& r) {
  return (r.row_shift != std::round(r.row_shift) ? 1 : 0) + (r.column_shift != 0 ? 1 : 0) + (r.row_shift != 0 ? 0.5 : 0) +
         (r.texels == TableTexels::Edge ? 0.25 : 0);
}

/// Whether two readings differ in nothing but where their texels lie.
bool same_but_for_texels(TableReading a, const TableReading& b) {
  a.row_shift = b.row_shift;
  a.column_shift = b.column_shift;
  a.texels = b.texels;
  a.clamped = b.clamped;
  return a == b;
}

/// A reading and by how many standard errors the best fits better.
struct Rival {
  TableReading reading;
  double behind;
};

/// Those of the readings that larger samples cannot tell from the best of them; the best comes first.
std::vector<Rival> not_told_apart(const Variant& variant, const AlbedoSource& source) {
  std::vector<Rival> tied;
  const auto sampled = static_cast<double>(sample_of(variant.plane, search_side).texels.size());
  for (const ScoredReading& rival : variant.found) {
    if (rival.loss <= (1 + tied_loss / std::sqrt(sampled)) * variant.found.front().loss) {
      tied.push_back({rival.reading, 0});
    }
  }
  for (int side : judged_sides) {
    const TableSample sample = sample_of(variant.plane, side);
    const auto weigh = [&] {
      for (Rival& rival : tied) {
        rival.behind = significance(tied[0].reading, rival.reading, variant.plane, sample, source);
      }
      return std::min_element(tied.begin(), tied.end(), [](const Rival& a, const Rival& b) { return a.behind < b.behind; });
    };
    if (const auto better = weigh(); better != tied.begin() && better->behind < 0) {
      std::iter_swap(tied.begin(), better);
      weigh();
    }
    tied.erase(std::remove_if(tied.begin() + 1, tied.end(), [](const Rival& rival) { return rival.behind >= sure; }), tied.end());
    if (tied.size() < 2) {
      break;
    }
  }
  return tied;
}

/// Errors of one row, or of all.
struct Errors {
  double max = -1, relative = 0, sum = 0;
  double loss = 0;  ///< sum of squares, compressed
  int column = 0, row = 0;
  std::size_t compared = 0;

  void add(double value, double truth, int x, int y) {
    const double error = std::abs(value - truth);
    if (error > max) {
      max = error;
      column = x;
      row = y;
    }
    relative = std::max(relative, error / std::max(truth, 1.0));
    sum += error * error;
    loss += (compressed(value) - compressed(truth)) * (compressed(value) - compressed(truth));
    ++compared;
  }
  void add(const Errors& other) {
    if (other.max > max) {
      max = other.max;
      column = other.column;
      row = other.row;
    }
    relative = std::max(relative, other.relative);
    sum += other.sum;
    loss += other.loss;
    compared += other.compared;
  }
};

/// Of the whole table, E as it is and clamped.
struct WholeTable {
  Errors plain, clamped;
  double largest = 0;       ///< value
  bool beyond_one = false;  ///< E exceeds 1 at some texel, those at N.V = 0 (taken as min_n_dot_v) included
};

WholeTable whole_table(const TableReading& reading, const TablePlane& plane, const AlbedoSource& source) {
  std::vector<WholeTable> rows(static_cast<std::size_t>(plane.height));
  tbb::parallel_for(0, plane.height, [&](int y) {
    WholeTable& row = rows[static_cast<std::size_t>(y)];
    for (int x = 0; x < plane.width; ++x) {
      const double value = plane.at(x, y);
      const TablePoint point = point_of(reading, plane.width, plane.height, x, y);
      if (!std::isfinite(value) || !point.inside) {
        continue;
      }
      const double e = stored_value(reading, point, source(reading.visibility, point));
      row.largest = std::max(row.largest, value);
      row.beyond_one = row.beyond_one || e > 1;
      if (point.n_dot_v >= min_n_dot_v) {
        row.plain.add(value, e, x, y);
        row.clamped.add(value, std::min(e, 1.0), x, y);
      }
    }
  });
  WholeTable all;
  for (const WholeTable& row : rows) {
    all.plain.add(row.plain);
    all.clamped.add(row.clamped);
    all.largest = std::max(all.largest, row.largest);
    all.beyond_one = all.beyond_one || row.beyond_one;
  }
  return all;
}

/// Fills in how far the table is from its reading.
void measure(TableCheck& check, const TablePlane& plane, const AlbedoSource& source) {
  TableReading& reading = *check.reading;
  const WholeTable whole = whole_table(reading, plane, source);
  // A table without a texel above 1 where E would have one is clamped, also where only texels that are not compared show it.
  reading.clamped =
      whole.clamped.loss < whole.plain.loss || (whole.clamped.loss == whole.plain.loss && whole.beyond_one && whole.largest <= 1);
  const Errors& errors = reading.clamped ? whole.clamped : whole.plain;
  check.compared = errors.compared;
  check.left_out = plane.values.size() - errors.compared;
  if (errors.compared == 0) {
    return;
  }
  check.max_error = errors.max;
  check.max_relative_error = errors.relative;
  check.rms_error = std::sqrt(errors.sum / static_cast<double>(errors.compared));
  check.worst_column = errors.column;
  check.worst_row = errors.row;
  check.worst = point_of(reading, plane.width, plane.height, errors.column, errors.row);
  check.worst_value = plane.at(errors.column, errors.row);
  const double e = stored_value(reading, check.worst, source(reading.visibility, check.worst));
  check.worst_truth = reading.clamped ? std::min(e, 1.0) : e;
  TableReading as_is;
  as_is.visibility = reading.visibility;
  const WholeTable misread = whole_table(as_is, plane, source);
  check.as_is_error = reading.clamped ? misread.clamped.max : misread.plain.max;
}

/// Settles on one reading of the variant, or says why none will do.
void decide(TableCheck& check, const Variant& variant, const AlbedoSource& source) {
  std::vector<Rival> tied = not_told_apart(variant, source);
  const TableReading best = tied[0].reading;
  if (std::any_of(tied.begin(), tied.end(), [&](const Rival& rival) { return !same_but_for_texels(rival.reading, best); })) {
    check.why = "readings that differ in more than where texels lie fit alike";
    return;
  }
  const auto simpler = [](const Rival& a, const Rival& b) {
    return std::pair(a.behind >= alike, oddness(a.reading)) < std::pair(b.behind >= alike, oddness(b.reading));
  };
  const TableReading simplest = std::min_element(tied.begin(), tied.end(), simpler)->reading;
  const auto differs = [&](auto field) {
    return std::any_of(tied.begin(), tied.end(), [&](const Rival& rival) { return rival.reading.*field != simplest.*field; });
  };
  if (differs(&TableReading::texels)) {
    check.undecided.emplace_back("texels");
  }
  if (differs(&TableReading::row_shift)) {
    check.undecided.emplace_back("row_shift");
  }
  if (differs(&TableReading::column_shift)) {
    check.undecided.emplace_back("column_shift");
  }
  check.reading = simplest;
  const auto is_chosen = [&](const ScoredReading& s) { return s.reading == simplest; };
  const auto chosen = std::find_if(variant.found.begin(), variant.found.end(), is_chosen);
  const auto next = std::find_if_not(variant.found.begin(), variant.found.end(), is_chosen);
  if (chosen != variant.found.end() && next != variant.found.end()) {
    check.runner_up = next->reading;
    check.margin = std::sqrt(next->loss / std::max(chosen->loss, 1e-20));
  }
}

}  // namespace

TableCheck check_table(const image::Image& image, bool from_codes, const AlbedoSource& source) {
  TableCheck check;
  if (image.width < min_side || image.height < min_side) {
    check.why = "a table has at least " + std::to_string(min_side) + " texels a side";
    return check;
  }
  std::vector<Variant> variants = variants_of(image, from_codes);
  for (Variant& variant : variants) {
    const TableSample sample = sample_of(variant.plane, judged_sides[0]);
    if (sample.variance >= min_variance) {
      variant.found = search(variant.plane, source);
      if (!variant.found.empty()) {
        variant.misfit = std::sqrt(variant.found.front().loss / sample.variance);
      }
    }
  }
  const Variant& best =
      *std::min_element(variants.begin(), variants.end(), [](const Variant& a, const Variant& b) { return a.misfit < b.misfit; });
  check.misfit = best.misfit;
  check.nonfinite = static_cast<std::size_t>(
      std::count_if(best.plane.values.begin(), best.plane.values.end(), [](double value) { return !std::isfinite(value); }));
  if (!(best.misfit <= max_misfit)) {
    check.why = "no reading as a table of directional albedo fits it";
    return check;
  }
  if (check.nonfinite * 10 > best.plane.values.size()) {
    check.why = "more than a tenth of it is not finite";
    return check;
  }
  decide(check, best, source);
  if (check.reading) {
    check.channels = best.channels;
    check.encoding = best.encoding;
    measure(check, best.plane, source);
  }
  return check;
}

}  // namespace sheen::albedo
