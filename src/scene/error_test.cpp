#include <string>

#include <gtest/gtest.h>

#include "scene/scene.h"

namespace sheen::scene {
namespace {

std::string said(const std::string& rule) {
  return Error("a.gltf", "nodes[0]", rule).what();
}

TEST(Error, NamesFileElementAndRule) {
  EXPECT_EQ(said("is its own ancestor"), "a.gltf: nodes[0]: is its own ancestor");
}

TEST(Error, KeepsUtf8AndSpellsOutWhatIsNone) {
  EXPECT_EQ(said("name 'Stoff \u00e4\u20ac\U0001F9F5'"), "a.gltf: nodes[0]: name 'Stoff \u00e4\u20ac\U0001F9F5'");
  EXPECT_EQ(said("\xff\xfe!"), "a.gltf: nodes[0]: \\xff\\xfe!");
  EXPECT_EQ(said("\xc0\xaf \xed\xa0\x80 \xf4\x90\x80\x80 \xe2\x82"),
            "a.gltf: nodes[0]: \\xc0\\xaf \\xed\\xa0\\x80 \\xf4\\x90\\x80\\x80 \\xe2\\x82")
      << "overlong, a surrogate, beyond U+10FFFF, cut short";
  EXPECT_EQ(said("\x1b[31m\n"), "a.gltf: nodes[0]: \\x1b[31m\\x0a") << "no file steers a terminal";
}

TEST(Error, ShowsBothEndsOfWhatIsLong) {
  std::string path;
  for (int i = 0; i < 100000; ++i) {
    path += "\u00e4";
  }
  const std::string text = Error("a.gltf", path, "is nested too deep").what();
  EXPECT_LT(text.size(), 450U);
  EXPECT_EQ(text.find("\\x"), std::string::npos) << "cut between characters: " << text;
  EXPECT_NE(text.find("is nested too deep"), std::string::npos);
}

}  // namespace
}  // namespace sheen::scene
