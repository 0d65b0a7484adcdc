// The beam image of one lamp position: its lit sources summed in candela.
// Computes: the sum of bilinear tables. On the union of the nodes of tables that share type, axis and aim that sum is
// exact (each table is bilinear in every cell of the union); tables that do not share them are sampled by direction.
// Sources: Kim et al. 2002 (US patent 7024034) for the Planckian locus, IEC 61966-2-1 for the sRGB primaries.
// Frame: angles of the image in the first lit source's lamp frame; `car_from_image` turns it into the car.
// Leaves out: colour over direction within one source (files have none).
// Checked by tests/photometry/beam_image_test.cpp.
#include "visual/photometry/beam/beam_image.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <iterator>

#include "config/rig.h"

namespace phare {
namespace {

/// Where a table ends with light (its limit belongs to it) and another goes on, the sum falls to the other's value over
/// this angle. Wide enough for float32 nodes and for look-up tables of the GPU, far below any test point's tolerance.
constexpr double kLimitStep_deg = 0.01;

bool same_aim(const glm::dmat3& a, const glm::dmat3& b) {
  constexpr double kAlike = 1e-12;  // of a direction cosine: 1e-12 rad
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      if (std::abs(a[column][row] - b[column][row]) > kAlike) return false;
    }
  }
  return true;
}

/// Sorted, each value once, none closer than `gap` to the one before unless gap is 0.
void sort_unique(std::vector<double>& nodes, double gap) {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end(), [gap](double kept, double next) { return next - kept <= gap; }),
              nodes.end());
}

/// Does the table shine on one of its limits? `first` chooses the axis, `upper` the end.
bool lit_limit(const IntensityTable& table, bool first, bool upper) {
  const std::size_t columns = table.first_deg.size();
  const std::size_t rows = table.second_deg.size();
  for (std::size_t k = 0; k < (first ? rows : columns); ++k) {
    const std::size_t i = first ? (upper ? columns - 1 : 0) : k;
    const std::size_t j = first ? k : (upper ? rows - 1 : 0);
    if (table.candela[j * columns + i] > 0.0) return true;
  }
  return false;
}

std::vector<double> union_nodes(std::span<const AimedSource> lit, bool first) {
  std::vector<double> nodes;
  for (const AimedSource& source : lit) {
    const auto& own = first ? source.table->first_deg : source.table->second_deg;
    nodes.insert(nodes.end(), own.begin(), own.end());
  }
  sort_unique(nodes, 0.0);
  const double low = nodes.front();
  const double high = nodes.back();
  for (const AimedSource& source : lit) {
    const auto& own = first ? source.table->first_deg : source.table->second_deg;
    if (own.front() > low && lit_limit(*source.table, first, false)) nodes.push_back(own.front() - kLimitStep_deg);
    if (own.back() < high && lit_limit(*source.table, first, true)) nodes.push_back(own.back() + kLimitStep_deg);
  }
  sort_unique(nodes, 0.0);
  return nodes;
}

/// Widest step of a resampled grid at this distance from the axis, degrees. Across a cut-off light changes by a factor
/// of up to 2.5 in 0.1° of V. Measured on our passing and driving beam aimed 0.2° apart and rolled by 1°
/// (beam_image_test.cpp): worst error 0.17 % of the peak, and 1.6 % of the local intensity above 100 cd; 0.05° in V
/// makes that 0.32 % and 3.1 %.
double widest_step_deg(double angle_deg, bool first) {
  const double a = std::abs(angle_deg);
  if (!first && a < 3.0) return 0.025;
  return a < 5.0 ? 0.05 : a < 10.0 ? 0.1 : a < 30.0 ? 0.5 : 2.5;
}

