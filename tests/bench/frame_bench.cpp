// How long a frame takes, where the time goes and how it grows, as ratios to the floor: the bare light integral of two
// headlamps by hand (tests/bench/floor.h), taken in the same run and turn by turn, so that the ratios stay when the
// machine is slower or busy.
//   phare_frame_bench [--scene SCENE.glb --lamp LAMP.ies] [--size 1280x720] [--rounds 40] [--only CASE] [--csv FILE]
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>

#include "tests/bench/cases.h"
#include "tests/bench/floor.h"
#include "tests/bench/growth.h"
#include "tests/bench/instruments.h"
#include "tests/bench/straight_road.h"
#include "visual/photometry/beam/beam_composer.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/scene/refine.h"
#include "visual/scene/scene.h"

namespace phare::bench {
namespace {

FrameInput without_lamps(FrameInput input) {
  input.lamps.clear();
  return input;
}

/// The first straight of the country road: its fullest view.
FrameInput country_view(int round) {
  const double x_m = 26.9 + 0.1 * (round % 64);
  FrameInput input;
  input.camera.eye_m = {x_m - 1.9, -1.2, 1.22};
  const glm::dmat3 aim = aim_rotation(0.0, -0.01, 0.0);
  for (const double y_m : {-1.0, -2.2})
    input.lamps.push_back({.position_m = {x_m, y_m, 0.65}, .world_from_image = aim});
  return input;
}

FrameInput without_shadows(FrameInput input) {
  input.effects[static_cast<std::size_t>(Effect::kShadows)] = 0;
  return input;
}

/// What the plan decides by how dear a pixel is (visual/effects.cpp): what does depth first cost, or save?
void add_depth_first(Bench& bench, const std::string& group, Renderer& renderer,
                     const std::function<FrameInput(int)>& view) {
  const auto add = [&](const std::string& name, Method method, std::size_t shadows) {
    for (const bool on : {false, true})
      bench.add(group, name + (on ? ", depth first" : ", not depth first"), renderer,
                [view, method, shadows, on](int round) {
                  FrameInput input = view(round);
                  input.method = method;
                  input.effects[static_cast<std::size_t>(Effect::kShadows)] = shadows;
                  input.effects[static_cast<std::size_t>(Effect::kDepthFirst)] = on ? 1 : 0;
                  return input;
                });
  };
  add("two lamps", Method::kFragment, 0);
  for (std::size_t level = 2; level < kShadowNames.size(); ++level)
    add("two lamps, shadows " + std::string(kShadowNames[level]), Method::kFragment, level);
  if (!renderer.no_reference()) add("two lamps by method reference", Method::kReference, 0);
}

/// What a frame costs with nothing in it, with its surfaces unlit, and lit; differences tell where time goes.
void add_parts(Bench& bench, const std::string& group, Renderer& renderer, const std::function<FrameInput(int)>& view) {
  bench.add(group, "fixed: nothing in view", renderer, [view](int round) {
    FrameInput input = without_lamps(view(round));
    input.camera.eye_m.z -= 1e5;  // far below the ground, looking down: no surface, no sky
    input.camera.world_from_eye = glm::dmat3(glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0));
    return input;
  });
  bench.add(group, "sky alone", renderer, [view](int round) {
    FrameInput input = without_lamps(view(round));
    input.camera.eye_m.z += 1e5;
    input.camera.world_from_eye = glm::dmat3(glm::dvec3(0, 0, 1), glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0));
    return input;
  });
  bench.add(group, "unlit: geometry and surfaces", renderer, [view](int round) { return without_lamps(view(round)); });
  const auto with_shadows = [view](std::size_t level) {
    return [view, level](int round) {
      FrameInput input = view(round);
      input.effects[static_cast<std::size_t>(Effect::kShadows)] = level;
      return input;
    };
  };
  bench.add(group, "two lamps", renderer, with_shadows(0));
  for (const Method method : {Method::kVertex, Method::kVertex1998, Method::kReference}) {
    if (method == Method::kReference && renderer.no_reference()) continue;
    bench.add(group, "two lamps by method " + std::string(kMethodNames[static_cast<std::size_t>(method)]), renderer,
              [view, method](int round) {
                FrameInput input = without_shadows(view(round));
                input.method = method;
                return input;
              });
  }
  for (std::size_t level = 1; level < kRayShadows; ++level)
    bench.add(group, "two lamps, shadows " + std::string(kShadowNames[level]), renderer, with_shadows(level));
  for (std::size_t level = 1; level < kFogNames.size(); ++level)
    bench.add(group, "two lamps, fog " + std::string(kFogNames[level]), renderer, [view, level](int round) {
      FrameInput input = without_shadows(view(round));
      input.air.visibility_m = 80.0;
      input.effects[static_cast<std::size_t>(Effect::kFog)] = level;
      return input;
    });
  for (const std::size_t level : {std::size_t{2}, std::size_t{4}})
    bench.add(group,
              "two lamps driven on, shadows " + std::string(kShadowNames[2]) + ", fog " + std::string(kFogNames[level]),
              renderer, [with_shadows, level, frame = 0](int round) mutable {
                FrameInput input = with_shadows(2)(round);
                input.air.visibility_m = 80.0;
                // Driven on by so much that a grid with shadows is another.
                const glm::dvec3 way_m = 0.01 * (++frame % 16) * input.camera.world_from_eye[0];
                input.camera.eye_m += way_m;
                for (PlacedLamp& lamp : input.lamps) lamp.position_m += way_m;
                input.effects[static_cast<std::size_t>(Effect::kFog)] = level;
                return input;
              });
  for (const bool snow : {false, true})
    bench.add(group, snow ? "two lamps, snow 1 mm/h" : "two lamps, rain 10 mm/h", renderer, [view, snow](int round) {
      FrameInput input = without_shadows(view(round));
      (snow ? input.air.snow_mmph : input.air.rain_mmph) = snow ? 1.0 : 10.0;
      input.falling = {.time_s = 0.1 * round, .eye_mps = {20.0, 0.0, 0.0}};
      return input;
    });
  for (const bool spray : {false, true})
    bench.add(group, spray ? "two lamps, wet ground, spray of a car" : "two lamps, wet ground", renderer,
              [view, spray](int round) {
                FrameInput input = without_shadows(view(round));
                input.effects[static_cast<std::size_t>(Effect::kWetGround)] = 2;
                input.want_hdr = true;
                if (!spray) return input;
                SprayingVehicle car{.speed_mps = 25.0, .tail_cd = 8.0, .time_s = 0.1 * round};
                for (std::size_t i = 0; i < car.wheels_m.size(); ++i)
                  car.wheels_m[i] = input.camera.eye_m - glm::dvec3(0.0, 0.0, input.camera.eye_m.z) +
                                    (40.0 - 30.0 * static_cast<double>(i)) * input.camera.world_from_eye[0];
                input.spraying = {car};
                return input;
              });
  for (const Wiper wiper : {Wiper::kOff, Wiper::kSlow})
    bench.add(group, "two lamps, rain 10 mm/h, wiper " + std::string(kWiperNames[static_cast<std::size_t>(wiper)]),
              renderer, [view, wiper](int round) {
                FrameInput input = without_shadows(view(round));
                input.air.rain_mmph = 10.0;
                input.falling = {.time_s = 0.1 * round, .eye_mps = {20.0, 0.0, 0.0}};
                input.windscreen = Windscreen{0.1 * round, 20.0, wiper};
                return input;
              });
  bench.add(group, "two lamps, snow cover", renderer, [view](int round) {
    FrameInput input = without_shadows(view(round));
    input.snow_cover_01 = 0.9;
    return input;
  });
  bench.add(group, "two lamps, eyeshine of 4", renderer, [view](int round) {
    FrameInput input = without_shadows(view(round));
    for (int i = 0; i < 4; ++i)
      input.pupils.push_back({input.camera.eye_m + glm::dvec3(40.0 + i, 2.0, -0.2), glm::vec3(0.05f), 1e-4});
    return input;
  });
  bench.add(group, "two lamps, wet ground", renderer, [view](int round) {
    FrameInput input = without_shadows(view(round));
    input.effects[static_cast<std::size_t>(Effect::kWetGround)] = 2;
    return input;
  });
  bench.add(group, "two lamps, luminance image", renderer, [view](int round) {
    FrameInput input = without_shadows(view(round));
    input.effects[static_cast<std::size_t>(Effect::kHdrImage)] = 1;
    return input;
  });
  for (const std::size_t count : {2u, 12u})
    bench.add(group, "two lamps, glare of " + std::to_string(count), renderer, [view, count](int round) {
      FrameInput input = without_shadows(view(round));
      for (std::size_t i = 0; i < count; ++i)
        input.glare.push_back({input.camera.eye_m + glm::dvec3(50.0, 2.0 + 0.1 * static_cast<double>(i), -0.5), 0.2});
      return input;
    });
  // By pipelines for any light, in place of those for the tables of this one.
  for (const auto& [name, wet, visibility_m] :
       {std::tuple("clear air", 0u, std::optional<double>()), std::tuple("fog medium", 0u, std::optional(80.0)),
        std::tuple("wet ground", 2u, std::optional<double>())})
    bench.add(group, std::string("two lamps, ") + name + ", shapes from the frame", renderer,
              [view, wet, visibility_m](int round) {
                FrameInput input = without_shadows(view(round));
                input.air.visibility_m = visibility_m;
                if (wet > 0) input.effects[static_cast<std::size_t>(Effect::kWetGround)] = wet;
                input.shapes = ShapesFrom::kFrame;
                return input;
              });
  // What is kept while lamps and eye keep their places to one another, computed in each frame.
  bench.add(group, "two lamps that sway, fog medium", renderer, [view, frame = 0](int round) mutable {
    FrameInput input = without_shadows(view(round));
    for (PlacedLamp& lamp : input.lamps) lamp.position_m.z += 1e-4 * (++frame % 16);
    input.air.visibility_m = 80.0;
    return input;
  });
}

