// A town street at night: two lanes between parked cars and rows of houses, 700 m with two gentle bends, street lamps
// on both sides in turn every 15 m. Layout by us after usual German town streets (RASt 06): lanes of 3.25 m, parking of
// 2.1 m, pavements of 2.5 m; lamps 7 m high.
#include <array>
#include <cmath>
#include <numbers>

#include "tools/scene/parts.h"
#include "tools/scene/path.h"

namespace phare::scene {
namespace {

using glm::dvec3;

constexpr double kHalfRoad_m = 3.25, kKerb_m = 0.12, kParking_m = 2.1, kPavement_m = 2.5;
constexpr double kRightKerb_m = -(kHalfRoad_m + kParking_m), kLeftKerb_m = kHalfRoad_m + 0.25;
constexpr double kRightWall_m = kRightKerb_m - kPavement_m, kLeftWall_m = kLeftKerb_m + kPavement_m;
constexpr double kCrossing_m = 120.0;  ///< of the zebra
constexpr double kLampEvery_m = 30.0, kLampHeight_m = 7.0;

void add_ground(Model& model, const Path& path) {
  each_piece(path, [&](int number, double begin, double end) {
    Node& road = model.add(numbered_node("road", number));
    // Lines across where light changes: lanes, gutter, parking.
    constexpr std::array kAcross_m{kRightKerb_m, -kHalfRoad_m, -1.625, 0.0, 1.625, kLeftKerb_m};
    for (std::size_t i = 0; i + 1 < kAcross_m.size(); ++i)
      add_strip(road, Material::kAsphalt, path, begin, end, 5.0, {kAcross_m[i], 0.0}, {kAcross_m[i + 1], 0.0});
    Node& ground = model.add(numbered_node("ground", number));
    add_strip(ground, Material::kKerb, path, begin, end, 5.0, {kRightKerb_m - 0.14, kKerb_m}, {kRightKerb_m, kKerb_m});
    add_strip(ground, Material::kKerb, path, begin, end, 5.0, {kRightKerb_m, kKerb_m}, {kRightKerb_m, 0.0});
    add_strip(ground, Material::kKerb, path, begin, end, 5.0, {kLeftKerb_m, kKerb_m}, {kLeftKerb_m + 0.14, kKerb_m});
    add_strip(ground, Material::kKerb, path, begin, end, 5.0, {kLeftKerb_m, 0.0}, {kLeftKerb_m, kKerb_m});
    add_strip(ground, Material::kPavement, path, begin, end, 5.0, {kRightWall_m, kKerb_m},
              {kRightKerb_m - 0.14, kKerb_m});
    add_strip(ground, Material::kPavement, path, begin, end, 5.0, {kLeftKerb_m + 0.14, kKerb_m},
              {kLeftWall_m, kKerb_m});
    add_strip(ground, Material::kVerge, path, begin, end, 10.0, {kRightWall_m - 40.0, kKerb_m},
              {kRightWall_m, kKerb_m});
    add_strip(ground, Material::kVerge, path, begin, end, 10.0, {kLeftWall_m, kKerb_m}, {kLeftWall_m + 40.0, kKerb_m});

    Node& marking = model.add(numbered_node("marking", number));
    constexpr double kUp_m = 0.006;
    const auto clear = [](double s) { return std::abs(s - kCrossing_m) > 9.0; };
    for (double s = begin; s < end - 2.9; s += 9.0)  // 3 m of paint, 6 m of gap, as in towns
      if (clear(s + 1.5)) add_strip(marking, Material::kPaint, path, s, s + 3.0, 3.0, {-0.06, kUp_m}, {0.06, kUp_m});
    add_strip(marking, Material::kPaint, path, begin, end, 5.0, {-kHalfRoad_m - 0.06, kUp_m},
              {-kHalfRoad_m + 0.06, kUp_m});
    if (begin <= kCrossing_m && kCrossing_m < end)
      for (double t = -2.75; t < 3.1; t += 1.0)
        add_strip(marking, Material::kPaint, path, kCrossing_m - 2.0, kCrossing_m + 2.0, 4.0, {t - 0.25, kUp_m},
                  {t + 0.25, kUp_m});
  });
}

/// x along the front, y away from the street, z up; the front stands in y = 0 from x = 0 to `width`.
class House {
 public:
  House(Pen pen, Random& random, double width) : pen_(pen), random_(random), width_(width) {}

