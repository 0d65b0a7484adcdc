// What draws: one Vulkan device, one scene, any number of lamps, any number of views a frame. Used by the visual
// process and by `phare measure`.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "config/desk.h"
#include "visual/effects.h"
#include "visual/eyeshine.h"
#include "visual/falling.h"
#include "visual/glare.h"
#include "visual/gui_content.h"
#include "visual/overlay_content.h"
#include "visual/photometry/beam/beam_composer.h"
#include "visual/photometry/beam/beam_image.h"
#include "visual/photometry/beam/image_levels.h"
#include "visual/photometry/table/opening.h"
#include "visual/scene/world.h"
#include "visual/spray.h"
#include "visual/view.h"
#include "visual/windscreen.h"

struct GLFWwindow;

namespace phare {

class FixedLight;  // visual/fixed_light.h

struct RendererOptions {
  int width_px = 1280;
  int height_px = 720;
  int samples = 1;                                  ///< 1 or 4 (multisampling)
  bool validation = false;                          ///< Vulkan validation with synchronization validation
  GLFWwindow* window = nullptr;                     ///< nullptr: headless
  ImageLevel beam_level = ImageLevel::kFloatNodes;  ///< how beam images are stored and looked up
  std::string device_name{};  ///< pick a device whose name contains this; empty: the first discrete GPU, else any
  bool float64 = true;        ///< false: as if the device had no shaderFloat64
  bool multi_draw = true;     ///< false: as if it had no VK_EXT_multi_draw
  bool processor_depths = true;  ///< false: one that is the processor draws shadow maps itself, as others do
  /// 1: a frame is waited for. 2: one is recorded while the device draws the one before, and a picture is up to a frame
  /// older when it is seen. One that takes a new pipeline is waited for all the same.
  std::size_t frames_in_flight = 1;
};

/// A lamp position in the world this frame.
struct PlacedLamp {
  glm::dvec3 position_m{0.0};
  glm::dmat3 world_from_image{1.0};  ///< columns: forward, left, up of the beam image
  std::size_t beam = 0;              ///< index of the beam image set with set_beam
  /// Which of FrameInput::moving carries it, and casts no shadow in its light.
  std::size_t carried_by = SIZE_MAX;
  bool of_b = false;  ///< of the other design, for View::kDifference and kRatio
  double body_m = 0.0;  ///< of its vehicle's body: from behind it, air nearer to it is not seen to shine
  LampOpening opening{};  ///< whose parts hide their share of the light, where shadows ask for it
};

/// So many lamps light one draw at most, which is a block of the scene where a view has many. Those that reach nothing
/// of it do not count.
inline constexpr std::size_t kLampsPerDraw = shader::kMaxLamps;
/// So many light all that a view sees; of more, each block of the scene is lit by those that reach it.
inline constexpr std::size_t kLampsForAll = 4;

/// Blocks of the scene farther than this are drawn with fewer triangles: their errors are made for this distance.
constexpr double kFarMeshFrom_m = 150.0;
constexpr double kFarMeshPixel_rad = 1.0471975511965976 / 1280;  ///< 60° over 1280 pixels; finer ones: farther

/// A part of a picture, in shares of its width and height from the upper left corner.
struct PicturePart {
  double left_01 = 0.0, top_01 = 0.0, width_01 = 1.0, height_01 = 1.0;
};

struct PictureSize {
  int width_px = 0, height_px = 0;
};

/// One eye, what it sees by, and where that is drawn.
struct ViewInput {
  std::string name{};  ///< in FrameResult; empty: "view 2" and so on
  Camera camera;
  /// Any number. Left out and counted are those that reach nothing in the view, and where more than kLampsPerDraw reach
  /// one draw the weakest there.
  std::vector<PlacedLamp> lamps;
  std::vector<PlacedMesh> moving{};  ///< beside the scene
  double exposure_per_cdm2 = 0.8;    ///< multiplies luminance before the tone curve; fixed, so that beams compare
  double adaptation_k = 4000.0;      ///< light of this colour temperature looks white
  std::optional<glm::vec3> white;  ///< linear sRGB of the light that does, in place of it (visual/process/adaptation.h)
  double sky_luminance_cdm2 = 0.004;
  Air air{};                                ///< fog, rain and snow between lamps, what they light, and the eye
  Falling falling{};                        ///< of the drops and flakes that are drawn one by one
  double snow_cover_01 = 0.0;               ///< share of level ground that snow covers
  std::optional<Windscreen> windscreen{};   ///< before this eye; none: as through a clean one
  double far_mesh_from_m = kFarMeshFrom_m;  ///< infinity: whole meshes everywhere, hidden by the ground or not
  View view = View::kPhoto;
  Method method = Method::kFragment;
  std::vector<double> isolux_lx{kIsoluxLevels_lx.begin(), kIsoluxLevels_lx.end()};  ///< at most kMostIsoluxLevels
  std::vector<GlaringLamp> glare{};                                                 ///< lamps that shine into this eye
  std::vector<ShiningPupil> pupils{};  ///< of animals, that send light back to this eye
  std::vector<SprayingVehicle> spraying{};  ///< where the ground is wet
  Viewer viewer{};                                                                  ///< whose eye it is
  bool want_hdr = false;    ///< the view's HDR image is called for (EXR): adds the tone-mapping pass
  bool want_image = false;  ///< read what is seen back
  /// The same picture by fewer kinds of pipelines, so that none has to be made for where something stands or how far
  /// lamps of others reach. Where one lamp has a shadow map, each has one, be it empty. Of more lamps than four, a
  /// block of the scene is lit by the first four or by all.
  bool few_kinds = false;
  PicturePart part{};
  std::optional<PictureSize> own_picture{};  ///< 1 to 16384 pixels a side; else it is drawn into the frame's picture
  EffectChoices effects{};                   ///< levels that the user has set; else the facts of the view decide
  EffectChoices picked{};                    ///< levels where the facts call for the effect (plan_effects)
};

/// Where pipelines have the shapes of lamps' tables from.
enum class ShapesFrom : std::uint8_t {
  kPipeline,  ///< their own constants: the fastest, and made for each light (low, high, both, of each design)
  kEither,    ///< the same where it is made; else the frame, where that is made; so no frame is late for a light
  kFrame      ///< one for many lights
};

/// A frame: its own view, and what is drawn over it.
struct FrameInput : ViewInput {
  std::vector<ViewInput> more_views{};  ///< drawn after it, in order: mirrors, insets, another design beside it
  std::vector<std::string> overlay{};   ///< lines of text over the picture
  std::vector<OverlayInstrument> instruments{};
  OverlayPanel panel{};
  OverlayMarks marks{};  ///< nothing in these four: no overlay pass
  OverlayRoom room{};
  ShapesFrom shapes = ShapesFrom::kPipeline;
  const GuiContent* gui = nullptr;  ///< over all of these, until draw() returns; nullptr: no gui pass
};

struct PassTime {
  std::string name;
  double ms = 0.0;
  std::optional<Effect> effect{};  ///< that calls for it; none: it is there in any frame
};

/// What an effect adds to a frame, over all its views. What it draws within the pass of another is not told apart.
struct EffectCost {
  std::uint32_t passes = 0;  ///< that draw
  std::uint64_t bytes = 0;   ///< of its images, also where they use the memory of others, and of what its passes keep
};

/// What one view took.
struct ViewResult {
  std::string name;
  EffectPlan effects;                   ///< what was on, and why
  std::uint32_t lamps = 0;              ///< that light it
  std::uint32_t lamps_unreached = 0;    ///< left out: nothing that it sees is within their light
  std::uint32_t lamps_over_limit = 0;   ///< left out somewhere: kLampsPerDraw that are brighter there light it already
  std::uint32_t lamps_without_map = 0;  ///< cast no shadow: the device, or a draw, holds no more maps
  std::uint32_t passes = 0, draws = 0;
  std::uint64_t triangles = 0;
};

struct FrameResult {
  /// Times: of this frame; where frames overlap, of the newest that is done. Nothing: they were told with a frame before.
  bool timed = true;
  bool timed_kept = false;  ///< of the frame they are of, something was read back
  /// From the call until the GPU was done, and the picture shown; where frames overlap, from when the one before was,
  /// but of a frame that made a pipeline from the call.
  double wall_ms = 0.0;
  double gpu_ms = 0.0;  ///< first to last time stamp
  std::vector<PassTime> passes;
  EffectPlan effects;  ///< what was on in any view, and why (visual/effects_of_frame.h)
  std::array<EffectCost, kMostEffects> effect_costs{};  ///< in the order of Effect
  EffectCost other_cost{};                              ///< what no effect calls for
  std::vector<ViewResult> views;  ///< its own, then the others
  std::uint32_t draws = 0;        ///< those of the overlay left out
  std::uint32_t binds = 0;        ///< of pipelines, sets, vertices and indices; likewise
  std::uint32_t pass_count = 0;   ///< passes that draw; reading back draws nothing
  std::uint64_t triangles = 0;
  std::uint32_t images = 0;  ///< images of the frame that live, and their bytes
  std::uint64_t image_bytes = 0;
  std::uint64_t shared_image_bytes = 0;  ///< what they would take besides, if none used the memory of another
  std::uint64_t pipelines_made = 0;      ///< because no frame before needed them: such a frame is late
};

/// What a rehearsal of a frame has made, and how many pipelines are left to make or to draw with.
struct Rehearsal {
  std::uint64_t made = 0;   ///< for itself
  std::uint64_t taken = 0;  ///< made beside the frames since the one before, whatever that was a rehearsal of
  std::size_t left = 0;