/// Nodes of a resampled type A grid: those of every type A source, seen in the image near its axis, and steps in
/// between.
std::vector<double> resampled_nodes(std::span<const AimedSource> lit, const glm::dmat3& image_from_car, bool first) {
  std::vector<double> seed{first ? -180.0 : -90.0, 0.0, first ? 180.0 : 90.0};
  for (const AimedSource& source : lit) {
    if (source.table->type == PhotometricType::kC) continue;
    const glm::dmat3 image_from_lamp = image_from_car * source.car_from_lamp;
    for (const double angle : first ? source.table->first_deg : source.table->second_deg) {
      if (std::abs(angle) > 60.0) continue;  // far out the lines of two aims cross; plain steps do there
      const glm::dvec3 direction = image_from_lamp * (first ? direction_hv(angle, 0.0) : direction_hv(0.0, angle));
      const TableAngles seen = table_angles(PhotometricType::kA, GammaAxis::kGamma0, direction);
      seed.push_back(first ? seen.first_deg : seen.second_deg);
    }
  }
  sort_unique(seed, kLimitStep_deg);
  std::vector<double> nodes;
  for (std::size_t i = 0; i + 1 < seed.size(); ++i) {
    nodes.push_back(seed[i]);
    while (true) {
      const double step = widest_step_deg(nodes.back(), first);
      if (seed[i + 1] - nodes.back() <= step) break;
      const double left = seed[i + 1] - nodes.back();
      nodes.push_back(left < 2.0 * step ? nodes.back() + 0.5 * left : nodes.back() + step);
    }
  }
  nodes.push_back(seed.back());
  return nodes;
}

/// Flux-weighted mean colour. Every colour has luminance 1, so the mean has, too.
glm::vec3 mean_colour(const std::vector<AimedSource>& lit) {
  glm::dvec3 sum{0.0};
  double weight = 0.0;
  for (const AimedSource& source : lit) {
    const double lumens = source.scale * source.table->flux_lm();
    sum += lumens * glm::dvec3(light_colour(source));
    weight += lumens;
  }
  return weight > 0.0 ? glm::vec3(sum / weight) : glm::vec3{1.0f};
}

}  // namespace

glm::dmat3 aim_rotation(double yaw_rad, double pitch_rad, double roll_rad) {
  const double cy = std::cos(yaw_rad), sy = std::sin(yaw_rad);
  const double cp = std::cos(pitch_rad), sp = std::sin(pitch_rad);
  const double cr = std::cos(roll_rad), sr = std::sin(roll_rad);
  return {glm::dvec3{cy * cp, sy * cp, sp},                                       // forward: pitch > 0 is up
          glm::dvec3{-cy * sp * sr - sy * cr, -sy * sp * sr + cy * cr, cp * sr},  // left: rises with roll > 0
          glm::dvec3{-cy * sp * cr + sy * sr, -sy * sp * cr - cy * sr, cp * cr}};
}

bool same_angles(const AimedSource& a, const AimedSource& b) {
  return (a.table->screen_distance_m > 0.0) == (b.table->screen_distance_m > 0.0) && a.table->type == b.table->type &&
         (a.table->type != PhotometricType::kC || a.table->axis == b.table->axis) &&
         same_aim(a.car_from_lamp, b.car_from_lamp);
}

BeamGrid beam_grid(std::span<const AimedSource> sources) {
  BeamGrid grid;
  grid.car_from_image = sources.front().car_from_lamp;
  grid.resampled = !std::all_of(sources.begin(), sources.end(),
                                [&](const AimedSource& s) { return same_angles(s, sources.front()); });
  if (grid.resampled) {
    const glm::dmat3 image_from_car = glm::transpose(grid.car_from_image);
    grid.first_deg = resampled_nodes(sources, image_from_car, true);
    grid.second_deg = resampled_nodes(sources, image_from_car, false);
  } else {
    grid.type = sources.front().table->type;
    grid.axis = sources.front().table->axis;
    grid.screen_distance_m = sources.front().table->screen_distance_m;
    grid.first_deg = union_nodes(sources, true);
    grid.second_deg = union_nodes(sources, false);
  }
  return grid;
}

