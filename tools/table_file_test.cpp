#include "tools/table_file.h"

#include <gtest/gtest.h>

#include "tools/errors.h"

namespace sheen::tools {
namespace {

std::string refusal(const std::string& text) {
  try {
    parse_table(text, "t.csv");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(TableFile, ACsvWithCoordinatesBecomesRowsOfOneRoughness) {
  const image::Image image = parse_table(
      "sheen_roughness,n_dot_v,directional_albedo\n0.25,0.1,1\n0.25,0.5,2\n0.25,0.9,3\n0.75,0.1,4\n0.75,0.5,5\n0.75,0.9,6e0\n", "t.csv");
  ASSERT_EQ(image.width, 3);
  ASSERT_EQ(image.height, 2);
  EXPECT_EQ(image.channels, std::vector<std::string>{"directional_albedo"});
  EXPECT_EQ(image.at(2, 0, 0), 3.0f);
  EXPECT_EQ(image.at(0, 1, 0), 4.0f);
}

TEST(TableFile, ACsvThatRunsOverRoughnessFirstIsATransposedTable) {
  const image::Image image =
      parse_table("n_dot_v, roughness, scale, bias\r\n0.1,0.25,1,10\r\n0.1,0.75,2,20\r\n0.5,0.25,3,30\r\n0.5,0.75,4,40\r\n\r\n", "t.csv");
  ASSERT_EQ(image.width, 2);
  ASSERT_EQ(image.height, 2);
  EXPECT_EQ(image.channels, (std::vector<std::string>{"scale", "bias"}));
  EXPECT_EQ(image.at(1, 0, 0), 2.0f);
  EXPECT_EQ(image.at(0, 1, 1), 30.0f);
}

TEST(TableFile, ACsvOfNumbersAloneIsTheTableItself) {
  const image::Image image = parse_table("1,2,3\n4,5,6", "t.csv");
  ASSERT_EQ(image.width, 3);
  ASSERT_EQ(image.height, 2);
  EXPECT_EQ(image.at(0, 1, 0), 4.0f);
}

TEST(TableFile, ABrokenCsvIsRefusedWithItsLine) {
  EXPECT_NE(refusal("1,2\n3\n").find("t.csv: line 2"), std::string::npos);
  EXPECT_NE(refusal("1,2\n3,four\n").find("line 2"), std::string::npos);
  EXPECT_NE(refusal("").find("no table"), std::string::npos);
  EXPECT_NE(refusal("roughness,n_dot_v\n1,2\n").find("line 1"), std::string::npos);
  EXPECT_NE(refusal("a,b,c\n1,2,3\n").find("n_dot_v"), std::string::npos);
  EXPECT_NE(refusal("roughness,n_dot_v,e\n1,1,0\n1,2,0\n2,1,0\n").find("rows"), std::string::npos);
  EXPECT_NE(refusal("roughness,n_dot_v,e\n1,1,0\n1,2,0\n2,1,0\n3,2,0\n").find("one length"), std::string::npos);
}

TEST(TableFile, AFileThatIsNotThereIsRefusedByName) {
  EXPECT_THROW(read_table("/nonexistent/t.csv"), InputError);
}

}  // namespace
}  // namespace sheen::tools
