// The cases of the frame bench: timed turn by turn beside the floor, told as a table, curves and CSV.
#pragma once

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <regex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "config/base/paths.h"
#include "tests/bench/floor.h"
#include "tests/bench/growth.h"
#include "visual/photometry/beam/beam_composer.h"
#include "visual/renderer.h"
#include "visual/scene/scene.h"

namespace phare::bench {

struct Options {
  std::string scene = (generated_dir() / "scenes/country_road.glb").string();
  std::string lamp = (generated_dir() / "lamps/low_rht.ies").string();
  int width_px = 1280, height_px = 720, rounds = 40;
  std::string csv;
  std::string only;  ///< pattern of "group: case"; empty: all
  bool growth = true, depth_first = false;
};

inline double clock_ms(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

inline double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// One thing that is timed: a frame of a renderer, or of the floor.
struct Case {
  std::string group, name;
  std::function<FrameResult(int round)> draw;
  std::vector<double> cpu_ms{}, wall_ms{}, cpu_floors{}, wall_floors{};
  std::map<std::string, std::vector<double>> pass_ms{};
  FrameResult newest{};
  std::string unit{};  ///< of what grows in the group; empty: nothing does
  double amount = 0.0;
};

/// Renderers live as long as the cases that draw with them.
class Bench {
 public:
  explicit Bench(const Options& options) : options_(options), only_(options.only) {}

  Renderer& renderer(const Scene& scene, const IntensityTable& table, int width_px, int height_px) {
    Result<Renderer> made = Renderer::create({.width_px = width_px, .height_px = height_px});
    if (!made) throw std::runtime_error(made.error().text());
    renderers_.push_back(std::make_unique<Renderer>(std::move(*made)));
    Renderer& renderer = *renderers_.back();
    if (const Status loaded = renderer.load_scene(scene); !loaded) throw std::runtime_error(loaded.error().text());
    const AimedSource source{.table = &table};
    renderer.set_beam(0, compose_beam_image(std::span(&source, 1)));
    return renderer;
  }
  Renderer& renderer(const Scene& scene, const IntensityTable& table) {
    return renderer(scene, table, options_.width_px, options_.height_px);
  }

  void add(const std::string& group, const std::string& name, Renderer& renderer,
           const std::function<FrameInput(int)>& view) {
    if (!std::regex_search(group + ": " + name, only_)) return;
    cases_.push_back({group, name, [&renderer, view](int round) { return renderer.draw(view(round)); }});
  }

  /// A point of a group's curve.
  void grow(const std::string& group, const std::string& unit, double amount, Renderer& renderer,
            const std::function<FrameInput(int)>& view) {
    char name[48];
    std::snprintf(name, sizeof name, "%.0f %s", amount, unit.c_str());
    const std::size_t before = cases_.size();
    add(group, name, renderer, view);
    if (cases_.size() == before) return;
    cases_.back().unit = unit;
    cases_.back().amount = amount;
  }

  /// Turn by turn: each round times the floor and then every case.
  void run(Floor& floor) {
    std::vector<double> floor_cpu, floor_wall;
    for (int round = -2; round < options_.rounds; ++round) {
      const auto timed = [&](auto&& work) {
        const double cpu = clock_ms(CLOCK_PROCESS_CPUTIME_ID), wall = clock_ms(CLOCK_MONOTONIC);
        work();
        return std::pair(clock_ms(CLOCK_PROCESS_CPUTIME_ID) - cpu, clock_ms(CLOCK_MONOTONIC) - wall);
      };
      // Three frames, so that the first's cold caches are not the unit.
      const auto unit = timed([&] {
        for (int i = 0; i < 3; ++i) floor.draw(0.1f * static_cast<float>((round + 2) % 64));
      });
      if (round >= 0) floor_cpu.push_back(unit.first / 3.0), floor_wall.push_back(unit.second / 3.0);
      for (Case& one : cases_) {
        FrameResult result;
        // In a drive frames of the same go before, not those of another case: what that one held, and this does not
        // need, is given up by the second.
        for (int i = 0; i < 2; ++i) one.draw(std::max(round, 0));
        const auto [cpu, wall] = timed([&] { result = one.draw(std::max(round, 0)); });
        if (round < 0) continue;  // pipelines were made
        one.cpu_ms.push_back(cpu);
        one.wall_ms.push_back(wall);
        one.cpu_floors.push_back(cpu / floor_cpu.back());
        one.wall_floors.push_back(wall / floor_wall.back());
        for (const PassTime& pass : result.passes) one.pass_ms[pass.name].push_back(pass.ms);
        one.newest = result;
      }
    }
    std::printf("one floor: %.2f ms of processor, %.2f ms on the wall, medians of %d rounds at %dx%d\n",
                median(floor_cpu), median(floor_wall), options_.rounds, options_.width_px, options_.height_px);
  }

  void print() const {
    std::string group;
    for (const Case& one : cases_) {
      if (one.group != group) {
        group = one.group;
        std::printf("\n%-34s %9s %9s %9s %9s %7s %10s\n", group.c_str(), "cpu ms", "wall ms", "cpu/floor", "wall/fl.",
                    "draws", "triangles");
      }
      std::printf("  %-32s %9.2f %9.2f %9.2f %9.2f %7u %10llu\n", one.name.c_str(), median(one.cpu_ms),
                  median(one.wall_ms), median(one.cpu_floors), median(one.wall_floors), one.newest.draws,
                  static_cast<unsigned long long>(one.newest.triangles));
    }
    std::printf("\npasses by the device's time stamps, ms\n");
    for (const Case& one : cases_)
      for (const auto& [pass, ms] : one.pass_ms)
        std::printf("  %-52s %-14s %8.2f\n", (one.group + ": " + one.name).c_str(), pass.c_str(), median(ms));
  }

  void print_curves() const {
    std::vector<std::string> order;
    std::map<std::string, std::vector<GrowthPoint>> curves;
    std::map<std::string, std::string> units;
    for (const Case& one : cases_) {
      if (one.unit.empty()) continue;
      if (!curves.contains(one.group)) order.push_back(one.group);
      curves[one.group].push_back({one.amount, median(one.cpu_ms), median(one.cpu_floors)});
      units[one.group] = one.unit;
    }
    for (const std::string& group : order)
      std::fputs(growth_curve(group + ", processor time", units[group], curves[group]).c_str(), stdout);
  }

  double cpu_floors(const std::string& group, const std::string& name) const {
    for (const Case& one : cases_)
      if (one.group == group && one.name == name) return median(one.cpu_floors);
    return 0.0;
  }

  void write_csv(const std::string& file) const {
    std::ofstream out(file);
    out << "group,case,cpu_ms,wall_ms,cpu_floors,wall_floors,draws,triangles\n";
    for (const Case& one : cases_)
      out << '"' << one.group << "\",\"" << one.name << "\"," << median(one.cpu_ms) << ',' << median(one.wall_ms) << ','
          << median(one.cpu_floors) << ',' << median(one.wall_floors) << ',' << one.newest.draws << ','
          << one.newest.triangles << '\n';
  }

 private:
  const Options& options_;
  std::regex only_;
  std::vector<std::unique_ptr<Renderer>> renderers_;
  std::vector<Case> cases_;
};

}  // namespace phare::bench
