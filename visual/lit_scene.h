// The lit scene: what every pass shares that draws surfaces under lamps. Geometry, materials, lamps, beam images, the
// descriptor set that shaders see them through (shaders/lamps.h), and the pipelines. Views of it are made in
// lit_view.cpp.
#pragma once

#include <array>
#include <chrono>
#include <deque>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <stop_token>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "config/desk.h"
#include "shaders/precipitation.h"
#include "shaders/spray.h"
#include "visual/beam_store.h"
#include "visual/caster_grid.h"
#include "visual/eyeshine.h"
#include "visual/gpu/descriptor_sets.h"
#include "visual/gpu/frame_graph.h"
#include "visual/gpu/scene_buffers.h"
#include "visual/kept_casters.h"
#include "visual/light_reach.h"
#include "visual/passes/constants.h"
#include "visual/passes/grain.h"
#include "visual/passes/pipeline.h"
#include "visual/passes/sky.h"
#include "visual/shadow_casters.h"

namespace phare {

/// What lamps.frag writes.
enum class LampOutput : std::uint32_t {
  kDisplay = 0,
  kHdr = 1,
  kFalseColour = 2,
  kMeasure = 3,
  kAudit = 4,
  kClipping = 5,
  kDifference = 6,
  kRatio = 7
};

/// Shows lux by colour, and no luminance: no sky, no display curve.
constexpr bool shows_lux(LampOutput output) {
  return output == LampOutput::kFalseColour || output == LampOutput::kDifference || output == LampOutput::kRatio;
}

/// Lamps that light some of what a view sees, kLampsPerDraw at most.
struct LitBy {
  std::uint32_t lamps = 0;
  std::size_t tables = 0;      ///< which of the scene's sets of table shapes
  std::size_t any_tables = 0;  ///< the same, of shapes that pipelines read from the frame
  std::uint32_t colours = 0;   ///< as kSpecColours
  bool alike = false;          ///< two, whose tables have the same axes
  vk::DescriptorSet set{};
  std::uint32_t data_at = 0;  ///< of their GpuFrame in the buffer, bytes
  shader::GpuFrame* data = nullptr;
  std::array<std::size_t, shader::kMaxLamps> lamp_at{};  ///< among those of the view
  std::uint32_t shadow_maps = 0;                         ///< as kSpecShadowMaps
};

/// Size of a shadow map in texels, and how many of them are read for one point. None: no shadows. Without a size: so
/// many rays to the lamp, and shader::kTapsOfRays.
struct ShadowLevel {
  std::uint32_t width = 0, height = 0, taps = 0;

  bool by_rays() const { return taps > shader::kTapsOfRays; }

  friend auto operator<=>(const ShadowLevel&, const ShadowLevel&) = default;
};

/// The maps of a view, as texels one after the other; or the scene's triangles, for rays.
struct ShadowDepths {
  explicit ShadowDepths(gpu::Device& device) : triangles(device) {}

  /// That cast them, corner by corner.
  struct Triangles {
    gpu::HostBuffer whole;
    gpu::HostBuffer cut;  ///< those with holes
  };
  gpu::PerFrame<Triangles> triangles;
  gpu::DeviceBuffer texels;
  vk::raii::BufferView view{nullptr};
  gpu::DescriptorSets sets{};
  vk::DescriptorSet set{};  ///< of the texels that are read

  /// In place of `texels` where the device is the processor: what is drawn anew goes where no frame that is still on
  /// its way reads.
  struct InTurn {
    gpu::HostBuffer texels;
    vk::raii::BufferView view{nullptr};
    vk::DescriptorSet set{};
  };
  std::vector<InTurn> in_turn{};
  std::size_t turn = 0;  ///< which of them is read

  vk::DeviceSize bytes() const {
    return texels.bytes + in_turn.size() * (in_turn.empty() ? 0 : in_turn[0].texels.bytes);
  }

  /// What the texels hold: of each map what it was drawn from.
  struct Held {
    std::shared_ptr<const CastBy> cast{};
    glm::dvec2 half{1.0}, texels{0.0};
    double zoom = 1.0;

