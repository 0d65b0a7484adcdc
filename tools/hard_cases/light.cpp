// Light that is hard to compute: near, far, grazing, behind, at the seams of a table, huge and tiny.
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "tools/hard_cases/lamps.h"
#include "tools/temporary_folder.h"
#include "visual/photometry/readers/read_lamp.h"
#include "visual/scene/scene.h"

namespace phare::hard {
namespace {

constexpr double kRadPerDeg = std::numbers::pi / 180.0;

/// What most cases ask: 1e-5 of the light by the shader (docs/accuracy.md), 1e-9 in float64.
constexpr double kDevice = 1e-5, kFloat64 = 1e-9;
const char* const kAsked =
    "1e-5 on the device's exact level, 1e-9 in float64: what docs/accuracy.md promises everywhere";

/// A triangle of glTF with this number in a position or a normal, or in its node's place.
bool scene_taken(const std::filesystem::path& folder, std::size_t at, float value, const std::string& node) {
  std::array<float, 18> numbers{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1};
  numbers[at] = value;
  std::ofstream bin(folder / "scene.bin", std::ios::binary);
  bin.write(reinterpret_cast<const char*>(numbers.data()), sizeof numbers);
  bin.close();
  std::ofstream(folder / "scene.gltf")
      << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)" << node
      << R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1}}]}],)"
      << R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},)"
      << R"({"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"}],)"
      << R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":36}],)"
      << R"("buffers":[{"uri":"scene.bin","byteLength":72}]})";
  return read_scene(folder / "scene.gltf").ok();
}

Outcome no_numbers_in_a_scene(const Bench&) {
  const TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  if (folder.empty()) return {.error = "no temporary folder"};
  Outcome outcome;
  constexpr float kInf = std::numeric_limits<float>::infinity(), kNan = std::numeric_limits<float>::quiet_NaN();
  double at = 0.0;
  for (const std::size_t number : {0u, 8u, 9u, 17u})
    for (const float bad : {kNan, kInf, -kInf})
      outcome.float64.push_back({at++, scene_taken(folder, number, bad, "") ? 1.0 : 0.0});
  for (const char* node : {",\"translation\":[1e400,0,0]", ",\"translation\":[nan,0,0]",
                           ",\"scale\":[1e308,1e308,1e308]", ",\"rotation\":[0,0,0,0]"})
    outcome.float64.push_back({at++, scene_taken(folder, 0, 0.0f, node) ? 1.0 : 0.0});
  // And one that is right, or the refusals would prove nothing.
  outcome.float64.push_back({at, scene_taken(folder, 0, 0.0f, ",\"translation\":[1,0,0]") ? 0.0 : 1.0});
  return outcome;
}

HardCase light(const char* name, const char* breaks, const char* setup, const char* along,
               std::function<Outcome(const Bench&)> run) {
  return {.name = name,
          .group = "Light",
          .breaks = breaks,
          .setup = setup,
          .unit = "relative error of lux",
          .along = along,
          .device_bound = kDevice,
          .float64_bound = kFloat64,
          .source = kAsked,
          .run = std::move(run)};
}

