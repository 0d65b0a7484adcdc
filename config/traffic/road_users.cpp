#include "config/traffic/road_users.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "config/base/paths.h"
#include "config/formats/toml_table.h"

namespace phare {
namespace {

// In the order of the enums.
constexpr std::array<std::string_view, 6> kClasses{"car",     "lorry",      "motorcycle",
                                                   "bicycle", "pedestrian", "deer"};
constexpr std::array<std::string_view, 3> kDirections{"oncoming", "same", "standing"};
constexpr std::array<std::string_view, 3> kLights{"off", "low", "high"};
constexpr std::array<double, 3> kAlongLane{-1.0, 1.0, 0.0};

struct Size {
  double width_m, height_m, length_m;
};
// Usual sizes, chosen by eye.
constexpr std::array<Size, 6> kSizes{
    {{1.8, 1.5, 4.3}, {2.5, 3.6, 10.0}, {0.8, 1.4, 2.1}, {0.6, 1.7, 1.8}, {0.5, 1.75, 0.4}, {0.3, 1.1, 1.2}}};

// Bounds that no road reaches: they catch a mistyped exponent. python/phare/control/road_users.py has the same.
constexpr double kFarthest_m = 1e6, kFastest_kmh = 1000.0, kLongest_s = 1e9, kSmallest_m = 0.01, kLargest_m = 100.0;

/// Whether a lamp key may stand where it does: only who has headlamps has files of them, and a high beam.
void expect_headlamps(TomlTable& table, const char* key, RoadUserClass kind) {
  if (kind == RoadUserClass::car || kind == RoadUserClass::lorry || kind == RoadUserClass::motorcycle) return;
  table.fail(key, "a " + std::string(kClasses[static_cast<std::size_t>(kind)]) + " has no headlamps");
}

RoadUserLights lights_of(TomlTable& table, RoadUserClass kind) {
  // Asked for as a flag where it is no text, so that what is neither is told.
  const bool text = table.is_text("lights");
  const auto lights = text ? static_cast<RoadUserLights>(table.choice("lights", kLights))
                           : (table.flag_or("lights", true) ? RoadUserLights::low : RoadUserLights::off);
  if (lights == RoadUserLights::high) expect_headlamps(table, "lights", kind);
  return kind == RoadUserClass::pedestrian || kind == RoadUserClass::deer ? RoadUserLights::off : lights;
}

/// Empty where it is not named.
std::filesystem::path lamp_file_of(TomlTable& table, const char* key, RoadUserClass kind) {
  if (table.text_or(key, "").empty()) {
    if (table.is_text(key)) table.fail(key, "expected the name of a file");
    return {};
  }
  expect_headlamps(table, key, kind);
  const std::filesystem::path file = resolve_path(table.text(key), table.file());
  std::error_code unreadable;
  if (!std::filesystem::is_regular_file(file, unreadable)) table.fail(key, file.string() + ": no such file");
  return file;
}

RoadUser road_user_of(TomlTable table) {
  RoadUser user;
  const std::size_t kind = table.choice_or("class", 0, kClasses);
  user.kind = static_cast<RoadUserClass>(kind);
  user.direction = static_cast<RoadUserDirection>(table.choice_or("direction", 0, kDirections));
  user.start_s_m = table.number_or("start_s_m", 0.0, -kFarthest_m, kFarthest_m);
  user.speed_mps = table.number_or("speed_kmh", 0.0, 0.0, kFastest_kmh) / 3.6;
  user.offset_m = table.number_or("offset_m", 0.0, -kFarthest_m, kFarthest_m);
  user.across_mps = table.number_or("across_kmh", 0.0, -kFastest_kmh, kFastest_kmh) / 3.6;
  user.across_from_s = table.number_or("across_from_s", 0.0, -kLongest_s, kLongest_s);
  if (table.has("across_to_s")) user.across_to_s = table.number("across_to_s", user.across_from_s, kLongest_s);
  user.lights = lights_of(table, user.kind);
  user.low_beam_file = lamp_file_of(table, "low_beam", user.kind);
  user.high_beam_file = lamp_file_of(table, "high_beam", user.kind);
  user.from_s = table.number_or("from_s", 0.0, -kLongest_s, kLongest_s);
  if (table.has("to_s")) user.to_s = table.number("to_s", -kLongest_s, kLongest_s);
  user.width_m = table.number_or("width_m", kSizes[kind].width_m, kSmallest_m, kLargest_m);
  user.height_m = table.number_or("height_m", kSizes[kind].height_m, kSmallest_m, kLargest_m);
  user.length_m = table.number_or("length_m", kSizes[kind].length_m, kSmallest_m, kLargest_m);
  return user;
}

}  // namespace

Result<std::vector<RoadUser>> read_road_users(const std::filesystem::path& file) {
  auto document = TomlTable::read(file);
  if (!document) return document.error();
  std::vector<RoadUser> users;
  for (const TomlTable& table : document->tables("road_user")) users.push_back(road_user_of(table));
  if (!document->has("road_user")) document->fail("road_user", "expected [[road_user]]");
  const Status read = document->finish();
  if (!read) return read.error();
  return users;
}

LaneLine::LaneLine(std::vector<LanePoint> points) : points_(std::move(points)) {
  assert(points_.size() >= 2);
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const double before = points_[i - 1].heading_rad;
    points_[i].heading_rad = before + std::remainder(points_[i].heading_rad - before, 2.0 * std::numbers::pi);
  }
}

