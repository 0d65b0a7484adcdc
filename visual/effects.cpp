#include "visual/effects.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "config/desk.h"
#include "visual/ground_water.h"

namespace phare {
namespace {

/// Whether nothing shines that ground can mirror or a drop send on: no lamp of a vehicle, no light of the scene.
bool nothing_shines(const EffectFacts& facts) {
  return facts.lit_lamps == 0 && facts.street_lamps == 0 && !facts.moon && facts.directional == 0;
}

/// What no map shows, where a lamp has light there. Rays go every way.
std::string past_the_maps(const EffectFacts& facts) {
  if (facts.wide_lamps == 0 || facts.by_rays) return "";
  return "; light of " + std::to_string(facts.wide_lamps) + (facts.wide_lamps == 1 ? " lamp" : " lamps") +
         " more than 75° beside the axis goes through what stands there, but by rays";
}

EffectDecision shadows(const EffectFacts& facts) {
  if (facts.lit_lamps == 0 && facts.casters.value_or(0) == 0) return {0, "no lamp is lit"};
  if (!facts.casters) return {0, "what stands in the light of the lamps is not looked for"};
  if (*facts.casters == 0) return {0, "nothing stands in the light of the lamps" + past_the_maps(facts)};
  if (!facts.shadow_maps) return {0, "the device holds no buffer as large as a shadow map"};
  return {2, std::to_string(*facts.casters) + " pieces of the scene stand in the light of the lamps" +
                 past_the_maps(facts)};
}

EffectDecision depth_first(const EffectFacts& facts) {
  if (facts.lit_lamps == 0) return {0, "no lamp is lit: a pixel drawn twice costs nothing"};
  // Chunks come near ones first, so few pixels are lit twice: on a software device and on a GPU a second pass over the
  // vertices costs 4 to 20 % of a frame, and saves 3 to 15 % by rays (phare_frame_bench --depth-first).
  if (facts.by_rays) return {1, "shadows by rays: no pixel is to be lit twice"};
  return {0, "near pieces are drawn first: a second pass over the vertices costs more than it saves"};
}

EffectDecision hdr_image(const EffectFacts& facts) {
  if (facts.false_colour) return {0, "the view shows illuminance in false colour, which needs no tone curve", true};
  if (facts.clipping)
    return {0, "the view marks what the display clips, where the lamp pass applies the tone curve", true};
  if (facts.glare_drawn) return {1, "light scattered in the eye is added to luminance in cd/m²", true};
  if (facts.drops_drawn) return {1, "drops and flakes are added to luminance in cd/m²", true};
  if (!facts.over_luminance.empty())
    return {1, std::string(facts.over_luminance) + " is drawn over luminance in cd/m²", true};
  if (facts.spray_drawn) return {1, "spray mixes luminance in cd/m²", true};
  if (facts.roofed) return {1, "rain or snow falls where the roof ends, and nothing is to be made anew there", true};
  if (facts.hdr_wanted) return {1, "the luminance image in cd/m² is called for", true};
  return {0, "nothing reads luminance in cd/m²: the lamp pass applies the tone curve itself"};
}

EffectDecision overlay(const EffectFacts& facts) {
  if (facts.overlay_lines == 0) return {0, "no line of text to show"};
  return {1, std::to_string(facts.overlay_lines) + " pieces of text and strokes to show"};
}

EffectDecision fog(const EffectFacts& facts) {
  if (facts.air.clear()) return {0, "the air is clear"};
  if (facts.false_colour) return {0, "the view shows illuminance, as in clear air"};
  if (facts.parallel_rays) return {0, "the view is from above with parallel rays, through no air"};
  return {2, words_of(facts.air) + " between the eye and what it sees"};
}

EffectDecision precipitation(const EffectFacts& facts) {
  if (!facts.air.falls()) return {0, "neither rain nor snow falls"};
  if (facts.false_colour) return {0, "the view shows illuminance, as in clear air"};
  if (facts.clipping) return {0, "the view marks what the display clips of the scene itself"};
  if (facts.parallel_rays) return {0, "the view is from above with parallel rays, through no air"};
  if (facts.roofed) return {0, "the eye is under a roof"};
  if (facts.air_lamps == 0) return {0, "no lamp lights a drop in view"};
  const bool snow = facts.air.particles().kind == Precipitation::kSnow;
  return {1, std::to_string(facts.air_lamps) + (facts.air_lamps == 1 ? " lamp lights " : " lamps light ") +
                 (snow ? "flakes" : "drops") + " near the eye"};
}

EffectDecision wet_ground(const EffectFacts& facts) {
  constexpr double kDrizzle_mmph = 0.5;  // chosen: less leaves no film
  if (facts.false_colour) return {0, "the view shows illuminance, whatever it falls on", true};
  if (nothing_shines(facts)) return {0, "no lamp is lit, and no moon shines"};
  const double rain = facts.air.rain_mmph;
  if (rain > 0.0 && facts.snow_drawn && facts.snow_cover_01 >= 0.5) return {0, "snow lies on it"};
  if (rain <= 0.0) return {0, "it does not rain"};
  char reason[90];
  const std::size_t level = film_mm(rain) > 0.0 ? 3 : rain >= kDrizzle_mmph ? 2 : 1;
  std::snprintf(reason, sizeof reason, "rain of %.4g mm/h %s", rain,
                level == 3   ? "stands over the texture of the road"
                : level == 2 ? "fills the texture of the road"
                             : "leaves no film on the road");
  return {level, reason};
}

EffectDecision glare(const EffectFacts& facts) {
  if (facts.glare_lamps == 0) return {0, "no lamp shines into the eye"};
  if (facts.false_colour) return {0, "the view shows illuminance, which no eye scatters"};
  if (facts.clipping) return {0, "the view marks what the display clips of the scene itself"};
  char reason[80];
  std::snprintf(reason, sizeof reason, "%zu lamp%s into the eye, %.3g lx", facts.glare_lamps,
                facts.glare_lamps == 1 ? " shines" : "s shine", facts.glare_lx);
  return {1, reason};
}

EffectDecision gui(const EffectFacts& facts) {
  // Whether it is shown is the user's word already, and what moves lamps by the mouse has to be seen.
  if (!facts.gui) return {0, "the panel is hidden", true};
  return {1, "the panel is shown", true};
}

EffectDecision fixed_light(const EffectFacts& facts) {
  std::string what;
  const auto add = [&](const std::string& one) { what += (what.empty() ? "" : ", ") + one; };
  const auto counted = [](std::size_t count, const char* noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
  };
  if (facts.street_lamps > 0) add(counted(facts.street_lamps, "street lamp"));
  if (facts.moon) add("the moon");
  if (facts.directional > 0) add(counted(facts.directional, "directional light"));
  if (facts.luminous > 0) add(counted(facts.luminous, "luminous material"));
  if (facts.covered) add("a roof over the road");
  if (facts.reflecting > 0) add(std::to_string(facts.reflecting) + " pieces under it send light on");
  if (facts.too_many_reflecting) add("too many pieces under it to send light on");
  if (what.empty()) return {0, "no street lamp, no moon, and nothing shines by itself"};
  return {1, what};
}

EffectDecision eyeshine(const EffectFacts& facts) {
  if (facts.pupils == 0) return {0, "no animal's eye sends light back"};
  if (facts.false_colour) return {0, "the view shows illuminance, whatever it falls on"};
  if (facts.clipping) return {0, "the view marks what the display clips of the scene itself"};
  return {1, std::to_string(facts.pupils) +
                 (facts.pupils == 1 ? " eye of an animal sends" : " eyes of animals send") + " light back"};
}

EffectDecision snow_cover(const EffectFacts& facts) {
  if (facts.snow_cover_01 <= 0.0) return {0, "no snow lies"};
  if (facts.false_colour) return {0, "the view shows illuminance, whatever it falls on", true};
  char reason[60];
  std::snprintf(reason, sizeof reason, "snow lies on %.3g %% of level ground", 100.0 * facts.snow_cover_01);
  return {1, reason};
}

EffectDecision windscreen(const EffectFacts& facts) {
  if (!facts.windscreen) return {0, "no windscreen is before the eye"};
  if (facts.air.rain_mmph <= 0.0) return {0, "no rain falls on the windscreen"};
  if (facts.roofed) return {0, "the windscreen is under a roof"};
  if (facts.false_colour) return {0, "the view shows illuminance, as without it"};
  if (facts.clipping) return {0, "the view marks what the display clips of the scene itself"};
  if (facts.parallel_rays) return {0, "the view is from above with parallel rays, by no eye"};
  char reason[60];
  std::snprintf(reason, sizeof reason, "rain of %.4g mm/h falls on the windscreen", facts.air.rain_mmph);
  return {1, reason};
}

EffectDecision spray(const EffectFacts& facts) {
  if (facts.ground == 0 && !facts.false_colour) return {0, "the ground is dry"};
  if (facts.spraying == 0 && !facts.false_colour) return {0, "no vehicle in view is fast enough to throw up water"};
  if (facts.lit_lamps == 0) return {0, "no lamp is lit"};
  if (facts.false_colour) return {0, "the view shows illuminance, as in clear air"};
  if (facts.clipping) return {0, "the view marks what the display clips of the scene itself"};
  if (facts.parallel_rays) return {0, "the view is from above with parallel rays, through no air"};
  char reason[80];
  std::snprintf(reason, sizeof reason, "%zu vehicle%s up water of %.2g mm", facts.spraying,
                facts.spraying == 1 ? " throws" : "s throw", water_mm(facts.air.rain_mmph, facts.ground));
  return {1, reason};
}

EffectDecision asphalt(const EffectFacts& facts) {
  if (!facts.r_table) return {0, "no street lamp and no moon shines on asphalt"};
  if (!facts.fixed_drawn) return {0, "street lamps and the moon are not drawn"};
  if (facts.false_colour) return {0, "the view shows illuminance, whatever it falls on"};
  if (facts.parallel_rays) return {0, "the view is from above, where asphalt is diffuse"};
  if (facts.ground > 0) return {0, "water lies on it, whose film mirrors street lamps"};
  if (facts.snow_drawn) return {0, "snow lies on it"};
  return {1, "street lamps or the moon shine on asphalt"};
}

constexpr std::array<EffectRow, kEffectCount> kTable{
    {{Effect::kShadows, "shadows", kShadowNames,
      "a depth map for each lamp with something in its light, and its copy; rays: the triangles in a buffer", shadows},
     {Effect::kDepthFirst, "depth first", kOffOnNames, "a depth pass before the lit pass", depth_first},
     {Effect::kHdrImage, "hdr image", kOffOnNames, "an image of 8 bytes a pixel and the tone-mapping pass", hdr_image},
     {Effect::kOverlay, "overlay", kOffOnNames, "a pass of text over the picture", overlay, true},
     {Effect::kFog, "fog", kFogNames, "a pass that computes, a buffer of scattered light, and the sky through fog", fog,
      true},
     {Effect::kPrecipitation, "precipitation", kOffOnNames, "the HDR image; a draw of lines in the lamp pass",
      precipitation, true},
     {Effect::kWetGround, "ground", kWetNames, "pipelines of ground with water's mirror in them", wet_ground},
     {Effect::kGlare, "glare", kOffOnNames, "the HDR image; its pass to the display adds what the eye scatters", glare,
      true},
     {Effect::kGui, "gui", kOffOnNames, "a pass of triangles over the picture, an image of letters", gui},
     {Effect::kFixedLight, "fixed light", kOffOnNames, "20 bytes a vertex, and pipelines that read them", fixed_light,
      true},
     {Effect::kEyeshine, "eyeshine", kOffOnNames, "a draw of a few pixels in the lamp pass for each eye", eyeshine,
      true},
     {Effect::kSnowCover, "snow cover", kOffOnNames, "pipelines of all surfaces with snow on what looks up", snow_cover,
      true},
     {Effect::kWindscreen, "windscreen", kOffOnNames, "the HDR image; two passes, an image of 128 × 96 texels",
      windscreen, true, true},
     {Effect::kSpray, "spray", kOffOnNames, "the HDR image; a draw of puffs in the lamp pass for each vehicle", spray,
      true},
     {Effect::kAsphalt, "asphalt", kAsphaltNames, "48 bytes a vertex of asphalt, and pipelines that read them", asphalt,
      true}}};

constexpr bool in_order() {
  for (std::size_t i = 0; i < kTable.size(); ++i)
    if (static_cast<std::size_t>(kTable[i].effect) != i) return false;
  return true;
}
static_assert(in_order());

/// With those that are added.
std::vector<EffectRow>& rows() {
  static std::vector<EffectRow> rows = [] {
    std::vector<EffectRow> own(kTable.begin(), kTable.end());
    own.reserve(kMostEffects);
    return own;
  }();
  return rows;
}

}  // namespace

std::span<const EffectRow> effect_table() {
  return rows();
}

AddedRow::AddedRow(EffectRow row) : effect_(static_cast<Effect>(rows().size())) {
  if (rows().size() == kMostEffects)
    throw std::invalid_argument("no room for another effect: " + std::string(row.name));
  if (std::ranges::find(rows(), row.name, &EffectRow::name) != rows().end())
    throw std::invalid_argument("there is an effect of this name: " + std::string(row.name));
  row.effect = effect_;
  rows().push_back(row);
}

AddedRow::~AddedRow() {
  rows().pop_back();
}

EffectPlan plan_effects(const EffectFacts& facts, const EffectChoices& choices, const EffectChoices& picked) {
  const auto decided = [&](const EffectRow& row, const EffectFacts& by) {
    const auto i = static_cast<std::size_t>(row.effect);
    EffectDecision decision = row.decide(by);
    if (row.over_luminance && decision.level > 0 && (by.false_colour || by.clipping))
      decision = {0, "the view shows no luminance to draw it over", true};
    if (!choices[i] && picked[i] && decision.level > 0)
      decision = {std::min(*picked[i], row.levels.size() - 1),
                  "picked for what is asked of time and accuracy; by itself: " + decision.reason};
    if (!choices[i]) return decision;
    const std::size_t chosen = std::min(*choices[i], row.levels.size() - 1);
    if (decision.settled) {
      if (chosen != decision.level)
        decision.reason += "; " + std::string(row.levels[chosen]) + ", set by the user, waits for that to end";
      return decision;
    }
    if (row.only_where_called_for && decision.level == 0) {
      if (chosen > 0) decision.reason += "; " + std::string(row.levels[chosen]) + ", set by the user, waits for that";
      return decision;
    }
    if (row.effect == Effect::kShadows && *choices[i] >= kRayShadows && !by.shadow_rays)
      return EffectDecision{kRayShadows - 1,
                            "rays are set by the user, and the device holds no buffer as large as the scene's "
                            "triangles: the finest maps; by itself: " +
                                decision.reason};
    return EffectDecision{chosen, "set by the user; by itself: " + decision.reason};
  };
  // What one effect needs of another is a fact for that.
  EffectFacts known = facts;
  known.by_rays |= decided(kTable[static_cast<std::size_t>(Effect::kShadows)], facts).level >= kRayShadows;
  known.snow_drawn = decided(kTable[static_cast<std::size_t>(Effect::kSnowCover)], facts).level > 0;
  known.ground = decided(kTable[static_cast<std::size_t>(Effect::kWetGround)], known).level;
  known.spray_drawn = decided(kTable[static_cast<std::size_t>(Effect::kSpray)], known).level > 0;
  known.drops_drawn = decided(kTable[static_cast<std::size_t>(Effect::kPrecipitation)], facts).level > 0;
  known.glare_drawn = decided(kTable[static_cast<std::size_t>(Effect::kGlare)], facts).level > 0;
  known.fixed_drawn = decided(kTable[static_cast<std::size_t>(Effect::kFixedLight)], facts).level > 0;
  for (const EffectRow& row : effect_table())
    if (row.over_luminance && known.over_luminance.empty() && decided(row, known).level > 0)
      known.over_luminance = row.name;
  EffectPlan plan;
  for (const EffectRow& row : effect_table())
    plan.decisions[static_cast<std::size_t>(row.effect)] = decided(row, known);
  return plan;
}

std::string explain(const EffectPlan& plan) {
  std::string text;
  for (const EffectRow& row : effect_table()) {
    const EffectDecision& decision = plan[row.effect];
    std::string line(row.name);
    line.resize(std::max<std::size_t>(line.size() + 1, 16), ' ');
    line += row.levels[decision.level];
    line.resize(std::max<std::size_t>(line.size() + 1, 24), ' ');
    text += line + decision.reason + "\n";
  }
  return text;
}

}  // namespace phare
