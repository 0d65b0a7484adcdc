// phare cost: what accuracy costs on this machine.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "config/base/commit.h"
#include "config/base/content_hash.h"
#include "config/base/input_files.h"
#include "config/base/paths.h"
#include "config/base/shell_word.h"
#include "config/base/whole_file.h"
#include "config/formats/gltf_uri.h"
#include "config/rig.h"
#include "config/vehicle.h"
#include "tools/commands.h"
#include "tools/cost/ladder.h"
#include "tools/cost/measure_ladders.h"
#include "tools/cost/measure_settings.h"
#include "tools/cost/page.h"
#include "tools/cost/plot.h"
#include "tools/cost/progress_line.h"
#include "tools/cost/ranks.h"
#include "tools/utc_now.h"
#include "visual/air_of_desk.h"

namespace phare {
namespace {

using namespace cost;

struct CostOptions {
  bool quick = false, json = false;
  std::string out = "cost", against, scene, lamp, vehicle, rig, size = "1280x720";
  std::vector<std::string> ladders;
  std::uint64_t seed = 1;
  std::string command;  ///< that repeats the run
};

const std::vector<std::string> kLadderNames{"light",   "shadows", "lens",  "fog",     "exposure",
                                            "effects", "vehicle", "poses", "settings"};

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

/// The options that were given, as a shell reads them; --seed always.
std::string command_line(const CLI::App& command) {
  std::string text = "phare cost";
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (name == "--help" || (option->count() == 0 && name != "--seed")) continue;
    if (option->get_items_expected_max() == 0) {
      text += " " + name;
      continue;
    }
    const std::vector<std::string> given =
        option->count() > 0 ? option->results() : std::vector{option->get_default_str()};
    for (const std::string& word : given) text += " " + name + " " + shell_word(word);
  }
  return text;
}

class CostRun {
 public:
  explicit CostRun(const CostOptions& options) : options_(options) {}

  int run() {
    Plan plan{.quick = options_.quick,
              .scene_file = options_.scene,
              .lamp_file = options_.lamp,
              .vehicle_file = options_.vehicle,
              .seed = options_.seed,
              .wanted = [this](const std::string& ladder) { return wanted(ladder); },
              .progress = {}};
    int end = 0;
    if (std::sscanf(options_.size.c_str(), "%dx%d%n", &plan.width_px, &plan.height_px, &end) != 2 ||
        static_cast<std::size_t>(end) != options_.size.size())
      return bad_input({"--size " + options_.size, "is not WIDTHxHEIGHT in pixels"});
    if (const Status read = read_named(); !read) return bad_input(read.error());
    std::error_code failed;
    std::filesystem::create_directories(options_.out, failed);
    if (failed) return bad_input({"--out " + options_.out, failed.message()});
    if (const Status measured = measure(plan); !measured) return bad_input(measured.error());
    for (Ladder& ladder : ladders_) mark_efficient(ladder);
    if (const Status written = write(); !written) return bad_input(written.error());
    print();
    return ranks_alike() ? kExitDone : kExitCheckFailed;
  }

 private:
  /// Before anything is measured: a file that is none is told at once, whichever ladders are wanted.
  Status read_named() {
    if (const auto rig = read_rig(options_.rig); !rig) return rig.error();
    if (const auto vehicle = read_vehicle(options_.vehicle); !vehicle) return vehicle.error();
    if (options_.against.empty()) return Done{};
    constexpr std::uintmax_t kMostBytes = 64u << 20;
    const auto text = read_input_bytes(options_.against, kMostBytes);
    if (!text) return text.error();
    before_ = nlohmann::json::parse(*text, nullptr, false);
    if (const auto sound = compare_ranks(before_, before_); !sound)
      return Error{options_.against, sound.error().reason};
    return Done{};
  }