    friend bool operator==(const Held&, const Held&) = default;
  };
  std::vector<Held> held{};
  ShadowLevel level{};
  std::vector<CasterGrid> grids{};  ///< of each map, where it may hide light
};

/// Maps that points in the air are looked up in.
struct AirShadows {
  /// Which of the maps a lamp has, 1 being the first, 0 none, and how points fall on it.
  struct Map {
    std::uint32_t number = 0;
    shader::GpuShadow place{};
  };
  ShadowLevel level{};
  const ShadowDepths* depths = nullptr;
  std::vector<Map> maps{};  ///< of each of the view's `casts`; empty: there are none
};

/// Shape of the grid of light scattered in fog, as kSpecFogLamps and what follows it. None: clear air.
struct FogGrid {
  std::uint32_t columns = 0, rows = 0, slices = 0;
  std::uint32_t lamps = 0;  ///< 1: some shine in it

  friend auto operator<=>(const FogGrid&, const FogGrid&) = default;
};

/// Width of the slopes of water on the ground, by the levels of the effect: dry, damp, wet, flooded.
inline constexpr std::array<float, 4> kWetAlpha{0.0f, 0.15f, 0.05f, 0.02f};
static_assert(kWetAlpha.size() == kWetNames.size());

/// One view of a frame, ready for its passes.
struct LitView {
  ViewGeometry geometry;
  Sky sky;
  Method method = Method::kFragment;
  std::span<const double> isolux_lx{};  ///< lines of false colour; of the caller, while the view is made
  std::vector<DrawItem> items{};
  std::vector<SceneBatch> moved{};       ///< of what moves, where it is now; items point to them
  vk::Rect2D area{};                     ///< of the picture, in pixels
  std::span<const PlacedMesh> moving{};  ///< of the caller, while the frame is recorded
  std::vector<LitBy> lit_by{};           ///< one at least
  std::vector<PlacedLamp> lit_lamps{};   ///< that light something in it
  KeptCasters::Casts casts{};            ///< what stands in the light of each, then of each of `air_alone`
  bool few_kinds = false;                ///< as ViewInput
  ShadowLevel shadows{};                 ///< of the maps that are read
  const ShadowDepths* depths = nullptr;
  AirShadows air_shadows{};             ///< where shadows are drawn
  std::vector<PlacedLamp> air_lamps{};  ///< whose light goes through what the view sees, on a surface or not
  std::vector<PlacedLamp> air_alone{};  ///< those of them that light no surface, where air has shadows
  std::vector<std::optional<std::size_t>> air_lit{};  ///< whose of `casts` the light of each of them is, if one's
  FogGrid fog{};
  vk::DescriptorSet fog_set{};
  std::vector<LitBy> drops_by{};  ///< lamps in groups, whose light falls on drops; none: no drop is drawn
  shader::GpuDrops drops{};
  std::uint32_t drops_count = 0;
  bool flakes = false;  ///< drops are of snow
  std::vector<LitBy> spray_by{};            ///< lamps whose light falls on spray; none: none is drawn
  std::vector<shader::GpuSpray> spray{};    ///< behind each vehicle, farthest first
  std::vector<PupilInPicture> pupils{};  ///< of animals, that send light back
  bool wet = false;               ///< there is water on the ground; how rough it is is in the data of `lit_by`
  bool snow = false;              ///< lies on what looks up; how much is in the same place
  bool fixed_light = false;       ///< what does not change shines, too
  bool r_table = false;           ///< on asphalt by its r-table
  std::size_t first_probe = 0;    ///< of `moving`, among those of the frame
  std::uint32_t lamps = 0;        ///< that light something in it
  std::uint32_t unreached = 0;    ///< left out: they light nothing of what it sees
  std::uint32_t over_limit = 0;   ///< left out somewhere: kLampsPerDraw that are brighter there light it already
  std::uint32_t without_map = 0;  ///< cast no shadow, though something stands in their light: there is no room for it

