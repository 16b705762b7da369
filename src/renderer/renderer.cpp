#include "renderer/renderer.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <future>
#include <map>
#include <optional>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include "gles/objects.h"
#include "renderer/assembly.h"
#include "renderer/environment_maps.h"
#include "renderer/features.h"
#include "renderer/geometry.h"
#include "renderer/kept_images.h"
#include "renderer/kept_table.h"
#include "renderer/lights.h"
#include "renderer/program.h"
#include "renderer/target.h"
#include "renderer/textures.h"

namespace sheen::renderer {

namespace {

/// DRAWS of shaders/environment_sampled.glsl, at most.
constexpr int ways_to_draw = 7;

/// What outlives a scene: programs by their source, tables by their visibility, the last target and environment.
struct Resources {
  Resources(gles::Context& context_, std::filesystem::path cache) : context(context_), kept(std::move(cache)) {}

  const Program& program(const ShaderPlan& plan, const Settings& settings) {
    const ShaderText text = assemble(plan, settings);
    const auto found = programs.find(text.fragment + text.vertex);
    if (found != programs.end()) {
      return found->second;
    }
    return programs.emplace(text.fragment + text.vertex, Program(context.gl(), text)).first->second;
  }

  /// Begins to get a table that will be asked for, while the driver compiles and pictures are uploaded.
  void start_table(albedo::Visibility visibility) {
    if (!tables.contains(visibility) && !built.contains(visibility)) {
      built.emplace(visibility, std::async(std::launch::async, kept_table, std::cref(kept), visibility));
    }
  }

  GLuint table(albedo::Visibility visibility) {
    auto found = tables.find(visibility);
    if (found == tables.end()) {
      start_table(visibility);
      found = tables.emplace(visibility, upload_table(context.gl(), built.extract(visibility).mapped().get())).first;
    }
    return found->second.name();
  }

  GLuint ggx_table() {
    if (!ggx) {
      ggx.emplace(upload_table(context.gl(), albedo::build_ggx_table()));
    }
    return ggx->name();
  }

  const Target& target_of(int width, int height) {
    if (!target || target->width() != width || target->height() != height) {
      target.reset();
      target.emplace(context, width, height);
    }
    return *target;
  }

  gles::Context& context;
  const KeptImages kept;
  std::map<std::string, Program> programs;
  std::map<albedo::Visibility, gles::Texture> tables;
  std::map<albedo::Visibility, std::future<albedo::Table>> built;  ///< not yet uploaded
  std::optional<gles::Texture> ggx;
  std::optional<Target> target;
  EnvironmentMaps environments{context, kept};
};

/// One primitive of the scene, ready to be drawn.
struct Drawable {
  const scene::Material* material = nullptr;
  ShaderPlan plan;
  const Program* program = nullptr;
  std::optional<Geometry> geometry;
};

void set_material(const Program& program, const scene::Material& material) {
  const double reflected = (1.0 - material.ior) / (1.0 + material.ior);
  program.set("u_base_color_factor", material.base_color_factor);
  program.set("u_metallic_factor", material.metallic_factor);
  program.set("u_roughness_factor", material.roughness_factor);
  program.set("u_normal_scale", material.normal_scale);
  program.set("u_specular_f0", reflected * reflected);
  program.set("u_specular_factor", material.specular.factor);
  program.set("u_specular_color_factor", material.specular.color_factor);
  program.set("u_sheen_color_factor", material.sheen.color_factor);
  program.set("u_sheen_roughness_factor", material.sheen.roughness_factor);
  program.set("u_clearcoat_factor", material.clearcoat.factor);
  program.set("u_clearcoat_roughness_factor", material.clearcoat.roughness_factor);
  program.set("u_clearcoat_normal_scale", material.clearcoat.normal_scale);
  program.set("u_occlusion_strength", material.occlusion_strength);
  program.set("u_emissive_factor", material.emissive_factor);
  program.set("u_alpha_cutoff", material.alpha_cutoff);
}

/// Draws one scene; lives for one call.
class SceneDraw {
 public:
  SceneDraw(Resources& resources, const scene::Scene& scene, const Settings& settings)
      : resources_(resources),
        gl_(resources.context.gl()),
        scene_(scene),
        settings_(settings),
        camera_(scene::resolve_camera(scene, settings.view)),
        view_from_world_(scene::camera_from_world(camera_)),
        lights_(pack_lights(scene.lights, view_from_world_)),
        pictures_(gl_) {
    prepare();
  }

  image::Image draw() {
    const Target& target = resources_.target_of(settings_.view.width, settings_.view.height);
    target.begin();
    if (settings_.environment != nullptr && settings_.environment->background) {
      draw_background();
    }
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_LESS);
    gl_.Disable(GL_BLEND);
    gl_.CullFace(GL_BACK);
    for (const scene::Instance& instance : scene_.instances) {
      const Drawable& drawable = drawables_.at(instance.primitive);
      if (drawable.material->alpha_mode == scene::AlphaMode::Blend) {
        continue;
      }
      set_up(drawable, instance);
      drawable.geometry->draw(gl_);
    }
    draw_blended();
    gles::check(gl_, "drawing " + scene_.file);
    return target.read();
  }