Outcome grazing(const Bench& bench) {
  const IntensityTable table = even_lamp(10'000.0);
  std::vector<Point> points;
  std::vector<double> exact, along;
  constexpr double kHeight_m = 0.65;
  for (double deg = 5.0; deg > 0.0195; deg *= 0.8) {
    const double far_m = kHeight_m / std::tan(deg * kRadPerDeg), r2 = far_m * far_m + kHeight_m * kHeight_m;
    points.push_back({{far_m, 0.0, 0.0}});
    exact.push_back(10'000.0 * kHeight_m / (r2 * std::sqrt(r2)));
    along.push_back(deg);
  }
  return against(bench, {.table = &table, .at_m = {0.0, 0.0, kHeight_m}}, points, exact, along);
}

Outcome at_distances(const Bench& bench, double candela, std::initializer_list<double> distances_m) {
  const IntensityTable table = even_lamp(candela);
  std::vector<Point> points;
  std::vector<double> exact, along;
  for (const double r_m : distances_m) {
    points.push_back({{r_m, 0.0, 0.0}, {-1.0, 0.0, 0.0}});
    exact.push_back(candela / (r_m * r_m));
    along.push_back(r_m);
  }
  return against(bench, {.table = &table}, points, exact, along);
}

Outcome behind(const Bench& bench) {
  const IntensityTable table = table_of(45.0, 91, 91, [](double, double) { return 30'000.0; });
  std::vector<Point> points;
  std::vector<double> along;
  for (double deg = 90.0; deg <= 180.0; deg += 2.5)
    for (const double side : {-1.0, 1.0}) {
      const glm::dvec3 way(std::cos(deg * kRadPerDeg), side * std::sin(deg * kRadPerDeg), 0.0);
      points.push_back({5.0 * way, -way});
      along.push_back(deg);
    }
  return against(bench, {.table = &table}, points, std::vector<double>(points.size(), 0.0), along);
}

Outcome seam(const Bench& bench) {
  // Type C about the optical axis, 5° nodes; the beam leans to one side, so that planes differ.
  IntensityTable table;
  table.type = PhotometricType::kC;
  for (int c = 0; c <= 360; c += 5) table.first_deg.push_back(c);
  for (int g = 0; g <= 180; g += 5) table.second_deg.push_back(g);
  const auto candela = [](double c_deg, double g_deg) {
    return 2'000.0 + 900.0 * std::cos(g_deg * kRadPerDeg) +
           700.0 * std::sin(g_deg * kRadPerDeg) * std::cos(c_deg * kRadPerDeg);
  };
  for (const double g : table.second_deg)
    for (const double c : table.first_deg) table.candela.push_back(candela(c, g));
  std::vector<Point> points;
  std::vector<double> exact, along;
  for (const double g_deg : {0.0, 5.0, 45.0, 90.0, 175.0, 180.0})
    for (const double c_deg : {0.0, 5.0, 180.0, 355.0, 360.0}) {
      const glm::dvec3 way = table_direction(table.type, table.axis, {c_deg, g_deg});
      points.push_back({3.0 * way, -way});
      exact.push_back(candela(c_deg, g_deg) / 9.0);
      along.push_back(c_deg);
    }
  return against(bench, {.table = &table}, points, exact, along);
}

Outcome cutoff(const Bench& bench) {
  // 12,000 cd below, 300 cd above, the step within 0.1° of -0.57°, as steep as a projector's.
  const auto candela = [](double v_deg) { return 300.0 + 11'700.0 * std::clamp((-0.52 - v_deg) / 0.1, 0.0, 1.0); };
  IntensityTable table = table_of(10.0, 5, 1001, [&](double, double v_deg) { return candela(v_deg); });
  std::vector<Point> points;
  std::vector<double> exact, along;
  for (double v_deg = -0.7; v_deg <= -0.4; v_deg += 0.025) {
    points.push_back({{25.0, 0.0, 25.0 * std::tan(v_deg * kRadPerDeg)}, {-1.0, 0.0, 0.0}});
    const double cos = std::cos(v_deg * kRadPerDeg), exact_cd = table.intensity_at_cd({0.0, v_deg});
    exact.push_back(exact_cd * cos * cos * cos / 625.0);
    along.push_back(v_deg);
  }
  return against(bench, {.table = &table}, points, exact, along);
}

Outcome far_origin(const Bench& bench) {
  const IntensityTable table =
      table_of(30.0, 241, 241, [](double h, double v) { return 9e3 * std::exp(-(h * h + 4 * v * v) / 90); });
  Outcome outcome;
  std::vector<Point> home, away;
  std::vector<double> along;
  const glm::dvec3 shift(5e6, -3e6, 1e3);
  for (double r_m = 1.0; r_m < 200.0; r_m *= 1.5) {
    // To a 2^-20 m, which float64 holds there too: the places are the same, and only the program can tell them apart.
    const glm::dvec3 at_m = glm::round(glm::dvec3(r_m, 0.1 * r_m, -0.6) * 1048576.0) / 1048576.0;
    home.push_back({at_m});
    away.push_back({at_m + shift});
    along.push_back(r_m);
  }
  const Placed lamp{.table = &table}, lamp_away{.table = &table, .at_m = shift};
  const std::vector<double> device = device_lx(bench, lamp, home), device_away = device_lx(bench, lamp_away, away);
  const std::vector<double> processor = float64_lx(lamp, home), processor_away = float64_lx(lamp_away, away);
  for (std::size_t i = 0; i < home.size(); ++i) {
    if (!device.empty()) outcome.device.push_back({along[i], relative(device_away[i], device[i])});
    outcome.float64.push_back({along[i], relative(processor_away[i], processor[i])});
  }
  return outcome;
}

Outcome table_sizes(const Bench& bench) {
  Outcome all;
  for (const std::size_t side : {std::size_t{2}, std::size_t{100}, std::size_t{1000}}) {
    const IntensityTable table =
        table_of(20.0, side, side, [](double h, double v) { return 5'000.0 + 50.0 * h - 30.0 * v; });
    std::vector<Point> points;
    std::vector<double> exact, along;
    for (double deg = -19.0; deg < 19.5; deg += 1.9) {
      const glm::dvec3 way = table_direction(table.type, table.axis, {deg, 0.5 * deg});
      points.push_back({7.0 * way, -way});
      exact.push_back((5'000.0 + 50.0 * deg - 15.0 * deg) / 49.0);
      along.push_back(static_cast<double>(side * side));
    }
    const Outcome one = against(bench, {.table = &table}, points, exact, along);
    all.device.insert(all.device.end(), one.device.begin(), one.device.end());
    all.float64.insert(all.float64.end(), one.float64.begin(), one.float64.end());
  }
  return all;
}

Outcome one_value(const Bench& bench) {
  const auto ies = [](const char* counts_and_angles) {
    return std::string("IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 ") + counts_and_angles;
  };
  for (const auto& [name, text] :
       {std::pair<const char*, std::string>("lamp.csv", "# unit: cd\nV\\H,0\n0,5000\n"),
        {"lamp.ies", ies("1 1 1 2 0 0 0\n1 1 10\n0\n0\n5000\n")}})
    if (parse_lamp(text, name, {}).ok()) return {.error = std::string(name) + " of one value was taken"};
  const auto table = parse_lamp(ies("2 1 1 2 0 0 0\n1 1 10\n0 180\n0\n5000 5000\n"), "lamp.ies", {});
  if (!table) return {.error = table.error().text()};
  std::vector<Point> points;
  std::vector<double> along;
  for (int up_deg = -90; up_deg <= 90; up_deg += 15)
    for (int left_deg = -180; left_deg < 180; left_deg += 20) {
      const double up = up_deg * kRadPerDeg, left = left_deg * kRadPerDeg;
      const glm::dvec3 way(std::cos(up) * std::cos(left), std::cos(up) * std::sin(left), std::sin(up));
      points.push_back({10.0 * way, -way});
      along.push_back(left_deg);
    }
  return against(bench, {.table = &*table}, points, std::vector<double>(points.size(), 50.0), along);
}

Outcome spike(const Bench& bench) {
  // One node of 200,000 cd among zeros: a pyramid over four cells.
  const IntensityTable table =
      table_of(10.0, 201, 201, [](double h, double v) { return std::hypot(h, v) < 1e-9 ? 200'000.0 : 0.0; });
  std::vector<Point> points;
  std::vector<double> exact, along;
  for (int i = -14; i <= 14; ++i) {
    const double h_deg = 0.01 * i, v_deg = 0.003 * i;
    const glm::dvec3 way = table_direction(table.type, table.axis, {h_deg, v_deg});
    points.push_back({10.0 * way, -way});
    exact.push_back(2'000.0 * std::max(1.0 - std::abs(h_deg) / 0.1, 0.0) * std::max(1.0 - std::abs(v_deg) / 0.1, 0.0));
    along.push_back(h_deg);
  }
  Outcome outcome = against(bench, {.table = &table}, points, exact, along);
  // Next to 0 an angle's own rounding is all there is: errors count against the spike.
  const std::vector<double> device = device_lx(bench, {.table = &table}, points),
                            processor = float64_lx({.table = &table}, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    outcome.float64[i].value = std::abs(processor[i] - exact[i]) / 2'000.0;
    if (!device.empty()) outcome.device[i].value = std::abs(device[i] - exact[i]) / 2'000.0;
  }
  return outcome;
}

Outcome hundred_lamps(const Bench& bench) {
  const IntensityTable table = even_lamp(1'000.0);
  const std::vector<Point> points{{{60.0, 0.0, 0.0}}, {{20.0, 3.0, 0.0}}, {{5.0, -1.0, 0.0}}};
  std::vector<double> device(points.size()), processor(points.size()), exact(points.size());
  for (int lamp = 0; lamp < 100; ++lamp) {
    const Placed placed{.table = &table, .at_m = {0.0, -5.0 + 0.1 * lamp, 0.65}};
    const std::vector<double> by_device = device_lx(bench, placed, points), by_processor = float64_lx(placed, points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!by_device.empty()) device[i] += by_device[i];
      processor[i] += by_processor[i];
      const glm::dvec3 to = placed.at_m - points[i].at_m;
      exact[i] += 1'000.0 * 0.65 / std::pow(glm::dot(to, to), 1.5);
    }
  }
  Outcome outcome;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (bench.renderer != nullptr) outcome.device.push_back({points[i].at_m.x, relative(device[i], exact[i])});
    outcome.float64.push_back({points[i].at_m.x, relative(processor[i], exact[i])});
  }
  return outcome;
}

Outcome dimmed(const Bench& bench) {
  const IntensityTable table = even_lamp(30'000.0);
  const std::vector<Point> points{{{25.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}}};
  Outcome outcome;
  for (double scale = 1.0; scale > 0.9e-6; scale *= 0.1) {
    const double exact = scale * 30'000.0 / 625.0;
    const Placed placed{.table = &table, .scale = scale};
    const std::vector<double> device = device_lx(bench, placed, points);
    if (!device.empty()) outcome.device.push_back({scale, relative(device[0], exact)});
    outcome.float64.push_back({scale, relative(float64_lx(placed, points)[0], exact)});
  }
  return outcome;
}

Outcome no_numbers(const Bench&) {
  Outcome outcome;
  double at = 0.0;
  for (const char* cell : {"nan", "inf", "-inf", "1e400", "0x1p3", "", "12,5", "--3"}) {
    const std::string text = std::string("# unit: cd\nV\\H,-10,0,10\n-5,1,2,3\n0,4,") + cell + ",6\n5,7,8,9\n";
    outcome.float64.push_back({at++, parse_lamp(text, "lamp.csv", {}).ok() ? 1.0 : 0.0});
  }
  // And one that is right, or the refusals would prove nothing.
  outcome.float64.push_back(
      {at, parse_lamp("# unit: cd\nV\\H,-10,0,10\n-5,1,2,3\n0,4,5,6\n5,7,8,9\n", "lamp.csv", {}).ok() ? 0.0 : 1.0});
  return outcome;
}

}  // namespace

std::vector<HardCase> light_cases() {
  std::vector<HardCase> cases{
      light("grazing-incidence", "the cosine is a difference of large numbers, or is clamped: no light on the far road",
            "even lamp 0.65 m above a level road, from 5° of incidence down to 0.02°", "incidence, degrees", grazing),
      light("close-to-the-lamp", "1/r² is clamped to keep it finite, or overflows 16-bit floats",
            "even lamp of 10,000 cd, a plate 5 mm to 1 m before it", "distance, m",
            [](const Bench& bench) {
              return at_distances(bench, 1e4, {0.005, 0.01, 0.05, 0.1, 0.5, 1.0});
            }),
      light("two-kilometres", "a range of the light cuts it off", "even lamp of 10,000 cd, a plate at 100 m to 2 km",
            "distance, m",
            [](const Bench& bench) {
              return at_distances(bench, 1e4, {100.0, 300.0, 1000.0, 2000.0});
            }),
      light("behind-the-lamp", "a projected texture shines backwards too, and in the lamp's plane divides by 0",
            "beam of ±45°, points from its plane to straight behind it", "angle from the axis, degrees", behind),
      light("seam-and-poles",
            "between the last plane of a type C table and its first the light jumps; at the pole it spins",
            "type C table, 5° nodes, at C 0, 355, 360° and γ 0, 180°", "C, degrees", seam),
      light("cut-off", "the texture filter smears the cut-off over its own texels",
            "12,000 to 300 cd within 0.1°, on a wall at 25 m in steps of 0.025°", "V, degrees", cutoff),
      light("table-sizes", "a table of four values or of a million is resampled",
            "2 × 2, 100 × 100 and 1,000 × 1,000 nodes of a plane of intensity", "values", table_sizes),
      light("one-value", "a step between nodes is divided by, and there is one node",
            "one value, in CSV and LM-63: refused; the same in one plane from pole to pole: that intensity everywhere",
            "to the left of the axis, degrees", one_value),
      light("one-spike", "filters and mip levels eat a single bright node",
            "200,000 cd at one node of 201 × 201, 0 elsewhere, through it in 0.01°", "H, degrees", spike),
      light("hundred-lamps", "a limit of eight lights, or sums in 16-bit floats",
            "100 lamps of 1,000 cd beside each other, added up", "distance, m", hundred_lamps),
      light("dimming", "8-bit dimming steps: a lamp at a thousandth is dark", "one lamp dimmed to 1e-6", "dimming",
            dimmed)};
  HardCase far = light("far-origin", "float32 world coordinates jitter by half a metre at 5,000 km",
                       "the same lamp and points 5,000 km east, 3,000 km south", "distance, m", far_origin);
  far.device_bound = far.float64_bound = 1e-6;
  far.source = "positions of 5e6 m are good to 1e-9 m in float64: 2e-9 of the light at 1 m; 1e-6 is asked for";
  cases.push_back(std::move(far));
  HardCase numbers = light("no-numbers", "NaN or infinity in a file reaches the picture as black or white blocks",
                           "a table with nan, inf, 1e400, an empty cell and the like", "file", no_numbers);
  numbers.unit = "files taken that have to be refused, or the other way";
  numbers.device_bound.reset();
  numbers.float64_bound = 0.0;
  numbers.source = "a file is refused with its line, or read right";
  cases.push_back(std::move(numbers));
  cases.push_back(float64_case("Light", "no-numbers-in-a-scene",
                               "one vertex at infinity, and the whole picture is lost",
                               "glTF with NaN or infinity in a position, a normal, a node's place, size or turn",
                               "scenes taken that have to be refused, or the other way", "scene", 0.0,
                               "a file is refused with its place, or read right", no_numbers_in_a_scene));
  for (HardCase& one : cases)
    if (one.name == "behind-the-lamp") {
      one.unit = "lx";
      one.device_bound = one.float64_bound = 0.0;
      one.source = "outside its table a beam is dark, exactly";
    } else if (one.name == "one-spike") {
      one.unit = "error of lux over that of the spike";
      one.device_bound = 2e-5;
      one.source = "angles good to 1.5e-6° by the shader, on a slope of 10 a degree";
    }
  return cases;
}

}  // namespace phare::hard
