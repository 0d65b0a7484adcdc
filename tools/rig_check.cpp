#include "tools/rig_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "cockpit_io/dbc.h"
#include "cockpit_io/feedback.h"
#include "cockpit_io/signal_map.h"
#include "cockpit_io/source.h"
#include "config/base/input_files.h"
#include "config/base/paths.h"
#include "config/cockpit.h"
#include "config/road/lane.h"
#include "config/road/road_surface.h"
#include "config/street_lamps.h"
#include "config/traffic/road_users.h"
#include "config/vehicle.h"
#include "tools/lamp_design.h"
#include "vehicle_dynamics/start_pose.h"
#include "visual/fixed_light.h"
#include "visual/gpu/pack_materials.h"
#include "visual/photometry/bench/lamp_aim.h"
#include "visual/photometry/bench/lint.h"
#include "visual/photometry/bench/table_end.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/photometry/table/surface_luminance.h"
#include "visual/scene/scene.h"

namespace phare {
namespace {

namespace fs = std::filesystem;

/// "-" is standard input; paths within are then relative to the working directory.
Result<RigReading> reading_of(const fs::path& file) {
  if (!is_standard_input(file)) return read_rig_whole(file);
  constexpr std::uintmax_t kMostBytes = 64u << 20;
  const auto text = read_input_bytes(file, kMostBytes);
  if (!text) return text.error();
  return read_rig_text(*text, input_name(file));
}

class Checker {
 public:
  RigFindings check(const fs::path& file) {
    auto reading = reading_of(file);
    if (!reading) {
      found_.problems.push_back(reading.error());
      return std::move(found_);
    }
    found_.problems = reading->problems;
    const Rig& rig = reading->rig;
    scene(rig.scene_file);
    if (is_there(rig.vehicle_file, "the vehicle")) {
      if (const auto vehicle = read_vehicle(rig.vehicle_file); !vehicle) problem(vehicle.error());
    }
    if (is_there(rig.cockpit_file, "the cockpit")) cockpit(rig.cockpit_file);
    traffic(rig);
    street_lamps(rig.street_lamps_file);
    lamps(rig);
    return std::move(found_);
  }

 private:
  void problem(const Error& error) { found_.problems.push_back(error); }

  /// False where nothing is named: that is told already.
  bool is_there(const fs::path& file, const std::string& what) {
    if (file.empty()) return false;
    const std::string why = why_no_file(file);
    if (why.empty()) return true;
    problem({file.string(), why + "; it is " + what});
    return false;
  }

  void scene(const fs::path& file) {
    if (!is_there(file, "the scene")) return;
    const auto scene = read_scene(file);
    if (!scene) return problem(scene.error());
    for (const std::string& note : scene->notes) found_.notes.push_back(file.string() + ": " + note);
    // Its own lamps' photometry files, too.
    if (const auto light = FixedLight::of(*scene, {}, std::nullopt, Reflected::kOff); !light) problem(light.error());
    fits_device(*scene);
    std::error_code ignored;
    const fs::path lane = lane_file_of(file);
    CarState start;
    if (!fs::exists(lane, ignored)) {
      found_.warnings.push_back(lane.string() + ": no such file: the car starts at the scene's origin");
    } else if (const auto points = lane_beside(file); !points) {
      problem(points.error());
    } else if (const auto on_lane = start_of_lane(lane); on_lane) {
      start = *on_lane;
    } else {
      problem(on_lane.error());
    }
    const auto ground = RoadSurface::read(file);
    if (!ground) return problem(ground.error());
    if (const std::string why = no_ground_below(*ground, start.x_m, start.y_m); !why.empty())
      found_.warnings.push_back(file.string() + ": " + why);
  }

  /// As many materials as a device holds, with those of our own road users.
  void fits_device(const Scene& scene) {
    const auto movers = read_scene(generated_dir() / "scenes/road_users.glb");
    try {
      (void)pack_materials(scene, movers ? *movers : Scene{});
    } catch (const std::runtime_error& too_many) {
      problem({scene.file.string(), too_many.what()});
    }
  }

