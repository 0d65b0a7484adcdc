// The effects of a frame: for each its name, its levels, what it needs, and what decides. Pure: no device, no image.
// To add one: its row here, its pass (one stem in passes/ and shaders/), its test. One that draws over a picture needs
// no word in the frame; a program that uses the renderer can bring its own (visual/picture_effect.h).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "visual/photometry/table/air.h"

namespace phare {

enum class Effect : std::size_t {
  kShadows,
  kDepthFirst,
  kHdrImage,
  kOverlay,
  kFog,
  kPrecipitation,
  kWetGround,
  kGlare,
  kGui,
  kFixedLight,
  kEyeshine,
  kSnowCover,
  kWindscreen,
  kSpray,
  kAsphalt
};
inline constexpr std::size_t kEffectCount = 15;  ///< those above
inline constexpr std::size_t kMostEffects = 31;  ///< with those that are added

/// What is known before a frame is drawn: of its lamps, its view, what is asked of it, and the device.
struct EffectFacts {
  std::size_t lit_lamps = 0;               ///< positions that give light in this view
  /// Pieces of the scene that stand in their light, and where fog has shadows in that of lamps that light air alone;
  /// nothing: not looked for.
  std::optional<std::size_t> casters = 0;
  std::size_t wide_lamps = 0;              ///< of the lit ones, whose light goes past the sides of a shadow map
  bool shadow_maps = true;                 ///< the device holds one
  bool shadow_rays = true;                 ///< the device holds the scene's triangles
  bool hdr_wanted = false;                 ///< something reads luminance in cd/m² (EXR, bird's eye)
  bool false_colour = false;               ///< the view shows illuminance, not luminance
  bool clipping = false;                   ///< the view marks what the display clips
  std::size_t overlay_lines = 0;           ///< text over the picture
  Air air{};                               ///< fog, rain, snow
  std::size_t air_lamps = 0;               ///< whose light goes through what the view sees of the air
  bool parallel_rays = false;              ///< a view from above, through no air
  std::size_t glare_lamps = 0;             ///< that shine into the eye, as far as the display shows it
  double glare_lx = 0.0;                   ///< of them, at the eye
  std::size_t pupils = 0;                  ///< of animals, that send light back as far as the display shows it
  double snow_cover_01 = 0.0;              ///< of level ground
  bool windscreen = false;                 ///< one is before the eye
  std::size_t spraying = 0;                ///< vehicles in view that throw up water where there is some
  bool gui = false;                        ///< the panel is shown over the picture
  std::size_t street_lamps = 0;            ///< that stand in the scene and are switched on
  std::size_t directional = 0;             ///< lights of the scene that have a direction alone
  std::size_t luminous = 0;                ///< materials that shine by themselves
  bool moon = false;                       ///< it shines
  bool covered = false;                    ///< some of the scene does not see the whole sky
  bool roofed = false;                     ///< the eye is below a roof of the scene while rain or snow falls
  std::size_t reflecting = 0;              ///< pieces of that which send light of street lamps on
  bool too_many_reflecting = false;        ///< so that none does
  bool r_table = false;                    ///< of what these light some is asphalt
  bool by_rays = false;                    ///< decided before: shadows have them at every pixel
  bool fixed_drawn = false;                ///< decided before: what shines in the scene is drawn
  bool glare_drawn = false;                ///< decided before: the luminance image is read for it
  bool drops_drawn = false;                ///< decided before: they are added to luminance
  std::string_view over_luminance{};       ///< decided before: an effect that is drawn over it
  bool spray_drawn = false;                ///< decided before: it is drawn over luminance
  bool snow_drawn = false;                 ///< decided before: it lies on the ground
  std::size_t ground = 0;                  ///< decided before: how wet it is, of kWetNames
};

/// Level 0 is off. `reason` says the fact that decided.
struct EffectDecision {
  std::size_t level = 0;
  std::string reason{};
  bool settled = false;  ///< no choice of the user changes it: the picture could not be what it is to be
};

struct EffectRow {
  Effect effect;
  std::string_view name;
  std::span<const std::string_view> levels;  ///< names, from off to the finest
  std::string_view needs;                    ///< passes and images that it adds
  EffectDecision (*decide)(const EffectFacts& facts);
  bool only_where_called_for = false;  ///< the user may choose its level, and switch it off, but not make it
  bool over_luminance = false;         ///< it draws over the image of luminance, and calls for that
};

/// In the order of Effect; what is added, after it.
std::span<const EffectRow> effect_table();

/// One effect more, as long as it lives. Neither while another thread plans, nor within the life of a plan; the last
/// that was added goes first. More than kMostEffects, or one whose name is taken: std::invalid_argument.
class AddedRow {
 public:
  /// `row.effect` is chosen here.
  explicit AddedRow(EffectRow row);
  ~AddedRow();
  AddedRow(const AddedRow&) = delete;
  AddedRow& operator=(const AddedRow&) = delete;

  Effect effect() const { return effect_; }

 private:
  Effect effect_;
};

/// A level that the user has set, for each effect; nothing: the facts decide.
using EffectChoices = std::array<std::optional<std::size_t>, kMostEffects>;

struct EffectPlan {
  std::array<EffectDecision, kMostEffects> decisions{};

  const EffectDecision& operator[](Effect effect) const { return decisions[static_cast<std::size_t>(effect)]; }
  std::size_t level(Effect effect) const { return (*this)[effect].level; }
  bool on(Effect effect) const { return (*this)[effect].level > 0; }
};

/// `picked`: the level of an effect where the facts call for it, which a budget or a tolerance has picked; what the
/// user has set counts before it.
EffectPlan plan_effects(const EffectFacts& facts, const EffectChoices& choices = {}, const EffectChoices& picked = {});

/// "tone mapping   off   nothing reads the HDR image …", a line an effect.
std::string explain(const EffectPlan& plan);

}  // namespace phare