BeamImage compose_beam_image(std::span<const AimedSource> sources) {
  std::vector<AimedSource> lit;
  for (const AimedSource& source : sources) {
    if (source.table != nullptr && source.scale > 0.0 && source.table->peak_cd() > 0.0) lit.push_back(source);
  }
  BeamImage image;
  if (lit.empty()) {
    if (!sources.empty()) image.car_from_image = sources.front().car_from_lamp;
    image.first_deg = {-1.0, 1.0};
    image.second_deg = {-1.0, 1.0};
    image.candela.assign(4, 0.0f);
    return image;
  }

  static_cast<BeamGrid&>(image) = beam_grid(lit);
  image.dark = false;
  image.colour = mean_colour(lit);
  const std::size_t columns = image.first_deg.size();
  std::vector<double> sum(columns * image.second_deg.size(), 0.0);
  for (const AimedSource& source : lit) {
    const glm::dmat3 lamp_from_image = glm::transpose(source.car_from_lamp) * image.car_from_image;
    for (std::size_t j = 0; j < image.second_deg.size(); ++j) {
      for (std::size_t i = 0; i < columns; ++i) {
        const TableAngles angles{image.first_deg[i], image.second_deg[j]};
        sum[j * columns + i] +=
            source.scale *
            (image.resampled
                 ? source.table->intensity_cd(lamp_from_image * direction_hv(angles.first_deg, angles.second_deg))
                 : source.table->intensity_at_cd(angles));
      }
    }
  }
  const bool mixed = std::ranges::any_of(
      lit, [&](const AimedSource& source) { return light_colour(source) != light_colour(lit.front()); });
  std::vector<glm::dvec2> tints(mixed ? sum.size() : 0);
  for (std::size_t k = 0; k < lit.size() && mixed; ++k) {
    const glm::dvec3 colour = light_colour(lit[k]);
    const glm::dmat3 lamp_from_image = glm::transpose(lit[k].car_from_lamp) * image.car_from_image;
    for (std::size_t at = 0; at < sum.size(); ++at) {
      const TableAngles angles{image.first_deg[at % columns], image.second_deg[at / columns]};
      const double cd =
          image.resampled
              ? lit[k].table->intensity_cd(lamp_from_image * direction_hv(angles.first_deg, angles.second_deg))
              : lit[k].table->intensity_at_cd(angles);
      tints[at] += lit[k].scale * cd * glm::dvec2(colour.x, colour.z);
    }
  }
  image.tints.assign(tints.begin(), tints.end());
  image.candela.reserve(sum.size());
  std::transform(sum.begin(), sum.end(), std::back_inserter(image.candela),
                 [](double cd) { return static_cast<float>(cd); });
  return image;
}

glm::vec3 light_colour(const AimedSource& source) {
  return source.chromaticity_xy ? chromaticity_colour(*source.chromaticity_xy)
                                : black_body_colour(source.colour_temperature_k);
}

glm::vec3 black_body_colour(double temperature_k) {
  const double t = std::clamp(temperature_k, kCoolestSource_k, kHottestSource_k);
  const double x = t <= 4000.0 ? -0.2661239e9 / (t * t * t) - 0.2343589e6 / (t * t) + 0.8776956e3 / t + 0.179910
                               : -3.0258469e9 / (t * t * t) + 2.1070379e6 / (t * t) + 0.2226347e3 / t + 0.240390;
  const double y = t <= 2222.0   ? ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
                   : t <= 4000.0 ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
                                 : ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
  return chromaticity_colour({x, y});
}

double reflectance_under_a(const glm::vec3& reflectance) {
  const glm::dvec3 seen = glm::dvec3(reflectance) * glm::dvec3(black_body_colour(2856.0));
  return std::max(0.2126 * seen.x + 0.7152 * seen.y + 0.0722 * seen.z, 1e-3);
}

glm::vec3 chromaticity_colour(glm::dvec2 xy) {
  const double big_x = xy.x / xy.y;  // of luminance Y = 1
  const double big_z = (1.0 - xy.x - xy.y) / xy.y;
  glm::dvec3 rgb{3.2406 * big_x - 1.5372 - 0.4986 * big_z, -0.9689 * big_x + 1.8758 + 0.0415 * big_z,
                 0.0557 * big_x - 0.2040 + 1.0570 * big_z};
  rgb = glm::max(rgb, glm::dvec3{0.0});  // so does a black body's blue below 1900 K
  return glm::vec3(rgb / (0.2126 * rgb.x + 0.7152 * rgb.y + 0.0722 * rgb.z));
}

}  // namespace phare
