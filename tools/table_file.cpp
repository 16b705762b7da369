#include "tools/table_file.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "image/io.h"
#include "tools/errors.h"
#include "tools/files.h"

namespace sheen::tools {
namespace {

using Record = std::vector<double>;

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\r\"");
  return begin == std::string_view::npos ? std::string_view() : text.substr(begin, text.find_last_not_of(" \t\r\"") - begin + 1);
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const auto comma = line.find(',');
    fields.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) {
      return fields;
    }
    line.remove_prefix(comma + 1);
  }
}

std::optional<double> number_of(std::string_view field) {
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (end != field.data() + field.size() || error != std::errc()) {
    return std::nullopt;
  }
  return value;
}

/// The header, empty where there is none, and the records, all of the same length.
struct Csv {
  std::vector<std::string> header;
  std::vector<Record> records;
};

Csv csv_of(const std::string& text, const std::string& name) {
  Csv csv;
  std::size_t line_number = 0, length = 0;
  for (std::size_t at = 0; at < text.size(); ++line_number) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = std::string_view(text).substr(at, end - at);
    at = end + 1;
    if (trimmed(line).empty()) {
      continue;
    }
    const std::vector<std::string_view> fields = fields_of(line);
    if (length == 0) {
      length = fields.size();
      if (!number_of(fields[0])) {
        csv.header.assign(fields.begin(), fields.end());
        continue;
      }
    }
    if (fields.size() != length) {
      throw InputError(fmt::format("{}: line {}: {} fields where the first line has {}", name, line_number + 1, fields.size(), length));
    }
    Record& record = csv.records.emplace_back();
    for (std::string_view field : fields) {
      const std::optional<double> value = number_of(field);
      if (!value) {
        throw InputError(fmt::format("{}: line {}: every field must be a number", name, line_number + 1));
      }
      record.push_back(*value);
    }
  }
  if (csv.records.empty()) {
    throw InputError(name + ": holds no table");
  }
  return csv;
}

int to_side(std::size_t n, const std::string& name) {
  if (n > 65536) {
    throw InputError(name + ": more than 65536 texels a side");
  }
  return static_cast<int>(n);
}

std::size_t column_of(const Csv& csv, std::initializer_list<const char*> names) {
  const auto found = std::find_first_of(csv.header.begin(), csv.header.end(), names.begin(), names.end());
  return static_cast<std::size_t>(found - csv.header.begin());
}

image::Image grid_of_records(const Csv& csv, const std::string& name) {
  const std::size_t roughness = column_of(csv, {"sheen_roughness", "roughness"}), cosine = column_of(csv, {"n_dot_v"});
  if (roughness == csv.header.size() || cosine == csv.header.size() || csv.header.size() < 3) {
    throw InputError(name + ": line 1: the header must name n_dot_v, sheen_roughness or roughness, and a column of values");
  }
  const std::vector<Record>& records = csv.records;
  // Along a row of the table one of the two stays as it is.
  const std::size_t still = records.size() > 1 && records[0][cosine] == records[1][cosine] ? cosine : roughness;
  const auto row_end = std::find_if(records.begin(), records.end(), [&](const Record& r) { return r[still] != records[0][still]; });
  const auto width = static_cast<std::size_t>(row_end - records.begin());
  if (records.size() % width != 0) {
    throw InputError(fmt::format("{}: {} texels do not fill rows of {}", name, records.size(), width));
  }
  std::vector<std::string> channels;
  std::vector<std::size_t> columns;
  for (std::size_t c = 0; c < csv.header.size(); ++c) {
    if (c != roughness && c != cosine) {
      channels.push_back(csv.header[c]);
      columns.push_back(c);
    }
  }
  image::Image image(to_side(width, name), to_side(records.size() / width, name), channels);
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (records[i][still] != records[i - i % width][still]) {
      throw InputError(fmt::format("{}: texel {}: the rows of the table must be of one length", name, i + 1));
    }
    for (std::size_t c = 0; c < columns.size(); ++c) {
      image.data[i * columns.size() + c] = static_cast<float>(records[i][columns[c]]);
    }
  }
  return image;
}

std::string text_of(const std::filesystem::path& file) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file)) {
    throw InputError(file.string() +
                     ": cannot be read: " + (stream ? std::string("it is a folder") : std::generic_category().message(errno)));
  }
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace

image::Image parse_table(const std::string& text, const std::string& name) {
  const Csv csv = csv_of(text, name);
  if (!csv.header.empty()) {
    return grid_of_records(csv, name);
  }
  const std::size_t width = csv.records[0].size();
  image::Image image(to_side(width, name), to_side(csv.records.size(), name), {"value"});
  for (std::size_t i = 0; i < image.data.size(); ++i) {
    image.data[i] = static_cast<float>(csv.records[i / width][i % width]);
  }
  return image;
}

TableFile read_table(const std::filesystem::path& file) {
  const std::string extension = extension_of(file);
  if (extension == ".csv") {
    return {parse_table(text_of(file), file.string()), false};
  }
  return {image::read(file), extension == ".png" || extension == ".jpg" || extension == ".jpeg"};
}

}  // namespace sheen::tools
