#include "albedo/table_search.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <tbb/parallel_for.h>

#include "albedo/coordinates.h"

namespace sheen::albedo {
namespace {

using brdf::square;

constexpr int max_row_shift = 8;
constexpr std::size_t orientations_kept = 3;  // of eight: a shift of many rows may make the true one second best
constexpr std::size_t families_kept = 12;     // of visibility, form, axis and orientation
constexpr double settled = 1e-4;              // loss over variance at which no other form is tried: those cost most
constexpr double hopeless = 0.5;              // loss over variance that no shift mends
constexpr double unseen_drop = 14;            // E is below 1e-6 there; not worth the making of a patch
constexpr int coarse_side = 24;               // of the first sample

/// Squared error of one texel, and the same with E clamped.
struct SquaredErrors {
  double plain, clamped;
};

SquaredErrors squared_errors(const TableReading& reading, const TablePlane& plane, const TableSample::Texel& texel,
                             const AlbedoSource& source) {
  const TablePoint point = point_of(reading, plane.width, plane.height, texel.column, texel.row);
  const bool unseen = !(point.sheen_roughness > 0) ||
                      log_peak_drop(half_elevation_tangent(std::max(point.n_dot_v, min_n_dot_v)), point.sheen_roughness) > unseen_drop;
  const double e = unseen ? 0 : stored_value(reading, point, source(reading.visibility, point));
  return {square(texel.value - compressed(e)), square(texel.value - compressed(std::min(e, 1.0)))};
}

bool fits_better(const ScoredReading& a, const ScoredReading& b) {
  return a.loss < b.loss;
}

std::vector<ScoredReading> all_scored(const std::vector<TableReading>& readings, const TablePlane& plane, const TableSample& sample,
                                      const AlbedoSource& source) {
  std::vector<ScoredReading> result(readings.size());
  tbb::parallel_for(std::size_t{0}, readings.size(), [&](std::size_t i) { result[i] = scored(readings[i], plane, sample, source); });
  std::stable_sort(result.begin(), result.end(), fits_better);
  return result;
}

bool same_orientation(const TableReading& a, const TableReading& b) {
  return a.transposed == b.transposed && a.n_dot_v_flipped == b.n_dot_v_flipped && a.roughness_flipped == b.roughness_flipped;
}

bool same_family(const TableReading& a, const TableReading& b) {
  return same_orientation(a, b) && a.visibility == b.visibility && a.form == b.form && a.axis == b.axis;
}

/// The best of each class, best first.
template <class Same>
std::vector<ScoredReading> best_of_each(const std::vector<ScoredReading>& sorted, std::size_t count, Same same) {
  std::vector<ScoredReading> result;
  for (const ScoredReading& candidate : sorted) {
    const auto alike = [&](const ScoredReading& kept) { return same(kept.reading, candidate.reading); };
    if (result.size() < count && std::none_of(result.begin(), result.end(), alike)) {
      result.push_back(candidate);
    }
  }
  return result;
}

/// Every orientation of every visibility, over both axes where plain.
std::vector<TableReading> unshifted_readings(const std::vector<TableForm>& forms) {
  std::vector<TableReading> readings;
  for (int orientation = 0; orientation < 8; ++orientation) {
    for (Visibility visibility : brdf::visibilities) {
      for (TableForm form : forms) {
        TableReading reading;
        reading.visibility = visibility;
        reading.form = form;
        reading.texels = form == TableForm::Plain ? TableTexels::Centre : TableTexels::Edge;
        reading.transposed = (orientation & 1) != 0;
        reading.n_dot_v_flipped = (orientation & 2) != 0;
        reading.roughness_flipped = (orientation & 4) != 0;
        readings.push_back(reading);
        if (form == TableForm::Plain) {
          reading.axis = TableAxis::Alpha;
          readings.push_back(reading);
        }
      }
    }
  }
  return readings;
}

/// The readings of the likeliest orientations with their rows shifted by whole texels.
std::vector<TableReading> shifted_readings(const std::vector<ScoredReading>& unshifted, const TablePlane& plane) {
  std::vector<TableReading> readings;
  for (const ScoredReading& orientation : best_of_each(unshifted, orientations_kept, same_orientation)) {
    const int rows = orientation.reading.transposed ? plane.width : plane.height;
    const int reach = std::clamp(rows / 8, 1, max_row_shift);
    for (const ScoredReading& family : unshifted) {
      if (same_orientation(family.reading, orientation.reading)) {
        TableReading reading = family.reading;
        for (int shift = -reach; shift <= reach; ++shift) {
          reading.row_shift = shift;
          readings.push_back(reading);
        }
      }
    }
  }
  return readings;
}

bool same_but_clamped(TableReading a, const TableReading& b) {
  a.clamped = b.clamped;
  return a == b;
}

/// Adds a reading unless it is there, or was scored.
void append_new(std::vector<TableReading>& readings, const std::vector<ScoredReading>& known, const TableReading& reading) {
  const auto alike = [&](const TableReading& r) { return same_but_clamped(r, reading); };
  const auto scored_alike = [&](const ScoredReading& s) { return alike(s.reading); };
  if (std::none_of(readings.begin(), readings.end(), alike) && std::none_of(known.begin(), known.end(), scored_alike)) {
    readings.push_back(reading);
  }
}

/// What may be laid out otherwise about a reading: rows by halves, columns by a half, corner-aligned texels.
void append_neighbours(std::vector<TableReading>& readings, const std::vector<ScoredReading>& known, const TableReading& found) {
  append_new(readings, known, found);
  if (found.form != TableForm::Plain) {
    return;
  }
  for (int half = -3; half <= 3; ++half) {
    TableReading reading = found;
    reading.row_shift += 0.5 * half;
    reading.texels = TableTexels::Centre;
    for (double column_shift : {0.0, -0.5, 0.5}) {
      reading.column_shift = column_shift;
      append_new(readings, known, reading);
    }
    if (reading.row_shift == std::round(reading.row_shift)) {
      reading.column_shift = 0;
      reading.texels = TableTexels::Edge;
      append_new(readings, known, reading);
    }
  }
}

/// Some of the indices of n texels: at most per_side, without the outer twelfth.
std::vector<int> spread(int n, int per_side) {
  const int margin = n / 12;
  const int inner = n - 2 * margin, count = std::min(inner, per_side);
  std::vector<int> result;
  for (int k = 0; k < count; ++k) {
    result.push_back(margin + static_cast<int>((2LL * k + 1) * inner / (2LL * count)));
  }
  return result;
}

}  // namespace

double compressed(double value) {
  return value >= 0 ? value / (1 + value) : std::max(value, -1.0);
}

TableSample sample_of(const TablePlane& plane, int per_side) {
  TableSample sample;
  double sum = 0, squares = 0;
  const std::vector<int> columns = spread(plane.width, per_side);
  for (int row : spread(plane.height, per_side)) {
    for (int column : columns) {
      const double value = plane.at(column, row);
      if (std::isfinite(value)) {
        sample.texels.push_back({column, row, compressed(value)});
        sum += compressed(value);
        squares += square(compressed(value));
      }
    }
  }
  if (!sample.texels.empty()) {
    const auto n = static_cast<double>(sample.texels.size());
    sample.variance = std::max(0.0, squares / n - square(sum / n));
  }
  return sample;
}

ScoredReading scored(const TableReading& reading, const TablePlane& plane, const TableSample& sample, const AlbedoSource& source) {
  SquaredErrors sum{0, 0};
  for (const TableSample::Texel& texel : sample.texels) {
    const SquaredErrors errors = squared_errors(reading, plane, texel, source);
    sum.plain += errors.plain;
    sum.clamped += errors.clamped;
  }
  ScoredReading result{reading, std::min(sum.plain, sum.clamped) / static_cast<double>(sample.texels.size())};
  result.reading.clamped = sum.clamped < sum.plain;
  return result;
}

std::vector<ScoredReading> search(const TablePlane& plane, const AlbedoSource& source) {
  const TableSample few = sample_of(plane, coarse_side);
  std::vector<ScoredReading> found = all_scored(unshifted_readings({TableForm::Plain}), plane, few, source);
  if (found.front().loss <= hopeless * few.variance) {
    found = all_scored(shifted_readings(found, plane), plane, few, source);
  }
  if (!(found.front().loss <= settled * few.variance)) {
    const std::vector<TableReading> warped = unshifted_readings({TableForm::Warped, TableForm::WarpedTimesRoughness});
    const std::vector<ScoredReading> more = all_scored(warped, plane, few, source);
    found.insert(found.end(), more.begin(), more.end());
    std::stable_sort(found.begin(), found.end(), fits_better);
  }
  if (!(found.front().loss <= hopeless * few.variance)) {
    return {};
  }
  // From the likeliest families on, climb: where an axis has few texels, an error of half of one is made up for by rows of the other.
  const TableSample many = sample_of(plane, search_side);
  std::vector<ScoredReading> result, front = best_of_each(found, families_kept, same_family);
  while (true) {
    std::vector<TableReading> readings;
    for (const ScoredReading& from : front) {
      append_neighbours(readings, result, from.reading);
    }
    if (readings.empty()) {
      return result;
    }
    const std::vector<ScoredReading> more = all_scored(readings, plane, many, source);
    result.insert(result.end(), more.begin(), more.end());
    std::stable_sort(result.begin(), result.end(), fits_better);
    front.assign(1, result.front());
  }
}

double significance(const TableReading& a, const TableReading& b, const TablePlane& plane, const TableSample& sample,
                    const AlbedoSource& source) {
  const auto error = [&](const TableReading& reading, const TableSample::Texel& texel) {
    const SquaredErrors errors = squared_errors(reading, plane, texel, source);
    return reading.clamped ? errors.clamped : errors.plain;
  };
  std::vector<double> differences(sample.texels.size());
  tbb::parallel_for(std::size_t{0}, differences.size(),
                    [&](std::size_t i) { differences[i] = error(b, sample.texels[i]) - error(a, sample.texels[i]); });
  double sum = 0, squares = 0;
  for (double difference : differences) {
    sum += difference;
    squares += square(difference);
  }
  return squares > 0 ? sum / std::sqrt(squares) : 0;
}

}  // namespace sheen::albedo
