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

#include "config/base/input_files.h"
#include "config/base/paths.h"
#include "config/formats/toml_table.h"
#include "config/traffic/bounds.h"

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

constexpr double kFarthest_m = kFarthestOfRoadUsers_m, kFastest_kmh = kFastestOfRoadUsers_kmh;
constexpr double kLongest_s = kLongestOfRoadUsers_s, kSmallest_m = 0.01, kLargest_m = 100.0;

/// Whether a lamp key may stand where it does: only who has such lamps has files of them, and a state.
void expect_lamps(TomlTable& table, const char* key, RoadUserClass kind, bool has, const char* lamps) {
  if (!has) table.fail(key, "a " + std::string(kClasses[static_cast<std::size_t>(kind)]) + " has no " + lamps);
}

RoadUserLights lights_of(TomlTable& table, RoadUserClass kind) {
  // Asked for as a flag where it is no text, so that what is neither is told.
  const bool text = table.is_text("lights");
  const auto lights = text ? static_cast<RoadUserLights>(table.choice("lights", kLights))
                           : (table.flag_or("lights", true) ? RoadUserLights::low : RoadUserLights::off);
  if (lights == RoadUserLights::high) expect_lamps(table, "lights", kind, has_motor(kind), "high beam");
  const bool none = kind == RoadUserClass::pedestrian || kind == RoadUserClass::deer;
  if (table.has("lights") && lights == RoadUserLights::low) expect_lamps(table, "lights", kind, !none, "lights");
  return none ? RoadUserLights::off : lights;
}

std::filesystem::path lamp_file_of(TomlTable& table, const char* key) {
  const std::string name = table.text(key);
  const std::filesystem::path file = resolve_path(name, table.file());
  if (name.empty())
    table.fail(key, "expected the name of a file");
  else if (const std::string why = why_no_file(file); !why.empty())
    table.fail(key, file.string() + ": " + why);
  return file;
}

/// A file's name, or a table of that and of a colour.
RoadUserLamp lamp_of(TomlTable& table, const char* key, RoadUserClass kind, bool has, const char* lamps) {
  if (!table.has(key)) return {};
  expect_lamps(table, key, kind, has, lamps);
  if (table.is_text(key)) return {.file = lamp_file_of(table, key)};
  TomlTable lamp = table.table(key);
  return {.file = lamp.has("file") ? lamp_file_of(lamp, "file") : std::filesystem::path(),
          .colour = read_light_colour(lamp)};
}

std::vector<SpeedAt> speeds_of(TomlTable& table, RoadUserDirection direction) {
  std::vector<SpeedAt> speeds;
  if (!table.has("speeds")) return speeds;
  if (table.has("speed_kmh")) table.fail("speeds", "there is speed_kmh, too; one of both");
  if (direction == RoadUserDirection::standing) table.fail("speeds", "who is standing has none");
  for (const std::vector<double>& row : table.rows_or_empty("speeds", 2)) {
    if (std::abs(row[0]) > kLongest_s) table.fail("speeds", "a time is outside -1e9 … 1e9 s");
    if (!(row[1] >= 0.0 && row[1] <= kFastest_kmh)) table.fail("speeds", "a speed is outside 0 … 1000 km/h");
    if (!speeds.empty() && !(row[0] > speeds.back().time_s)) table.fail("speeds", "times do not rise");
    speeds.push_back({row[0], row[1] / 3.6});
  }
  return speeds;
}

/// Of a user that is otherwise read.
void take_path(TomlTable& table, RoadUser& user) {
  if (!table.has("path")) return;
  for (const char* key :
       {"direction", "start_s_m", "speed_kmh", "speeds", "offset_m", "across_kmh", "across_from_s", "across_to_s"})
    if (table.has(key)) table.fail(key, "there is a path, too, which says where it is; one of both");
  if (table.text("path").empty()) return table.fail("path", "expected the name of a file");
  auto path = RecordedPath::read(resolve_path(table.text("path"), table.file()));
  if (!path) return table.fail("path", path.error().text());
  user.path = std::move(*path);
  user.from_s = std::max(user.from_s, user.path->from_s());
  user.to_s = std::min(user.to_s, user.path->to_s());
}