  const PlacedLamp& lamp_of_cast(std::size_t i) const {
    return i < lit_lamps.size() ? lit_lamps[i] : air_alone[i - lit_lamps.size()];
  }
  /// After the lamps are filled in. `cover_01`: share of level ground; `level`: of kWetAlpha.
  void cover_with_snow(double cover_01);
  void wet_ground(std::size_t level);
};

/// What makes a pipeline of lamps.frag.
struct LitVariant {
  static constexpr std::uint32_t kNoSnow = shader::kSnowNone;
  MaterialKind kind{};
  LampOutput output = LampOutput::kDisplay;
  std::uint32_t lamp_count = 0, lamp_base = 0;
  std::size_t tables = 0;  ///< as LitView
  std::uint32_t colours = 0;
  bool alike = false;  ///< as LitBy; asked for by lean shaders alone
  std::uint32_t shadow_maps = 0;
  ShadowLevel shadows{};
  FogGrid fog{};
  Method method = Method::kFragment;
  bool wet = false;
  std::uint32_t snow = kNoSnow;
  bool fixed_light = false, moves = false;
  bool bent = false;  ///< as SceneBatch; where maps are read
  vk::SampleCountFlagBits samples = vk::SampleCountFlagBits::e1;
  vk::Format format = vk::Format::eUndefined;
  bool depth_done = false;

  friend auto operator<=>(const LitVariant&, const LitVariant&) = default;
};

class LitScene {
 public:
  /// `level`: of all beam images.
  LitScene(gpu::Device& device, ImageLevel level);

  /// Nothing is being drawn.
  void set_geometry(SceneBuffers geometry, ShadowCasters casters, std::shared_ptr<const FixedLight> light);
  const FixedLight& fixed_light() const { return *fixed_light_; }
  const ShadowCasters& casters() const { return casters_; }
  /// Another number with each scene.
  std::uint64_t geometry_version() const { return geometry_version_; }
  void set_beam(std::size_t beam, const BeamImage& image);
  void change_beam(std::size_t beam, const BeamImage& image, std::span<const TexelRect> changed);
  /// Another number with each change.
  std::uint64_t beam_version(std::size_t beam) const { return beam_versions_[beam]; }
  bool is_dark(std::size_t beam) const { return beams_.beam(beam).dark; }
  std::uint64_t uploaded_texels() const { return beams_.uploaded_texels(); }

  /// Before the views of a frame. Uploads the beams that changed, in a pass.
  void begin_frame(gpu::FrameGraph& graph, ShapesFrom shapes = ShapesFrom::kPipeline);
  /// Which tables a pipeline is for; `made`: whether there is one for these.
  template <typename Made>
  std::size_t tables_for(const LitBy& lit, Made&& made) const {
    if (shapes_ == ShapesFrom::kPipeline) return lit.tables;
    if (shapes_ == ShapesFrom::kEither && (made(lit.tables) || !made(lit.any_tables))) return lit.tables;
    return lit.any_tables;
  }
  /// A key of pipelines whose first part are the tables.
  template <typename Key, typename Pipeline>
  Key key_for(const LitBy& lit, const std::map<Key, Pipeline>& made, std::type_identity_t<Key> key) const {
    std::get<0>(key) = tables_for(lit, [&](std::size_t tables) {
      std::get<0>(key) = tables;
      return made.contains(key);
    });
    return key;
  }
  /// A view of the scene with those of the lamps that reach something in it. Up to kLampsForAll light all that it sees;
  /// of more, each block is lit by those that reach it: fewer to sum, at the price of a pipeline for every number.
  /// `few_kinds`: as ViewInput.
  LitView view(const ViewGeometry& geometry, const Sky& sky, std::span<const PlacedLamp> lamps,
               std::span<const PlacedMesh> moving, double far_mesh_from_m, std::span<const double> isolux_lx,
               bool few_kinds = false);
  /// An eye with lamps and no surface, for points that are given.
  LitView view_of_points(const ViewGeometry& geometry, std::span<const PlacedLamp> lamps);
  /// Finds what stands in the light of the view's lamps; returns how many pieces of the scene.
  std::size_t find_casters(LitView& view, const CastersFor& wanted = {}, bool in_air = false);
  /// Lamps of the view with light past the sides of any map of shadows (LightPeaks).
  std::size_t wide_lamps(const LitView& view) const;

