#include "albedo/table_check.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "albedo/split_sum.h"
#include "image/srgb.h"

namespace sheen::albedo {
namespace {

using image::Image;

const AlbedoSource& source() {
  static const AlbedoSource shared;
  return shared;
}

double e_of(Visibility visibility, double n_dot_v, double sheen_roughness) {
  return source()(visibility, {n_dot_v, sheen_roughness, true});
}

/// A picture of one channel, value(column, row).
Image picture(int width, int height, const std::function<double(int, int)>& value) {
  Image image(width, height, {"R"});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at(x, y, 0) = static_cast<float>(value(x, y));
    }
  }
  return image;
}

/// E at texel centres of (N.V, roughness), rows shifted.
Image centred(Visibility visibility, int width, int height, double row_shift = 0) {
  return picture(width, height,
                 [&](int x, int y) { return e_of(visibility, (x + 0.5) / width, std::clamp((y + 0.5 + row_shift) / height, 0.0, 1.0)); });
}

Image transposed(const Image& image) {
  return picture(image.height, image.width, [&](int x, int y) { return image.at(y, x, 0); });
}

Image mirrored(const Image& image, bool columns, bool rows) {
  return picture(image.width, image.height,
                 [&](int x, int y) { return image.at(columns ? image.width - 1 - x : x, rows ? image.height - 1 - y : y, 0); });
}

Image changed(Image image, const std::function<double(double)>& change) {
  for (float& value : image.data) {
    value = static_cast<float>(change(value));
  }
  return image;
}

Image with_noise(const Image& image, double deviation) {
  std::mt19937 generator(3);
  std::normal_distribution<double> noise(0, deviation);
  return changed(image, [&](double v) { return v + noise(generator); });
}

/// What E is rounded to: 11 significant bits, as a half float has.
double to_half(double value) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);
  return std::ldexp(std::round(mantissa * 2048) / 2048, exponent);
}

/// Expects the reading, and an error of at most `error`.
TableCheck expect(const Image& image, const TableReading& expected, double error, bool from_codes = false) {
  TableCheck check = check_table(image, from_codes, source());
  EXPECT_TRUE(check.reading.has_value()) << check.why << ", misfit " << check.misfit;
  if (check.reading) {
    const TableReading& r = *check.reading;
    EXPECT_EQ(r.visibility, expected.visibility);
    EXPECT_EQ(r.form, expected.form);
    EXPECT_EQ(r.axis, expected.axis);
    EXPECT_EQ(r.texels, expected.texels);
    EXPECT_EQ(r.row_shift, expected.row_shift);
    EXPECT_EQ(r.column_shift, expected.column_shift);
    EXPECT_EQ(r.transposed, expected.transposed);
    EXPECT_EQ(r.n_dot_v_flipped, expected.n_dot_v_flipped);
    EXPECT_EQ(r.roughness_flipped, expected.roughness_flipped);
    EXPECT_EQ(r.clamped, expected.clamped);
    EXPECT_TRUE(check.undecided.empty()) << check.undecided.front();
    EXPECT_LE(check.max_error, error);
    EXPECT_GT(check.margin, 1);
  }
  return check;
}

TEST(TableCheck, NamesVisibilityAndAxis) {
  for (Visibility visibility : brdf::visibilities) {
    TableReading reading;
    reading.visibility = visibility;
    expect(centred(visibility, 32, 32), reading, 1e-5);
    reading.axis = TableAxis::Alpha;
    const Image over_alpha = picture(64, 48, [&](int x, int y) { return e_of(visibility, (x + 0.5) / 64, std::sqrt((y + 0.5) / 48)); });
    const TableCheck check = expect(over_alpha, reading, 1e-5);
    EXPECT_GT(check.as_is_error, 0.1) << "what reading it by roughness costs";
  }
}

TEST(TableCheck, NamesEveryOrientation) {
  for (int orientation = 0; orientation < 8; ++orientation) {
    TableReading reading;
    reading.visibility = Visibility::Ashikhmin;
    reading.n_dot_v_flipped = (orientation & 1) != 0;
    reading.roughness_flipped = (orientation & 2) != 0;
    reading.transposed = (orientation & 4) != 0;
    Image image = mirrored(centred(Visibility::Ashikhmin, 40, 24), reading.n_dot_v_flipped, reading.roughness_flipped);
    if (reading.transposed) {
      image = transposed(image);
    }
    expect(image, reading, 1e-5);
  }
}

