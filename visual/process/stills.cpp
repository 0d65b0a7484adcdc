#include "visual/process/stills.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>
#include <vector>

#include "visual/image/canvas.h"
#include "visual/image/image.h"
#include "visual/image/lux_scale.h"
#include "visual/photometry/table/illuminance.h"
#include "visual/process/cameras.h"
#include "visual/process/props.h"

namespace phare {
namespace {

constexpr double kHalfWidth_deg = 20.0;
constexpr double kHalfHeight_deg = 8.0;
constexpr int kPxPerDeg = 28;
constexpr int kMarginLeft_px = 52, kMarginTop_px = 30, kMarginBottom_px = 36, kMarginRight_px = 84;
constexpr Colour kInk{220, 220, 220};
constexpr Colour kGrid{80, 84, 96};

Image8 page_around(int width_px, int height_px) {
  return blank_image(kMarginLeft_px + width_px + kMarginRight_px, kMarginTop_px + height_px + kMarginBottom_px, 18, 18,
                     20);
}

/// A whole number in the middle of (x, y), or left of it.
void draw_number(Image8& page, int x_px, int y_px, int value, bool centred) {
  const std::string text = std::to_string(value);
  const int width_px = text_width_px(text);
  draw_text(page, x_px - (centred ? width_px / 2 : width_px), y_px, text, kInk);
}

/// False colour of illuminance_lx(x, y) of each pixel, white where the isolux band changes from the left or from above.
template <typename Illuminance>
Image8 isolux_map(int width_px, int height_px, Illuminance illuminance_lx) {
  Image8 map = blank_image(width_px, height_px, 0, 0, 0);
  std::vector<int> above(static_cast<std::size_t>(width_px), -1);
  for (int y = 0; y < height_px; ++y) {
    int before = -1;
    for (int x = 0; x < width_px; ++x) {
      const double e_lx = illuminance_lx(x, y);
      const int band = isolux_band(e_lx);
      int& over = above[static_cast<std::size_t>(x)];
      const bool line = (before >= 0 && band != before) || (over >= 0 && band != over);
      fill_box(map, x, y, 1, 1, line ? Colour{255, 255, 255} : false_colour(e_lx));
      before = over = band;
    }
  }
  return map;
}

}  // namespace

Image8 wall_picture(const Lamps& lamps, std::size_t design_index) {
  const DesignConfig& design = lamps.designs()[design_index];
  const glm::dvec3 origin_m = middle_of_low_beam(design, lamps.mounts(design_index));
  const int width_px = static_cast<int>(2.0 * kHalfWidth_deg) * kPxPerDeg,
            height_px = static_cast<int>(2.0 * kHalfHeight_deg) * kPxPerDeg;
  constexpr double kRadPerDeg = std::numbers::pi / 180.0;

  const std::vector<PlacedSource> sources = lamps.sources_in_car(design_index, {LampFunction::kLow});
  // Type A: azimuth h about the vertical axis, then elevation v; H to the right, so y falls.
  const auto wall_lx = [&](double h_deg, double v_deg) {
    const double h_rad = h_deg * kRadPerDeg, v_rad = v_deg * kRadPerDeg;
    const glm::dvec3 on_wall_m{kWall_m, -kWall_m * std::tan(h_rad), kWall_m / std::cos(h_rad) * std::tan(v_rad)};
    return illuminance_lx(sources, origin_m + on_wall_m, {-1.0, 0.0, 0.0});
  };
  double brightest_lx = 0.0;
  Image8 map = isolux_map(width_px, height_px, [&](int x, int y) {
    const double e_lx = wall_lx((x + 0.5) / kPxPerDeg - kHalfWidth_deg, kHalfHeight_deg - (y + 0.5) / kPxPerDeg);
    brightest_lx = std::max(brightest_lx, e_lx);
    return e_lx;
  });
  for (int deg = -15; deg <= 15; deg += 5) {
    const int x = static_cast<int>((deg + kHalfWidth_deg) * kPxPerDeg);
    draw_line(map, x, 0, x, height_px - 1, deg == 0 ? kInk : kGrid);
  }
  for (int deg = -6; deg <= 6; deg += 2) {
    const int y = static_cast<int>((kHalfHeight_deg - deg) * kPxPerDeg);
    draw_line(map, 0, y, width_px - 1, y, deg == 0 ? kInk : kGrid);
  }
  const int hv_x = width_px / 2, hv_y = height_px / 2;
  draw_text(map, hv_x + 6, hv_y - 18, "HV", {255, 255, 255});

  Image8 page = page_around(width_px, height_px);
  paste(page, map, kMarginLeft_px, kMarginTop_px);
  for (int deg = -20; deg <= 20; deg += 5) {
    draw_number(page, kMarginLeft_px + (deg + 20) * kPxPerDeg, kMarginTop_px + height_px + 4, deg, true);
  }
  for (int deg = -8; deg <= 8; deg += 2) {
    draw_number(page, kMarginLeft_px - 6, kMarginTop_px + (8 - deg) * kPxPerDeg - text_height_px() / 2, deg, false);
  }
  draw_text(page, kMarginLeft_px + width_px / 2 - 60, kMarginTop_px + height_px + 18, "H, degrees to the right", kInk);
  draw_text(page, 2, 6, "V, deg", kInk);
  char title[160];
  std::snprintf(title, sizeof title,
                "Wall at 25 m, low beam of '%s', aimed as mounted; lux on the wall, brightest %.1f lx",
                design.name.c_str(), brightest_lx);
  draw_text(page, kMarginLeft_px + 50, 8, title, kInk);
  draw_lux_legend(page, kMarginLeft_px + width_px + 14, kMarginTop_px + 20, height_px - 20);
  return page;
}

Image8 versus_picture(const ImageF& a, const ImageF& b, VersusScale scale, const std::string& caption) {
  const bool ratio = scale == VersusScale::kRatio;
  Image8 page = page_around(a.width_px, a.height_px);
  const std::size_t width = static_cast<std::size_t>(a.width_px);
  for (int y = 0; y < a.height_px; ++y)
    for (int x = 0; x < a.width_px; ++x) {
      const std::size_t alpha = (static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)) * 4 + 3;
      const double of_a = static_cast<double>(a.rgba[alpha]), of_b = static_cast<double>(b.rgba[alpha]);
      const bool dark = ratio && std::max(of_a, of_b) < versus_dark_lx();
      const double value = ratio ? std::max(of_b, 1e-3) / std::max(of_a, 1e-3) : of_b - of_a;
      fill_box(page, kMarginLeft_px + x, kMarginTop_px + y, 1, 1, dark ? Colour{0, 0, 0} : versus_colour(value, scale));
    }
  draw_text(page, kMarginLeft_px + 50, 8, caption, kInk);
  // The scale, from B brighter above to A brighter below.
  const int left = kMarginLeft_px + a.width_px + 14, top = kMarginTop_px + 20, height = a.height_px - 40;
  const std::vector<std::pair<double, const char*>> marks = versus_marks(scale);
  const auto row_of = [&](double value) {
    return top + static_cast<int>(std::lround((1.0 - versus_share(value, scale)) / 2.0 * (height - 1)));
  };
  for (int y = 0; y < height; ++y) {
    const double share = 1.0 - 2.0 * y / (height - 1);
    fill_box(page, left, top + y, 18, 1, versus_colour_at(share));
  }
  for (const auto& [value, text] : marks) {
    draw_line(page, left, row_of(value), left + 21, row_of(value), kInk);
    draw_text(page, left + 25, row_of(value) - text_height_px() / 2, text, kInk);
  }
  draw_text(page, left, top - text_height_px() - 3, ratio ? "B/A" : "lux", kInk);
  return page;
}