  /// What does not change shines in the view: what moves gets what arrives at it.
  void add_fixed_light(LitView& view);

  /// Lamps of a view, kMaxLamps at most, into data of their own.
  LitBy fill(const LitView& view, std::span<const PlacedLamp> lamps);
  /// Of all their light; of beams with light of several colours that of their first source.
  glm::vec3 mean_colour(std::span<const PlacedLamp> lamps) const;

  vk::PipelineLayout layout() const { return *layout_; }
  /// The same, with the set of a surface's textures behind; only where the scene has some.
  vk::PipelineLayout textured_layout();
  /// Of the set that holds the lamps, for pipelines that compute.
  vk::DescriptorSetLayout lamps_layout() const { return sets_.layout(); }
  /// Of the set that holds shadow maps.
  vk::DescriptorSetLayout shadow_layout() const { return shadow_sets_.layout(); }
  /// Beams are weighed by the texture filter.
  bool filtered() const;
  /// The shapes of the tables of a set of lamps, as specialization constants from kSpecTables on. `shown`: only for the
  /// 8 bits of a display (shader::kLookupShown).
  std::vector<std::uint32_t> table_words(std::size_t tables, bool shown = false) const;
  vk::Pipeline pipeline(const LitVariant& variant) { return pipelines(std::span(&variant, 1)).front(); }
  /// Of each, in their order. Those that are not there yet are made together.
  std::vector<vk::Pipeline> pipelines(std::span<const LitVariant> variants);
  /// By the method "reference" (visual/reference_light.h): what ReferenceLight::set_points and fill say, for this
  /// frame.
  void set_reference_points(std::span<const double> points);
  void bind_reference(gpu::Recorder& commands, const LitView& view, const LitBy& lit_by);
  /// The view's data, and the vertices of the scene.
  void bind(gpu::Recorder& commands, const LitView& view) const;
  void bind(gpu::Recorder& commands, const LitBy& lit_by) const;
  /// Textures and corners of a batch that has a look: drawn from its first vertex on. After it bind_vertices() for
  /// others.
  void bind_look(gpu::Recorder& commands, const SceneBatch& batch, bool reference = false);
  void bind_vertices(gpu::Recorder& commands) const;
  /// Textures of a material that has some, on a device that draws them.
  vk::DescriptorSet textures_of(std::size_t material) const { return geometry_.textures.set(material); }
  bool has_textures() const { return !geometry_.textures.empty(); }
  void bind_shadows(gpu::Recorder& commands, const LitView& view) const;
  void bind_fog(gpu::Recorder& commands, const LitView& view) const;
  void push(vk::CommandBuffer commands, const shader::GpuDraw& draw) const;
  /// All that the view sees; of `common` all counts but the material and the lamps.
  void draw(gpu::Recorder& commands, const LitView& view, const LitVariant& common);
  /// Makes the pipelines that this takes; in a rehearsal has them made beside the frames.
  void prepare(const LitView& view, const LitVariant& common);
  /// From here on draw() has pipelines that are missing made beside the frames, and draws once with so many at most of
  /// those that are done, and nothing else.
  void begin_rehearsal(std::size_t most) {
    take_made();
    rehearsal_ = Rehearsal{.most = most};
  }
  /// How many are left, to be made or to be drawn with.
  std::size_t end_rehearsal() { return std::exchange(rehearsal_, std::nullopt)->left; }
  bool is_making() const { return being_made_ && !being_made_->is_done(); }

 private:
  static constexpr std::uint32_t kViewsInPage = 16;
  static constexpr std::size_t kProbesInPage = 256;
  static constexpr std::size_t kMostSets = 256;  ///< kept from frame to frame
  static constexpr std::size_t kNoBeam = SIZE_MAX;
  using Beams = std::array<std::size_t, shader::kMaxLamps>;