  /// As in the run before, if there is one.
  bool ranks_alike() const {
    if (options_.against.empty()) return true;
    const auto ranks = compare_ranks(json_, before_);
    std::fprintf(options_.json ? stderr : stdout, "against %s\n%s", options_.against.c_str(), text_of(*ranks).c_str());
    if (ranks->empty()) {
      std::fprintf(stderr, "phare: %s: has no ladder of this run: nothing to compare\n", options_.against.c_str());
      return false;
    }
    for (const std::string& line : unlike(json_, before_))
      std::fprintf(options_.json ? stderr : stdout, "  not the same: %s\n", line.c_str());
    return std::ranges::all_of(*ranks, &RanksAlike::alike);
  }

  bool wanted(const std::string& name) const {
    // The truth of one and the eight scenes of the other take too long.
    if (options_.quick && options_.ladders.empty() && (name == "lens" || name == "effects")) return false;
    return options_.ladders.empty() ||
           std::find(options_.ladders.begin(), options_.ladders.end(), name) != options_.ladders.end();
  }

  Status measure(Plan& plan) {
    ProgressLine line;
    plan.progress = [&](const std::string& doing, double share_01) { line.show(doing, share_01); };
    if (wanted("light") || wanted("shadows") || wanted("lens") || wanted("fog") || wanted("exposure")) {
#ifdef PHARE_WITH_GRAPHICS
      if (options_.quick && options_.ladders.empty())
        left_out_.push_back("lens, effects: --ladder lens --ladder effects, or without --quick");
      Result<PictureLadders> pictures = picture_ladders(plan);
      if (!pictures) return pictures.error();
      device_ = pictures->device;
      for (Ladder* ladder : {&pictures->light, &pictures->shadows, &pictures->lens, &pictures->fog, &pictures->exposure})
        if (wanted(ladder->name)) ladders_.push_back(std::move(*ladder));
#else
      left_out_.push_back("light, shadows, fog and exposure: this build draws nothing");
#endif
    }
    if (wanted("effects")) {
#ifdef PHARE_WITH_GRAPHICS
      Result<EffectLadders> effects = effect_ladders(plan);
      if (!effects) return effects.error();
      device_ = effects->device;
      ladders_.insert(ladders_.end(), effects->ladders.begin(), effects->ladders.end());
#else
      left_out_.push_back("effects: this build draws nothing");
#endif
    }
    if (wanted("vehicle")) {
      Result<std::vector<Ladder>> vehicle = vehicle_ladders(plan);
      if (!vehicle) return vehicle.error();
      ladders_.insert(ladders_.end(), vehicle->begin(), vehicle->end());
    }
    if (wanted("poses")) {
      Result<Ladder> poses = pose_ladder(plan);
      if (!poses) return poses.error();
      ladders_.push_back(std::move(*poses));
    }
    if (wanted("settings")) {
#ifdef PHARE_WITH_GRAPHICS
      if (const Status done = settings(plan); !done) return done.error();
#else
      left_out_.push_back("settings: this build draws nothing");
#endif
    }
    return Done{};
  }

#ifdef PHARE_WITH_GRAPHICS
  /// Whole settings of the picture, and kept for phare drive --budget-ms and --tolerance.
  Status settings(const Plan& plan) {
    const Result<Rig> rig = read_rig(options_.rig);
    if (!rig) return rig.error();
    const Result<SettingsTable> table = measure_settings({.rig = &*rig,
                                                          .width_px = plan.width_px,
                                                          .height_px = plan.height_px,
                                                          .air = air_of(rig->desk),
                                                          .quick = plan.quick,
                                                          .progress = plan.progress});
    if (!table) return table.error();
    device_ = table->validity.device;
    if (const auto file = keep_settings(*table); file)
      kept_ = file->stays ? "not kept for phare drive: the table in " + file->file.string() + " was measured longer"
                          : "kept for phare drive --budget-ms and --tolerance in " + file->file.string();
    else
      left_out_.push_back("settings are not kept: " + file.error().text());
    ladders_.push_back(ladder_of(*table));
    return Done{};
  }
#endif

