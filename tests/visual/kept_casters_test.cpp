// What stands in the light is looked for only where it, or the light, has moved; so are the maps of it drawn.
#include "visual/kept_casters.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/visual/shape.h"
#include "tests/visual/shared_renderer.h"
#include "tests/visual/yard.h"
#include "visual/passes/shadows.h"

namespace phare {
namespace {

Scene box(const glm::dvec3& low_m, const glm::dvec3& high_m) {
  Shape shape;
  shape.box(low_m, high_m);
  return shape.scene();
}

/// A person's size, about its own origin.
Scene walker() {
  return box({-0.2, -0.3, 0.0}, {0.2, 0.3, 1.8});
}

void expect_same(const CastBy& found, const CastBy& expected) {
  EXPECT_EQ(found.count, expected.count);
  EXPECT_EQ(found.chunks, expected.chunks);
  EXPECT_EQ(found.far_sides.corners, expected.far_sides.corners);
  EXPECT_EQ(found.both_sides.corners, expected.both_sides.corners);
  EXPECT_EQ(found.part.left, expected.part.left);
  EXPECT_EQ(found.part.right, expected.part.right);
  EXPECT_EQ(found.part.high, expected.part.high);
  EXPECT_EQ(found.part.low, expected.part.low);
}

TEST(KeptCasters, AreLookedForWhereLampEyeOrSceneMovedAndAreThoseOfAFullSearch) {
  const ShadowCasters casters(box({20, -4, 0}, {21, -2, 3}), walker());
  const ViewGeometry view({.eye_m = {0.0, 0.3, 1.2}}, 16.0 / 9.0), nodding({.eye_m = {0.0, 0.3, 1.21}}, 16.0 / 9.0);
  KeptCasters kept;
  KeptCasters::Lamp lamp{.reach = LampReach({2.0, 0.6, 0.65}, glm::dmat3(1.0), {{1.0, 0.0, 0.0}, 1.3})};
  std::vector<PlacedMesh> moving{{.mesh = 0, .position_m = {12.0, 1.0, 0.0}}};
  std::shared_ptr<const CastBy> before;
  /// Whether standing and moving things are looked for by this frame.
  const auto looked_for = [&](const ViewGeometry& by) {
    const KeptCasters::Counts counts = kept.counts();
    kept.begin_frame();
    const auto found = kept.find(casters, std::span(&lamp, 1), moving, {.view = &by});
    expect_same(*found.front(), casters.by(lamp.reach, lamp.world_from_image, moving, lamp.carried_by, {.view = &by}));
    const bool same = found.front() == before;
    before = found.front();
    EXPECT_EQ(same, kept.counts().moving == counts.moving) << "the same object where nothing was looked for";
    return std::pair(kept.counts().standing > counts.standing, kept.counts().moving > counts.moving);
  };
  using Looked = std::pair<bool, bool>;
  EXPECT_EQ(looked_for(view), Looked(true, true));
  EXPECT_EQ(looked_for(view), Looked(false, false)) << "all stands still";
  moving[0].position_m.y = 0.9;
  EXPECT_EQ(looked_for(view), Looked(true, true)) << "somebody walks: for once also what stands, alone";
  for (const double y_m : {0.8, 0.7, 5.0, 40.0, 0.6}) {
    moving[0].position_m.y = y_m;
    EXPECT_EQ(looked_for(view), Looked(false, true)) << y_m;
  }
  EXPECT_EQ(looked_for(view), Looked(false, false));
  EXPECT_EQ(looked_for(nodding), Looked(true, true)) << "the eye";
  lamp.version = 1;
  EXPECT_EQ(looked_for(nodding), Looked(true, true)) << "the beam";
  lamp.reach.tip_m.z += 1e-3;
  EXPECT_EQ(looked_for(nodding), Looked(true, true)) << "the lamp";
  lamp.carried_by = 0;
  EXPECT_EQ(looked_for(nodding), Looked(true, true)) << "what carries it casts nothing";
  moving[0].position_m.x = 13.0;
  EXPECT_EQ(looked_for(nodding), Looked(false, false)) << "wherever it is";
  moving.clear();
  lamp.carried_by = SIZE_MAX;
  EXPECT_EQ(looked_for(nodding).second, true) << "it is gone";
}

class KeptMaps : public SharedRenderer {
 protected:
  static std::ptrdiff_t maps(const FrameResult& frame) {
    return std::ranges::count(frame.passes, std::string("shadows"), &PassTime::name);
  }
};

TEST_F(KeptMaps, AreDrawnAnewOnlyWhereSomethingMovedAndShowTheSamePicture) {
  renderer->set_beam(0, image_of(cut_off_table(PhotometricType::kA, GammaAxis::kGamma0)));
  Scene scene = yard();
  ASSERT_TRUE(renderer->load_scene(scene, walker()).ok());
  FrameInput input = driver_view();
  input.want_image = true;
  input.moving = {{.mesh = 0, .position_m = {14.0, 0.8, 0.0}}};
  ASSERT_EQ(maps(renderer->draw(input)), 1);
  const std::vector<std::uint8_t> drawn = renderer->read_image().rgba;
  const FrameResult still = renderer->draw(input);
  EXPECT_EQ(maps(still), 0);
  EXPECT_EQ(renderer->read_image().rgba, drawn);
  EXPECT_TRUE(still.effects.on(Effect::kShadows));
  renderer->draw(input);  // the room for the beam's upload is not used any more
  const std::uint64_t memory = renderer->device_memory_bytes();

  // Somebody walks, the lamp nods, another level, another scene: the picture of a renderer that has seen no other.
  const auto as_if_first = [&](const FrameInput& of, const Scene& standing) {
    Result<Renderer> other = Renderer::create({.width_px = 320, .height_px = 180, .validation = true});
    EXPECT_TRUE(other.ok());
    other->set_beam(0, image_of(cut_off_table(PhotometricType::kA, GammaAxis::kGamma0)));
    EXPECT_TRUE(other->load_scene(standing, walker()).ok());
    other->draw(of);
    return other->read_image().rgba;
  };
  const auto expect_anew = [&](const char* what) {
    EXPECT_EQ(maps(renderer->draw(input)), 1) << what;
    EXPECT_EQ(renderer->read_image().rgba, as_if_first(input, scene)) << what;
    EXPECT_EQ(maps(renderer->draw(input)), 0) << what;
    EXPECT_EQ(renderer->read_image().rgba, as_if_first(input, scene)) << what;
  };
  input.moving[0].position_m.y = 0.5;
  expect_anew("somebody walks");
  input.moving[0].position_m.y = 0.2;
  expect_anew("and walks on");
  EXPECT_EQ(renderer->device_memory_bytes(), memory) << "nothing is freed and made again";
  input.lamps[0].world_from_image = input.lamps[0].world_from_image * aim_rotation(0.0, 0.01, 0.0);
  expect_anew("a lamp nods");
  input.effects[static_cast<std::size_t>(Effect::kShadows)] = 3;
  expect_anew("a level");
  scene.chunks.pop_back();
  ASSERT_TRUE(renderer->load_scene(scene, walker()).ok());
  expect_anew("a scene");
}

}  // namespace
}  // namespace phare
