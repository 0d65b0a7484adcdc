#include "visual/process/road_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <utility>

#include "visual/image/lux_scale.h"

namespace phare {
namespace {

constexpr double kAboveRoad_m = 0.01;  // lines lie on it
constexpr OverlayColour kGridInk{150, 215, 235}, kGridFaint{95, 150, 175};

double level_lx(const Lamps& lamps, const VehicleState& car, const MeasurePoint& road) {
  return lamps.illuminance_lx(car, {road.position_m, {0.0, 0.0, 1.0}});
}

/// The farthest place ahead that has the level on one edge.
double reach_m(const Lamps& lamps, const VehicleState& car, const RoadLine::Ahead& road, double left_m, double lx) {
  constexpr double kNearest_m = 4.0, kStep_m = 2.0;
  const auto at = [&](double ahead_m) { return level_lx(lamps, car, road(ahead_m, left_m)); };
  double far_m = kFarthestReach_m;
  while (far_m >= kNearest_m && at(far_m) < lx) far_m -= kStep_m;
  if (far_m < kNearest_m) return 0.0;
  if (far_m == kFarthestReach_m) return far_m;
  double with_m = far_m, without_m = far_m + kStep_m;
  for (int i = 0; i < 6; ++i) {
    const double middle_m = 0.5 * (with_m + without_m);
    (at(middle_m) >= lx ? with_m : without_m) = middle_m;
  }
  return with_m;
}

glm::dvec3 lifted(const MeasurePoint& point) {
  return point.position_m + glm::dvec3(0.0, 0.0, kAboveRoad_m);
}

/// Of the colours of the levels' own false colour, light enough over a dark road.
OverlayColour colour_of(double lx) {
  const Colour colour = false_colour(lx);
  const auto light = [](std::uint8_t part) { return static_cast<unsigned char>(90 + part * 165 / 255); };
  return {light(colour.red), light(colour.green), light(colour.blue)};
}

/// Of "100 m" in a picture of 1280 × 720.
constexpr double kLabelWidth_01 = 0.04, kLabelHeight_01 = 0.025;  // of most
constexpr double kLetterWidth_01 = 0.0065;                        // so that six letters are as wide; chosen

/// Where a line of the eye's view cuts its near side; clip space with w the distance ahead.
struct Seen {
  double x_01 = 0.0, y_01 = 0.0;
};
std::optional<std::pair<Seen, Seen>> seen_line(const glm::dmat4& clip_from_eye, glm::dvec3 a_m, glm::dvec3 b_m) {
  glm::dvec4 a = clip_from_eye * glm::dvec4(a_m, 1.0), b = clip_from_eye * glm::dvec4(b_m, 1.0);
  constexpr double kNear = 0.1;
  if (a.w < kNear && b.w < kNear) return std::nullopt;
  const auto cut = [&](glm::dvec4& behind, const glm::dvec4& before) {
    behind = before + (behind - before) * ((before.w - kNear) / (before.w - behind.w));
  };
  if (a.w < kNear) cut(a, b);
  if (b.w < kNear) cut(b, a);
  const auto on_picture = [](const glm::dvec4& p) { return Seen{0.5 + 0.5 * p.x / p.w, 0.5 + 0.5 * p.y / p.w}; };
  return std::pair{on_picture(a), on_picture(b)};
}

/// With room for a label to its right.
bool in_picture(const Seen& at) {
  return at.x_01 > 0.0 && at.x_01 < 1.0 - kLabelWidth_01 && at.y_01 > 0.0 && at.y_01 < 1.0;
}

bool near_picture(const Seen& at) {
  return at.x_01 > -1.0 && at.x_01 < 2.0 && at.y_01 > -1.0 && at.y_01 < 2.0;
}

}  // namespace

std::vector<Reach> reach_of(const Lamps& lamps, const VehicleState& car, const RoadLine& road) {
  const RoadLine::Ahead ahead = road.ahead_of(car);
  std::vector<Reach> all;
  for (const double lx : kReachLevels_lx)
    all.push_back({lx, reach_m(lamps, car, ahead, kLaneEdge_m, lx), reach_m(lamps, car, ahead, -kLaneEdge_m, lx)});
  return all;
}

std::string reach_line(const std::vector<Reach>& reach) {
  std::string text = "reach left/right:";
  for (std::size_t i = 0; i < reach.size(); ++i)
    text += fmt::format("{} {:g} lx {:.0f}/{:.0f} m", i == 0 ? "" : ",", reach[i].level_lx, reach[i].left_m,
                        reach[i].right_m);
  return text;
}

RoadMarks grid_marks(const VehicleState& car, const RoadLine& road, double spacing_m) {
  constexpr int kAcross = 10, kParts = 5, kSide = 3;
  constexpr double kApart_m = 2.0;
  const RoadLine::Ahead ahead = road.ahead_of(car);
  RoadMarks marks;
  for (int row = 1; row <= kAcross; ++row) {
    RoadMarks::Line line{{}, kGridInk};
    for (int k = -2 * kSide; k <= 2 * kSide; ++k)
      line.points_m.push_back(lifted(ahead(row * spacing_m, 0.5 * k * kApart_m)));
    marks.labels.push_back({line.points_m[2 * kSide - 2], fmt::format("{:g} m", row * spacing_m), kGridInk});
    marks.lines.push_back(std::move(line));
  }
  for (int k = -kSide; k <= kSide; ++k) {
    RoadMarks::Line line{{}, k == 0 ? kGridInk : kGridFaint};
    for (int part = kParts; part <= kAcross * kParts; ++part)
      line.points_m.push_back(lifted(ahead(part * spacing_m / kParts, k * kApart_m)));
    marks.lines.push_back(std::move(line));
  }
  return marks;
}

RoadMarks isolux_marks(const Lamps& lamps, const VehicleState& car, const RoadLine& road,
                       const std::vector<double>& levels_lx) {
  // Rows grow with distance, as the picture shrinks: 0.14 m near the car, 6.6 m at 145 m.
  constexpr double kFrom_m = 3.0, kGrowth = 1.048, kApart_m = 0.5;
  constexpr int kRows = 84, kColumns = 57;  // to 147 m, 14 m to either side
  struct Node {
    glm::dvec3 at_m;
    double log_lx;  // smoother between nodes than lux
  };
  const RoadLine::Ahead ahead = road.ahead_of(car);
  std::vector<Node> nodes;
  nodes.reserve(static_cast<std::size_t>(kRows * kColumns));
  double ahead_m = kFrom_m;
  for (int row = 0; row < kRows; ++row, ahead_m *= kGrowth)
    for (int column = 0; column < kColumns; ++column) {
      const MeasurePoint point = ahead(ahead_m, (column - kColumns / 2) * kApart_m);
      nodes.push_back({lifted(point), std::log(std::max(level_lx(lamps, car, point), 1e-6))});
    }
  const auto node = [&](int row, int column) -> const Node& {
    return nodes[static_cast<std::size_t>(row * kColumns + column)];
  };
  RoadMarks marks;
  for (const double lx : levels_lx) {
    const double level = std::log(lx);
    const OverlayColour ink = colour_of(lx);
    int last_row = -1;
    std::vector<glm::dvec3> places;  // one of each row, from near to far
    for (int row = 0; row + 1 < kRows; ++row)
      for (int column = 0; column + 1 < kColumns; ++column) {
        // Marching triangles: each has a line or none.
        const Node* corner[4] = {&node(row, column), &node(row, column + 1), &node(row + 1, column + 1),
                                 &node(row + 1, column)};
        for (const auto& [i, j, k] : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
          std::vector<glm::dvec3> cuts;
          for (const auto& [p, q] : {std::pair{corner[i], corner[j]}, {corner[j], corner[k]}, {corner[k], corner[i]}}) {
            if ((p->log_lx >= level) == (q->log_lx >= level)) continue;
            cuts.push_back(p->at_m + (q->at_m - p->at_m) * ((level - p->log_lx) / (q->log_lx - p->log_lx)));
          }
          if (cuts.size() != 2) continue;
          if (places.empty() || row != last_row) places.push_back(cuts[0]);
          last_row = row;
          marks.lines.push_back({std::move(cuts), ink});
        }
      }
    if (places.empty()) continue;
    std::ranges::reverse(places);
    marks.labels.push_back({places.front(), fmt::format("{:g} lx", lx), {}, {places.begin() + 1, places.end()}});
  }
  return marks;
}

RoadMarks seen_marks(RoadMarks marks, const std::function<bool(const glm::dvec3& point_m)>& hides) {
  RoadMarks seen;
  for (RoadMarks::Line& line : marks.lines) {
    // A piece of an isolux line is short: one of its ends tells. A long line is cut where it goes out of sight.
    if (line.points_m.size() == 2) {
      if (!hides(line.points_m.front())) seen.lines.push_back(std::move(line));
      continue;
    }
    RoadMarks::Line piece{{}, line.colour};
    for (const glm::dvec3& point_m : line.points_m) {
      if (!hides(point_m)) {
        piece.points_m.push_back(point_m);
        continue;
      }
      if (piece.points_m.size() > 1) seen.lines.push_back(piece);
      piece.points_m.clear();
    }
    if (piece.points_m.size() > 1) seen.lines.push_back(std::move(piece));
  }
  for (RoadMarks::Label& label : marks.labels) {
    std::erase_if(label.others_m, [&](const glm::dvec3& at_m) { return hides(at_m); });
    if (hides(label.at_m)) {
      if (label.others_m.empty()) continue;
      label.at_m = label.others_m.front();
      label.others_m.erase(label.others_m.begin());
    }
    seen.labels.push_back(std::move(label));
  }
  return seen;
}

RoadMarks seen_marks(RoadMarks marks, const glm::dvec3& eye_m, const RoadLine& road) {
  return seen_marks(std::move(marks), [&](const glm::dvec3& point_m) { return road.hides(eye_m, point_m); });
}

void draw_marks(OverlayMarks& picture, const RoadMarks& marks, const ViewGeometry& view,
                std::span<const OverlayMarks::Label> others) {
  const glm::dmat4 clip_from_eye = view.clip_from_eye();
  const glm::dvec3 eye_m = view.camera().eye_m;
  for (const RoadMarks::Line& line : marks.lines)
    for (std::size_t i = 1; i < line.points_m.size(); ++i) {
      const auto ends = seen_line(clip_from_eye, line.points_m[i - 1] - eye_m, line.points_m[i] - eye_m);
      if (ends && (near_picture(ends->first) || near_picture(ends->second)))
        picture.lines.push_back(
            {ends->first.x_01, ends->first.y_01, ends->second.x_01, ends->second.y_01, line.colour});
    }
  for (const RoadMarks::Label& label : marks.labels) {
    // Far rows lie close together: a label that would lie on another, or out of the picture, goes on along its line.
    std::vector<glm::dvec3> places{label.at_m};
    places.insert(places.end(), label.others_m.begin(), label.others_m.end());
    for (const glm::dvec3& place_m : places) {
      const auto at = seen_line(clip_from_eye, place_m - eye_m, place_m - eye_m);
      if (!at || !in_picture(at->first)) continue;
      const auto taken = [&](const OverlayMarks::Label& other) {
        return std::abs(other.x_01 - at->first.x_01) < kLabelWidth_01 &&
               std::abs(other.y_01 - at->first.y_01) < kLabelHeight_01;
      };
      if (std::ranges::any_of(picture.labels, taken) || std::ranges::any_of(others, taken)) continue;
      picture.labels.push_back({at->first.x_01, at->first.y_01, label.text, label.colour});
      break;
    }
  }
}

namespace {

struct Tick {
  double share_01 = 0.0;  ///< from the lower end
  std::string text;
};

/// A column of colours at the right edge; `colour_at` of the share from its lower end.
template <typename ColourAt>
void draw_column(OverlayMarks& picture, const char* title, const ColourAt& colour_at, const std::vector<Tick>& ticks) {
  constexpr double kLeft_01 = 0.94, kWidth_01 = 0.014, kTop_01 = 0.12, kHeight_01 = 0.47;  // above the right mirror
  constexpr int kBoxes = 64;
  constexpr double kEnd_01 = 0.997;
  picture.boxes.push_back(
      {kLeft_01 - 0.008, kTop_01 - 0.055, kEnd_01 - kLeft_01 + 0.008, kHeight_01 + 0.075, {30, 36, 42}, 155});
  for (int i = 0; i < kBoxes; ++i) {
    const Colour colour = colour_at(1.0 - (i + 0.5) / kBoxes);
    picture.boxes.push_back({kLeft_01,
                             kTop_01 + kHeight_01 * i / kBoxes,
                             kWidth_01,
                             kHeight_01 / kBoxes + 0.001,
                             {colour.red, colour.green, colour.blue},
                             255});
  }
  picture.labels.push_back({kLeft_01, kTop_01 - 0.028, title, {}, kEnd_01 - kLeft_01});
  for (const Tick& tick : ticks) {
    const double y = kTop_01 + kHeight_01 * (1.0 - tick.share_01);
    picture.lines.push_back({kLeft_01, y, kLeft_01 + kWidth_01 + 0.004, y, {255, 255, 255}});
    constexpr double kText_01 = kLeft_01 + kWidth_01 + 0.007;
    picture.labels.push_back({kText_01, y, tick.text, {}, kEnd_01 - kText_01});
  }
}

}  // namespace

void draw_scale(OverlayMarks& picture, const std::vector<double>& levels_lx) {
  constexpr double kLowest_lx = 0.3, kHighest_lx = 200.0;  // where the colours begin and end (shaders/lib/tone.h)
  const double decades = std::log(kHighest_lx / kLowest_lx);
  std::vector<Tick> ticks;
  for (const double lx : levels_lx)
    if (lx >= kLowest_lx && lx <= kHighest_lx)
      ticks.push_back({std::log(lx / kLowest_lx) / decades, fmt::format("{:g}", lx)});
  draw_column(
      picture, "lux", [&](double share) { return false_colour(kLowest_lx * std::exp(decades * share)); }, ticks);
}

void draw_versus_scale(OverlayMarks& picture, VersusScale scale) {
  std::vector<Tick> ticks;
  for (const auto& [value, text] : versus_marks(scale)) ticks.push_back({0.5 + 0.5 * versus_share(value, scale), text});
  draw_column(
      picture, scale == VersusScale::kRatio ? "B/A" : "B-A lux",
      [](double share) { return versus_colour_at(2.0 * share - 1.0); }, ticks);
}

void keep_clear(OverlayMarks& picture, const PicturePart& part) {
  const double right = part.left_01 + part.width_01, bottom = part.top_01 + part.height_01;
  std::vector<OverlayMarks::Line> outside;
  for (const OverlayMarks::Line& line : picture.lines) {
    // The piece within, from one share of the line to another (Liang and Barsky 1984).
    const double along_x = line.x1_01 - line.x0_01, along_y = line.y1_01 - line.y0_01;
    double enters = 0.0, leaves = 1.0;
    const auto cut = [&](double along, double to_edge) {  // within while share * along <= to_edge
      if (along == 0.0 && to_edge <= 0.0) leaves = -1.0;
      if (along > 0.0) leaves = std::min(leaves, to_edge / along);
      if (along < 0.0) enters = std::max(enters, to_edge / along);
    };
    cut(-along_x, line.x0_01 - part.left_01);
    cut(along_x, right - line.x0_01);
    cut(-along_y, line.y0_01 - part.top_01);
    cut(along_y, bottom - line.y0_01);
    if (enters >= leaves) {
      outside.push_back(line);
      continue;
    }
    const auto piece = [&](double from, double to) {
      if (to > from)
        outside.push_back({line.x0_01 + from * along_x, line.y0_01 + from * along_y, line.x0_01 + to * along_x,
                           line.y0_01 + to * along_y, line.colour});
    };
    piece(0.0, enters);
    piece(leaves, 1.0);
  }
  picture.lines = std::move(outside);
  std::erase_if(picture.labels, [&](const OverlayMarks::Label& label) {
    const double width = std::min(kLabelWidth_01, kLetterWidth_01 * static_cast<double>(label.text.size()));
    return label.x_01 + width > part.left_01 && label.x_01 < right &&
           std::abs(label.y_01 - std::clamp(label.y_01, part.top_01, bottom)) < 0.5 * kLabelHeight_01;
  });
}

void put_into(OverlayMarks& marks, const PicturePart& part) {
  const auto x = [&](double& at_01) { at_01 = part.left_01 + part.width_01 * at_01; };
  const auto y = [&](double& at_01) { at_01 = part.top_01 + part.height_01 * at_01; };
  for (OverlayMarks::Box& box : marks.boxes) {
    x(box.left_01), y(box.top_01);
    box.width_01 *= part.width_01, box.height_01 *= part.height_01;
  }
  for (OverlayMarks::Line& line : marks.lines) x(line.x0_01), y(line.y0_01), x(line.x1_01), y(line.y1_01);
  for (OverlayMarks::Label& label : marks.labels) x(label.x_01), y(label.y_01), label.room_01 *= part.width_01;
}

void frame_part(OverlayMarks& picture, const PicturePart& part) {
  constexpr OverlayColour kInk{120, 125, 130};
  const double left = part.left_01, top = part.top_01, right = left + part.width_01, bottom = top + part.height_01;
  picture.lines.push_back({left, top, right, top, kInk});
  picture.lines.push_back({right, top, right, bottom, kInk});
  picture.lines.push_back({right, bottom, left, bottom, kInk});
  picture.lines.push_back({left, bottom, left, top, kInk});
}

}  // namespace phare
