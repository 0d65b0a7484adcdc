// phare lamp levels: what each level of beam image is off by, and what recomposing 36 sources takes.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tools/commands.h"
#include "tools/lamp/lamp_commands.h"
#include "tools/lamp/print_json.h"
#include "visual/photometry/beam/beam_composer.h"
#include "visual/photometry/beam/image_levels.h"
#include "visual/photometry/bench/sample_lamps.h"
#ifdef PHARE_WITH_GRAPHICS
#include "visual/renderer.h"
#endif

namespace phare {
namespace {

template <typename Work>
double median_ms(int rounds, const Work& work) {
  std::vector<double> ms;
  for (int i = 0; i < rounds; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    work(i);
    ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
  std::sort(ms.begin(), ms.end());
  return ms[ms.size() / 2];
}

#ifdef PHARE_WITH_GRAPHICS
/// The same on the device: what a frame takes longer in which all or one of the segments were dimmed, from the sums on
/// the CPU to the texture.
void bench_device(BeamComposer& matrix, const std::vector<double>& h, const std::vector<double>& v,
                  nlohmann::json& json) {
  auto renderer = Renderer::create({.width_px = 16, .height_px = 16});
  if (!renderer) {
    json["device"] = renderer.error().text();
    return;
  }
  json["device"] = renderer->device();
  BeamImage image;
  image.first_deg = h;
  image.second_deg = v;
  image.dark = false;
  FrameInput input;
  input.lamps = {PlacedLamp{}};
  const auto frame = [&](std::size_t first, std::size_t end, double scale, bool whole) {
    for (std::size_t k = first; k < end; ++k) matrix.set_dimming(k, scale);
    const std::vector<TexelRect> changed = matrix.update();
    image.candela.resize(matrix.candela().size());
    for (const TexelRect& rect : changed)
      for (std::size_t j = rect.row; j < rect.end_row; ++j)
        std::copy_n(matrix.candela().begin() + static_cast<std::ptrdiff_t>(j * h.size() + rect.column),
                    rect.end_column - rect.column,
                    image.candela.begin() + static_cast<std::ptrdiff_t>(j * h.size() + rect.column));
    if (whole)
      renderer->set_beam(0, image);
    else if (!changed.empty())
      renderer->change_beam(0, image, changed);
    renderer->draw(input);
  };
  frame(0, 36, 0.9, true);
  const double still = median_ms(31, [&](int) { frame(0, 0, 0.0, false); });
  json["device_frame_all_changed_ms"] =
      median_ms(15, [&](int round) { frame(0, 36, 0.5 + 0.01 * round, false); }) - still;
  json["device_frame_one_changed_ms"] =
      median_ms(31, [&](int round) { frame(17, 18, 0.1 + 0.01 * round, false); }) - still;
  json["device_new_image_ms"] = median_ms(7, [&](int round) { frame(0, 36, 0.5 + 0.01 * round, true); }) - still;
  json["device_frame_none_changed_ms"] = still;
}
#endif

/// 36 matrix segments on 1801 × 601 texels: all, one, none changed; and 36 sources that all fill the image.
nlohmann::json bench() {
  std::vector<double> h, v;
  for (int i = 0; i < 1801; ++i) h.push_back(-18.0 + 0.02 * i);
  for (int j = 0; j < 601; ++j) v.push_back(-6.0 + 0.02 * j);
  const std::vector<SampleLamp> segments = matrix_segments();
  BeamComposer matrix(h, v);
  const double sampled = median_ms(1, [&](int) {
    for (const SampleLamp& segment : segments) matrix.add(segment.table);
  });
  const double all = median_ms(15, [&](int round) {
    for (std::size_t k = 0; k < segments.size(); ++k) matrix.set_dimming(k, 0.5 + 0.01 * round);
    matrix.update();
  });
  const double one = median_ms(31, [&](int round) {
    matrix.set_dimming(17, 0.1 + 0.01 * round);
    matrix.update();
  });
  const std::size_t before = matrix.count().texels;
  const double none = median_ms(31, [&](int) { matrix.update(); });
  const std::size_t texels_when_idle = matrix.count().texels - before;
  IntensityTable wide;
  wide.first_deg = {-20, 0, 20};
  wide.second_deg = {-8, 8};
  wide.candela = {1, 2, 3, 4, 5, 6};
  BeamComposer full(h, v);
  for (int k = 0; k < 36; ++k) full.add(wide);
  const double worst = median_ms(9, [&](int round) {
    for (std::size_t k = 0; k < 36; ++k) full.set_dimming(k, 0.5 + 0.01 * round);
    full.update();
  });
  nlohmann::json json{{"image", "1801 x 601"},
                      {"sources", 36},
                      {"sampling_36_sources_ms", sampled},
                      {"all_changed_ms", all},
                      {"one_changed_ms", one},
                      {"none_changed_ms", none},
                      {"texels_when_none_changed", texels_when_idle},
                      {"all_changed_36_full_size_sources_ms", worst}};
#ifdef PHARE_WITH_GRAPHICS
  bench_device(matrix, h, v, json);
#endif
  return json;
}

}  // namespace

int lamp_levels(const LampLevelsOptions& options) {
  if (options.file.empty() && !options.bench) return bad_input({"", "give a photometry file, or --bench"});
  nlohmann::json json;
  if (!options.file.empty()) {
    const auto table = read_lamp(options.file, options.settings);
    if (!table) return bad_input(table.error());
    json["file"] = options.file;
    json["peak_cd"] = table->peak_cd();
    if (!options.json) {
      std::printf("%s: %zu × %zu nodes, peak %.0f cd; error at every node and at the quarters of every cell\n",
                  base_name(options.file).c_str(), table->first_deg.size(), table->second_deg.size(), table->peak_cd());
      std::printf("  %-28s %12s %14s %20s %12s %20s\n", "level", "bytes", "worst cd", "at", "worst %",
                  "at (above 1 cd)");
    }
    for (const ImageLevel level : kImageLevels) {
      const LevelError error = level_error(*table, LevelImage(*table, level));
      json["levels"].push_back(
          {{"level", level_name(level)},
           {"bytes", error.bytes},
           {"worst_cd", error.worst_cd},
           {"worst_at_deg", {error.worst_at.first_deg, error.worst_at.second_deg}},
           {"worst_percent", error.worst_percent},
           {"worst_percent_at_deg", {error.worst_percent_at.first_deg, error.worst_percent_at.second_deg}},
           {"looked_at", error.looked_at}});
      if (!options.json)
        std::printf("  %-28s %12zu %14.4g %9.2f, %9.2f %12.3g %9.2f, %9.2f\n", level_name(level).c_str(), error.bytes,
                    error.worst_cd, error.worst_at.first_deg, error.worst_at.second_deg, error.worst_percent,
                    error.worst_percent_at.first_deg, error.worst_percent_at.second_deg);
    }
  }
  if (options.bench) {
    json["recomposition"] = bench();
    if (!options.json) {
      const auto& b = json["recomposition"];
      std::printf(
          "recomposing 1801 × 601 from 36 matrix segments: all changed %.2f ms, one changed %.3f ms, none changed %.4f "
          "ms (%zu texels);\n"
          "36 sources that fill the image, all changed %.1f ms; sampling the 36 sources once %.0f ms\n",
          b["all_changed_ms"].get<double>(), b["one_changed_ms"].get<double>(), b["none_changed_ms"].get<double>(),
          b["texels_when_none_changed"].get<std::size_t>(), b["all_changed_36_full_size_sources_ms"].get<double>(),
          b["sampling_36_sources_ms"].get<double>());
      if (b.contains("device_new_image_ms"))
        std::printf(
            "a frame on %s takes longer by: all changed %.2f ms, one changed %.2f ms, another image %.2f ms (none "
            "changed: %.2f ms in all)\n",
            b["device"].get<std::string>().c_str(), b["device_frame_all_changed_ms"].get<double>(),
            b["device_frame_one_changed_ms"].get<double>(), b["device_new_image_ms"].get<double>(),
            b["device_frame_none_changed_ms"].get<double>());
    }
  }
  if (options.json) print_json(json);
  return kExitDone;
}

}  // namespace phare
