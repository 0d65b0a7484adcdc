// The ladders of this program, measured on this machine.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "tools/cost/ladder.h"

namespace phare::cost {

struct Plan {
  bool quick = false;  ///< fewer levels, samples and rounds
  std::string scene_file, lamp_file, vehicle_file;
  int width_px = 1280, height_px = 720;
  std::uint64_t seed = 1;
  std::function<bool(const std::string& ladder)> wanted = [](const std::string&) { return true; };  ///< of pictures
  std::function<void(const std::string& doing, double share_01)> progress;
};

#ifdef PHARE_WITH_GRAPHICS
struct PictureLadders {
  std::string device;
  Ladder light, shadows, lens, fog, exposure;
};
/// Light: method × beam image level × cuts of the ground, against float64 at the pixels' own points. Shadows: each
/// level at points of the scene, against rays in float64: to the lamp's middle, and (lens) over its opening. Times turn
/// by turn, so that noise hits all levels alike; a frame of the same level goes before each that is timed, as in a
/// drive. Ladders that are not wanted have no levels.
Result<PictureLadders> picture_ladders(const Plan& plan);

struct EffectLadders {
  std::string device;
  std::vector<Ladder> ladders;
};
/// Precipitation, wet ground, glare, snow cover, spray, windscreen, eyeshine, each in a moment of the shipped country
/// road that calls for it: every level against the picture at the highest, in steps of the display. And a road that
/// calls for none of what only a scene calls for, with all of it set off and left to the scene: the same picture for
/// the same time. All else is as the scene calls for it, the luminance image too. Times as those of picture_ladders().
Result<EffectLadders> effect_ladders(const Plan& plan);
#endif

/// Integrator and step of each vehicle level, against the same level at its finest.
Result<std::vector<Ladder>> vehicle_ladders(const Plan& plan);

/// Rate of the pose messages, held or carried on until the next, against the pose itself.
Result<Ladder> pose_ladder(const Plan& plan);

}  // namespace phare::cost