  struct Reference;
  struct ReferenceDeleter {
    void operator()(Reference* reference) const;
  };
  struct Textured;
  struct TexturedDeleter {
    void operator()(Textured* textured) const;
  };
  using Code = std::span<const std::uint32_t>;
  struct FragmentStage {
    Code code;
    vk::PipelineLayout layout;
  };
  struct Stages {
    Code vertex;
    FragmentStage fragment;
  };

  /// With what it points to.
  struct Recipe {
    SpecConstants numbers{};
    vk::SpecializationInfo constants{};
    std::vector<vk::VertexInputAttributeDescription> attributes{};
    PipelineRecipe pipeline{};
  };

  struct Rehearsal {
    std::size_t most = 0, left = 0;
  };
  /// Pipelines that a thread makes beside the frames.
  struct BeingMade {
    std::vector<LitVariant> variants{};
    std::deque<Recipe> recipes{};
    std::stop_source stop{};
    std::future<std::vector<vk::raii::Pipeline>> made{};  ///< of the variants, in their order

    bool is_done() const { return made.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }
    ~BeingMade() { stop.request_stop(); }
  };

  bool is_lean(const LitVariant& variant) const;
  /// `before`: of another item of the same list.
  LitVariant variant_of(const LitView& view, const DrawItem& item, const LitVariant& common,
                        const LitVariant* before) const;
  /// Of those tables of the item's lamps.
  LitVariant variant_for(std::size_t tables, const LitView& view, const DrawItem& item, const LitVariant& common) const;
  std::vector<LitVariant> variants_of(const LitView& view, std::span<const DrawItem> items,
                                      const LitVariant& common) const;
  /// A shadow may reach in the next frame what none reaches in this one.
  static std::vector<DrawItem> shadowed_next(const LitView& view);
  /// In a rehearsal: what is missing is left to make, and begun where nothing else is being made.
  void make_beside(const std::set<LitVariant>& missing);
  void take_made();
  /// One for each pipeline that was made beside the frames and is drawn with now.
  std::vector<DrawItem> rehearsed(const LitView& view, const LitVariant& common);
  /// `variants`: of the items, then of what else is made with them.
  void draw_items(gpu::Recorder& commands, const LitView& view, std::span<const DrawItem> items,
                  std::span<const LitVariant> variants);
  void write_recipe(const LitVariant& variant, Recipe& recipe);
  void light_by_block(LitView& view);
  void add_mirrored(const LitView& view);
  void bind_fixed_light(gpu::Recorder& commands, const LitView& view, const DrawItem& item, vk::Buffer& bound) const;
  /// Of asphalt by its r-table: drawn from its first vertex on. After it bind_vertices() for others.
  void bind_road(gpu::Recorder& commands, const SceneBatch& batch) const;
  static std::uint32_t probe_in_page(const LitView& view, const DrawItem& item);
  vk::raii::PipelineLayout pipeline_layout(std::span<const vk::DescriptorSetLayout> sets);
  FragmentStage fragment_stage(const LitVariant& variant, std::size_t size);
  FragmentStage reference_stage(const LitVariant& variant);
  Textured& textured();
  Stages textured_stages(const LitVariant& variant);
  static void add_road_vertices(PipelineRecipe& recipe, std::vector<vk::VertexInputAttributeDescription>& attributes);
  static void add_textured_vertices(const LitVariant& variant, PipelineRecipe& recipe,
                                    std::vector<vk::VertexInputAttributeDescription>& attributes);
  /// After bind_look().
  void bind_fixed_light_of_look(gpu::Recorder& commands, const LitView& view, const DrawItem& item) const;
  vk::DescriptorSetLayout reference_layout();
  Reference& reference();
  void keep_image(std::size_t beam, const BeamImage& image, std::span<const TexelRect> changed);
  LampReach reach_of(const PlacedLamp& lamp) const {
    return {lamp.position_m, lamp.world_from_image, cones_[lamp.beam]};
  }
  Code scene_vert(std::size_t size, Method method, bool fog) const;
  /// Of the shaders of visual/passes/fixed_shaders.h.
  Code fixed_vertex(const LitVariant& variant, std::size_t size) const;
  std::size_t tables_of(std::vector<shader::TableShape> shapes);
  /// Pipelines of these tables read shapes from the frame.
  bool reads_shapes(std::size_t tables) const;
  vk::DescriptorSet set_of(std::size_t page, const Beams& beams);