/// How far it has come since time 0, by its speeds: 0 or more after it.
double way_m(const std::vector<SpeedAt>& speeds, double time_s) {
  // From the first time on, which may be before 0 or behind it.
  const auto since_first_m = [&](double until_s) {
    double m = std::min(until_s - speeds.front().time_s, 0.0) * speeds.front().speed_mps;
    for (std::size_t i = 1; i < speeds.size() && until_s > speeds[i - 1].time_s; ++i) {
      const SpeedAt &a = speeds[i - 1], &b = speeds[i];
      const double here_s = std::min(until_s, b.time_s) - a.time_s;
      m += (a.speed_mps + 0.5 * (b.speed_mps - a.speed_mps) / (b.time_s - a.time_s) * here_s) * here_s;
    }
    return m + std::max(until_s - speeds.back().time_s, 0.0) * speeds.back().speed_mps;
  };
  return since_first_m(time_s) - since_first_m(0.0);
}

double speed_mps(const std::vector<SpeedAt>& speeds, double time_s) {
  const auto behind = std::ranges::upper_bound(speeds, time_s, {}, &SpeedAt::time_s);
  if (behind == speeds.begin()) return behind->speed_mps;
  const SpeedAt& a = *(behind - 1);
  if (behind == speeds.end()) return a.speed_mps;
  return a.speed_mps + (behind->speed_mps - a.speed_mps) / (behind->time_s - a.time_s) * (time_s - a.time_s);
}

bool slows_down(const RoadUser& user, double time_s) {
  double from_s = time_s - 0.5 * kBrakesWithin_s, to_s = time_s + 0.5 * kBrakesWithin_s;
  if (user.path) {
    from_s = std::max(from_s, user.path->from_s()), to_s = std::min(to_s, user.path->to_s());
    return user.path->at(from_s).speed_mps - user.path->at(to_s).speed_mps > kBrakes_mps2 * (to_s - from_s);
  }
  if (user.speeds.empty()) return false;
  return speed_mps(user.speeds, from_s) - speed_mps(user.speeds, to_s) > kBrakes_mps2 * (to_s - from_s);
}

bool brakes(const RoadUser& user, double time_s) {
  return has_motor(user.kind) && (user.brake ? *user.brake : slows_down(user, time_s));
}

RoadUser road_user_of(TomlTable table) {
  RoadUser user;
  const std::size_t kind = table.choice_or("class", 0, kClasses);
  user.kind = static_cast<RoadUserClass>(kind);
  user.direction = static_cast<RoadUserDirection>(table.choice_or("direction", 0, kDirections));
  user.start_s_m = table.number_or("start_s_m", 0.0, -kFarthest_m, kFarthest_m);
  user.speed_mps = table.number_or("speed_kmh", 0.0, 0.0, kFastest_kmh) / 3.6;
  if (user.direction == RoadUserDirection::standing && user.speed_mps != 0.0)
    table.fail("speed_kmh", "who is standing has none");
  user.speeds = speeds_of(table, user.direction);
  user.offset_m = table.number_or("offset_m", 0.0, -kFarthest_m, kFarthest_m);
  user.across_mps = table.number_or("across_kmh", 0.0, -kFastest_kmh, kFastest_kmh) / 3.6;
  user.across_from_s = table.number_or("across_from_s", 0.0, -kLongest_s, kLongest_s);
  if (table.has("across_to_s")) user.across_to_s = table.number("across_to_s", user.across_from_s, kLongest_s);
  for (const char* key : {"across_from_s", "across_to_s"})
    if (table.has(key) && user.across_mps == 0.0) table.fail(key, "nobody goes across: there is no across_kmh");
  user.lights = lights_of(table, user.kind);
  if (table.has("brake")) {
    user.brake = table.flag_or("brake", false);
    expect_lamps(table, "brake", user.kind, has_motor(user.kind), "brake lamps");
  }
  const bool motor = has_motor(user.kind), lamps = motor || user.kind == RoadUserClass::bicycle;
  user.low_beam = lamp_of(table, "low_beam", user.kind, lamps, "headlamps");
  user.high_beam = lamp_of(table, "high_beam", user.kind, motor, lamps ? "high beam" : "headlamps");
  user.tail_lamp = lamp_of(table, "tail_lamp", user.kind, lamps, "tail lamps");
  user.brake_lamp = lamp_of(table, "brake_lamp", user.kind, motor, "brake lamps");
  user.third_brake_lamp =
      lamp_of(table, "third_brake_lamp", user.kind, user.kind == RoadUserClass::car, "third brake lamp");
  user.from_s = table.number_or("from_s", 0.0, -kLongest_s, kLongest_s);
  if (table.has("to_s")) user.to_s = table.number("to_s", user.from_s, kLongest_s);
  take_path(table, user);
  user.width_m = table.number_or("width_m", kSizes[kind].width_m, kSmallest_m, kLargest_m);
  user.height_m = table.number_or("height_m", kSizes[kind].height_m, kSmallest_m, kLargest_m);
  user.length_m = table.number_or("length_m", kSizes[kind].length_m, kSmallest_m, kLargest_m);
  return user;
}

}  // namespace

