// How the picture is drawn, as options of the command line: declared once, for phare-visual and for `phare drive`,
// which hands them on.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "config/desk.h"

namespace phare {

/// Most cuts of the ground: 64 triangles from one.
inline constexpr int kMostRoadCuts = 3;

/// "SETTING=VALUE" as --set takes it.
DeskCommand setting_of(const std::string& words);

/// A share of "1%" or "0.5 %", above 0; nothing: it is none.
std::optional<double> share_of_percent(const std::string& text);

class PictureOptions {
 public:
  PictureOptions() = default;
  PictureOptions(const PictureOptions&) = delete;  // the parser holds addresses of the members
  PictureOptions& operator=(const PictureOptions&) = delete;

  /// Declares them all. This must live as long as `app`.
  void add_to(CLI::App& app);

  /// What was given, as arguments for another program that declares them.
  std::vector<std::string> arguments() const;

  std::int64_t frames = 0;          ///< > 0: save every one of this many frames, then leave
  int width_px = 0, height_px = 0;  ///< 0: the channel's
  int samples = 1;
  double still_at_s = -1.0;  ///< simulated time of the stills; negative: chosen
  std::vector<DeskCommand>
      desk;                ///< what was set of the picture, in the order given; of the value --set none is checked
  std::string traffic;     ///< a file of road users, in place of the rig's
  bool video = false;      ///< a picture of every frame, for the video
  std::string beam_image;  ///< one of kImageLevelNames; empty: the rig's
  int road_cuts = 0;       ///< how often each triangle of the ground is cut in four
  std::int64_t audit_every = 300;     ///< frames; 0: never
  std::optional<double> audit_bound;  ///< a share of the light, in place of what the level states
  std::optional<int> frames_in_flight{};  ///< in real time; else two, in a window without a GPU one
  std::string device_name;
  bool validation = false;

 private:
  std::vector<const CLI::Option*> declared_;
};

}  // namespace phare