  /// A frame like it finds all that it takes.
  bool ready() const { return made == 0 && left == 0; }
};

struct Image8 {
  int width_px = 0, height_px = 0;
  std::vector<std::uint8_t> rgba;  ///< sRGB, rows from the top
};
struct ImageF {
  int width_px = 0, height_px = 0;
  std::vector<float>
      rgba;  ///< linear, cd/m² (RGB, Rec. 709 primaries scaled so that luminance is Y), alpha: illuminance in lx
};

struct MeasurePoint {
  glm::dvec3 position_m{0.0};
  glm::dvec3 normal{0.0, 0.0, 1.0};
};

/// A point of the frame recomputed: what the picture's shader found there.
struct AuditSample {
  MeasurePoint point;         ///< world position and normal of the pixel
  double illuminance_lx = 0;  ///< by the GPU
  double x_01 = 0, y_01 = 0;  ///< where in the picture, from its upper left corner
  /// What the interpolated normal may be off by, rad: a device takes a varying for a plane over the picture and reckons
  /// from its corner, so what turns by g a pixel is rounded at g times the way from there; four such roundings.
  double normal_room_rad = 0;
};

class Renderer {
 public:
  /// What was asked for cannot be had: an Error. A device that is lost, here and in what follows, is thrown.
  static Result<Renderer> create(const RendererOptions& options);
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;
  ~Renderer();

