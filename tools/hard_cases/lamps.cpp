#include "tools/hard_cases/lamps.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "visual/photometry/table/illuminance.h"
#ifdef PHARE_WITH_GRAPHICS
#include "visual/photometry/beam/beam_composer.h"
#include "visual/renderer.h"
#endif

namespace phare::hard {

IntensityTable table_of(double half_deg, std::size_t columns, std::size_t rows,
                        const std::function<double(double h_deg, double v_deg)>& candela) {
  IntensityTable table;
  table.name = "of a formula";
  table.type = PhotometricType::kB;
  const auto nodes = [half_deg](std::size_t count) {
    std::vector<double> deg;
    for (std::size_t i = 0; i < count; ++i)
      deg.push_back(-half_deg + 2.0 * half_deg * static_cast<double>(i) / static_cast<double>(count - 1));
    return deg;
  };
  table.first_deg = nodes(columns);
  table.second_deg = nodes(rows);
  for (const double v_deg : table.second_deg)
    for (const double h_deg : table.first_deg) table.candela.push_back(candela(h_deg, v_deg));
  return table;
}

IntensityTable even_lamp(double candela) {
  return table_of(89.0, 3, 3, [candela](double, double) { return candela; });
}

std::vector<double> float64_lx(const Placed& lamp, std::span<const Point> points) {
  std::vector<double> lx;
  for (const Point& point : points)
    lx.push_back(illuminance_lx(lamp.at_m, lamp.world_from_lamp, *lamp.table, lamp.scale, point.at_m, point.normal));
  return lx;
}

std::vector<double> device_lx(const Bench& bench, const Placed& lamp, std::span<const Point> points) {
#ifdef PHARE_WITH_GRAPHICS
  if (bench.renderer == nullptr) return {};
  const AimedSource source{.table = lamp.table, .scale = lamp.scale};
  bench.renderer->set_beam(0, compose_beam_image(std::span(&source, 1)));
  const PlacedLamp placed{.position_m = lamp.at_m, .world_from_image = lamp.world_from_lamp};
  std::vector<MeasurePoint> asked;
  for (const Point& point : points) asked.push_back({point.at_m, point.normal});
  const std::vector<std::vector<float>> found = bench.renderer->measure(std::span(&placed, 1), asked);
  return {found[0].begin(), found[0].end()};
#else
  (void)bench, (void)lamp, (void)points;
  return {};
#endif
}

double relative(double value, double exact) {
  return exact == 0.0 ? std::abs(value) : std::abs(value - exact) / std::abs(exact);
}

Outcome against(const Bench& bench, const Placed& lamp, std::span<const Point> points, std::span<const double> exact,
                std::span<const double> along) {
  Outcome outcome;
  const std::vector<double> device = device_lx(bench, lamp, points), processor = float64_lx(lamp, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    outcome.float64.push_back({along[i], relative(processor[i], exact[i])});
    if (!device.empty()) outcome.device.push_back({along[i], relative(device[i], exact[i])});
  }
  return outcome;
}

}  // namespace phare::hard