  gpu::Device& device_;
  ImageLevel level_;
  SceneBuffers geometry_;
  ShadowCasters casters_;
  std::uint64_t geometry_version_ = 0;
  KeptCasters kept_casters_;
  ShapesFrom shapes_ = ShapesFrom::kPipeline;  ///< of this frame
  std::optional<Rehearsal> rehearsal_;
  std::set<LitVariant> undrawn_;  ///< made beside the frames, not drawn with yet
  std::shared_ptr<const FixedLight> fixed_light_ = std::make_shared<FixedLight>();
  BeamStore beams_;
  std::vector<LightCone> cones_;  ///< of each beam
  std::vector<LightPeaks> peaks_;  ///< the same
  std::vector<std::uint64_t> beam_versions_;
  std::vector<BeamImage> images_;  ///< of each beam, where the device has float64
  std::vector<float> peaks_cd_;    ///< of each beam; of one that was changed, at most
  Grain grain_;
  gpu::DescriptorSets sets_, shadow_sets_, fog_sets_;  ///< of the last two only the layout
  vk::raii::PipelineLayout layout_{nullptr};
  vk::raii::Sampler filter_sampler_{nullptr};
  vk::DeviceSize stride_ = 0;                            ///< of the data of one view
  /// What one frame writes for its own draws; more pages are made when it needs them.
  struct Written {
    std::vector<std::unique_ptr<gpu::HostBuffer>> pages;   ///< data of views
    std::size_t views = 0;
    std::vector<std::unique_ptr<gpu::HostBuffer>> probes;  ///< of what moves
    std::size_t probes_used = 0;
    std::map<std::pair<std::size_t, Beams>, vk::DescriptorSet> set_of;
    std::uint64_t names_of = 0;  ///< beams_made_ when the sets were made
  };
  gpu::PerFrame<Written> written_{device_};
  std::uint64_t beams_made_ = 0;  ///< how often buffers or images of beams were made anew
  std::vector<std::vector<shader::TableShape>> table_shapes_;  ///< of the lamps of a view, each set that came up
  std::map<LitVariant, vk::raii::Pipeline> pipelines_;
  std::unique_ptr<Reference, ReferenceDeleter> reference_;  ///< made when it is called for
  bool reference_begun_ = false;                            ///< in this frame
  std::unique_ptr<Textured, TexturedDeleter> textured_;     ///< made when it is called for
  std::unique_ptr<BeingMade> being_made_;                   ///< the last: its thread uses what stands above
};

/// The constants of a draw by the method "reference": with its first index and vertex, as GpuDraw has them.
shader::GpuDraw reference_draw(const DrawItem& item);

/// Of a set of ShadowDepths.
extern const std::array<vk::DescriptorSetLayoutBinding, 1> kShadowBindings;
/// Of LitView::fog_set.
extern const std::array<vk::DescriptorSetLayoutBinding, 2> kFogBindings;

/// lamps.frag for fog, for up to 2, 4, 8 lamps and the same with shadows.
std::span<const std::uint32_t> lamps_fog_frag(std::size_t size, bool filtered);
/// scene.vert for fog and two lamps at most on surfaces; of more it is that of clear air.
std::span<const std::uint32_t> scene_fog_vert(bool shadows, bool by_vertex, bool filtered);

inline constexpr auto kLitStages = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;
/// Of GpuVertex.
extern const std::array<vk::VertexInputAttributeDescription, 3> kVertexAttributes;
/// Of GpuVertex and GpuCornerLook.
extern const std::array<vk::VertexInputAttributeDescription, 5> kTexturedAttributes;
/// The same with a FixedVertex beside each, or a FixedProbe for all.
extern const std::array<vk::VertexInputAttributeDescription, 6> kFixedAttributes, kProbeAttributes;

}  // namespace phare