  void traffic(const Rig& rig) {
    if (!is_there(rig.traffic_file, "the traffic")) return;
    if (const auto users = read_road_users(rig.traffic_file); !users) problem(users.error());
    std::error_code ignored;
    if (const fs::path lane = lane_file_of(rig.scene_file); !rig.scene_file.empty() && !fs::exists(lane, ignored))
      problem({rig.traffic_file.string(),
               "the scene has no lane beside it that road users would drive along: no " + lane.string()});
  }

  void street_lamps(const fs::path& file) {
    if (!is_there(file, "the street lamps")) return;
    const auto config = read_street_lamps(file);
    if (!config) return problem(config.error());
    if (config->lamps.empty() && config->off == 0)
      found_.warnings.push_back(file.string() + ": no [[lamp]]: none of its luminaires hangs anywhere");
    if (is_there(config->r_table_file, "the r-table of " + file.string()))
      if (const auto table = read_r_table(config->r_table_file); !table) problem(table.error());
    for (const LuminaireConfig& kind : config->luminaires)
      if (is_there(kind.file, "the light of luminaire \"" + kind.name + "\" of " + file.string()))
        if (const auto table = read_lamp(kind.file, read_settings(kind)); !table) problem(table.error());
  }

  void cockpit(const fs::path& file) {
    if (!cockpits_.insert(file).second) return;
    const auto config = read_cockpit(file);
    if (!config) return problem(config.error());
    if (is_there(config->dbc_file, "the DBC of " + file.string())) {
      const auto dbc = read_dbc(config->dbc_file);
      if (!dbc) {
        problem(dbc.error());
      } else {
        if (const auto map = SignalMap::bind(*config, *dbc, 0); !map) problem(map.error());
        if (const auto sends = Feedback::bind(*config, *dbc); !sends) problem(sends.error());
      }
    }
    is_there(config->input_file, "what " + file.string() + " plays");
    for (const fs::path& also : config->also) {
      if (!is_there(also, "a further source of " + file.string())) continue;
      if (const auto beside = read_source_beside(also); !beside)
        problem(beside.error());
      else
        cockpit(also);
    }
  }

  void lamps(const Rig& rig) {
    std::set<std::string> told;
    const auto once = [&](std::vector<std::string>& list, const std::string& text) {
      if (told.insert(text).second) list.push_back(text);
    };
    std::vector<DesignConfig> designs = rig.designs;
    for (DesignConfig& design : designs) {
      std::set<std::string> names;
      bool low = false;  // also of a file that cannot be read, which is a problem of its own
      for (const LampConfig& lamp : design.lamps) {
        low = low || std::ranges::any_of(lamp.sources, [](const SourceConfig& source) {
                return source.function == LampFunction::kLow;
              });
        if (!names.insert(lamp.name).second)
          once(found_.warnings,
               fmt::format("design \"{}\": two lamps are named \"{}\"; `phare control` finds the first", design.name,
                           lamp.name));
      }
      std::erase_if(design.lamps, [&](LampConfig& lamp) {
        std::erase_if(lamp.sources, [&](const SourceConfig& source) { return !readable(source, design, lamp); });
        return lamp.sources.empty();
      });
      std::string right, left;  // a lamp whose low beam is for that traffic
      for (LampConfig& lamp : design.lamps) {
        const CutoffSide side = aimed(design, lamp, once);
        if (side == CutoffSide::kRisesRight) right = lamp.name;
        if (side == CutoffSide::kRisesLeft) left = lamp.name;
      }
      if (!right.empty() && !left.empty())
        once(found_.warnings, fmt::format("design \"{}\": the low beam of {} is for right-hand traffic, that of {} for "
                                          "left-hand traffic",
                                          design.name, right, left));
      if (!low) once(found_.warnings, fmt::format("design \"{}\" has no low beam: the car drives dark", design.name));
    }
    for (const SourceEnd& end : table_ends(designs, tables_, rig.channels))
      once(found_.warnings, fmt::format("design \"{}\", {}", end.design, end.text()));
  }