std::optional<LanePoint> LaneLine::at(double s_m, double offset_m) const {
  if (!(s_m >= points_.front().s_m && s_m <= points_.back().s_m)) return std::nullopt;
  const auto behind = std::ranges::upper_bound(points_, s_m, {}, &LanePoint::s_m);
  const LanePoint& b = behind == points_.end() ? points_.back() : *behind;
  const LanePoint& a = *(&b - 1);
  const auto between = [&](double LanePoint::*of) { return a.*of + (b.*of - a.*of) / (b.s_m - a.s_m) * (s_m - a.s_m); };
  LanePoint found{.s_m = s_m,
                  .x_m = between(&LanePoint::x_m),
                  .y_m = between(&LanePoint::y_m),
                  .z_m = between(&LanePoint::z_m),
                  .heading_rad = between(&LanePoint::heading_rad),
                  .curvature_1pm = between(&LanePoint::curvature_1pm)};
  found.x_m -= offset_m * std::sin(found.heading_rad);
  found.y_m += offset_m * std::cos(found.heading_rad);
  return found;
}

std::optional<RoadUserPose> pose_of(const RoadUser& user, const LaneLine& lane, double time_s) {
  if (!(time_s >= user.from_s && time_s <= user.to_s)) return std::nullopt;
  const double along = kAlongLane[static_cast<std::size_t>(user.direction)];
  const double going_across_s = std::clamp(time_s, user.across_from_s, user.across_to_s) - user.across_from_s;
  const auto place =
      lane.at(user.start_s_m + along * user.speed_mps * time_s, user.offset_m + user.across_mps * going_across_s);
  if (!place) return std::nullopt;
  const bool against = user.direction == RoadUserDirection::oncoming;
  const bool goes_across = user.across_mps != 0.0 && time_s >= user.across_from_s && time_s < user.across_to_s;
  // Looks along its way; who stands until it goes across looks across before and after it too.
  double turn = against ? std::numbers::pi : 0.0;
  const double along_mps = along * user.speed_mps;
  if (goes_across || (user.across_mps != 0.0 && along_mps == 0.0)) turn = std::atan2(user.across_mps, along_mps);
  return RoadUserPose{.s_m = place->s_m,
                      .x_m = place->x_m,
                      .y_m = place->y_m,
                      .z_m = place->z_m,
                      .heading_rad = place->heading_rad + turn,
                      .speed_mps = std::hypot(along_mps, goes_across ? user.across_mps : 0.0)};
}

}  // namespace phare
