// Prints what a frame of a bare road takes that calls for no effect: the same of two programs, of which one has another
// frame.cpp in place of the renderer's, built without effects. `fog`: with air that calls for some, `N`: frames to
// time, ms of the processor. See plain_frame_test.sh.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "tests/bench/straight_road.h"

namespace {

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// What stands on it left out, so that nothing casts a shadow.
phare::Scene bare_road() {
  phare::Scene scene = phare::bench::straight_road();
  std::erase_if(scene.chunks,
                [](const phare::SceneChunk& chunk) { return chunk.node != "road" && chunk.node != "ground"; });
  return scene;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string wanted = argc > 1 ? argv[1] : "";
  const int rounds = wanted == "fog" ? 0 : std::atoi(wanted.c_str());
  auto made = phare::Renderer::create({.width_px = 1280, .height_px = 720, .validation = rounds == 0});
  if (!made) {
    std::fprintf(stderr, "%s\n", made.error().text().c_str());
    return 1;
  }
  phare::Renderer& renderer = *made;
  if (!renderer.load_scene(bare_road()).ok()) return 1;
  const auto table = phare::bench::straight_road_beam(phare::bench::Nodes::kEven);
  const phare::AimedSource source{.table = &table};
  renderer.set_beam(0, phare::compose_beam_image(std::span(&source, 1)));
  phare::FrameInput input = phare::bench::straight_road_view(0.0);
  if (wanted == "fog") input.air.visibility_m = 80.0;
  renderer.draw(input);
  input.want_image = rounds == 0;
  const phare::FrameResult frame = renderer.draw(input);
  if (rounds == 0) {
    std::uint64_t sum = 14695981039346656037u;  // FNV-1a
    for (const std::uint8_t byte : renderer.read_image().rgba) sum = (sum ^ byte) * 1099511628211u;
    std::printf(
        "passes %u\ndraws %u\nbinds %u\ntriangles %llu\nimages %u\nimage bytes %llu\nshared %llu\nmemory %llu\n"
        "picture %016llx\nvalidation %llu\n",
        frame.pass_count, frame.draws, frame.binds, static_cast<unsigned long long>(frame.triangles), frame.images,
        static_cast<unsigned long long>(frame.image_bytes), static_cast<unsigned long long>(frame.shared_image_bytes),
        static_cast<unsigned long long>(renderer.device_memory_bytes()), static_cast<unsigned long long>(sum),
        static_cast<unsigned long long>(renderer.validation_messages()));
    return 0;
  }
  std::vector<double> times;
  for (int i = 0; i < rounds; ++i) {
    const double before = processor_ms();
    renderer.draw(phare::bench::straight_road_view(0.1 * (i % 64)));
    times.push_back(processor_ms() - before);
  }
  std::nth_element(times.begin(), times.begin() + rounds / 2, times.end());
  std::printf("%.3f\n", times[static_cast<std::size_t>(rounds / 2)]);
}
