// Unit: what decides about each effect, without a device.
#include "visual/effects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace phare {
namespace {

TEST(Effects, NothingCalledForIsNothingDone) {
  const EffectPlan plan = plan_effects({});
  for (const EffectRow& row : effect_table()) {
    EXPECT_FALSE(plan.on(row.effect)) << row.name;
    EXPECT_FALSE(plan[row.effect].reason.empty()) << row.name;
  }
}

TEST(Effects, EachFactSwitchesItsEffectAndNoOther) {
  const struct {
    EffectFacts facts;
    Effect effect;
  } cases[] = {{{.lit_lamps = 2, .casters = 3}, Effect::kShadows},
               {{.lit_lamps = 2, .by_rays = true}, Effect::kDepthFirst},
               {{.hdr_wanted = true}, Effect::kHdrImage},
               {{.overlay_lines = 3}, Effect::kOverlay},
               {{.air = {.visibility_m = 80.0}}, Effect::kFog},
               {{.air = {.rain_mmph = 4.0}, .air_lamps = 2}, Effect::kPrecipitation},
               {{.lit_lamps = 1, .air = {.rain_mmph = 4.0}}, Effect::kWetGround},
               {{.glare_lamps = 1, .glare_lx = 0.5}, Effect::kGlare},
               {{.gui = true}, Effect::kGui},
               {{.street_lamps = 40}, Effect::kFixedLight},
               {{.pupils = 2}, Effect::kEyeshine},
               {{.snow_cover_01 = 0.4}, Effect::kSnowCover},
               {{.air = {.rain_mmph = 4.0}, .windscreen = true}, Effect::kWindscreen},
               {{.lit_lamps = 1, .air = {.rain_mmph = 4.0}, .spraying = 1}, Effect::kSpray},
               {{.street_lamps = 40, .r_table = true}, Effect::kAsphalt}};
  std::set<Effect> tried;
  for (const auto& [facts, effect] : cases) {
    const EffectPlan plan = plan_effects(facts);
    for (const EffectRow& row : effect_table()) {
      const bool needed = ((effect == Effect::kGlare || effect == Effect::kPrecipitation ||
                            effect == Effect::kWindscreen || effect == Effect::kSpray) &&
                           row.effect == Effect::kHdrImage) ||
                          ((effect == Effect::kPrecipitation || effect == Effect::kWetGround ||
                            effect == Effect::kWindscreen || effect == Effect::kSpray) &&
                           row.effect == Effect::kFog) ||
                          (effect == Effect::kSpray && row.effect == Effect::kWetGround) ||
                          (effect == Effect::kAsphalt && row.effect == Effect::kFixedLight);
      EXPECT_EQ(plan.on(row.effect), row.effect == effect || needed) << row.name;
    }
    tried.insert(effect);
  }
  EXPECT_EQ(tried.size(), kEffectCount) << "every row has its case here";
}

/// Water mirrors street lamps and the moon as it does lamps of vehicles, and nothing where all is dark.
TEST(Effects, GroundIsWetUnderWhateverShinesOnIt) {
  const Air rain{.rain_mmph = 10.0};
  EXPECT_EQ(plan_effects({.air = rain}).level(Effect::kWetGround), 0u);
  EXPECT_EQ(plan_effects({.air = rain})[Effect::kWetGround].reason, "no lamp is lit, and no moon shines");
  for (const EffectFacts& facts :
       {EffectFacts{.air = rain, .street_lamps = 1}, EffectFacts{.air = rain, .directional = 1},
        EffectFacts{.air = rain, .moon = true}, EffectFacts{.lit_lamps = 1, .air = rain}})
    EXPECT_EQ(plan_effects(facts).level(Effect::kWetGround), 2u);
  const EffectFacts asphalt{.air = rain, .street_lamps = 1, .r_table = true};
  EXPECT_EQ(plan_effects(asphalt).level(Effect::kAsphalt), 0u) << "whose table is of a dry road";
}

/// Under a roof no drop is drawn; the image of luminance stays, or one would be made where the roof ends.
TEST(Effects, NothingFallsUnderARoof) {
  const EffectFacts rain{.lit_lamps = 2, .air = {.rain_mmph = 4.0}, .air_lamps = 2, .windscreen = true};
  EffectFacts roofed = rain;
  roofed.roofed = true;
  EXPECT_TRUE(plan_effects(rain).on(Effect::kPrecipitation));
  EXPECT_TRUE(plan_effects(rain).on(Effect::kWindscreen));
  const EffectPlan plan = plan_effects(roofed);
  EXPECT_FALSE(plan.on(Effect::kPrecipitation));
  EXPECT_EQ(plan[Effect::kPrecipitation].reason, "the eye is under a roof");
  EXPECT_FALSE(plan.on(Effect::kWindscreen));
  EXPECT_TRUE(plan.on(Effect::kHdrImage));
  EXPECT_TRUE(plan.on(Effect::kWetGround)) << "of what is not covered";
}

TEST(Effects, FixedLightNamesAllThatShines) {
  EXPECT_EQ(plan_effects({.street_lamps = 1})[Effect::kFixedLight].reason, "1 street lamp");
  EXPECT_EQ(
      plan_effects({.street_lamps = 212, .luminous = 3, .moon = true, .covered = true})[Effect::kFixedLight].reason,
      "212 street lamps, the moon, 3 luminous materials, a roof over the road");
  EXPECT_EQ(plan_effects({.street_lamps = 2, .covered = true, .reflecting = 7000})[Effect::kFixedLight].reason,
            "2 street lamps, a roof over the road, 7000 pieces under it send light on");
  EXPECT_EQ(plan_effects({.street_lamps = 2, .covered = true, .too_many_reflecting = true})[Effect::kFixedLight].reason,
            "2 street lamps, a roof over the road, too many pieces under it to send light on");
  EffectChoices choices{};
  choices[static_cast<std::size_t>(Effect::kFixedLight)] = 1;
  EXPECT_FALSE(plan_effects({}, choices).on(Effect::kFixedLight)) << "there is nothing that it could be made of";
  choices[static_cast<std::size_t>(Effect::kFixedLight)] = 0;
  EXPECT_FALSE(plan_effects({.moon = true}, choices).on(Effect::kFixedLight));
}

TEST(Effects, AsphaltIsByItsRTableWhereStreetLampsLightItDry) {
  const EffectFacts town{.lit_lamps = 2, .street_lamps = 52, .r_table = true};
  EXPECT_TRUE(plan_effects(town).on(Effect::kAsphalt));
  EffectFacts other = town;
  other.air.rain_mmph = 4.0;
  EXPECT_EQ(plan_effects(other)[Effect::kAsphalt].reason, "water lies on it, whose film mirrors street lamps");
  other = town, other.snow_cover_01 = 0.2;
  EXPECT_EQ(plan_effects(other)[Effect::kAsphalt].reason, "snow lies on it");
  for (bool EffectFacts::*view : {&EffectFacts::false_colour, &EffectFacts::parallel_rays}) {
    other = town, other.*view = true;
    EXPECT_FALSE(plan_effects(other).on(Effect::kAsphalt));
  }
  EffectChoices choices{};
  choices[static_cast<std::size_t>(Effect::kFixedLight)] = 0;
  EXPECT_FALSE(plan_effects(town, choices).on(Effect::kAsphalt)) << "its light is switched off";
  choices = {};
  choices[static_cast<std::size_t>(Effect::kAsphalt)] = 0;
  EXPECT_FALSE(plan_effects(town, choices).on(Effect::kAsphalt));
  choices[static_cast<std::size_t>(Effect::kAsphalt)] = 1;
  EXPECT_FALSE(plan_effects({.street_lamps = 52}, choices).on(Effect::kAsphalt)) << "there is none";
}

// Light past the sides of the maps is told wherever maps are drawn, or would be.
TEST(Effects, ShadowsTellOfLightPastTheirMaps) {
  const std::string beside =
      "; light of 2 lamps more than 75° beside the axis goes through what stands there, but by rays";
  EffectFacts facts{.lit_lamps = 2, .casters = 3, .wide_lamps = 2};
  EXPECT_EQ(plan_effects(facts)[Effect::kShadows].reason,
            "3 pieces of the scene stand in the light of the lamps" + beside);
  facts.casters = 0;
  EXPECT_EQ(plan_effects(facts)[Effect::kShadows].reason, "nothing stands in the light of the lamps" + beside);
  facts.casters = 3;
  EffectChoices rays{};
  rays[static_cast<std::size_t>(Effect::kShadows)] = kRayShadows;
  EXPECT_EQ(plan_effects(facts, rays)[Effect::kShadows].reason.find("75°"), std::string::npos);
  facts.shadow_rays = false;
  EXPECT_NE(plan_effects(facts, rays)[Effect::kShadows].reason.find("75°"), std::string::npos) << "maps in their place";
}

TEST(Effects, DeviceAndViewCountToo) {
  EXPECT_FALSE(plan_effects({.lit_lamps = 2, .casters = 3, .shadow_maps = false}).on(Effect::kShadows));
  EXPECT_FALSE(plan_effects({.lit_lamps = 2, .casters = std::nullopt}).on(Effect::kShadows));
  EXPECT_FALSE(plan_effects({.hdr_wanted = true, .false_colour = true}).on(Effect::kHdrImage));
  EXPECT_FALSE(plan_effects({.hdr_wanted = true, .clipping = true}).on(Effect::kHdrImage));
  // Nor by force: the tone curve would make a photo of them.
  EffectChoices forced{};
  forced[static_cast<std::size_t>(Effect::kHdrImage)] = 1;
  EXPECT_FALSE(plan_effects({.false_colour = true}, forced).on(Effect::kHdrImage));
  EXPECT_FALSE(plan_effects({.clipping = true}, forced).on(Effect::kHdrImage));
  EXPECT_TRUE(plan_effects({}, forced).on(Effect::kHdrImage));
  EXPECT_FALSE(plan_effects({.false_colour = true, .air = {.visibility_m = 80.0}}).on(Effect::kFog));
  EXPECT_FALSE(plan_effects({.air = {.visibility_m = 80.0}, .parallel_rays = true}).on(Effect::kFog));
}

// A pixel that is drawn twice is a loss where it is dear.
TEST(Effects, DepthComesFirstWhereAPixelIsDear) {
  const auto on = [](const EffectFacts& facts, const EffectChoices& choices = {}) {
    return plan_effects(facts, choices).on(Effect::kDepthFirst);
  };
  EXPECT_FALSE(on({.lit_lamps = 2}));
  EffectChoices choices{};
  for (std::size_t level = 0; level < kShadowNames.size(); ++level) {
    choices[static_cast<std::size_t>(Effect::kShadows)] = level;
    EXPECT_EQ(on({.lit_lamps = 2, .casters = 3}, choices), level >= kRayShadows) << kShadowNames[level];
    EXPECT_FALSE(on({.lit_lamps = 2, .casters = 3, .shadow_rays = false}, choices)) << "the device has no rays";
  }
}

TEST(Effects, RainAndSnowAreDrawnWhereALampLightsThem) {
  const EffectFacts rain{.air = {.rain_mmph = 4.0}, .air_lamps = 1};
  EXPECT_EQ(plan_effects(rain)[Effect::kPrecipitation].reason, "1 lamp lights drops near the eye");
  EXPECT_EQ(plan_effects({.air = {.rain_mmph = 1.0, .snow_mmph = 2.0}, .air_lamps = 2})[Effect::kPrecipitation].reason,
            "2 lamps light flakes near the eye");
  EXPECT_FALSE(plan_effects({.air = {.rain_mmph = 4.0}}).on(Effect::kPrecipitation)) << "in the dark";
  EXPECT_FALSE(plan_effects({.air = {.visibility_m = 50.0}, .air_lamps = 2}).on(Effect::kPrecipitation));
  for (bool EffectFacts::*view : {&EffectFacts::false_colour, &EffectFacts::clipping, &EffectFacts::parallel_rays}) {
    EffectFacts other = rain;
    other.*view = true;
    EXPECT_FALSE(plan_effects(other).on(Effect::kPrecipitation));
  }
  EffectChoices off{};
  off[static_cast<std::size_t>(Effect::kPrecipitation)] = 0;
  EXPECT_FALSE(plan_effects(rain, off).on(Effect::kHdrImage));
  EXPECT_TRUE(plan_effects(rain, off).on(Effect::kFog)) << "the air stays as it is";
}

// By the depth of the film: Gallaway's formula gives -0.27 mm at 10 mm/h and 0.57 mm at 50 mm/h.
TEST(Effects, GroundIsAsWetAsItRains) {
  const auto level_of = [](double rain_mmph) {
    return kWetNames[plan_effects({.lit_lamps = 1, .air = {.rain_mmph = rain_mmph}}).level(Effect::kWetGround)];
  };
  EXPECT_EQ(level_of(0.0), "dry");
  EXPECT_EQ(level_of(0.2), "damp");
  EXPECT_EQ(level_of(10.0), "wet");
  EXPECT_EQ(level_of(50.0), "flooded");
  EffectChoices after_rain{};
  after_rain[static_cast<std::size_t>(Effect::kWetGround)] = 2;
  EXPECT_EQ(plan_effects({.lit_lamps = 1}, after_rain).level(Effect::kWetGround), 2u);
  EXPECT_FALSE(plan_effects({.lit_lamps = 1, .false_colour = true}, after_rain).on(Effect::kWetGround));
}

// Where the ground is wet, by rain or by the user's word, and a vehicle is fast enough; not where no luminance is
// shown.
TEST(Effects, SprayNeedsWaterAVehicleAndALamp) {
  const EffectFacts facts{.lit_lamps = 2, .air = {.rain_mmph = 10.0}, .spraying = 1};
  EXPECT_EQ(plan_effects(facts)[Effect::kSpray].reason, "1 vehicle throws up water of 0.53 mm");
  EXPECT_EQ(plan_effects({.lit_lamps = 2, .spraying = 3})[Effect::kSpray].reason, "the ground is dry");
  EffectChoices choices{};
  choices[static_cast<std::size_t>(Effect::kWetGround)] = 3;
  EXPECT_EQ(plan_effects({.lit_lamps = 2, .spraying = 3}, choices)[Effect::kSpray].reason,
            "3 vehicles throw up water of 1.2 mm");
  EXPECT_FALSE(plan_effects({.lit_lamps = 2}, choices).on(Effect::kSpray));
  EXPECT_EQ(plan_effects({.lit_lamps = 2, .false_colour = true, .air = {.rain_mmph = 10.0}})[Effect::kSpray].reason,
            "the view shows illuminance, as in clear air")
      << "it rains: the ground is not dry";
  EXPECT_FALSE(plan_effects({.spraying = 3}, choices).on(Effect::kSpray)) << "in the dark";
  choices[static_cast<std::size_t>(Effect::kWetGround)] = 0;
  EXPECT_FALSE(plan_effects(facts, choices).on(Effect::kSpray)) << "the ground is dry by the user's word";
  for (bool EffectFacts::*view : {&EffectFacts::false_colour, &EffectFacts::clipping, &EffectFacts::parallel_rays}) {
    EffectFacts other = facts;
    other.*view = true;
    EXPECT_FALSE(plan_effects(other).on(Effect::kSpray));
  }
  choices = {};
  choices[static_cast<std::size_t>(Effect::kSpray)] = 0;
  choices[static_cast<std::size_t>(Effect::kPrecipitation)] = 0;
  EXPECT_FALSE(plan_effects(facts, choices).on(Effect::kSpray));
  EXPECT_FALSE(plan_effects(facts, choices).on(Effect::kHdrImage));
  choices[static_cast<std::size_t>(Effect::kSpray)] = 1;
  EXPECT_FALSE(plan_effects({.lit_lamps = 2}, choices).on(Effect::kSpray)) << "there is nothing that it could be of";
}

// The eye scatters light in cd/m², so glare has the luminance image made, even against the user's word; without glare
// nothing asks for it, and in views that show no luminance there is neither.
TEST(Effects, GlareHasTheLuminanceImageMade) {
  const EffectFacts facts{.glare_lamps = 2, .glare_lx = 0.3};
  EffectChoices choices{};
  choices[static_cast<std::size_t>(Effect::kHdrImage)] = 0;
  EXPECT_TRUE(plan_effects(facts, choices).on(Effect::kHdrImage));
  choices = {};
  choices[static_cast<std::size_t>(Effect::kGlare)] = 0;
  EXPECT_FALSE(plan_effects(facts, choices).on(Effect::kGlare));
  EXPECT_FALSE(plan_effects(facts, choices).on(Effect::kHdrImage));
  choices[static_cast<std::size_t>(Effect::kGlare)] = 1;
  EXPECT_FALSE(plan_effects({}, choices).on(Effect::kGlare)) << "there is nothing that it could be made of";
  for (const bool clipping : {false, true}) {
    EffectFacts other = facts;
    (clipping ? other.clipping : other.false_colour) = true;
    EXPECT_FALSE(plan_effects(other).on(Effect::kGlare));
    EXPECT_FALSE(plan_effects(other).on(Effect::kHdrImage));
  }
}

TEST(Effects, TheUserDecidesAndThePlanSaysSo) {
  EffectChoices choices{};
  choices[static_cast<std::size_t>(Effect::kDepthFirst)] = 1;
  choices[static_cast<std::size_t>(Effect::kOverlay)] = 0;
  const EffectPlan plan = plan_effects({.lit_lamps = 2, .overlay_lines = 1}, choices);
  EXPECT_TRUE(plan.on(Effect::kDepthFirst));
  EXPECT_FALSE(plan.on(Effect::kOverlay));
  EXPECT_NE(plan[Effect::kDepthFirst].reason.find("user"), std::string::npos);
  choices[static_cast<std::size_t>(Effect::kDepthFirst)] = 99;
  EXPECT_EQ(plan_effects({}, choices)[Effect::kDepthFirst].level, 1u) << "the finest there is";
  // A level of what only weather makes is not lost in clear air, nor silent.
  choices[static_cast<std::size_t>(Effect::kFog)] = 3;
  const EffectPlan clear = plan_effects({.lit_lamps = 2}, choices);
  EXPECT_FALSE(clear.on(Effect::kFog));
  EXPECT_EQ(clear[Effect::kFog].reason, "the air is clear; fine, set by the user, waits for that");
  choices[static_cast<std::size_t>(Effect::kFog)] = 0;
  EXPECT_EQ(plan_effects({.lit_lamps = 2}, choices)[Effect::kFog].reason, "the air is clear");
}

// What a budget has picked holds where the scene calls for the effect, and makes none; the user's word counts before
// it.
TEST(Effects, WhatIsPickedHoldsWhereItIsCalledFor) {
  const auto shadows = static_cast<std::size_t>(Effect::kShadows);
  EffectChoices picked{}, choices{};
  picked[shadows] = 1;
  const EffectFacts called{.lit_lamps = 2, .casters = 3};
  EXPECT_EQ(plan_effects(called, {}, picked).level(Effect::kShadows), 1u);
  EXPECT_NE(plan_effects(called, {}, picked)[Effect::kShadows].reason.find("picked"), std::string::npos);
  EXPECT_EQ(plan_effects({.lit_lamps = 2, .casters = 0}, {}, picked).level(Effect::kShadows), 0u);
  choices[shadows] = 3;
  EXPECT_EQ(plan_effects(called, choices, picked).level(Effect::kShadows), 3u);
  picked[shadows] = 0;
  EXPECT_EQ(plan_effects(called, {}, picked).level(Effect::kShadows), 0u);
}

TEST(Effects, EveryEffectIsExplainedInOneLine) {
  const std::string text = explain(plan_effects({.lit_lamps = 2}));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), static_cast<std::ptrdiff_t>(kEffectCount));
  for (const EffectRow& row : effect_table()) EXPECT_NE(text.find(row.name), std::string::npos);
}

}  // namespace
}  // namespace phare
