#include <array>
#include <cstdio>
#include <cstring>

#include <glad/egl.h>

#include "gles/contexts.h"
#include "gles/library.h"

namespace sheen::gles {
namespace {

constexpr const char* egl_advice = "\n  install it: apt-get install libegl1 libegl-mesa0 libgl1-mesa-dri";

/// Whether a space-separated list holds a word.
bool lists(const char* list, const char* word) {
  if (list == nullptr) {
    return false;
  }
  const std::size_t length = std::strlen(word);
  for (const char* at = std::strstr(list, word); at != nullptr; at = std::strstr(at + length, word)) {
    const bool starts = at == list || at[-1] == ' ';
    const bool ends = at[length] == ' ' || at[length] == '\0';
    if (starts && ends) {
      return true;
    }
  }
  return false;
}

/// The entry points this file needs, from a libEGL opened at run time.
struct Egl {
  explicit Egl(const std::vector<std::string>& names)
      : library("EGL", names),
        get_proc_address(library.symbol<PFNEGLGETPROCADDRESSPROC>("eglGetProcAddress")),
        get_error(library.symbol<PFNEGLGETERRORPROC>("eglGetError")),
        query_string(library.symbol<PFNEGLQUERYSTRINGPROC>("eglQueryString")),
        get_display(library.symbol<PFNEGLGETDISPLAYPROC>("eglGetDisplay")),
        initialize(library.symbol<PFNEGLINITIALIZEPROC>("eglInitialize")),
        terminate(library.symbol<PFNEGLTERMINATEPROC>("eglTerminate")),
        bind_api(library.symbol<PFNEGLBINDAPIPROC>("eglBindAPI")),
        choose_config(library.symbol<PFNEGLCHOOSECONFIGPROC>("eglChooseConfig")),
        create_context(library.symbol<PFNEGLCREATECONTEXTPROC>("eglCreateContext")),
        destroy_context(library.symbol<PFNEGLDESTROYCONTEXTPROC>("eglDestroyContext")),
        make_current(library.symbol<PFNEGLMAKECURRENTPROC>("eglMakeCurrent")) {}

  /// EGL's own name of what went wrong last.
  std::string last_error() const {
    constexpr std::array<const char*, 15> names{
        "EGL_SUCCESS",           "EGL_NOT_INITIALIZED",   "EGL_BAD_ACCESS",          "EGL_BAD_ALLOC",   "EGL_BAD_ATTRIBUTE",
        "EGL_BAD_CONFIG",        "EGL_BAD_CONTEXT",       "EGL_BAD_CURRENT_SURFACE", "EGL_BAD_DISPLAY", "EGL_BAD_MATCH",
        "EGL_BAD_NATIVE_PIXMAP", "EGL_BAD_NATIVE_WINDOW", "EGL_BAD_PARAMETER",       "EGL_BAD_SURFACE", "EGL_CONTEXT_LOST"};
    const EGLint code = get_error();
    const auto index = static_cast<std::size_t>(code - EGL_SUCCESS);
    if (index < names.size()) {
      return names[index];
    }
    std::array<char, 16> text{};
    std::snprintf(text.data(), text.size(), "0x%x", static_cast<unsigned>(code));
    return text.data();
  }

  Library library;
  PFNEGLGETPROCADDRESSPROC get_proc_address;
  PFNEGLGETERRORPROC get_error;
  PFNEGLQUERYSTRINGPROC query_string;
  PFNEGLGETDISPLAYPROC get_display;
  PFNEGLINITIALIZEPROC initialize;
  PFNEGLTERMINATEPROC terminate;
  PFNEGLBINDAPIPROC bind_api;
  PFNEGLCHOOSECONFIGPROC choose_config;
  PFNEGLCREATECONTEXTPROC create_context;
  PFNEGLDESTROYCONTEXTPROC destroy_context;
  PFNEGLMAKECURRENTPROC make_current;
};

/// A display to try, and how to call it in a message.
struct Candidate {
  std::string name;
  EGLDisplay display = EGL_NO_DISPLAY;
};

/// Every display this EGL can give: surfaceless, then one a device, then the default. What it cannot give is appended to `tried`.
std::vector<Candidate> displays(const Egl& egl, bool& counted, std::string& tried) {
  std::vector<Candidate> found;
  const char* const client = egl.query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  // With counted references one context's eglTerminate does not pull the display from under another's.
  counted = lists(client, "EGL_KHR_display_reference");
  const std::array<EGLint, 3> attributes{counted ? EGL_TRACK_REFERENCES_KHR : EGL_NONE, EGL_TRUE, EGL_NONE};
  const auto get_platform_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(egl.get_proc_address("eglGetPlatformDisplayEXT"));
  const auto add = [&](const std::string& name, EGLDisplay display) {
    if (display != EGL_NO_DISPLAY) {
      found.push_back({name, display});
    } else {
      tried += "\n  " + name + ": no display, " + egl.last_error();
    }
  };
  if (get_platform_display != nullptr && lists(client, "EGL_MESA_platform_surfaceless")) {
    add("surfaceless", get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, attributes.data()));
  } else {
    tried += "\n  surfaceless: EGL_MESA_platform_surfaceless is not offered";
  }
  const auto query_devices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(egl.get_proc_address("eglQueryDevicesEXT"));
  if (get_platform_display != nullptr && query_devices != nullptr && lists(client, "EGL_EXT_platform_device")) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count);
    if (count == 0) {
      tried += "\n  device: there is none";
    }
    for (EGLint i = 0; i < count; ++i) {
      add("device " + std::to_string(i),
          get_platform_display(EGL_PLATFORM_DEVICE_EXT, devices.at(static_cast<std::size_t>(i)), attributes.data()));
    }
  } else {
    tried += "\n  device: EGL_EXT_platform_device is not offered";
  }
  add("default", egl.get_display(EGL_DEFAULT_DISPLAY));
  return found;
}

