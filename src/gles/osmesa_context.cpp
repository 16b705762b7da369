#include <array>

#include <glad/gles2.h>

#include "gles/contexts.h"
#include "gles/library.h"

namespace sheen::gles {
namespace {

// <GL/osmesa.h> of Mesa 22.3; not included, since it drags in a desktop <GL/gl.h>.
using OsMesaHandle = struct OsMesaContextStruct*;
constexpr int osmesa_format = 0x22;
constexpr int osmesa_depth_bits = 0x30;
constexpr int osmesa_stencil_bits = 0x31;
constexpr int osmesa_accum_bits = 0x32;
constexpr int osmesa_profile = 0x33;
constexpr int osmesa_core_profile = 0x34;
constexpr int osmesa_major = 0x36;
constexpr int osmesa_minor = 0x37;
constexpr int osmesa_rgba = 0x1908;  // GL_RGBA

constexpr const char* osmesa_advice = "\n  install it: apt-get install libosmesa6";

class OsMesaContext final : public Context {
 public:
  explicit OsMesaContext(const std::vector<std::string>& names)
      : Context(ContextKind::OsMesa),
        library_("OSMesa", names),
        destroy_(library_.symbol<Destroy>("OSMesaDestroyContext")),
        make_current_(library_.symbol<MakeCurrent>("OSMesaMakeCurrent")) {
    const auto create = library_.symbol<Create>("OSMesaCreateContextAttribs");
    const auto get_proc_address = library_.symbol<Loader>("OSMesaGetProcAddress");
    constexpr std::array<std::array<int, 2>, 2> versions{{{4, 5}, {3, 3}}};
    for (const auto& version : versions) {
      const std::array<int, 15> attributes{osmesa_format,
                                           osmesa_rgba,
                                           osmesa_depth_bits,
                                           0,
                                           osmesa_stencil_bits,
                                           0,
                                           osmesa_accum_bits,
                                           0,
                                           osmesa_profile,
                                           osmesa_core_profile,
                                           osmesa_major,
                                           version[0],
                                           osmesa_minor,
                                           version[1],
                                           0};
      handle_ = create(attributes.data(), nullptr);
      if (handle_ != nullptr) {
        break;
      }
    }
    if (handle_ == nullptr) {
      throw Unavailable(library_.name() + ": OSMesaCreateContextAttribs gives no core profile, neither 4.5 nor 3.3");
    }
    try {
      const CurrentScope scope(*this);
      load(get_proc_address, "OSMesa");
    } catch (...) {
      destroy_(handle_);
      throw;
    }
  }

  ~OsMesaContext() override {
    release();
    destroy_(handle_);
  }

  void make_current() override {
    if (make_current_(handle_, buffer_.data(), GL_UNSIGNED_BYTE, 1, 1) == GL_FALSE) {
      throw Error("OSMesaMakeCurrent refuses its context");
    }
  }

  void release() noexcept override { make_current_(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

 private:
  using Create = OsMesaHandle (*)(const int*, OsMesaHandle);
  using Destroy = void (*)(OsMesaHandle);
  using MakeCurrent = GLboolean (*)(OsMesaHandle, void*, GLenum, GLsizei, GLsizei);

  Library library_;
  Destroy destroy_;
  MakeCurrent make_current_;
  OsMesaHandle handle_ = nullptr;
  std::array<GLubyte, 4> buffer_{};  // OSMesa wants a colour buffer; everything is drawn into framebuffer objects
};

}  // namespace

std::unique_ptr<Context> create_osmesa_context(const std::vector<std::string>& library_names) {
  try {
    return std::make_unique<OsMesaContext>(library_names);
  } catch (const Unavailable& why) {
    throw Unavailable(why.what() + std::string(osmesa_advice));
  }
}

}  // namespace sheen::gles