  Status write() {
    json_ = {{"date", utc_now()},
             {"version", std::string(PHARE_VERSION) + ", commit " + build_commit()},
             {"processor", processor() + ", " + std::to_string(std::thread::hardware_concurrency()) + " at once"},
             {"size", options_.size},
             {"quick", options_.quick},
             {"seed", options_.seed},
             {"left_out", left_out_},
             {"ladders", nlohmann::json::array()}};
    if (!device_.empty()) json_["device"] = device_;
    for (const auto& [key, file] :
         {std::pair{"scene", options_.scene}, {"lamp", options_.lamp}, {"vehicle", options_.vehicle}}) {
      const bool scene = std::string_view(key) == "scene";
      const Result<std::string> hash = scene ? content_hash_of_gltf(file) : content_hash_of_file(file);
      if (hash) json_[key] = file + ", " + *hash;
    }
    json_["command"] = options_.command;
    std::vector<std::string> plots;
    const std::filesystem::path out(options_.out);
    for (const Ladder& ladder : ladders_) {
      json_["ladders"].push_back(json_of(ladder));
      const std::string stem = (out / ladder.name).string();
      if (const Status drawn = plot(ladder, stem); !drawn) return drawn.error();
      std::ifstream svg(stem + ".svg", std::ios::binary);
      plots.emplace_back(std::istreambuf_iterator<char>(svg), std::istreambuf_iterator<char>());
    }
    for (const auto& [name, text] : {std::pair<const char*, std::string>{"cost.json", json_.dump(2) + "\n"},
                                     {"cost.csv", csv_of(ladders_)},
                                     {"index.html", page(json_, ladders_, plots)}})
      if (const Status written = write_whole_file(out / name, text); !written) return written.error();
    return Done{};
  }

  void print() const {
    if (options_.json) {
      std::printf("%s\n", json_.dump(2).c_str());
      return;
    }
    for (const Ladder& ladder : ladders_) std::printf("%s\n", text_of(ladder).c_str());
    if (!kept_.empty()) std::printf("%s\n", kept_.c_str());
    for (const std::string& line : left_out_) std::printf("left out: %s\n", line.c_str());
    std::printf("* worth it: no other level is at once as exact and cheaper\n%s/index.html\n", options_.out.c_str());
  }

  const CostOptions& options_;
  std::vector<Ladder> ladders_;
  std::vector<std::string> left_out_;
  std::string device_, kept_;
  nlohmann::json json_, before_;
};

}  // namespace

void add_cost(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<CostOptions>();
  options->scene = (generated_dir() / "scenes/country_road.glb").string();
  options->lamp = (generated_dir() / "lamps/low_rht.ies").string();
  options->vehicle = config_path("vehicles/bmw_320i.toml");
  options->rig = config_path("rigs/country_road.toml");
  CLI::App* command = app.add_subcommand("cost",
                                         "What accuracy costs on this machine: error and time of every level of light, "
                                         "shadows, effects, car and messages");
  command->footer(
      "Example:\n  phare cost --quick --ladder poses --out cost\n"
      "Writes index.html (one page, to be mailed), cost.json, cost.csv and a plot of each ladder.");
  command->add_flag("--quick", options->quick, "Fewer levels, samples and rounds: under a minute");
  command->add_option("--ladder", options->ladders, "Only this one, more than once for several [all]")
      ->check(CLI::IsMember(kLadderNames));
  command->add_option("--out", options->out, "Folder to write")->capture_default_str();
  command->add_option("--against", options->against,
                      "cost.json of another run: whether both rank the levels alike; exit code 1 if not");
  command->add_flag("--json", options->json, "Print all figures as JSON");
  command->add_option("--scene", options->scene,
                      "Scene (.glb, .gltf) with a straight road along x from the origin [the shipped country road]");
  command->add_option("--lamp", options->lamp, "Photometry of both low beams [a shipped one]");
  command->add_option("--vehicle", options->vehicle, "Vehicle file [config/vehicles/bmw_320i.toml]");
  command->add_option("--rig", options->rig,
                      "Whose settings are measured, and kept for phare drive [config/rigs/country_road.toml]");
  command->add_option("--size", options->size, "Pictures, WIDTHxHEIGHT in pixels")->capture_default_str();
  command->add_option("--seed", options->seed, "Of the pixels that errors are taken at")->capture_default_str();
  command->callback([options, command, &chosen] {
    options->command = command_line(*command);
    chosen = [options] { return CostRun(*options).run(); };
  });
}

}  // namespace phare