Image8 birds_eye_picture(const ImageF& seen, const std::string& caption) {
  const Image8 map = isolux_map(seen.width_px, seen.height_px, [&](int x, int y) {
    return static_cast<double>(seen.rgba[(static_cast<std::size_t>(y) * static_cast<std::size_t>(seen.width_px) +
                                          static_cast<std::size_t>(x)) *
                                             4 +
                                         3]);
  });
  const double px_per_m = map.width_px / kBirdsEyeLength_m;
  Image8 page = page_around(map.width_px, map.height_px);
  paste(page, map, kMarginLeft_px, kMarginTop_px);
  for (int ahead_m = 0; ahead_m <= static_cast<int>(kBirdsEyeLength_m); ahead_m += 10) {
    const int x = kMarginLeft_px + static_cast<int>(ahead_m * px_per_m);
    draw_line(page, x, kMarginTop_px + map.height_px, x, kMarginTop_px + map.height_px + 4, kInk);
    draw_number(page, x, kMarginTop_px + map.height_px + 5, static_cast<int>(kBirdsEyeStart_m) + ahead_m, true);
  }
  const int half_m = static_cast<int>(kBirdsEyeWidth_m) / 2;
  for (int left_m = -half_m; left_m <= half_m; left_m += 5) {
    const int y = kMarginTop_px + static_cast<int>((half_m - left_m) * px_per_m);
    draw_line(page, kMarginLeft_px - 4, y, kMarginLeft_px - 1, y, kInk);
    draw_number(page, kMarginLeft_px - 6, y - text_height_px() / 2, left_m, false);
  }
  draw_text(page, kMarginLeft_px + map.width_px / 2 - 110, kMarginTop_px + map.height_px + 19,
            "x, m ahead of the car's origin (rear axle)", kInk);
  draw_text(page, 2, 6, "y, m", kInk);
  draw_text(page, kMarginLeft_px + 50, 8, caption, kInk);
  draw_lux_legend(page, kMarginLeft_px + map.width_px + 14, kMarginTop_px + 20, map.height_px - 20);
  return page;
}

}  // namespace phare
