// Road users that drive or walk: one node each at the origin, its middle there, x forward, for those that move.
#include <numbers>

#include "tools/scene/parts.h"

namespace phare::scene {
namespace {

using glm::dvec3;

/// A lorry of two axles with a box body, 10 m long.
void draw_lorry(Pen pen) {
  pen.box(Material::kDarkPlastic, {-4.9, -0.45, 0.55}, {4.6, 0.45, 0.95});  // frame
  pen.box(Material::kPlaster, {-5.0, -1.25, 1.05}, {2.75, 1.25, 3.6});      // body
  pen.box(Material::kSteel, {-5.02, -1.25, 0.95}, {2.75, 1.25, 1.05});
  pen.box(Material::kCarPaint, {3.0, -1.22, 0.75}, {4.9, 1.22, 2.9});  // cab
  pen.box(Material::kGlass, {4.85, -1.1, 1.75}, {4.93, 1.1, 2.65});
  pen.box(Material::kDarkPlastic, {4.75, -1.22, 0.35}, {5.0, 1.22, 0.75});  // bumper
  pen.box(Material::kDarkPlastic, {-5.0, -1.2, 0.4}, {-4.9, 1.2, 0.55});    // underrun bar
  for (const double side : {-1.0, 1.0}) {
    for (const double x : {-3.2, 3.6}) {
      pen.cone(Material::kRubber, {x, side * 0.85, 0.5}, 0.5, {x, side * 1.2, 0.5}, 0.49, 18);
      pen.cone(Material::kChrome, {x, side * 1.15, 0.5}, 0.28, {x, side * 1.21, 0.5}, 0.26, 12);
    }
    pen.box(Material::kGlass, {3.5, side * 1.225 - 0.01, 1.75}, {4.6, side * 1.225 + 0.01, 2.55});
    pen.box(Material::kDarkPlastic, {4.8, side * 1.32 - 0.08, 1.9}, {4.95, side * 1.32 + 0.08, 2.6});  // mirror
    pen.ellipsoid(Material::kChrome, {4.97, side * 0.95, 0.62}, {0.06, 0.16, 0.09}, 5, 9);             // headlamp
    pen.box(Material::kSheetRed, {-5.03, side * 1.0 - 0.2, 0.75}, {-4.98, side * 1.0 + 0.2, 0.9});
    const double y = side * 0.95;
    pen.quad(Material::kReflectorRed, {-5.035, y + 0.1, 0.78}, {-5.035, y - 0.1, 0.78}, {-5.035, y - 0.1, 0.87},
             {-5.035, y + 0.1, 0.87});
    // Contour marking along the side (UN R104).
    pen.box(Material::kSheetWhite, {-4.9, side * 1.252 - 0.002, 1.15}, {2.65, side * 1.252 + 0.002, 1.2});
  }
}

glm::dmat4 shifted(double x_m) {
  glm::dmat4 frame(1.0);
  frame[3].x = x_m;
  return frame;
}

/// A plastered wall across x that is read on its near side, in squares of a metre for light at the vertices; its foot
/// is below the road, where that falls.
void draw_wall(Pen pen) {
  constexpr int kHalf_m = 16, kFoot_m = -3, kTop_m = 9;
  for (int y = -kHalf_m; y < kHalf_m; ++y)
    for (int z = kFoot_m; z < kTop_m; ++z)
      pen.quad(Material::kPlaster, {0.0, y + 1.0, z}, {0.0, y, z}, {0.0, y, z + 1.0}, {0.0, y + 1.0, z + 1.0});
}

}  // namespace

void add_road_users(Model& model) {
  draw_car(Pen(model.add("car"), shifted(-1.24)));
  draw_lorry(Pen(model.add("lorry"), shifted(0.0)));
  draw_cyclist(Pen(model.add("bicycle"), shifted(-0.5)));
  draw_walker(Pen(model.add("pedestrian"), shifted(0.0)),
              {Material::kClothDark, Material::kClothBlue, Material::kClothDark}, 0.55, false, false);
  draw_deer(Pen(model.add("deer"), shifted(0.0)));
  draw_wall(Pen(model.add("wall"), glm::dmat4(1.0)));
}

}  // namespace phare::scene