/// The straight road with surfaces of one kind, all of them.
void add_surfaces(Bench& bench, Scene straight, const IntensityTable& beam,
                  const std::function<FrameInput(int)>& view) {
  const auto add = [&](const std::string& name, const Retroreflection& retro) {
    for (SceneMaterial& material : straight.materials) material.retro = retro;
    bench.add("straight road, all surfaces", name, bench.renderer(straight, beam), view);
  };
  add("Lambert", {});
  add("upright facets", {.kind = RetroKind::kFacets});
  add("Oren-Nayar", grooves(30.0));
}

/// The straight road with more of one thing: triangles, draws, lamps, pixels, views.
void add_growth(Bench& bench, const Scene& straight, const IntensityTable& beam, const Options& options) {
  const auto view = [](int round) { return without_shadows(straight_road_view(0.1 * (round % 64))); };
  for (const int times : {0, 1, 2, 3}) {
    const Scene scene = refined(straight, times);
    bench.grow("growth with triangles", "triangles", static_cast<double>(scene.indices.size() / 3),
               bench.renderer(scene, beam), [view](int round) {
                 FrameInput input = view(round);
                 input.far_mesh_from_m = std::numeric_limits<double>::infinity();
                 return input;
               });
  }
  for (const std::size_t count : {0u, 50u, 100u, 200u})
    bench.grow("growth with draws", "more draws", static_cast<double>(count),
               bench.renderer(with_more_draws(straight, count), beam), view);

  Renderer& renderer = bench.renderer(straight, beam);
  const auto with_lamps = [view](int round, std::size_t count) {
    FrameInput input = view(round);
    const PlacedLamp first = input.lamps.front();
    input.lamps.assign(count, first);
    for (std::size_t i = 0; i < count; ++i) input.lamps[i].position_m.y = -2.6 + 0.3 * static_cast<double>(i);
    return input;
  };
  for (const std::size_t count : {0u, 1u, 2u, 4u, 8u})
    bench.grow("growth with lamps", "lamps", static_cast<double>(count), renderer,
               [=](int round) { return with_lamps(round, count); });
  bench.add("lamps that reach nothing here", "2 lamps, and 8 of cars behind", renderer, [=](int round) {
    FrameInput input = with_lamps(round, 10);
    for (std::size_t i = 2; i < 10; ++i) {
      input.lamps[i].position_m.x -= 20.0;
      input.lamps[i].world_from_image = aim_rotation(3.14159265, 0.0, 0.0);
    }
    return input;
  });

  for (const auto& [w, h] : {std::pair(640, 360), std::pair(1280, 720), std::pair(1920, 1080)})
    bench.grow("growth with pixels", "pixels", double{1} * w * h, bench.renderer(straight, beam, w, h), view);

  // Views: of the same road a quarter as wide and high; a mirror that sees nothing lit; two halves.
  const auto inset = [view](int round, std::size_t place) {
    ViewInput more = view(round);
    more.part = {0.25 * static_cast<double>(place % 4), 0.25 * static_cast<double>(place / 4), 0.25, 0.25};
    return more;
  };
  for (const std::size_t count : {0u, 1u, 2u, 4u, 8u})
    bench.grow("growth with views", "insets", static_cast<double>(count), renderer, [=](int round) {
      FrameInput input = view(round);
      for (std::size_t i = 0; i < count; ++i) input.more_views.push_back(inset(round, i));
      return input;
    });
  bench.add("a second view", "none", renderer, view);
  bench.add("a second view", "inset, 1/16 of the picture", renderer, [=](int round) {
    FrameInput input = view(round);
    input.more_views = {inset(round, 0)};
    return input;
  });
  bench.add("a second view", "inset that sees nothing lit", renderer, [=](int round) {
    FrameInput input = view(round);
    input.more_views = {inset(round, 0)};
    input.more_views[0].camera.world_from_eye = aim_rotation(3.14159265, 0.0, 0.0);
    return input;
  });
  bench.add("a second view", "two designs, half of the picture each", renderer, [=](int round) {
    FrameInput input = view(round);
    input.part.width_01 = 0.5;
    ViewInput beside = input;
    beside.part.left_01 = 0.5;
    input.more_views = {beside};
    return input;
  });
  bench.add("a second view", "as large, its own picture", renderer, [=, &options](int round) {
    FrameInput input = view(round);
    ViewInput other = view(round);
    other.own_picture = {options.width_px, options.height_px};
    input.more_views = {other};
    return input;
  });
}