  /// `moving`: meshes for what moves, one a node, each about its own origin.
  Status load_scene(const Scene& scene);
  Status load_scene(const Scene& scene, const Scene& moving, const Progress& progress = {});
  /// With light that does not change: street lamps, the moon, what shines by itself. Computed now, which takes seconds
  /// where there are many lamps.
  Status load_scene(const Scene& scene, const Scene& moving, std::shared_ptr<const FixedLight> light,
                    const Progress& progress = {});
  /// A new beam image, at any index. Uploaded with the next frame.
  void set_beam(std::size_t index, const BeamImage& image);
  /// The image set last, changed in these rectangles of its nodes only; nodes, type and aim are the same.
  void change_beam(std::size_t index, const BeamImage& image, std::span<const TexelRect> changed);
  /// Another size of picture.
  void resize(int width_px, int height_px);
  /// Of the frame's picture: of a window what it has now, not what was asked for.
  PictureSize picture_size() const;

  /// Draws one frame and waits for it, or where frames overlap for the one before. In a window that is also presented.
  FrameResult draw(const FrameInput& input);
  /// Makes what this frame would have to make, in steps, for who goes on drawing others meanwhile. Pipelines of
  /// surfaces that are missing are made beside the frames, by a thread of its own; with `most` of those that it has
  /// done the scene is drawn on a few pixels and waited for, since a software device makes its code when a pipeline
  /// first draws. All else that is missing is made at once. Nothing is shown; overlay, panel and what is read back are
  /// left out. `audited`: with what an audit of its own view takes.
  Rehearsal rehearse(const FrameInput& input, std::size_t most, bool audited = false);
  /// Pipelines are being made beside the frames: until it is done a rehearsal finds nothing new.
  bool is_making() const;
  /// Waits for all frames and shows them: for who has nothing to draw just now.
  void finish();
  /// The same, but waits for the device no longer than that; to show a picture may take longer. False: one is still on
  /// its way.
  bool finish_within(std::chrono::nanoseconds most);
  /// What the newest frame with want_image or want_hdr keeps is there: reading it waits for nothing.
  bool has_kept() const;
  /// After draw with want_image, before the next one with it; that frame is waited for: the picture of the frame's own
  /// view with all that lies over it, or what another view drew (`view` counts from 1).
  Image8 read_image(std::size_t view = 0) const;
  ImageF read_hdr(std::size_t view = 0) const;  ///< after draw with want_hdr: the part of that view

  /// Illuminance in lx at points, per lamp, through the same fragment shader: result[lamp][point]. `shadows`: level of
  /// that effect, 0 for what falls there if nothing stands in the way (occluder() of visual/scene/ray_hit.h tells
  /// exactly).
  /// `method`: kFragment or kReference.
  std::vector<std::vector<float>> measure(std::span<const PlacedLamp> lamps, std::span<const MeasurePoint> points,
                                          std::size_t shadows = 0, Method method = Method::kFragment);

  /// Draws the view again in fewer pixels, with position and normal out, waits for it, and returns `count` lit pixels
  /// chosen by `seed`.
  std::vector<AuditSample> audit(const FrameInput& input, std::size_t count, std::uint64_t seed);
  /// The same without waiting: it is drawn with the next frame, by beams as they are then, and can be taken when that
  /// frame is done. Its draws are not counted among the frame's.
  void ask_audit(ViewInput view);
  /// Makes the pipelines that an audit of this view takes.
  void prepare_audit(const ViewInput& view);
  /// Once; nothing: none was asked for, or it is not done.
  std::optional<std::vector<AuditSample>> take_audit(std::size_t count, std::uint64_t seed);

  /// Why this device cannot draw by Method::kReference; nothing: it can. To draw by it all the same throws.
  std::optional<std::string> no_reference() const;
  std::string device() const;                 ///< name, driver, Vulkan version
  std::size_t frames_in_flight() const;       ///< as RendererOptions has it
  std::uint64_t device_memory_bytes() const;  ///< allocated by us and alive
  std::uint64_t validation_messages() const;  ///< since create
  std::uint64_t uploaded_texels() const;      ///< of beam images, since create

 private:
  struct Impl;
  explicit Renderer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace phare