 private:
  glm::dmat4 view_from_local(const scene::Instance& instance) const {
    const Geometry& geometry = *drawables_.at(instance.primitive).geometry;
    return glm::translate(view_from_world_ * instance.world_from_local, geometry.origin());
  }

  void prepare() {
    std::vector<ShaderPlan> plans;
    std::vector<TextureUse> uses;
    std::vector<Box> boxes;
    std::vector<glm::dmat4> matrices;
    for (const scene::Instance& instance : scene_.instances) {
      const auto [place, fresh] = drawables_.try_emplace(instance.primitive);
      Drawable& drawable = place->second;
      if (fresh) {
        const scene::Primitive& primitive = scene_.primitives.at(static_cast<std::size_t>(instance.primitive));
        drawable.material = &scene_.materials.at(static_cast<std::size_t>(primitive.material));
        drawable.plan = plan_shader(scene_, primitive, camera_, settings_);
        if (drawable.plan.sheen_albedo_table) {
          resources_.start_table(settings_.sheen.visibility);
        }
        drawable.program = &resources_.program(drawable.plan, settings_);
        drawable.geometry.emplace(gl_, scene_, primitive, drawable.plan);
        plans.push_back(drawable.plan);
        uses.insert(uses.end(), drawable.plan.textures.begin(), drawable.plan.textures.end());
      }
      boxes.push_back(drawable.geometry->box());
      matrices.push_back(view_from_local(instance));
    }
    pictures_.prepare(scene_, uses);
    const double aspect = static_cast<double>(settings_.view.width) / static_cast<double>(settings_.view.height);
    clip_from_view_ = scene::clip_from_camera(tighten_depth_range(camera_, boxes, matrices), aspect);
    if (settings_.environment != nullptr && settings_.environment->background) {
      plans.push_back(plan_background(settings_));
    }
    prepare_environment(plans);
    units_ = texture_units(plans);
    GLint available = 0;
    gl_.GetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &available);
    if (units_.size() > static_cast<std::size_t>(available)) {
      throw gles::Error(scene_.file + " needs " + std::to_string(units_.size()) + " texture units, this driver has " +
                        std::to_string(available));
    }
    if (std::find(units_.begin(), units_.end(), "lights") != units_.end()) {
      light_texture_.emplace(upload_lights(gl_, lights_));
    }
  }

  /// Binds a texture to the unit of that name and tells the program.
  void bind(const Program& program, const std::string& name, GLuint texture) const {
    const auto unit = static_cast<int>(std::find(units_.begin(), units_.end(), name) - units_.begin());
    gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    gl_.BindTexture(GL_TEXTURE_2D, texture);
    program.set("u_" + name, unit);
  }

  /// Makes what the plans read of the environment. Filtering draws, so it comes before anything else is bound.
  void prepare_environment(const std::vector<ShaderPlan>& plans) {
    const auto any = [&](bool ShaderPlan::*reads) {
      return std::any_of(plans.begin(), plans.end(), [&](const ShaderPlan& plan) { return plan.*reads; });
    };
    EnvironmentMaps& maps = resources_.environments;
    if (any(&ShaderPlan::environment_image)) {
      around_.image = settings_.prefiltered() ? maps.prefiltered(*settings_.environment, kernels_of(plans))  //
                                              : maps.sampled(*settings_.environment);
    }
    if (any(&ShaderPlan::split_sum_table)) {
      around_.split_sums = maps.split_sums();
    }
    if (any(&ShaderPlan::environment_points)) {
      // Each way to draw directions draws one at least.
      around_.points = maps.points(*settings_.environment, settings_.environment_samples + ways_to_draw, settings_.seed);
    }
  }

