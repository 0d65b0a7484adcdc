// The lamp bench: `phare lamp info|table|check|plot|compare|convert|hspr|levels`. Options are plain data here; lamp.cpp
// hangs them on the command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "visual/photometry/bench/check.h"
#include "visual/photometry/readers/read_lamp.h"

namespace phare {

struct LampInfoOptions {
  std::vector<std::string> files;
  LampReadSettings settings;
  bool json = false, strict = false;
};
int lamp_info(const LampInfoOptions& options);

struct LampTableOptions {
  std::string file, at, out;
  std::vector<std::string> hv;  ///< "H,V" in degrees, right and up, by azimuth and elevation; in place of `at`
  LampReadSettings settings;
  bool json = false;
};
int lamp_table(const LampTableOptions& options);

struct LampCheckOptions {
  std::vector<std::string> files;  ///< one, or left and right
  std::vector<std::string> rules;
  LampReadSettings settings;
  std::string traffic = "find";
  std::optional<double> aim_up_deg, aim_right_deg;
  std::string aim;               ///< one of the rule's: "VOL", "VOR"; empty: by the beam
  std::string market, function;  ///< of --rule all: "ECE", "US"; "low", "high", "fog"; empty: every, by the beam
  std::string beam;              ///< of a list of points; empty: all of them
  std::string out;               ///< HTML page; empty: none
  bool reaim = true, led_module = false, json = false, list = false;
};
int lamp_check(const LampCheckOptions& options);

struct LampConvertOptions {
  std::vector<std::string> files;  ///< several: their sum
  std::string out, format;
  LampReadSettings settings;
  GammaAxis out_axis = GammaAxis::kGamma0;  ///< of EULUMDAT
  bool out_axis_given = false, json = false;
};
int lamp_convert(const LampConvertOptions& options);

struct LampCompareOptions {
  std::string a, b, out;
  LampReadSettings settings;
  bool align = true, mirror_b = false, json = false;
  double height_m = 0.65;
};
int lamp_compare(const LampCompareOptions& options);

inline constexpr const char* kPlotViews[] = {"wall_25m", "isocandela", "vertical_cut", "false_colour", "birds_eye"};

struct LampPlotOptions {
  std::vector<std::string> files;  ///< one, or left and right
  std::string out, rule;
  std::string beam;                ///< of a list of points; empty: all of them
  std::vector<std::string> views;  ///< stems of kPlotViews; empty: all
  LampReadSettings settings;
  double height_m = 0.65, spacing_m = 1.2;
  double pitch_deg = 0.0;
  bool pitch_given = false, json = false;
};
int lamp_plot(const LampPlotOptions& options);

struct LampHsprOptions {
  std::string left, right, beam = "find";
  std::vector<std::string> high;  ///< left and right of the driving beam; empty: one beam alone
  std::vector<std::string> adb;   ///< situation, left, right; all six or none
  LampReadSettings settings;
  double height_m = 0.75, spacing_m = 1.5;  ///< of the method
  double pitch_deg = 0.0;
  bool pitch_given = false, json = false;
};
int lamp_hspr(const LampHsprOptions& options);

struct LampLevelsOptions {
  std::string file;
  LampReadSettings settings;
  bool json = false, bench = false;
};
int lamp_levels(const LampLevelsOptions& options);

/// Folder of the rulebooks.
std::string rules_folder();

/// A file name for tables of people: without folders.
std::string base_name(const std::string& file);

}  // namespace phare
