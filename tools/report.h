// What came out of a drive: one report.json from the processes' own files, and one page that shows it.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "config/rig.h"
#include "tools/supervisor.h"

namespace phare {

struct DriveFacts {
  std::vector<std::string> command;  ///< as typed
  bool lockstep = false;
  double wall_s = 0.0;
  int exit_code = 0;
  std::string why;           ///< when exit_code is not 0
  bool interrupted = false;  ///< by Ctrl-C or SIGTERM
  std::vector<Restart> restarts;
  std::vector<Supervisor::Ended> ends;
  std::optional<std::filesystem::path> source_file;   ///< drive, script or log that was driven
  std::optional<std::filesystem::path> traffic_file;  ///< other road users, of the rig or in place of it
  std::vector<std::string> process_names;             ///< "cockpit", "dynamics", "visual-0": OUT/<name>.json
  std::map<std::string, nlohmann::json>
      own_counts{};                               ///< stats_json of the launcher's own sockets: "phare", "recorder"
  std::vector<nlohmann::json> before_restarts{};  ///< per restart: the last OUT/<name>.json of the process that died
};

/// OUT/<process>.json; null when it is missing or broken.
nlohmann::json read_stats(const std::filesystem::path& out, const std::string& process);

/// Merges OUT/<process>.json of every process and names every input by its content. A process that left no file is left
/// out.
nlohmann::json make_report(const Rig& rig, const DriveFacts& facts, const std::filesystem::path& out);

/// kBeside: the page finds pictures and video in its folder. kWithin: it holds them, one file that can be mailed.
enum class PageFiles { kBeside, kWithin };

/// A page on a report, the series (drive_series.h) and the pictures that lie in `out`. What is not there is left out.
std::string report_page(const nlohmann::json& report, const std::filesystem::path& out,
                        PageFiles files = PageFiles::kBeside);
/// Its lower half: processes, times, effects, hashes.
std::string report_tables(const nlohmann::json& report);

}  // namespace phare