TEST(TableCheck, TellsCornerAlignedNodesAndShiftsApart) {
  TableReading reading;
  for (double shift : {-3.0, -1.0, -0.5, 0.5, 1.0, 2.0, 8.0}) {
    reading.row_shift = shift;
    expect(centred(Visibility::Charlie, 64, 64, shift), reading, 1e-5);
    reading.roughness_flipped = true;
    expect(mirrored(centred(Visibility::Charlie, 64, 64, shift), false, true), reading, 1e-5);
    reading.roughness_flipped = false;
  }
  TableReading edge;
  edge.texels = TableTexels::Edge;
  const TableCheck check = expect(picture(33, 65, [](int x, int y) { return e_of(Visibility::Charlie, x / 32.0, y / 64.0); }), edge, 1e-5);
  EXPECT_EQ(check.left_out, 65U) << "E of Charlie has no value at N.V = 0";
  TableReading low;
  low.row_shift = -0.5;
  low.column_shift = -0.5;
  expect(picture(64, 64, [](int x, int y) { return e_of(Visibility::Charlie, x / 64.0, y / 64.0); }), low, 1e-5);
}

// With few columns, columns half a texel off look like rows several texels off.
TEST(TableCheck, FindsAFarShiftOfCornerAlignedNodesWithFewColumns) {
  TableReading reading;
  reading.texels = TableTexels::Edge;
  reading.row_shift = 4;
  reading.clamped = true;
  const Image image = picture(12, 253, [](int x, int y) {
    return std::round(255 * std::min(1.0, e_of(Visibility::Charlie, x / 11.0, std::min(1.0, (y + 4) / 252.0)))) / 255;
  });
  expect(image, reading, 0.5001 / 255);
}

// As Filament's cmgen writes it: Ashikhmin's term, the roughest row first and every row one texel too rough.
TEST(TableCheck, KnowsRowsThatAreOneTexelOff) {
  TableReading reading;
  reading.visibility = Visibility::Ashikhmin;
  reading.roughness_flipped = true;
  reading.row_shift = 1;
  for (int size : {8, 32, 128}) {
    const Image image = picture(
        size, size, [size](int x, int y) { return e_of(Visibility::Ashikhmin, (x + 0.5) / size, std::min(1.0, (size - y + 0.5) / size)); });
    const TableCheck check = expect(image, reading, 1e-5);
    EXPECT_EQ(check.left_out, static_cast<std::size_t>(size)) << "the row that would be rougher than 1";
  }
}

TEST(TableCheck, KnowsTablesOfAnySize) {
  const std::pair<int, int> sizes[] = {{8, 8}, {9, 31}, {17, 12}, {256, 16}, {300, 128}};
  for (const auto& [width, height] : sizes) {
    for (Visibility visibility : brdf::visibilities) {
      TableReading reading;
      reading.visibility = visibility;
      expect(centred(visibility, width, height), reading, 1e-5);
    }
  }
}

TEST(TableCheck, KnowsRoundedClampedAndNoisyTables) {
  for (Visibility visibility : brdf::visibilities) {
    TableReading reading;
    reading.visibility = visibility;
    const Image exact = centred(visibility, 64, 64);
    const double largest = *std::max_element(exact.data.begin(), exact.data.end());
    expect(changed(exact, to_half), reading, largest / 2048);
    expect(with_noise(exact, 0.01), reading, 0.06);
    reading.clamped = largest > 1;
    expect(changed(exact, [](double v) { return std::min(v, 1.0); }), reading, 1e-5);
    expect(changed(exact, [](double v) { return std::round(std::min(v, 1.0) * 255) / 255; }), reading, 0.5001 / 255);
    expect(with_noise(changed(exact, [](double v) { return std::min(v, 1.0); }), 0.01), reading, 0.06);
  }
}

TEST(TableCheck, TellsPlainCodesFromThoseOfTheSrgbCurve) {
  const Image clamped = changed(centred(Visibility::Charlie, 64, 64), [](double v) { return std::min(v, 1.0); });
  const auto quantised = [](double v) { return std::round(v * 255) / 255; };
  TableReading reading;
  reading.clamped = true;
  // What a decoder makes of either file.
  const Image plain = changed(clamped, [&](double v) { return image::srgb_to_linear(quantised(v)); });
  EXPECT_EQ(expect(plain, reading, 0.5001 / 255, true).encoding, TableEncoding::Linear);
  const Image curved = changed(clamped, [&](double v) { return image::srgb_to_linear(quantised(image::linear_to_srgb(v))); });
  EXPECT_EQ(expect(curved, reading, 0.005, true).encoding, TableEncoding::Srgb);
}

