#include "gles/context.h"

#include <array>
#include <string>

#include <glad/gles2.h>
#include <gtest/gtest.h>

namespace sheen::gles {
namespace {

/// What a context reads back after clearing one RGBA8 texel to 51/255, 102/255, 153/255, 1.
std::array<unsigned char, 4> clear_and_read(Context& context) {
  const CurrentScope scope(context);
  const Functions& gl = context.gl();
  GLuint color = 0;
  GLuint framebuffer = 0;
  gl.GenRenderbuffers(1, &color);
  gl.BindRenderbuffer(GL_RENDERBUFFER, color);
  gl.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, 1, 1);
  gl.GenFramebuffers(1, &framebuffer);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
  gl.ClearColor(0.2f, 0.4f, 0.6f, 1.0f);
  gl.Clear(GL_COLOR_BUFFER_BIT);
  std::array<unsigned char, 4> texel{};
  gl.ReadPixels(0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, texel.data());
  EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
  gl.DeleteFramebuffers(1, &framebuffer);
  gl.DeleteRenderbuffers(1, &color);
  return texel;
}

constexpr std::array<unsigned char, 4> cleared{51, 102, 153, 255};

class TwoContexts : public testing::TestWithParam<std::array<ContextKind, 2>> {};

TEST_P(TwoContexts, LiveInOneProcessAndDrawInTurn) {
  const auto first = Context::create(GetParam()[0]);
  EXPECT_EQ(clear_and_read(*first), cleared);
  const auto second = Context::create(GetParam()[1]);
  for (int turn = 0; turn < 2; ++turn) {
    EXPECT_EQ(clear_and_read(*first), cleared) << "turn " << turn;
    EXPECT_EQ(clear_and_read(*second), cleared) << "turn " << turn;
  }
}

TEST_P(TwoContexts, OneOutlivesTheOther) {
  auto first = Context::create(GetParam()[0]);
  const auto second = Context::create(GetParam()[1]);
  EXPECT_EQ(clear_and_read(*first), cleared);
  first.reset();
  EXPECT_EQ(clear_and_read(*second), cleared);
}

INSTANTIATE_TEST_SUITE_P(InEveryOrder, TwoContexts,
                         testing::Values(std::array{ContextKind::OsMesa, ContextKind::Egl},
                                         std::array{ContextKind::Egl, ContextKind::OsMesa},
                                         std::array{ContextKind::OsMesa, ContextKind::OsMesa},
                                         std::array{ContextKind::Egl, ContextKind::Egl}));

TEST(Context, SaysWhatItIs) {
  for (const ContextKind kind : {ContextKind::OsMesa, ContextKind::Egl}) {
    const auto context = Context::create(kind);
    EXPECT_EQ(context->kind(), kind);
    EXPECT_FALSE(context->info().renderer.empty());
    EXPECT_FALSE(context->info().platform.empty());
    EXPECT_GE(context->info().subpixel_bits, 4) << "OpenGL ES 3.0.6, table 6.29";
    EXPECT_GE(context->info().mediump_bits, 9) << "GLSL ES 3.00.6, section 4.5.1";
    EXPECT_EQ(context->info().desktop, kind == ContextKind::OsMesa);
  }
}

std::string why_unavailable(ContextKind kind, const LibraryNames& names) {
  try {
    Context::create(kind, names);
  } catch (const Unavailable& why) {
    return why.what();
  }
  return "nothing thrown";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Context, ALibraryThatIsMissingIsNamedWithWhatToInstall) {
  const LibraryNames names{{"libNoOSMesa.so.8", "libNoOSMesa.so.6"}, {"libNoEGL.so.1"}};
  const std::string osmesa = why_unavailable(ContextKind::OsMesa, names);
  EXPECT_TRUE(contains(osmesa, "libNoOSMesa.so.8: cannot open") && contains(osmesa, "libNoOSMesa.so.6: cannot open")) << osmesa;
  EXPECT_TRUE(contains(osmesa, "apt-get install libosmesa6")) << osmesa;
  const std::string egl = why_unavailable(ContextKind::Egl, names);
  EXPECT_TRUE(contains(egl, "libNoEGL.so.1: cannot open") && contains(egl, "libegl1")) << egl;
}

TEST(Context, ALibraryThatIsNotAGlLibraryIsUnavailableToo) {
  const LibraryNames names{{"libm.so.6"}, {"libm.so.6"}};
  EXPECT_TRUE(contains(why_unavailable(ContextKind::OsMesa, names), "libm.so.6 has no function OSMesa"));
  EXPECT_TRUE(contains(why_unavailable(ContextKind::Egl, names), "libm.so.6 has no function egl"));
}

TEST(Context, AnyKindDoesWhenThePreferredIsMissingAndBothAreNamedWhenNoneIs) {
  const LibraryNames no_osmesa{{"libNoOSMesa.so.8"}, {"libEGL.so.1"}};
  EXPECT_EQ(Context::create_any(ContextKind::OsMesa, no_osmesa)->kind(), ContextKind::Egl);
  EXPECT_EQ(Context::create_any(ContextKind::OsMesa)->kind(), ContextKind::OsMesa);
  try {
    Context::create_any(ContextKind::Egl, {{"libNoOSMesa.so.8"}, {"libNoEGL.so.1"}});
    FAIL() << "nothing thrown";
  } catch (const Unavailable& why) {
    EXPECT_TRUE(contains(why.what(), "libosmesa6") && contains(why.what(), "libegl-mesa0")) << why.what();
  }
}

}  // namespace
}  // namespace sheen::gles