bool has_motor(RoadUserClass kind) {
  return kind == RoadUserClass::car || kind == RoadUserClass::lorry || kind == RoadUserClass::motorcycle;
}

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

LanePoint LaneLine::nearest(double x_m, double y_m) const {
  double best_m2 = std::numeric_limits<double>::infinity(), best_s_m = points_.front().s_m;
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const LanePoint &a = points_[i - 1], &b = points_[i];
    const double along_x = b.x_m - a.x_m, along_y = b.y_m - a.y_m;
    const double square = along_x * along_x + along_y * along_y;
    const double foot = ((x_m - a.x_m) * along_x + (y_m - a.y_m) * along_y) / square;
    const double share = square > 0.0 ? std::clamp(foot, 0.0, 1.0) : 0.0;
    const double off_x = a.x_m + share * along_x - x_m, off_y = a.y_m + share * along_y - y_m;
    const double m2 = off_x * off_x + off_y * off_y;
    if (m2 < best_m2) best_m2 = m2, best_s_m = a.s_m + share * (b.s_m - a.s_m);
  }
  return *at(std::clamp(best_s_m, points_.front().s_m, points_.back().s_m), 0.0);
}

namespace {

std::optional<RoadUserPose> pose_on_path(const RecordedPath& path, const LaneLine& lane, double time_s) {
  const RecordedPath::Place now = path.at(time_s);
  if (path.on_lane()) {
    const auto place = lane.at(now.first_m, now.second_m);
    if (!place) return std::nullopt;
    return RoadUserPose{.s_m = place->s_m,
                        .x_m = place->x_m,
                        .y_m = place->y_m,
                        .z_m = place->z_m,
                        .heading_rad = place->heading_rad + now.heading_rad,
                        .speed_mps = now.speed_mps};
  }
  const LanePoint beside = lane.nearest(now.first_m, now.second_m);
  return RoadUserPose{.s_m = beside.s_m,
                      .x_m = now.first_m,
                      .y_m = now.second_m,
                      .z_m = beside.z_m,
                      .heading_rad = now.heading_rad,
                      .speed_mps = now.speed_mps};
}

std::optional<RoadUserPose> pose_along_lane(const RoadUser& user, const LaneLine& lane, double time_s) {
  const double along = kAlongLane[static_cast<std::size_t>(user.direction)];
  const double going_across_s = std::clamp(time_s, user.across_from_s, user.across_to_s) - user.across_from_s;
  const double speed = user.speeds.empty() ? user.speed_mps : speed_mps(user.speeds, time_s);
  const double way = user.speeds.empty() ? user.speed_mps * time_s : way_m(user.speeds, time_s);
  const auto place = lane.at(user.start_s_m + along * way, user.offset_m + user.across_mps * going_across_s);
  if (!place) return std::nullopt;
  const bool against = user.direction == RoadUserDirection::oncoming;
  const bool goes_across = user.across_mps != 0.0 && time_s >= user.across_from_s && time_s < user.across_to_s;
  // Looks along its way; who stands until it goes across looks across before and after it too.
  double turn = against ? std::numbers::pi : 0.0;
  const double along_mps = along * speed;
  const bool never_along = user.speeds.empty() && along_mps == 0.0;
  if (goes_across || (user.across_mps != 0.0 && never_along)) turn = std::atan2(user.across_mps, along_mps);
  return RoadUserPose{.s_m = place->s_m,
                      .x_m = place->x_m,
                      .y_m = place->y_m,
                      .z_m = place->z_m,
                      .heading_rad = place->heading_rad + turn,
                      .speed_mps = std::hypot(along_mps, goes_across ? user.across_mps : 0.0)};
}

}  // namespace

std::optional<RoadUserPose> pose_of(const RoadUser& user, const LaneLine& lane, double time_s) {
  if (!(time_s >= user.from_s && time_s <= user.to_s)) return std::nullopt;
  auto pose = user.path ? pose_on_path(*user.path, lane, time_s) : pose_along_lane(user, lane, time_s);
  if (pose) pose->brakes = brakes(user, time_s);
  return pose;
}

}  // namespace phare