int run(const Options& options) {
  if (!Floor::possible()) {
    std::fprintf(stderr, "phare_frame_bench: this processor has no AVX2 and FMA, so no floor to compare with\n");
    return kExitCheckFailed;
  }
  const Result<Scene> country = read_scene(options.scene);
  const Result<IntensityTable> lamp = read_lamp(options.lamp, {});
  if (!country || !lamp) {
    std::fprintf(stderr, "phare_frame_bench: %s\n", (country ? lamp.error() : country.error()).text().c_str());
    return kExitBadInput;
  }
  const Scene straight = straight_road();
  const IntensityTable even = straight_road_beam(Nodes::kEven), rounded = straight_road_beam(Nodes::kRounded);
  const auto straight_view = [](int round) { return without_shadows(straight_road_view(0.1 * (round % 64))); };

  Bench bench(options);
  const auto add_road = [&](const std::string& group, Renderer& renderer, const auto& view) {
    if (options.depth_first)
      add_depth_first(bench, group, renderer, view);
    else
      add_parts(bench, group, renderer, view);
  };
  add_road("straight road, even nodes", bench.renderer(straight, even), straight_view);
  bench.add("straight road, rounded nodes", "two lamps", bench.renderer(straight, rounded), straight_view);
  add_surfaces(bench, straight, even, straight_view);
  add_road("country road", bench.renderer(*country, *lamp), country_view);
  Instruments instruments;
  Renderer& with_instruments = bench.renderer(*country, *lamp);
  instruments.load_into(with_instruments);
  instruments.add_to([&](const std::string& name, const Instruments::View& view) {
    bench.add("instruments, country road with shadows", name, with_instruments, view);
  });
  if (options.growth) add_growth(bench, straight, even, options);

  Floor floor(even, options.width_px, options.height_px);
  bench.run(floor);
  bench.print();
  bench.print_curves();
  for (const std::string group : {"straight road, even nodes", "country road"}) {
    const double fixed = bench.cpu_floors(group, "fixed: nothing in view");
    const double unlit = bench.cpu_floors(group, "unlit: geometry and surfaces");
    const double lit = bench.cpu_floors(group, "two lamps");
    if (fixed == 0.0 || unlit == 0.0 || lit == 0.0) continue;  // not all were asked for
    std::printf("\n%s, floors: %.2f = fixed %.2f + geometry and surfaces %.2f + lamps %.2f", group.c_str(), lit, fixed,
                unlit - fixed, lit - unlit);
  }
  std::printf("\n");
  if (!options.csv.empty()) bench.write_csv(options.csv);
  return kExitDone;
}

}  // namespace
}  // namespace phare::bench

