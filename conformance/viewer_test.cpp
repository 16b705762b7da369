#include "conformance/viewer.h"

#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "conformance/run.h"
#include "conformance/test_folder.h"

namespace sheen::conformance {
namespace {

using nlohmann::json;

const json good_hello = {{"viewer", "fake"}, {"version", "1.2"}, {"capabilities", json::array()}, {"encoding", "linear-float"}};

class ViewerTest : public testing::Test {
 protected:
  TestFolder folder_;

  /// The command of a fake viewer that follows the plan.
  std::vector<std::string> command(json plan) {
    plan["log"] = (folder_.path() / "log").string();
    const std::filesystem::path file = folder_.path() / "plan.json";
    std::ofstream(file) << plan.dump();
    return {SHEEN_CTS_FAKE_VIEWER, file.string()};
  }
  json plan(const json& how) { return {{"hello", good_hello}, {"answers", {{"*", "unsupported"}, {"victim", how}}}}; }
  Request request(const std::string& scene) { return {folder_.path() / scene, 0, 8, 8, folder_.path() / "out.exr", {}}; }
  int starts() {
    std::ifstream log(folder_.path() / "log");
    int count = 0;
    for (std::string line; std::getline(log, line);) {
      ++count;
    }
    return count;
  }
  /// What the misbehaviour is answered with; the request after it must be served as if nothing had been.
  Answer misbehave(const std::string& how, double limit = 20) {
    Viewer viewer(command(plan(how)), {20, limit});
    Answer answer = viewer.draw(request("victim.glb"));
    EXPECT_EQ(viewer.draw(request("next.glb")).status, AnswerStatus::Unsupported) << "it must be started again after: " << how;
    return answer;
  }
};

TEST_F(ViewerTest, HelloIsRead) {
  const Hello hello = parse_hello(
      R"({"viewer":"v","version":"3","capabilities":["settings"],"encoding":"srgb-8bit","context":{"renderer":"r","version":"4.5","mediump_bits":10,"subpixel_bits":8}})");
  EXPECT_EQ(hello.name, "v");
  EXPECT_EQ(hello.encoding, Encoding::Srgb8);
  EXPECT_EQ(hello.renderer, "r");
  EXPECT_EQ(hello.mediump_bits, 10);
  EXPECT_EQ(hello.subpixel_bits, 8);
  EXPECT_TRUE(hello.takes_settings());
}

TEST_F(ViewerTest, SubpixelBitsAreTheStandardsLeastWhereUnknownOrFewer) {
  EXPECT_EQ(parse_hello(good_hello.dump()).subpixel_bits, 4);
  json greedy = good_hello;
  greedy["context"] = {{"subpixel_bits", 0}};
  EXPECT_EQ(parse_hello(greedy.dump()).subpixel_bits, 4) << "fewer would widen every bound";
}

TEST_F(ViewerTest, BadHelloIsRefused) {
  for (const char* line : {"", "hello", "[]", "{}", R"({"viewer":"v"})", R"({"viewer":"v","encoding":"jpeg"})"}) {
    EXPECT_THROW(parse_hello(line), std::runtime_error) << line;
  }
}

TEST_F(ViewerTest, AnswersAreRead) {
  std::ofstream(folder_.path() / "picture") << "pixels";
  Viewer viewer(
      command({{"hello", good_hello}, {"answers", {{"*", {{"image", (folder_.path() / "picture").string()}}}, {"no", "failed"}}}}), {});
  const Answer drawn = viewer.draw(request("yes.glb"));
  EXPECT_EQ(drawn.status, AnswerStatus::Rendered) << drawn.message;
  EXPECT_EQ(drawn.image, folder_.path() / "out.exr");
  EXPECT_EQ(drawn.seconds, 0.25);
  const Answer refused = viewer.draw(request("no.glb"));
  EXPECT_EQ(refused.status, AnswerStatus::Failed);
  EXPECT_EQ(refused.message, "told to");
  EXPECT_EQ(starts(), 1) << "started once";
}

TEST_F(ViewerTest, APrecisionIsAskedForInTheSettingsIfOneIsWanted) {
  json asked = plan("unsupported");
  asked["requests"] = (folder_.path() / "requests").string();
  Viewer viewer(command(asked), {});
  Request wanted = request("wanted.glb");
  wanted.precision = "mediump";
  viewer.draw(wanted);
  viewer.draw(request("indifferent.glb"));
  std::ifstream requests(folder_.path() / "requests");
  std::string line;
  ASSERT_TRUE(std::getline(requests, line));
  EXPECT_EQ(json::parse(line)["settings"].value("precision", "none"), "mediump") << line;
  ASSERT_TRUE(std::getline(requests, line));
  EXPECT_EQ(json::parse(line)["settings"].value("precision", "none"), "none") << line;
}

TEST_F(ViewerTest, ACrashCostsOneCase) {
  const Answer answer = misbehave("crash");
  EXPECT_EQ(answer.status, AnswerStatus::Crash);
  EXPECT_NE(answer.message.find("signal"), std::string::npos) << answer.message;
  EXPECT_NE(answer.message.find("about to crash"), std::string::npos) << "its last words: " << answer.message;
  EXPECT_EQ(starts(), 2);
}

TEST_F(ViewerTest, AnEndInTheMiddleIsACrash) {
  const Answer answer = misbehave("exit");
  EXPECT_EQ(answer.status, AnswerStatus::Crash);
  EXPECT_NE(answer.message.find("exited with status 3"), std::string::npos) << answer.message;
}

TEST_F(ViewerTest, AHangCostsOneCase) {
  EXPECT_EQ(misbehave("hang", 0.5).status, AnswerStatus::Timeout);
  EXPECT_EQ(starts(), 2);
}

TEST_F(ViewerTest, AClosedOutputIsACrashThoughTheProcessLives) {
  EXPECT_EQ(misbehave("close").status, AnswerStatus::Crash);
}

TEST_F(ViewerTest, GarbageIsInvalid) {
  EXPECT_EQ(misbehave("garbage").status, AnswerStatus::Invalid);
}

TEST_F(ViewerTest, AnAnswerToAnotherRequestIsInvalid) {
  EXPECT_EQ(misbehave("wrong_id").status, AnswerStatus::Invalid);
}

TEST_F(ViewerTest, AnUnknownStatusIsInvalid) {
  EXPECT_EQ(misbehave("wrong_status").status, AnswerStatus::Invalid);
}

TEST_F(ViewerTest, AnEndlessLineIsInvalid) {
  EXPECT_EQ(misbehave("endless").status, AnswerStatus::Invalid);
}

TEST_F(ViewerTest, AnOldPictureIsNotTakenForANewOne) {
  std::ofstream(folder_.path() / "out.exr") << "old";
  Viewer viewer(command(plan("no_file")), {});
  EXPECT_EQ(viewer.draw(request("victim.glb")).status, AnswerStatus::Rendered) << "so it says";
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "out.exr"));
}

