#include "tools/scene/lane_files.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace phare::scene {

namespace {

/// Arc length of the lane per metre of centreline: a line at offset t is 1 - t·curvature times as long.
double lane_scale(double s) {
  return 1.0 - kLaneCentre_m * curvature_1pm(s);
}

/// Arc length of the lane at a station; the integral of lane_scale is exact through the heading.
double lane_s_m(double station) {
  return station - kLaneCentre_m * (heading_rad(station) - heading_rad(0.0));
}

double station_of_lane(double lane_s) {
  double s = lane_s;
  for (int i = 0; i < 8; ++i) s -= (lane_s_m(s) - lane_s) / lane_scale(s);  // Newton; the scale is within 1 % of 1
  return s;
}

double rounded_cm(double s) {
  return std::round(100.0 * lane_s_m(s)) / 100.0;
}

}  // namespace

std::string lane_csv(const Alignment& road) {
  std::string text = "s_m,x_m,y_m,z_m,heading_rad,curvature_1pm\n";
  const int last = static_cast<int>(lane_s_m(kLength_m));
  for (int i = 0; i <= last; ++i) {
    const double s = station_of_lane(i);
    const glm::dvec3 p = road.point(s, kLaneCentre_m);
    char line[160];
    std::snprintf(line, sizeof line, "%d,%.6f,%.6f,%.6f,%.9f,%.9f\n", i, p.x, p.y, p.z, heading_rad(s),
                  curvature_1pm(s) / lane_scale(s));
    text += line;
  }
  return text;
}

std::string places_json(const Alignment& road) {
  nlohmann::ordered_json places;
  const auto spot = [&](const char* name, double s, double t, const char* what) {
    const glm::dvec3 p = road.point(s, t);
    places[name] = {{"s_m", rounded_cm(s)}, {"offset_m", t}, {"x_m", p.x}, {"y_m", p.y}, {"z_m", p.z}, {"what", what}};
  };
  const auto stretch = [&](const char* name, double begin, double end, const char* what) {
    places[name] = {{"begin_s_m", rounded_cm(begin)}, {"end_s_m", rounded_cm(end)}, {"what", what}};
  };
  places["lane_file"] = "country_road_lane.csv";
  places["length_m"] = lane_s_m(kLength_m);
  spot("start", 20.0, kLaneCentre_m, "where a drive begins; straight until s = 300");
  spot("pedestrian_1", kPedestrian1_m, -4.6, "dark clothes, on the right verge");
  spot("car_parked", kParkedCar_m, -5.2, "lay-by on the right");
  stretch("curve_1", kFirstBend.begin_m, kFirstBend.end_m, "left, radius 200 m between s = 380 and 520");
  spot("barn", kBarn_m, -13.0, "right, outside of curve_1; its light wall faces a driver at s = 425");
  spot("pedestrian_2", kPedestrian2_m, -4.1, "steps out from the right, clear of the lane");
  stretch("crest", kCrest.begin_m, kCrest.end_m, "6 m high; brake before it");
  spot("crest_top", kCrest.middle_m(), kLaneCentre_m, "vertical radius 625 m");
  spot("cyclist", kCyclist_m, -3.55, "on the right edge behind the crest");
  stretch("dip", kDip.begin_m, kDip.end_m, "4 m deep");
  spot("dip_bottom", kDip.middle_m(), kLaneCentre_m, "vertical radius 504 m");
  stretch("rail_dip", kRailDipBegin_m, kRailDipEnd_m, "guard rail on the right");
  stretch("curve_2", kSecondBend.begin_m, kSecondBend.end_m, "right, radius 180 m between s = 1300 and 1440");
  stretch("rail_curve_2", kRailBendBegin_m, kRailBendEnd_m,
          "guard rail on the left, outside of curve_2, with chevrons");
  stretch("wood", kWoodBegin_m, kWoodEnd_m, "trees close to the road on both sides");
  spot("end", kLength_m - 20.0, kLaneCentre_m, "stop before it");
  return places.dump(2) + "\n";
}

}  // namespace phare::scene
