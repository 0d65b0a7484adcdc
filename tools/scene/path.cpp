#include "tools/scene/path.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "tools/scene/parts.h"

namespace phare::scene {

Path::Path(double length_m, double margin_m, std::vector<PathBend> bends)
    : length_m_(length_m), margin_m_(margin_m), bends_(std::move(bends)) {
  // Straight before 0. Heading is exact at the knots' middles: the curvature's integral by Simpson's rule.
  glm::dvec3 knot(-margin_m - 2.0, 0.0, 0.0);
  for (double s = -margin_m - 2.0; s < length_m + margin_m + 3.0; s += 1.0) {
    knots_.push_back(knot);
    const double turn = (curvature_1pm(s) + 4.0 * curvature_1pm(s + 0.5) + curvature_1pm(s + 1.0)) / 6.0;
    const double middle = knot.z + 0.5 * turn;
    knot += glm::dvec3(std::cos(middle), std::sin(middle), turn);
  }
}

double Path::curvature_1pm(double s_m) const {
  double sum = 0.0;
  for (const PathBend& bend : bends_) {
    if (s_m <= bend.begin_m || s_m >= bend.end_m) continue;
    const double part = (s_m - bend.begin_m) / (bend.end_m - bend.begin_m);
    sum += 0.5 * (1.0 - std::cos(2.0 * std::numbers::pi * part)) / bend.radius_m;
  }
  return sum;
}

double Path::heading_rad(double s_m) const {
  const double at = std::clamp(s_m + margin_m_ + 2.0, 0.0, static_cast<double>(knots_.size()) - 1.001);
  const auto i = static_cast<std::size_t>(at);
  return std::lerp(knots_[i].z, knots_[i + 1].z, at - std::floor(at));
}

glm::dvec3 Path::point(double s_m, double t_m, double z_m) const {
  const double at = std::clamp(s_m + margin_m_ + 2.0, 0.0, static_cast<double>(knots_.size()) - 1.001);
  const auto i = static_cast<std::size_t>(at);
  const double part = at - std::floor(at), heading = heading_rad(s_m);
  return {std::lerp(knots_[i].x, knots_[i + 1].x, part) - t_m * std::sin(heading),
          std::lerp(knots_[i].y, knots_[i + 1].y, part) + t_m * std::cos(heading), z_m};
}

glm::dmat4 placed_at(glm::dvec3 point, double heading) {
  return glm::rotate(glm::translate(glm::dmat4(1.0), point), heading, glm::dvec3(0.0, 0.0, 1.0));
}

glm::dmat4 Path::placed(double s_m, double t_m, double turn_rad, double z_m) const {
  return placed_at(point(s_m, t_m, z_m), heading_rad(s_m) + turn_rad);
}

std::string Path::lane_csv(double t_m) const {
  std::string text = "s_m,x_m,y_m,z_m,heading_rad,curvature_1pm\n";
  double station = 0.0;
  for (int i = 0; station <= length_m_; ++i) {
    const glm::dvec3 p = point(station, t_m);
    const double scale = 1.0 - t_m * curvature_1pm(station);
    char line[160];
    std::snprintf(line, sizeof line, "%d,%.6f,%.6f,%.6f,%.9f,%.9f\n", i, p.x, p.y, p.z, heading_rad(station),
                  curvature_1pm(station) / scale);
    text += line;
    // A metre of the line's own length: by the scale half way.
    station += 1.0 / (1.0 - t_m * curvature_1pm(station + 0.5 / scale));
  }
  return text;
}

void add_strip(Node& node, Material material, const Path& path, double begin, double end, double step, StripLine right,
               StripLine left) {
  const int count = std::max(1, static_cast<int>(std::ceil((end - begin) / step - 1e-9)));
  Pen pen(node, glm::dmat4(1.0));
  for (int i = 0; i < count; ++i) {
    const double a = begin + (end - begin) * i / count, b = begin + (end - begin) * (i + 1) / count;
    pen.quad(material, path.point(a, right.t_m, right.z_m), path.point(b, right.t_m, right.z_m),
             path.point(b, left.t_m, left.z_m), path.point(a, left.t_m, left.z_m));
  }
}

void each_piece(const Path& path, const std::function<void(int number, double begin, double end)>& piece) {
  int number = 0;
  for (double begin = path.begin_m(); begin < path.end_m() - 1e-6; begin += kPiece_m)
    piece(number++, begin, std::min(begin + kPiece_m, path.end_m()));
}

std::string numbered_node(const char* kind, int number) {
  char name[48];
  std::snprintf(name, sizeof name, "%s_%03d", kind, number);
  return name;
}

std::string street_lamps_toml(const char* heading, const std::vector<MadeLuminaire>& luminaires,
                              const std::vector<MadeLamp>& lamps) {
  std::string text = std::string("# ") + heading + "\nfineness = \"fine\"\n";
  char line[200];
  for (const MadeLuminaire& kind : luminaires) {
    std::snprintf(line, sizeof line, "\n[[luminaire]]\nname = \"%s\"\nfile = \"%s\"\ncolour_temperature_k = %.0f\n",
                  kind.name, kind.file, kind.colour_temperature_k);
    text += line;
  }
  for (const MadeLamp& lamp : lamps) {
    std::snprintf(line, sizeof line,
                  "\n[[lamp]]\nluminaire = \"%s\"\nposition_m = [%.3f, %.3f, %.3f]\nyaw_deg = %.3f\ntilt_deg = %.1f\n",
                  lamp.luminaire, lamp.position_m.x, lamp.position_m.y, lamp.position_m.z,
                  std::remainder(lamp.yaw_rad, 2.0 * std::numbers::pi) * 180.0 / std::numbers::pi,
                  lamp.tilt_rad * 180.0 / std::numbers::pi);
    text += line;
  }
  return text;
}

}  // namespace phare::scene
