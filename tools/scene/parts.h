// What the scene is put together from; each function adds its nodes to the model.
#pragma once

#include <vector>

#include "tools/scene/alignment.h"
#include "tools/scene/mesh.h"

namespace phare::scene {

/// "road_…", "ground_…" and "marking_…", one node each 50 m.
void add_road(Model& model, const Alignment& road);
/// "post_…", "rail_…", "sign_…".
void add_furniture(Model& model, const Alignment& road);
/// "tree_…" (some trees of one place per node) and "bush_…".
void add_plants(Model& model, const Alignment& road);
/// "barn", "car_parked", "fence_…", "bale_…".
void add_things(Model& model, const Alignment& road);
/// "pedestrian_1", "pedestrian_2", "cyclist".
void add_people(Model& model, const Alignment& road);

/// "car", "lorry", "bicycle", "pedestrian", "deer": those that move, each about the origin, x forward; and "wall", 25 m before
/// the lamps in the camera of that name.
void add_road_users(Model& model);

struct Clothes {
  Material legs, torso, sleeves;
};
/// Walks along x. `stride` is how far the left foot is ahead of the right, m.
void draw_walker(Pen pen, const Clothes& clothes, double stride, bool coat, bool bag);
/// A roe deer that stands and looks ahead, x forward from its middle, on the ground.
void draw_deer(Pen pen);
/// x forward from the middle of the rear wheel, on the ground.
void draw_cyclist(Pen pen);
/// A broad-leaved tree about its foot.
void draw_tree(Pen pen, Random& random, double height, Material leaves);
/// A post of 1 m with its reflectors; x looks along the road; `outer` is +1 where the road's outside is to the left.
void draw_kerb_post(Pen pen, double outer);
/// A saloon of 4.5 m; x forward from the rear axle's middle, on the ground.
void draw_car(Pen pen, Material paint = Material::kCarPaint);

/// Object frame on the ground at station and offset: x along the road turned left by turn_rad, z straight up.
glm::dmat4 placed(const Alignment& road, double s_m, double t_m, double turn_rad = 0.0, double raise_m = 0.0);
/// Object frame at a point of the world.
glm::dmat4 placed_at(glm::dvec3 point_m, double heading_rad);

}  // namespace phare::scene