TEST_F(ViewerTest, AViewerThatDoesNotStartSaysWhy) {
  EXPECT_THROW(Viewer({"/no/such/viewer"}, {}), ViewerUnavailable);
  EXPECT_THROW(Viewer(command({{"hello", nullptr}}), {0.3, 1}), ViewerUnavailable) << "silence";
  EXPECT_THROW(Viewer(command({{"hello", "Gtk-WARNING: cannot open display"}}), {}), ViewerUnavailable);
  try {
    Viewer({"/bin/sh", "-c", "echo no GL here >&2; exit 4"}, {});
    FAIL() << "must throw";
  } catch (const ViewerUnavailable& error) {
    EXPECT_NE(std::string(error.what()).find("exited with status 4"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("no GL here"), std::string::npos) << error.what();
  }
}

TEST_F(ViewerTest, AViewerThatCannotBeStartedAgainIsGivenUp) {
  // It starts once, then never again, since its plan is gone.
  Viewer viewer(command(plan("crash")), {});
  std::filesystem::remove(folder_.path() / "plan.json");
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(viewer.draw(request("victim.glb")).status, AnswerStatus::Crash);
  }
}

TEST(ChildProcess, IsEndedWithAllItStarted) {
  const TestFolder folder;
  const std::string mark = (folder.path() / "mark").string();
  {
    ChildProcess child({"/bin/sh", "-c", "(sleep 1; echo late > " + mark + ") & echo ready; wait"});
    std::string line;
    ASSERT_EQ(child.read_line(line, deadline_in(10)), ChildProcess::ReadStatus::Line);
    EXPECT_EQ(line, "ready");
  }
  // Its grandchild, were it alive, would write the file after its second.
  ChildProcess wait({"/bin/sleep", "1.5"});
  EXPECT_EQ(wait.finish(20), "exited with status 0");
  EXPECT_FALSE(std::filesystem::exists(mark));
}

TEST(ChildProcess, ReadsLinesThatComeInPieces) {
  ChildProcess child({"/bin/sh", "-c", "printf 'on'; sleep 0.1; printf 'e\\ntwo\\nthr'; sleep 0.1; printf 'ee\\n'"});
  std::string line;
  for (const char* expected : {"one", "two", "three"}) {
    ASSERT_EQ(child.read_line(line, deadline_in(10)), ChildProcess::ReadStatus::Line);
    EXPECT_EQ(line, expected);
  }
  EXPECT_EQ(child.read_line(line, deadline_in(10)), ChildProcess::ReadStatus::Closed);
}

TEST(ChildProcess, WritingToADeadChildIsNoSignal) {
  ChildProcess child({"/bin/true"});
  std::string line;
  EXPECT_EQ(child.read_line(line, deadline_in(10)), ChildProcess::ReadStatus::Closed);
  bool written = true;
  for (int i = 0; i < 100 && written; ++i) {
    written = child.write_line(std::string(10000, 'x'), deadline_in(1));
  }
  EXPECT_FALSE(written);
}

TEST(SplitCommand, KnowsQuotesAndNoShell) {
  EXPECT_EQ(split_command(R"(node  "my viewer.js" --a='b c' d\ e)"), (std::vector<std::string>{"node", "my viewer.js", "--a=b c", "d e"}));
  EXPECT_EQ(split_command("a '' $HOME;b"), (std::vector<std::string>{"a", "", "$HOME;b"}));
  EXPECT_THROW(split_command("a 'b"), std::invalid_argument);
  EXPECT_THROW(split_command("  "), std::invalid_argument);
}

}  // namespace
}  // namespace sheen::conformance
