// Pictures that are hard to draw: degenerate triangles, depth over five decades, sizes, exposures.
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "tools/hard_cases/lamps.h"
#include "visual/photometry/beam/beam_composer.h"
#include "visual/renderer.h"
#include "visual/scene/scene.h"

namespace phare::hard {
namespace {

/// One material, triangles given by their corners about `origin_m`.
void add(Scene& scene, const std::vector<glm::vec3>& corners, const glm::vec3& normal, std::uint32_t material = 0) {
  SceneChunk chunk;
  chunk.material = material;
  chunk.first_vertex = static_cast<std::uint32_t>(scene.vertices.size());
  chunk.first_index = static_cast<std::uint32_t>(scene.indices.size());
  chunk.low_m = chunk.high_m = corners[0];
  for (const glm::vec3& corner : corners) {
    scene.indices.push_back(static_cast<std::uint32_t>(scene.vertices.size()) - chunk.first_vertex);
    scene.vertices.push_back({corner, normal});
    chunk.low_m = glm::min(chunk.low_m, glm::dvec3(corner));
    chunk.high_m = glm::max(chunk.high_m, glm::dvec3(corner));
  }
  chunk.vertex_count = chunk.index_count = static_cast<std::uint32_t>(corners.size());
  scene.chunks.push_back(chunk);
}

/// Faces -x, fills the view at any distance.
std::vector<glm::vec3> wall(float x_m) {
  const float half = 2.0f * x_m;
  return {{x_m, half, -half}, {x_m, -half, -half}, {x_m, -half, half},
          {x_m, half, -half}, {x_m, -half, half},  {x_m, half, half}};
}

FrameInput lit_view(Renderer& renderer) {
  static const IntensityTable table = even_lamp(30'000.0);
  const AimedSource source{.table = &table};
  renderer.set_beam(0, compose_beam_image(std::span(&source, 1)));
  FrameInput input;
  input.camera.eye_m = {0.0, 0.0, 1.2};
  input.lamps.push_back({.position_m = {0.0, 0.5, 0.65}});
  return input;
}

/// Values that are not finite; of a picture without light, all: then the case has not been tried.
std::size_t not_finite(const ImageF& image) {
  std::size_t count = 0, lit = 0;
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    count += std::isfinite(image.rgba[i]) ? 0u : 1u;
    lit += i % 4 == 3 && image.rgba[i] > 0.0f ? 1u : 0u;
  }
  return lit > 0 ? count : image.rgba.size();
}

Outcome odd_triangles(const Bench& bench) {
  Renderer& renderer = *bench.renderer;
  Outcome outcome;
  for (int kind = 0; kind < 6; ++kind) {
    Scene scene;
    scene.materials = {{.name = "grey"}};
    add(scene, {{2, -50, 0}, {200, -50, 0}, {200, 50, 0}, {2, -50, 0}, {200, 50, 0}, {2, 50, 0}}, {0, 0, 1});
    if (kind == 0) add(scene, {{5, 0, 1}, {5, 0, 1}, {5, 0, 1}}, {-1, 0, 0});         // a point
    if (kind == 1) add(scene, {{5, 0, 1}, {5, 1, 1}, {5, 2, 1}}, {-1, 0, 0});         // a line
    if (kind == 2) add(scene, {{1000, 0, 1}, {5, 0, 1}, {5, 0.001f, 1}}, {0, 0, 1});  // a needle, 1 km × 1 mm
    if (kind == 3) add(scene, {{5, 1, 1}, {5, 2, 1}, {5, 1, 2}}, {0, 0, 0});          // no normal
    if (kind == 4) add(scene, {{5, 1, 1}, {5, 1, 2}, {5, 2, 1}}, {1, 0, 0});          // inside out
    if (kind == 5)                                                                    // twice the same
      for (const float facing : {-1.0f, 1.0f}) add(scene, {{5, 1, 1}, {5, 2, 1}, {5, 1, 2}}, {facing, 0, 0});
    if (const Status loaded = renderer.load_scene(scene); !loaded) return {.error = loaded.error().text()};
    FrameInput input = lit_view(renderer);
    input.want_hdr = true;
    renderer.draw(input);
    outcome.device.push_back({static_cast<double>(kind), static_cast<double>(not_finite(renderer.read_hdr()))});
  }
  return outcome;
}

Outcome eye_in_the_lamp(const Bench& bench) {
  Renderer& renderer = *bench.renderer;
  Scene scene;
  scene.materials = {{.name = "grey"}};
  add(scene, {{-50, -50, 0}, {200, -50, 0}, {200, 50, 0}, {-50, -50, 0}, {200, 50, 0}, {-50, 50, 0}}, {0, 0, 1});
  if (const Status loaded = renderer.load_scene(scene); !loaded) return {.error = loaded.error().text()};
  Outcome outcome;
  for (const double apart_m : {0.0, 1e-9, 1e-6, 1e-3}) {
    FrameInput input = lit_view(renderer);
    input.camera.eye_m = input.lamps[0].position_m + glm::dvec3(0.0, 0.0, apart_m);
    input.want_hdr = true;
    renderer.draw(input);
    outcome.device.push_back({apart_m, static_cast<double>(not_finite(renderer.read_hdr()))});
  }
  return outcome;
}

/// A wall a ten-thousandth of its distance before another one that is ten times as bright: pixels that show the
/// farther.
Outcome depth(const Bench& bench) {
  Renderer& renderer = *bench.renderer;
  Outcome outcome;
  for (const float at_m : {0.1f, 1.0f, 10.0f, 100.0f, 1000.0f, 10'000.0f}) {
    Scene near, both;
    near.materials = both.materials = {{.name = "dark", .reflectance = glm::vec3(0.05f)},
                                       {.name = "bright", .reflectance = glm::vec3(0.5f)}};
    add(near, wall(at_m), {-1, 0, 0}, 0);
    add(both, wall(at_m * 1.0001f), {-1, 0, 0}, 1);
    add(both, wall(at_m), {-1, 0, 0}, 0);
    ImageF pictures[2];
    for (int k = 0; k < 2; ++k) {
      if (const Status loaded = renderer.load_scene(k == 0 ? near : both); !loaded)
        return {.error = loaded.error().text()};
      FrameInput input = lit_view(renderer);
      input.effects[static_cast<std::size_t>(Effect::kShadows)] = 0;
      input.camera.near_m = 0.09, input.camera.far_m = 20'000.0;
      input.camera.eye_m = glm::dvec3(0.0);
      input.lamps[0].position_m = {-1.0, 0.0, 0.0};
      input.want_hdr = true;
      renderer.draw(input);
      pictures[k] = renderer.read_hdr();
    }
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < pictures[0].rgba.size(); i += 4)
      wrong += pictures[0].rgba[i + 3] == 0.0f ||
                       std::abs(pictures[1].rgba[i + 1] - pictures[0].rgba[i + 1]) > 0.5f * pictures[0].rgba[i + 1]
                   ? 1u
                   : 0u;
    outcome.device.push_back({static_cast<double>(at_m), static_cast<double>(wrong)});
  }
  return outcome;
}

Outcome exposure(const Bench& bench) {
  Renderer& renderer = *bench.renderer;
  Scene scene;
  scene.materials = {{.name = "grey"}};
  add(scene, wall(10.0f), {-1, 0, 0});
  if (const Status loaded = renderer.load_scene(scene); !loaded) return {.error = loaded.error().text()};
  Outcome outcome;
  double before = -1.0;
  for (double per_cdm2 = 1e-6; per_cdm2 < 2e6; per_cdm2 *= 10.0) {
    FrameInput input = lit_view(renderer);
    input.exposure_per_cdm2 = per_cdm2;
    input.want_image = true;
    renderer.draw(input);
    const Image8 image = renderer.read_image();
    const double middle = image.rgba[4 * (image.rgba.size() / 8) + 1];
    outcome.device.push_back({per_cdm2, middle < before ? 1.0 : 0.0});
    if (before < 0.0 && middle > 0.0) outcome.error = "the darkest picture is not black";
    before = middle;
  }
  if (before < 255.0) outcome.error = "the brightest picture is not white";
  return outcome;
}

Outcome sizes(const Bench& bench) {
  Renderer& renderer = *bench.renderer;
  Outcome outcome;
  for (const int side : {1, 2, 3, 17}) {
    renderer.resize(side, side);
    FrameInput input = lit_view(renderer);
    input.want_image = true;
    renderer.draw(input);
    outcome.device.push_back({static_cast<double>(side), renderer.read_image().width_px == side ? 0.0 : 1.0});
  }
  renderer.resize(64, 64);
  for (const int side : {0, -1, 16385, 1 << 30})
    outcome.device.push_back(
        {static_cast<double>(side), Renderer::create({.width_px = side, .height_px = 64}).ok() ? 1.0 : 0.0});
  outcome.device.push_back({16384.0, Renderer::create({.width_px = 16384, .height_px = 16384}).ok() ? 1.0 : 0.0});
  return outcome;
}

/// Pixels that are wrong before a wall at 10 m: not finite, in fog of 1 m showing what the wall is made of, in haze of
/// 100 km other than in clear air.
Outcome fog(const Bench& bench) {
  Renderer& renderer = *bench.renderer;
  Outcome outcome;
  const auto seen = [&](float reflectance, double visibility_m) {
    Scene scene;
    scene.materials = {{.name = "wall", .reflectance = glm::vec3(reflectance)}};
    add(scene, wall(10.0f), {-1, 0, 0});
    if (!renderer.load_scene(scene)) return ImageF{};
    FrameInput input = lit_view(renderer);
    input.sky_luminance_cdm2 = 0.0;
    if (visibility_m > 0.0) input.air.visibility_m = visibility_m;
    input.want_hdr = true;
    renderer.draw(input);
    return renderer.read_hdr();
  };
  const ImageF clear = seen(0.5f, 0.0);
  for (const double visibility_m : {1.0, 3.0, 10.0, 1e3, 1e5}) {
    const ImageF grey = seen(0.5f, visibility_m), dark = seen(0.05f, visibility_m);
    std::size_t wrong = 0;
    for (const ImageF* image : {&grey, &dark})
      for (const float value : image->rgba) wrong += std::isfinite(value) ? 0u : 1u;
    // 10 m there and back: of light e^-39 · e^-39 is left at 1 m. At 100 km 0.08 % is lost; a step of a 16-bit float is
    // 0.1 %, and so much the picture may be off.
    constexpr float kUnseen = 1e-3f, kHaze = 0.002f;
    for (std::size_t i = 0; i < grey.rgba.size(); i += 4) {
      wrong += grey.rgba[i] > 0.0f ? 0u : 1u;  // the fog itself is lit
      if (visibility_m == 1.0) wrong += std::abs(grey.rgba[i] - dark.rgba[i]) > kUnseen * grey.rgba[i] ? 1u : 0u;
      if (visibility_m == 1e5) wrong += std::abs(grey.rgba[i] - clear.rgba[i]) > kHaze * clear.rgba[i] ? 1u : 0u;
    }
    outcome.device.push_back({visibility_m, static_cast<double>(wrong)});
  }
  return outcome;
}

/// Pixels that a lamp as small as a point makes darker, which only a veil that is no number does.
Outcome point_glare(const Bench& bench) {
  Renderer& renderer = *bench.renderer;
  Scene scene;
  scene.materials = {{.name = "grey"}};
  add(scene, wall(50.0f), {-1, 0, 0});
  if (const Status loaded = renderer.load_scene(scene); !loaded) return {.error = loaded.error().text()};
  Outcome outcome;
  const auto seen = [&](const std::vector<GlaringLamp>& glare) {
    FrameInput input = lit_view(renderer);
    input.glare = glare;
    input.want_image = true;
    renderer.draw(input);
    return renderer.read_image();
  };
  const Image8 without = seen({});
  // In the middle of a pixel and between four, at the picture's edge, beside the eye and on it.
  const glm::dvec3 eye_m{0.0, 0.0, 1.2};
  const glm::dvec3 ways[] = {
      {5000.0, 0.0, 0.0}, {5000.0, 1e-9, 1e-9}, {10.0, 5.7735, 0.0}, {1e-6, 0.0, 0.0}, {0, 0, 0}};
  for (const double lx : {1e-12, 1e-3, 1.0, 1e6, 1e12}) {
    std::size_t darker = 0;
    for (const glm::dvec3& way : ways) {
      const Image8 with = seen({{.place_m = eye_m + way, .eye_lx = lx}});
      for (std::size_t i = 0; i < with.rgba.size(); ++i) darker += with.rgba[i] + 1 < without.rgba[i] ? 1u : 0u;
    }
    outcome.device.push_back({lx, static_cast<double>(darker)});
  }
  return outcome;
}

/// Pixels outside that a lamp within a closed box lights.
Outcome lamp_in_a_box(const Bench& bench) {
  Renderer& renderer = *bench.renderer;
  Outcome outcome;
  for (const float half : {0.06f, 0.1f, 0.5f, 2.0f}) {
    Scene scene;
    scene.materials = {{.name = "grey"}};
    add(scene, {{-20, -50, 0}, {200, -50, 0}, {200, 50, 0}, {-20, -50, 0}, {200, 50, 0}, {-20, 50, 0}}, {0, 0, 1});
    for (int axis = 0; axis < 3; ++axis)
      for (const float side : {-1.0f, 1.0f}) {
        glm::vec3 normal{0.0f}, u{0.0f}, v{0.0f}, middle{6.0f, 0.0f, 3.0f};
        normal[axis] = side, u[(axis + 1) % 3] = side, v[(axis + 2) % 3] = 1.0f;
        middle += half * normal;
        u *= half, v *= half;
        add(scene, {middle - u - v, middle + u - v, middle + u + v, middle - u - v, middle + u + v, middle - u + v},
            normal);
      }
    if (const Status loaded = renderer.load_scene(scene); !loaded) return {.error = loaded.error().text()};
    FrameInput input = lit_view(renderer);
    input.camera.eye_m = {-6.0, 0.0, 4.0};
    // As wide as a headlamp's beam.
    static const IntensityTable table = table_of(40.0, 3, 3, [](double, double) { return 30'000.0; });
    const AimedSource source{.table = &table};
    renderer.set_beam(0, compose_beam_image(std::span(&source, 1)));
    input.lamps[0].position_m = {6.0, 0.0, 3.0};
    input.want_hdr = true;
    renderer.draw(input);
    const ImageF image = renderer.read_hdr();
    std::size_t lit = 0;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) lit += image.rgba[i] == 0.0f ? 0u : 1u;
    // Without shadows the ground ahead of it is lit: the case has been tried.
    input.effects[static_cast<std::size_t>(Effect::kShadows)] = 0;
    renderer.draw(input);
    if (not_finite(renderer.read_hdr()) > 0) outcome.error = "the lamp lights nothing without shadows either";
    outcome.device.push_back({static_cast<double>(half), static_cast<double>(lit)});
  }
  return outcome;
}

/// Lux by every way of storing a beam, of intensities beyond the largest 16-bit float.
Outcome half_floats(const Bench&) {
  Outcome outcome;
  const IntensityTable table = even_lamp(200'000.0);
  const std::vector<Point> points{{{20.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}}};
  double at = 0.0;
  for (const ImageLevel level : kImageLevels) {
    Result<Renderer> renderer = Renderer::create({.width_px = 16, .height_px = 16, .beam_level = level});
    if (!renderer) return {.error = renderer.error().text()};
    const Bench own{.renderer = &*renderer};
    outcome.device.push_back({at++, relative(device_lx(own, {.table = &table}, points)[0], 500.0)});
  }
  return outcome;
}

}  // namespace

std::vector<HardCase> picture_cases() {
  const auto picture = [](const char* name, const char* breaks, const char* setup, const char* unit, const char* along,
                          double bound, const char* source, Outcome (*run)(const Bench&)) {
    return HardCase{.name = name,
                    .group = "The picture",
                    .breaks = breaks,
                    .setup = setup,
                    .unit = unit,
                    .along = along,
                    .device_bound = bound,
                    .source = source,
                    .run = run};
  };
  return {
      picture("odd-triangles", "a triangle without area or normal gives NaN, which blooms over the picture",
              "a point, a line, a needle of 1 km × 1 mm, no normal, inside out, two that coincide",
              "values that are not finite", "kind", 0.0, "none may be", odd_triangles),
      picture("eye-in-the-lamp", "the way to the lamp and the way to the eye coincide: 0 over 0",
              "eye at the lamp, and 1 nm to 1 mm off", "values that are not finite", "apart, m", 0.0, "none may be",
              eye_in_the_lamp),
      picture("depth", "far walls fight for the same depth: z-fighting beyond some hundred metres",
              "a wall a ten-thousandth of its distance before a brighter one, 0.1 m to 10 km",
              "pixels that show the farther", "distance, m", 0.0,
              "float32 depth, near at infinity's side: steps of 6e-8 of the distance", depth),
      picture("exposure", "half floats overflow or underflow before the tone curve",
              "one wall at exposures from 1e-6 to 1e6", "steps that get darker", "exposure, per cd/m²", 0.0,
              "more exposure is never darker", exposure),
      picture("sizes", "a picture of one pixel divides by 0; one of 16,385 is taken and crashes",
              "1 × 1 to 17 × 17 drawn; 0, −1, 16,385, 2^30 and 16,384 × 16,384 refused", "wrong answers",
              "side, pixels", 0.0, "drawn or refused, never a crash", sizes),
      picture("fog-of-one-metre", "the exponent runs out of float32, or a step of the fog's grid jumps over the light",
              "a wall at 10 m in fog of 1, 3, 10, 1,000 and 100,000 m", "pixels wrong", "visibility, m", 0.0,
              "at 1 m e^-78 of the wall is left; at 100 km the picture is that of clear air to 0.2 %", fog),
      picture("point-glare", "a lamp smaller than a pixel has no angle: its veil divides by 0 and spreads",
              "lamps of 1e-12 to 1e12 lx in a pixel's middle, at the edge, beside the eye and on it",
              "pixels made darker", "lux at the eye", 0.0, "light is added: nothing gets darker", point_glare),
      picture("lamp-in-a-box", "light leaks through what closes around the lamp",
              "a lamp in closed boxes of 12 cm to 4 m above a road, shadows as the scene calls for; what is within 5 "
              "cm casts none",
              "pixels lit outside", "half the box's side, m", 0.0, "none may be", lamp_in_a_box),
      picture("half-float-overflow", "above 65,504 cd a 16-bit float is infinite",
              "200,000 cd through each way of storing a beam", "relative error of lux", "level", 5e-3,
              "half a step of 8 bits, 2e-3, is the coarsest level's; 1.5e-5 of exposed grids' weights below",
              half_floats)};
}

}  // namespace phare::hard