  void set_environment(const Program& program, const ShaderPlan& plan) const {
    if (settings_.environment == nullptr) {
      return;
    }
    const scene::Environment& environment = *settings_.environment;
    if (plan.environment_image) {
      const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), -environment.rotation, glm::dvec3(0.0, 1.0, 0.0));
      bind(program, "environment", around_.image);
      program.set("u_environment_size", glm::ivec2(environment.width, environment.height));
      program.set("u_environment_from_view", glm::dmat3(turned) * glm::transpose(glm::dmat3(view_from_world_)));
    } else {
      program.set("u_environment_uniform", environment.uniform);
    }
    if (plan.split_sum_table) {
      bind(program, "split_sum", around_.split_sums);
    }
    if (plan.environment_points) {
      bind(program, "environment_points", around_.points);
      program.set("u_environment_samples", settings_.environment_samples);
    }
  }

  void draw_background() {
    const ShaderPlan plan = plan_background(settings_);
    const Program& program = resources_.program(plan, settings_);
    program.use();
    set_environment(program, plan);
    const double up = camera_.perspective ? std::tan(0.5 * camera_.yfov) : 0.0;
    program.set("u_viewport", glm::dvec2(settings_.view.width, settings_.view.height));
    program.set("u_view_extent", glm::dvec2(up * settings_.view.width / settings_.view.height, up));
    gl_.Disable(GL_DEPTH_TEST);
    gl_.Disable(GL_CULL_FACE);
    gl_.Disable(GL_BLEND);
    const gles::VertexArray nothing(gl_);
    gl_.BindVertexArray(nothing.name());
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  }

  void set_up(const Drawable& drawable, const scene::Instance& instance) {
    const Program& program = *drawable.program;
    program.use();
    set_material(program, *drawable.material);
    // Uploading a table binds to the active unit, so they are made before anything is bound to its own.
    std::vector<GLuint> textures;
    for (const TextureUse& use : drawable.plan.textures) {
      textures.push_back(pictures_.texture(scene_, use));
    }
    const GLuint table = drawable.plan.sheen_albedo_table ? resources_.table(settings_.sheen.visibility) : 0;
    const GLuint ggx_table = drawable.plan.ggx_albedo_table ? resources_.ggx_table() : 0;
    for (std::size_t i = 0; i < textures.size(); ++i) {
      const TextureUse& use = drawable.plan.textures[i];
      bind(program, use.name, textures[i]);
      program.set("u_" + use.name + "_size", Pictures::size(scene_, use));
      if (use.transformed) {
        program.set("u_" + use.name + "_transform", use.info->transform);
      }
    }
    if (table != 0) {
      bind(program, "sheen_albedo", table);
    }
    if (ggx_table != 0) {
      bind(program, "ggx_albedo", ggx_table);
    }
    set_environment(program, drawable.plan);
    program.set("u_light_count", static_cast<int>(scene_.lights.size()));
    if (drawable.plan.light_texture) {
      bind(program, "lights", light_texture_->name());
    } else {
      program.set("u_lights", lights_);
    }
    const glm::dmat4 matrix = view_from_local(instance);
    program.set("u_clip_from_local", clip_from_view_ * matrix);
    program.set("u_view_from_local", matrix);
    program.set("u_normal_from_local", normal_matrix(matrix));
    gl_.FrontFace(instance.mirrored() ? GL_CW : GL_CCW);
    drawable.material->double_sided ? gl_.Disable(GL_CULL_FACE) : gl_.Enable(GL_CULL_FACE);
  }

  /// Back to front by triangle; neighbours in the order that belong to one instance go in one draw.
  void draw_blended() {
    const std::vector<scene::BlendTriangle> order = scene::blend_order(scene_, camera_);
    if (order.empty()) {
      return;
    }
    if (!resources_.context.info().desktop && gl_.EXT_float_blend == 0) {
      throw gles::Error(resources_.context.info().renderer + " lacks GL_EXT_float_blend: it cannot blend into 32-bit floats");
    }
    gl_.DepthMask(GL_FALSE);
    gl_.Enable(GL_BLEND);
    gl_.BlendEquation(GL_FUNC_ADD);
    gl_.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    std::vector<std::uint32_t> triangles;
    for (std::size_t begin = 0; begin < order.size(); begin += triangles.size()) {
      triangles.clear();
      for (std::size_t i = begin; i < order.size() && order[i].instance == order[begin].instance; ++i) {
        triangles.push_back(order[i].triangle);
      }
      const scene::Instance& instance = scene_.instances.at(order[begin].instance);
      const Drawable& drawable = drawables_.at(instance.primitive);
      set_up(drawable, instance);
      drawable.geometry->draw(gl_, triangles);
    }
    gl_.Disable(GL_BLEND);
    gl_.DepthMask(GL_TRUE);
  }

  Resources& resources_;
  const gles::Functions& gl_;
  const scene::Scene& scene_;
  const Settings& settings_;
  scene::Camera camera_;
  glm::dmat4 view_from_world_;
  glm::dmat4 clip_from_view_{1.0};
  std::vector<glm::vec4> lights_;
  std::map<int, Drawable> drawables_;
  std::vector<std::string> units_;
  struct {
    GLuint image = 0, split_sums = 0, points = 0;
  } around_;
  Pictures pictures_;
  std::optional<gles::Texture> light_texture_;
};

}  // namespace

struct Renderer::Impl : Resources {
  using Resources::Resources;
};

Renderer::Renderer(gles::Context& context, std::filesystem::path cache) : impl_(std::make_unique<Impl>(context, std::move(cache))) {}

Renderer::~Renderer() {
  try {
    const gles::CurrentScope scope(impl_->context);
    impl_.reset();
  } catch (const gles::Error&) {
    // A context that can no longer be made current has taken its objects with it.
  }
}

image::Image Renderer::render(const scene::Scene& scene, const Settings& settings) {
  const gles::CurrentScope scope(impl_->context);
  return SceneDraw(*impl_, scene, settings).draw();
}

}  // namespace sheen::renderer
