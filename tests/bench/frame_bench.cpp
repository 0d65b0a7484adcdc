// How long a frame takes, and how many bare two-lamp quads that is: the ratio stays when the machine is slower or busy.
//   phare_frame_bench SCENE.glb LAMP [WIDTHxHEIGHT] [ROUNDS]
// The quad: one full-screen surface, the same two lamps, the same shader. Rounds alternate, so both see the same
// machine.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "visual/photometry/beam_image.h"
#include "visual/photometry/read_lamp.h"
#include "visual/renderer.h"
#include "visual/scene/scene.h"

namespace phare {
namespace {

Scene one_quad() {
  Scene scene;
  scene.materials = {{.name = "quad", .reflectance = glm::vec3(0.1f)}};
  for (const glm::vec3 corner :
       {glm::vec3(20, 40, -30), glm::vec3(20, -40, -30), glm::vec3(20, -40, 30), glm::vec3(20, 40, 30)})
    scene.vertices.push_back({corner, {-1, 0, 0}});
  scene.indices = {0, 1, 2, 0, 2, 3};
  scene.chunks = {{.node = "quad",
                   .origin_m = {},
                   .low_m = {20, -40, -30},
                   .high_m = {20, 40, 30},
                   .index_count = 6,
                   .vertex_count = 4}};
  return scene;
}

// Processor time of all threads: a busy machine lengthens it far less than the wall clock.
double cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

int run(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: phare_frame_bench SCENE.glb LAMP [WIDTHxHEIGHT] [ROUNDS]\n");
    return kExitBadInput;
  }
  int width = 1280, height = 720;
  if (argc > 3 && std::sscanf(argv[3], "%dx%d", &width, &height) != 2) return kExitBadInput;
  const int rounds = argc > 4 ? std::max(1, std::atoi(argv[4])) : 40;
  const Result<Scene> scene = read_scene(argv[1]);
  const Result<IntensityTable> table = read_lamp(argv[2]);
  if (!scene || !table) {
    std::fprintf(stderr, "%s\n", (scene ? table.error() : scene.error()).text().c_str());
    return kExitBadInput;
  }
  const AimedSource source{.table = &*table};
  const BeamImage image = compose_beam_image(std::span(&source, 1));
  const RendererOptions options{.width_px = width, .height_px = height};
  Result<Renderer> road = Renderer::create(options), quad = Renderer::create(options);
  if (!road || !quad) {
    std::fprintf(stderr, "%s\n", (road ? quad.error() : road.error()).text().c_str());
    return kExitCheckFailed;
  }
  if (!road->load_scene(*scene) || !quad->load_scene(one_quad())) return kExitCheckFailed;
  road->set_beam(0, image);
  quad->set_beam(0, image);

  // The scene's road starts at the origin along x; its first straight is the fullest view.
  auto view = [&](int lamps) {
    FrameInput input;
    input.camera.eye_m = {25.0, -1.2, 1.22};
    const glm::dmat3 aim = aim_rotation(0.0, -0.01, 0.0);
    for (int i = 0; i < lamps; ++i)
      input.lamps.push_back({.position_m = {26.9, -1.6 + (i % 2 == 0 ? 0.6 : -0.6), 0.65}, .world_from_image = aim});
    return input;
  };
  FrameInput quad_view = view(2);
  quad_view.camera.eye_m = {0.0, 0.0, 0.0};
  for (PlacedLamp& lamp : quad_view.lamps) lamp.position_m -= glm::dvec3(25.0, -1.6, 0.0);
  FrameInput quad_dark = quad_view;
  quad_dark.lamps.clear();
  struct Case {
    const char* name;
    Renderer& renderer;
    FrameInput input;
    std::vector<double> wall{}, cpu{};
  };
  FrameInput sky = view(0);
  sky.camera.world_from_eye =
      glm::dmat3(glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0));  // straight up
  std::vector<Case> cases{{"road, two lamps", *road, view(2)},
                          {"road, no lamp", *road, view(0)},
                          {"bare two-lamp quad", *quad, quad_view},
                          {"bare quad, no lamp", *quad, quad_dark},
                          {"sky alone", *road, sky}};
  FrameResult result;
  for (int i = -2; i < rounds; ++i) {
    for (Case& one : cases) {
      const double before = cpu_ms();
      const FrameResult drawn = one.renderer.draw(one.input);
      if (i < 0) continue;  // pipelines were compiled
      one.cpu.push_back(cpu_ms() - before);
      one.wall.push_back(drawn.wall_ms);
      if (&one == &cases.front()) result = drawn;
    }
  }
  std::printf("%s, %dx%d, %d rounds, median ms; %u draws, %llu triangles\n", road->device().c_str(), width, height,
              rounds, result.draws, static_cast<unsigned long long>(result.triangles));
  for (const Case& one : cases)
    std::printf("  %-20s %8.2f wall %8.2f cpu, %8.2f cpu at best\n", one.name, median(one.wall), median(one.cpu),
                *std::min_element(one.cpu.begin(), one.cpu.end()));
  std::printf("  ratio road / quad    %8.2f wall %8.2f cpu\n", median(cases[0].wall) / median(cases[2].wall),
              median(cases[0].cpu) / median(cases[2].cpu));

  // The levels of beam image, turn by turn in one run.
  std::vector<Result<Renderer>> at_level;
  for (const ImageLevel level : kImageLevels) {
    at_level.push_back(Renderer::create({.width_px = width, .height_px = height, .beam_level = level}));
    if (!at_level.back() || !at_level.back()->load_scene(one_quad())) return kExitCheckFailed;
    at_level.back()->set_beam(0, image);
  }
  std::vector<std::vector<double>> wall(at_level.size()), cpu(at_level.size());
  for (int i = -2; i < rounds; ++i) {
    for (std::size_t level = 0; level < at_level.size(); ++level) {
      const double before = cpu_ms();
      const double ms = at_level[level]->draw(quad_view).wall_ms;
      if (i < 0) continue;
      wall[level].push_back(ms);
      cpu[level].push_back(cpu_ms() - before);
    }
  }
  std::printf("bare two-lamp quad by level of beam image\n");
  for (std::size_t level = 0; level < at_level.size(); ++level)
    std::printf("  %-28s %8.2f wall %8.2f cpu, %5.2f of the native one's cpu\n",
                level_name(kImageLevels[level]).c_str(), median(wall[level]), median(cpu[level]),
                median(cpu[level]) / median(cpu.back()));
  return kExitDone;
}

}  // namespace
}  // namespace phare

int main(int argc, char** argv) {
  return phare::run(argc, argv);
}
