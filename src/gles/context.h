#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

struct GladGLES2Context;

namespace sheen::gles {

/// The GL ES 3.0 entry points of one context, as glad names them without their "gl" (gl.DrawArrays).
using Functions = GladGLES2Context;

/// This machine lacks what is needed: says what was tried and what to install.
class Unavailable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The driver refused something it should do (shader, framebuffer): carries its own words.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class ContextKind { OsMesa, Egl };

/// What a driver says of itself.
struct ContextInfo {
  std::string renderer;   ///< GL_RENDERER
  std::string version;    ///< GL_VERSION
  int subpixel_bits = 4;  ///< GL_SUBPIXEL_BITS
  int mediump_bits = 23;  ///< fraction bits of fragment mediump floats, by glGetShaderPrecisionFormat
  bool desktop = false;   ///< a desktop GL core context that accepts GLSL ES 3.00, rather than GL ES
  std::string platform;   ///< "OSMesa", or the EGL platform: "surfaceless", "device 0", "default"
};

/// Names under which the libraries are looked for, in order; a test gives others.
struct LibraryNames {
  std::vector<std::string> osmesa{"libOSMesa.so.8", "libOSMesa.so.6"};
  std::vector<std::string> egl{"libEGL.so.1"};
};

/// A GL ES 3.0 (or compatible desktop core) context without a window. No GL library is linked: OSMesa and EGL are opened with dlopen.
/// EGL tries surfaceless, then device, then default display. Contexts of both kinds may live in one process, in either order: each has its
/// own table of functions, and none stays current outside a CurrentScope.
class Context {
 public:
  /// Throws Unavailable when this machine has no such context.
  static std::unique_ptr<Context> create(ContextKind kind, const LibraryNames& names = {});
  /// The preferred kind or, on a machine that lacks it, the other. Throws Unavailable with both lists when there is neither.
  static std::unique_ptr<Context> create_any(ContextKind preferred, const LibraryNames& names = {});

  virtual ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  /// Makes this the calling thread's context. Throws Error when the driver refuses.
  virtual void make_current() = 0;
  /// Leaves the calling thread without a context. Mesa's OSMesa and EGL share one dispatch table, so a context that stays current would
  /// still be seen by the other library.
  virtual void release() noexcept = 0;

  ContextKind kind() const { return kind_; }
  const ContextInfo& info() const { return info_; }
  /// Valid while the context is current.
  const Functions& gl() const { return *functions_; }

 protected:
  using Loader = void (*(*)(const char*))();
  explicit Context(ContextKind kind);
  /// Loads the functions of the current context and asks it what it is. Throws Unavailable when it is older than GL ES 3.0.
  void load(Loader get_proc_address, const std::string& platform);

 private:
  ContextKind kind_;
  ContextInfo info_;
  std::unique_ptr<Functions> functions_;
};

/// A context is current from the construction to the end of this scope.
class CurrentScope {
 public:
  explicit CurrentScope(Context& context) : context_(context) { context_.make_current(); }
  ~CurrentScope() { context_.release(); }
  CurrentScope(const CurrentScope&) = delete;
  CurrentScope& operator=(const CurrentScope&) = delete;

 private:
  Context& context_;
};

}  // namespace sheen::gles