  bool readable(const SourceConfig& source, const DesignConfig& design, const LampConfig& lamp) {
    if (source.file.empty()) return false;
    if (const std::string why = why_no_file(source.file); !why.empty()) {
      if (bad_files_.insert(source.file).second)
        problem(
            {source.file.string(), fmt::format("{}; it is lamp \"{}\", design \"{}\"", why, lamp.name, design.name)});
      return false;
    }
    if (const Status read = tables_.add(source); !read) {
      if (bad_files_.insert(source.file).second) problem(read.error());
      return false;
    }
    const IntensityTable& table = tables_.of(source);
    if (!source.pixels.empty() && table.peak_cd() <= 0.0) {  // a law or a program gives it others
      if (looked_at_.insert(source.pixels).second)
        found_.notes.push_back(source.pixels.string() + ": a black picture: this pixel light begins dark");
      return true;
    }
    const bool ahead = source.function == LampFunction::kCornering || lights_ahead(source, table);
    if (!ahead && bad_files_.insert(source.file).second)
      problem({source.file.string(), "sends no light ahead: look at axis, c0_deg, yaw_deg, pitch_deg and roll_deg"});
    if (looked_at_.insert(source.file).second) {
      for (const Finding& finding : lint_lamp(table).findings) {
        const std::string text = (finding.place.empty() ? source.file.string() : finding.place) + ": " + finding.text;
        if (finding.grade == Grade::kError) problem({source.file.string(), finding.text});
        if (finding.grade == Grade::kWarning && ahead) found_.warnings.push_back(text);
      }
    }
    return true;
  }

  /// Gives the side of traffic that the lamp's low beam tells.
  template <typename Once>
  CutoffSide aimed(const DesignConfig& design, LampConfig& lamp, const Once& once) {
    const LampAiming aiming = aim_lamp(lamp, tables_);
    const std::string who = fmt::format("design \"{}\", {}", design.name, lamp.name);
    const bool has_function = std::ranges::any_of(
        lamp.sources, [&](const SourceConfig& source) { return source.function == aiming.function; });
    if (aiming.asked != AimConfig::Kind::kAsFiled) once(found_.notes, who + ": " + aiming.text());
    const bool low = has_function && aiming.function == LampFunction::kLow;
    const CutoffSide side = low && aiming.found ? aiming.shape.side : CutoffSide::kNone;
    if (!has_function) return side;
    if (aiming.asked == AimConfig::Kind::kCutoff && !aiming.found) once(found_.warnings, who + ": " + aiming.text());
    if (aiming.found && !aiming.within()) {
      once(found_.warnings,
           fmt::format("{}: the cut-off stands at {:+.2f}° ({:+.1f} %); {} asks {:.1f} to {:.1f} % of a "
                       "new {} {:.2f} m high",
                       who, aiming.after_deg, percent_of_degrees(aiming.after_deg), aiming.line.clause,
                       aiming.line.highest_percent, aiming.line.lowest_percent, beam_name(aiming.function),
                       aiming.height_m));
    }
    // UN R48 6.2.4.2: 500 to 1,200 mm.
    if (aiming.function == LampFunction::kLow && (lamp.position_m.z < 0.5 || lamp.position_m.z > 1.2))
      once(found_.warnings, fmt::format("{}: {:.2f} m above the road; UN R48 6.2.4.2 has low beams at 0.5 to 1.2 m",
                                        who, lamp.position_m.z));
    return side;
  }

  RigFindings found_;
  LampTables tables_;
  std::set<fs::path> cockpits_, bad_files_, looked_at_;
};

}  // namespace

RigFindings check_rig(const fs::path& file) {
  return Checker().check(file);
}

nlohmann::json as_json(const RigFindings& findings, const fs::path& file) {
  nlohmann::json json{{"file", file.string()},
                      {"good", findings.problems.empty()},
                      {"problems", nlohmann::json::array()},
                      {"warnings", findings.warnings},
                      {"notes", findings.notes}};
  for (const Error& error : findings.problems)
    json["problems"].push_back({{"place", error.place}, {"reason", error.reason}});
  return json;
}

}  // namespace phare