int main(int argc, char** argv) {
  // Threads of the floor that wait for work must not spend processor time that frames are charged with; the runtime
  // reads this before main, so the program begins once more.
  if (std::getenv("OMP_WAIT_POLICY") == nullptr && setenv("OMP_WAIT_POLICY", "passive", 1) == 0)
    execv("/proc/self/exe", argv);
  phare::bench::Options options;
  std::string size = "1280x720";
  CLI::App app{"Frame times in floors: the bare light integral of two headlamps, taken in the same run",
               "phare_frame_bench"};
  app.add_option("--scene", options.scene, "A road of any length, driven along x from the origin")
      ->capture_default_str();
  app.add_option("--lamp", options.lamp, "Its low beam")->capture_default_str();
  app.add_option("--size", size, "WIDTHxHEIGHT, the width a multiple of 8")->capture_default_str();
  app.add_option("--rounds", options.rounds, "Frames of each case")->check(CLI::Range(1, 10000))->capture_default_str();
  app.add_flag("!--no-growth", options.growth, "Only the roads, not how time grows");
  app.add_flag("--depth-first", options.depth_first,
               "What depth first costs or saves in place of the roads' other cases: minutes without a GPU, by rays");
  app.add_option("--only", options.only,
                 "Only cases whose \"group: case\" has this regular expression, as \"two lamps$\"");
  app.add_option("--csv", options.csv, "Write the table there");
  CLI11_PARSE(app, argc, argv);
  if (std::sscanf(size.c_str(), "%dx%d", &options.width_px, &options.height_px) != 2 || options.width_px % 8 != 0 ||
      options.width_px < 8 || options.height_px < 8) {
    std::fprintf(stderr, "phare_frame_bench: --size: expected WIDTHxHEIGHT, got '%s'\n", size.c_str());
    return phare::kExitBadInput;
  }
  try {
    return phare::bench::run(options);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "phare_frame_bench: %s\n", failure.what());
    return phare::kExitCheckFailed;
  }
}