class EglContext final : public Context {
 public:
  explicit EglContext(const std::vector<std::string>& names) : Context(ContextKind::Egl), egl_(names) {
    std::string tried;
    bool counted = false;
    for (const Candidate& candidate : displays(egl_, counted, tried)) {
      try {
        open(candidate);
        // The default display comes without counted references: it is left initialised, for others may use it.
        terminates_ = counted && candidate.name != "default";
        return;
      } catch (const std::runtime_error& why) {
        tried += "\n  " + candidate.name + ": " + why.what();
        close();
      }
    }
    throw Unavailable(egl_.library.name() + " gives no GL ES 3.0 context:" + tried);
  }

  ~EglContext() override {
    release();
    close();
    if (terminates_) {
      egl_.terminate(display_);
    }
  }

  void make_current() override {
    // The API is a state of the thread, and eglMakeCurrent(none) releases the context of the bound one.
    egl_.bind_api(EGL_OPENGL_ES_API);
    if (egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
      throw Error("eglMakeCurrent refuses its context: " + egl_.last_error());
    }
  }

  void release() noexcept override {
    egl_.bind_api(EGL_OPENGL_ES_API);
    egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }

 private:
  void open(const Candidate& candidate) {
    display_ = candidate.display;
    EGLint major = 0;
    EGLint minor = 0;
    if (egl_.initialize(display_, &major, &minor) == EGL_FALSE) {
      throw Unavailable("eglInitialize: " + egl_.last_error());
    }
    const char* const extensions = egl_.query_string(display_, EGL_EXTENSIONS);
    if (!lists(extensions, "EGL_KHR_surfaceless_context")) {
      throw Unavailable("EGL_KHR_surfaceless_context is not offered");
    }
    if (egl_.bind_api(EGL_OPENGL_ES_API) == EGL_FALSE) {
      throw Unavailable("eglBindAPI(EGL_OPENGL_ES_API): " + egl_.last_error());
    }
    EGLConfig config = EGL_NO_CONFIG_KHR;
    if (!lists(extensions, "EGL_KHR_no_config_context")) {
      const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_ES3_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
      EGLint count = 0;
      if (egl_.choose_config(display_, wanted.data(), &config, 1, &count) == EGL_FALSE || count == 0) {
        throw Unavailable("eglChooseConfig finds no GL ES 3 configuration: " + egl_.last_error());
      }
    }
    const std::array<EGLint, 5> version{EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 0, EGL_NONE};
    context_ = egl_.create_context(display_, config, EGL_NO_CONTEXT, version.data());
    if (context_ == EGL_NO_CONTEXT) {
      throw Unavailable("eglCreateContext: " + egl_.last_error());
    }
    const CurrentScope scope(*this);
    load(egl_.get_proc_address, candidate.name);
  }

  void close() noexcept {
    if (context_ != EGL_NO_CONTEXT) {
      egl_.destroy_context(display_, context_);
    }
    context_ = EGL_NO_CONTEXT;
  }

  Egl egl_;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
  bool terminates_ = false;
};

}  // namespace

std::unique_ptr<Context> create_egl_context(const std::vector<std::string>& library_names) {
  try {
    return std::make_unique<EglContext>(library_names);
  } catch (const Unavailable& why) {
    throw Unavailable(why.what() + std::string(egl_advice));
  }
}

}  // namespace sheen::gles
