#include "gles/objects.h"

#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace sheen::gles {
namespace {

constexpr const char* vertex = "#version 300 es\nvoid main() { gl_Position = vec4(0.0); }\n";
constexpr const char* fragment = "#version 300 es\nprecision highp float;\nout vec4 color;\nvoid main() { color = vec4(1.0); }\n";

std::string why_refused(const Functions& gl, const std::string& vertex_source, const std::string& fragment_source) {
  try {
    link_program(gl, vertex_source, fragment_source);
  } catch (const Error& why) {
    return why.what();
  }
  return "";
}

class Objects : public testing::Test {
 protected:
  std::unique_ptr<Context> context_ = Context::create_any(ContextKind::OsMesa);
  CurrentScope scope_{*context_};
};

TEST_F(Objects, AShaderThatDoesNotCompileCarriesTheDriversLogAndNumberedLines) {
  const std::string why = why_refused(context_->gl(), vertex,
                                      "#version 300 es\nprecision highp float;\nout vec4 color;\nvoid main() { color = undeclared; }\n");
  EXPECT_NE(why.find("fragment shader does not compile"), std::string::npos) << why;
  EXPECT_NE(why.find("`undeclared' undeclared"), std::string::npos) << why;
  EXPECT_NE(why.find("4: void main() { color = undeclared; }"), std::string::npos) << why;
}

TEST_F(Objects, AProgramThatDoesNotLinkSaysWhy) {
  const std::string reads =
      "#version 300 es\nprecision highp float;\nin vec4 v_missing;\nout vec4 color;\nvoid main() { color = v_missing; }\n";
  const std::string why = why_refused(context_->gl(), vertex, reads);
  EXPECT_NE(why.find("does not link"), std::string::npos) << why;
  EXPECT_NE(why.find("v_missing"), std::string::npos) << why;
}

TEST_F(Objects, AreDeletedWithTheirOwnerAndMovedWithIt) {
  const Functions& gl = context_->gl();
  GLuint name = 0;
  {
    Program program = link_program(gl, vertex, fragment);
    name = program.name();
    const Program moved = std::move(program);
    EXPECT_EQ(moved.name(), name);
    EXPECT_EQ(gl.IsProgram(name), GL_TRUE);
  }
  EXPECT_EQ(gl.IsProgram(name), GL_FALSE);
}

TEST_F(Objects, AnErrorTheContextRecordedIsThrownByName) {
  context_->gl().Enable(GL_TEXTURE_WRAP_S);
  try {
    check(context_->gl(), "enabling nonsense");
    FAIL() << "nothing thrown";
  } catch (const Error& why) {
    EXPECT_STREQ(why.what(), "enabling nonsense: GL_INVALID_ENUM");
  }
  EXPECT_NO_THROW(check(context_->gl(), "nothing"));
}

TEST_F(Objects, AFramebufferWithoutAttachmentsIsIncomplete) {
  const Functions& gl = context_->gl();
  const Framebuffer framebuffer(gl);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  EXPECT_THROW(check_framebuffer(gl, "empty"), Error);
}

}  // namespace
}  // namespace sheen::gles
