#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "albedo/table_search.h"
#include "image/image.h"

namespace sheen::albedo {

/// How the numbers of a file stand for E.
enum class TableEncoding { Linear, Srgb };

/// What a table was found to be, and how good it is as that. Without a reading only `why` and `nonfinite` are said.
struct TableCheck {
  std::optional<TableReading> reading;
  std::string why;                    ///< in words: why there is no reading; empty where there is one
  std::vector<std::string> channels;  ///< the channel that holds the table, then those with the same values
  TableEncoding encoding = TableEncoding::Linear;

  // Against the true E (min(E, 1) where clamped) at each texel's point; texels without one (N.V = 0, beyond an end) are left out.
  double max_error = 0;           ///< absolute; for TableForm::WarpedTimesRoughness that of E r
  double max_relative_error = 0;  ///< of error / max(truth, 1)
  double rms_error = 0;
  int worst_column = 0, worst_row = 0;  ///< of max_error, from the top left
  TablePoint worst{};                   ///< its point
  double worst_value = 0, worst_truth = 0;
  double as_is_error = 0;  ///< largest error when the table is read as it stands: texel centres of (N.V, roughness), first row smoothest
  std::size_t compared = 0, left_out = 0, nonfinite = 0;

  double misfit = 0;                      ///< rms error over the values' standard deviation, both compressed; at most 0.16
  std::optional<TableReading> runner_up;  ///< the next best reading
  double margin = 0;                      ///< misfit of the runner-up over this one's
  std::vector<std::string> undecided;     ///< fields in which another reading fits as well, the simplest having been taken
};

/// Finds out what a table of directional albedo is: in which channel, of which visibility, over which axis and laid out how.
/// @param from_codes  the image's values were decoded from codes by the sRGB curve, and the file may have meant them plainly
/// @param source  made once for many tables
TableCheck check_table(const image::Image& image, bool from_codes, const AlbedoSource& source);

}  // namespace sheen::albedo