TEST(TableCheck, FindsTheChannelAmongOthers) {
  const Image table = centred(Visibility::Refined, 32, 32);
  Image image(32, 32, {"R", "G", "B", "A", "sheen"});
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      const SplitSum sum = ggx_split_sum((x + 0.5) / 32, (y + 0.5) / 32);
      image.at(x, y, 0) = static_cast<float>(sum.scale);
      image.at(x, y, 1) = static_cast<float>(sum.bias);
      image.at(x, y, 2) = image.at(x, y, 4) = table.at(x, y, 0);
      image.at(x, y, 3) = 1;
    }
  }
  TableReading reading;
  reading.visibility = Visibility::Refined;
  EXPECT_EQ(expect(image, reading, 1e-5).channels, (std::vector<std::string>{"B", "sheen"}));
}

TEST(TableCheck, KnowsTheWarpedLayout) {
  for (bool times_roughness : {false, true}) {
    TableReading reading;
    reading.visibility = Visibility::Ashikhmin;
    reading.form = times_roughness ? TableForm::WarpedTimesRoughness : TableForm::Warped;
    reading.texels = TableTexels::Edge;
    expect(picture(24, 24,
                   [&](int x, int y) {
                     const double r = 0.02 + 0.98 * y / 23.0, u = x / 23.0;
                     return e_of(Visibility::Ashikhmin, std::clamp(u * r / (1 + r - u), 1e-4, 1.0), r) * (times_roughness ? r : 1);
                   }),
           reading, 1e-4);
  }
}

TEST(TableCheck, ReportsTheLargestErrorAndWhereItIs) {
  Image image = centred(Visibility::Charlie, 64, 64);
  image.at(20, 50, 0) += 0.25f;
  image.at(30, 40, 0) = std::numeric_limits<float>::quiet_NaN();
  const TableCheck check = expect(image, {}, 0.2501);
  EXPECT_NEAR(check.max_error, 0.25, 1e-5);
  EXPECT_EQ(check.worst_column, 20);
  EXPECT_EQ(check.worst_row, 50);
  EXPECT_DOUBLE_EQ(check.worst.n_dot_v, 20.5 / 64);
  EXPECT_DOUBLE_EQ(check.worst.sheen_roughness, 50.5 / 64);
  EXPECT_EQ(check.nonfinite, 1U);
}

TEST(TableCheck, SaysWhichFieldsNoiseHides) {
  TableReading reading;
  const TableCheck check = check_table(with_noise(centred(Visibility::Charlie, 128, 128), 0.02), false, source());
  ASSERT_TRUE(check.reading.has_value()) << check.why;
  EXPECT_EQ(*check.reading, reading) << "of readings that fit alike the simplest is taken";
  EXPECT_FALSE(check.undecided.empty());
}

TEST(TableCheck, NamesNothingInOtherPictures) {
  const int size = 48;
  const auto at = [](int k) { return (k + 0.5) / size; };
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> unit(0, 1);
  const std::vector<std::pair<const char*, std::function<double(int, int)>>> pictures = {
      {"constant", [](int, int) { return 0.5; }},
      {"noise", [&](int, int) { return unit(generator); }},
      {"not finite", [](int, int) { return std::numeric_limits<double>::quiet_NaN(); }},
      {"ramp along columns", [&](int x, int) { return at(x); }},
      {"ramp along rows", [&](int, int y) { return at(y); }},
      {"product of ramps", [&](int x, int y) { return (1 - at(x)) * at(y); }},
      {"sum of ramps", [&](int x, int y) { return (1 - at(x) + at(y)) / 2; }},
      {"Schlick's weight", [&](int x, int y) { return std::pow(1 - at(x), 5) * at(y); }},
      {"grazing power", [&](int x, int y) { return std::pow(1 - at(x), 1 / at(y)); }},
      {"disc", [&](int x, int y) { return std::hypot(at(x) - 0.5, at(y) - 0.5) < 0.4 ? 1.0 : 0.0; }},
      {"waves", [&](int x, int y) { return 0.5 + 0.5 * std::sin(9 * at(x)) * std::cos(7 * at(y)); }},
      {"split sum's scale", [&](int x, int y) { return ggx_split_sum(at(x), at(y)).scale; }},
      {"split sum's bias", [&](int x, int y) { return ggx_split_sum(at(x), at(y)).bias; }}};
  for (const auto& [name, value] : pictures) {
    const TableCheck check = check_table(picture(size, size, value), false, source());
    EXPECT_FALSE(check.reading.has_value()) << name << ", misfit " << check.misfit;
    EXPECT_FALSE(check.why.empty()) << name;
    if (std::isfinite(check.misfit)) {
      EXPECT_GT(check.misfit, 0.22) << name << ": too near the limit";
    }
  }
  EXPECT_FALSE(check_table(centred(Visibility::Charlie, 3, 64), false, source()).reading.has_value());
}

}  // namespace
}  // namespace sheen::albedo