  void draw() {
    const int floors = random_.uniform(0.0, 1.0) < 0.35 ? 2 : random_.uniform(0.0, 1.0) < 0.7 ? 3 : 4;
    const double ground = 3.4, upper = 2.9, top = ground + upper * (floors - 1), depth = 10.0;
    constexpr std::array kWalls{Material::kFacadeWhite, Material::kFacadeOchre, Material::kFacadeGrey,
                                Material::kFacadeRed,   Material::kFacadeWhite, Material::kPlaster};
    const Material wall = kWalls[static_cast<std::size_t>(random_.uniform(0.0, 5.999))];
    // Front in panes of a floor each, ends, back.
    front(wall, 0.0, ground);
    for (int floor = 1; floor < floors; ++floor) front(wall, ground + upper * (floor - 1), ground + upper * floor);
    pen_.quad(wall, {0, depth, 0}, {0, 0, 0}, {0, 0, top}, {0, depth, top});
    pen_.quad(wall, {width_, 0, 0}, {width_, depth, 0}, {width_, depth, top}, {width_, 0, top});
    pen_.quad(wall, {width_, depth, 0}, {0, depth, 0}, {0, depth, top}, {width_, depth, top});
    pen_.box(Material::kStone, {-0.02, -0.04, 0.0}, {width_ + 0.02, 0.0, 0.5});  // plinth
    pen_.box(Material::kFacadeWhite, {-0.05, -0.12, top - 0.15}, {width_ + 0.05, 0.1, top});
    // Roof along the street.
    const double ridge = top + 3.2, eave = 0.45;
    pen_.quad(Material::kRoofTiles, {-0.2, -eave, top - 0.1}, {width_ + 0.2, -eave, top - 0.1},
              {width_ + 0.2, 0.5 * depth, ridge}, {-0.2, 0.5 * depth, ridge});
    pen_.quad(Material::kRoofTiles, {width_ + 0.2, depth + eave, top - 0.1}, {-0.2, depth + eave, top - 0.1},
              {-0.2, 0.5 * depth, ridge}, {width_ + 0.2, 0.5 * depth, ridge});
    pen_.triangle(wall, {0, depth, top}, {0, 0, top}, {0, 0.5 * depth, ridge});
    pen_.triangle(wall, {width_, 0, top}, {width_, depth, top}, {width_, 0.5 * depth, ridge});

    const bool shop = random_.uniform(0.0, 1.0) < 0.28;
    ground_floor(shop, ground);
    const int windows = std::max(2, static_cast<int>(width_ / 2.4));
    for (int floor = 1; floor < floors; ++floor)
      for (int i = 0; i < windows; ++i) {
        const double x = width_ * (i + 0.5) / windows, z = ground + upper * (floor - 1) + 0.85;
        window(x - 0.5, x + 0.5, z, z + 1.45, lit());
      }
  }

 private:
  void front(Material wall, double z0, double z1) {
    const int panes = std::max(1, static_cast<int>(width_ / 3.5));
    for (int i = 0; i < panes; ++i) {
      const double a = width_ * i / panes, b = width_ * (i + 1) / panes;
      pen_.quad(wall, {a, 0, z0}, {b, 0, z0}, {b, 0, z1}, {a, 0, z1});
    }
  }
  Material lit() {
    const double dice = random_.uniform(0.0, 1.0);
    return dice < 0.14   ? Material::kWindowWarm
           : dice < 0.27 ? Material::kWindowDim
           : dice < 0.31 ? Material::kWindowCool
                         : Material::kWindowDark;
  }
  /// A frame stands out of the wall; its pane lies 4 cm behind the frame's face.
  void window(double x0, double x1, double z0, double z1, Material pane) {
    constexpr double kFrame_m = 0.09, kOut_m = 0.05;
    const auto bar = [&](double a, double b, double low, double high) {
      pen_.box(Material::kFacadeWhite, {a, -kOut_m, low}, {b, 0.0, high});
    };
    bar(x0 - kFrame_m, x0, z0, z1);
    bar(x1, x1 + kFrame_m, z0, z1);
    bar(x0 - kFrame_m, x1 + kFrame_m, z1, z1 + kFrame_m);
    pen_.box(Material::kKerb, {x0 - 0.14, -0.12, z0 - 0.07}, {x1 + 0.14, 0.0, z0});
    const double middle = 0.5 * (x0 + x1);
    for (const auto& [a, b] : {std::pair(x0, middle - 0.03), std::pair(middle + 0.03, x1)})
      pen_.quad(pane, {a, -0.01, z0}, {b, -0.01, z0}, {b, -0.01, z1}, {a, -0.01, z1});
    bar(middle - 0.03, middle + 0.03, z0, z1);
  }
  void ground_floor(bool shop, double height) {
    const double door = random_.uniform(0.6, width_ - 1.7);
    const Material leaf = random_.uniform(0.0, 1.0) < 0.5 ? Material::kDoor : Material::kWood;
    pen_.box(leaf, {door, -0.03, 0.0}, {door + 1.05, 0.0, 2.15});
    pen_.box(Material::kStone, {door - 0.1, -0.3, 0.0}, {door + 1.15, 0.0, 0.13});
    double x = 0.5;
    while (x + 1.1 < width_ - 0.3) {
      const double wide = shop ? 2.2 : 1.1;
      if (x + wide > width_ - 0.3) break;
      if (x + wide > door - 0.2 && x < door + 1.25) {
        x = door + 1.35;
        continue;
      }
      const bool open = shop && random_.uniform(0.0, 1.0) < 0.6;
      window(x, x + wide, shop ? 0.6 : 1.0, height - (shop ? 0.7 : 0.9),
             shop ? (open ? Material::kShopFront : Material::kWindowDark) : lit());
      x += wide + (shop ? 0.4 : 1.3);
    }
  }

  Pen pen_;
  Random& random_;
  double width_;
};

void add_houses(Model& model, const Path& path) {
  Random random(20261125);
  int number = 0;
  for (const double side : {-1.0, 1.0}) {
    double s = path.begin_m();
    while (s < path.end_m() - 8.0) {
      const double width = random.uniform(8.5, 15.0);
      if (random.uniform(0.0, 1.0) < 0.12) {  // a gap with a tree behind a wall
        const double wide = random.uniform(6.0, 11.0);
        Node& node = model.add(numbered_node("wall", number++));
        const double wall = side < 0.0 ? kRightWall_m : kLeftWall_m;
        Pen pen(node, path.placed(s + 0.5 * wide, wall + side * 0.15, 0.0, kKerb_m));
        pen.box(Material::kStone, {-0.5 * wide, -0.15, 0.0}, {0.5 * wide, 0.15, 1.1});
        draw_tree(Pen(model.add(numbered_node("tree", number)), path.placed(s + 0.5 * wide, wall + side * 4.5)), random,
                  random.uniform(7.0, 9.5), Material::kLeaves);
        s += wide + 0.4;
        continue;
      }
      Node& node = model.add(numbered_node("house", number++));
      // On the left the front is drawn from far to near, so that its outside looks at the street.
      const double middle = s + 0.5 * width, wall = side < 0.0 ? kRightWall_m : kLeftWall_m;
      const glm::dmat4 frame = path.placed(middle, wall, side < 0.0 ? std::numbers::pi : 0.0, kKerb_m - 0.05);
      glm::dmat4 shift(1.0);
      shift[3] = glm::dvec4(-0.5 * width, 0.0, 0.0, 1.0);
      House(Pen(node, frame * shift), random, width).draw();
      s += width + (random.uniform(0.0, 1.0) < 0.2 ? random.uniform(0.8, 2.5) : 0.0);
    }
  }
}

void draw_street_lamp(Pen pen) {  // x toward the street
  pen.cone(Material::kSteel, {0, 0, 0}, 0.085, {0, 0, 1.2}, 0.085, 10);
  pen.cone(Material::kSteel, {0, 0, 1.2}, 0.06, {0, 0, kLampHeight_m + 0.12}, 0.042, 8);
  pen.cone(Material::kSteel, {0, 0, kLampHeight_m + 0.08}, 0.035, {0.75, 0, kLampHeight_m + 0.1}, 0.03, 7);
  const double z = kLampHeight_m + 0.03;
  pen.box(Material::kLampHousing, {0.65, -0.14, z}, {1.25, 0.14, z + 0.09});
  pen.box(Material::kLampGlass, {0.72, -0.115, z - 0.035}, {1.22, 0.115, z});
}

std::vector<MadeLamp> add_lamps(Model& model, const Path& path) {
  std::vector<MadeLamp> lamps;
  int number = 0;
  for (double s = path.begin_m() + 8.0; s < path.end_m(); s += 0.5 * kLampEvery_m) {
    const bool left = number % 2 == 1;
    const double t = left ? kLeftKerb_m + 0.55 : kRightKerb_m - 0.55, turn = left ? -0.5 : 0.5;
    const glm::dmat4 frame = path.placed(s, t, turn * std::numbers::pi, kKerb_m);
    draw_street_lamp(Pen(model.add(numbered_node("street_lamp", number++)), frame));
    const glm::dvec4 light = frame * glm::dvec4(0.97, 0.0, kLampHeight_m - 0.02, 1.0);
    lamps.push_back({"street", glm::dvec3(light), path.heading_rad(s) + turn * std::numbers::pi, 0.0});
  }
  return lamps;
}

void add_things(Model& model, const Path& path) {
  Random random(77), colours(78);
  constexpr std::array kPaints{Material::kCarPaint, Material::kCarPaintSilver, Material::kCarPaintBlack,
                               Material::kCarPaintRed, Material::kCarPaintWhite};
  int number = 0;
  for (double s = path.begin_m() + 6.0; s < path.end_m() - 6.0; s += 6.2) {  // parked in line on the right
    if (std::abs(s - kCrossing_m) < 11.0 || random.uniform(0.0, 1.0) < 0.25) continue;
    const double t = kRightKerb_m + 1.05 + random.uniform(-0.08, 0.08);
    const auto paint = static_cast<std::size_t>(colours.uniform(0.0, 1.0) * kPaints.size());
    draw_car(Pen(model.add(numbered_node("car_parked", number++)), path.placed(s - 1.24, t)), kPaints.at(paint));
  }
  const std::array<Clothes, 3> clothes{{{Material::kClothDark, Material::kClothDark, Material::kClothDark},
                                        {Material::kClothBlue, Material::kClothLight, Material::kClothLight},
                                        {Material::kClothDark, Material::kClothRed, Material::kClothRed}}};
  struct Walker {
    double s, t, turn;
  };
  // One waits at the zebra, the others walk on the pavements.
  constexpr std::array<Walker, 9> kWalkers{{{kCrossing_m + 0.6, kRightKerb_m + 1.7, 0.5},
                                            {62.0, kLeftKerb_m + 1.4, 1.0},
                                            {63.1, kLeftKerb_m + 1.9, 1.0},
                                            {95.0, kRightKerb_m - 1.3, 0.0},
                                            {170.0, kLeftKerb_m + 1.3, 0.0},
                                            {214.0, kRightKerb_m - 1.5, 1.0},
                                            {300.0, kLeftKerb_m + 1.5, 1.0},
                                            {402.0, kRightKerb_m - 1.3, 0.0},
                                            {520.0, kLeftKerb_m + 1.4, 0.0}}};
  int walker = 0;
  for (const Walker& w : kWalkers) {
    const double stride = walker == 0 ? 0.1 : 0.5;
    draw_walker(Pen(model.add(numbered_node("pedestrian", walker)),
                    path.placed(w.s, w.t, w.turn * std::numbers::pi, walker == 0 ? 0.0 : kKerb_m)),
                clothes[static_cast<std::size_t>(walker % 3)], stride, walker % 2 == 0, walker % 3 == 1);
    ++walker;
  }
  for (const double s : {250.0, 258.0, 266.0, 274.0, 455.0, 463.0, 471.0})  // trees on the left pavement
    draw_tree(Pen(model.add(numbered_node("tree", 900 + static_cast<int>(s))),
                  path.placed(s, kLeftKerb_m + 0.9, 0.0, kKerb_m)),
              random, random.uniform(5.0, 6.2), Material::kLeaves);
}

}  // namespace

MadeScene make_town() {
  const Path path(700.0, 40.0, {{150.0, 330.0, 260.0}, {370.0, 560.0, -240.0}});
  MadeScene scene;
  add_ground(scene.model, path);
  add_houses(scene.model, path);
  const std::vector<MadeLamp> lamps = add_lamps(scene.model, path);
  add_things(scene.model, path);
  scene.lane_csv = path.lane_csv(-1.625);
  scene.street_lamps = street_lamps_toml("The lamps of the town street, by phare-make-scene (tools/scene/town.cpp).",
                                         {{"street", "generated/scenes/street_led.ies", 4000.0}}, lamps);
  return scene;
}

}  // namespace phare::scene
