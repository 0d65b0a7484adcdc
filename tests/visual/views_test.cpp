// Many views in one frame: each is what it is alone, costs what it calls for, and leaves the others as they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/visual/yard.h"
#include "visual/photometry/table/illuminance.h"
#include "visual/renderer.h"

namespace phare {
namespace {

constexpr int kFrameWidth = 320, kFrameHeight = 180;

struct Pixels {
  int left = 0, top = 0, width = 0, height = 0;
};

Image8 cut(const Image8& image, const Pixels& part) {
  Image8 result{part.width, part.height, {}};
  for (int y = 0; y < part.height; ++y)
    for (int i = 0; i < 4 * part.width; ++i)
      result.rgba.push_back(
          image.rgba[static_cast<std::size_t>(4 * ((part.top + y) * image.width_px + part.left) + i)]);
  return result;
}

std::size_t different(const Image8& a, const Image8& b, int by_more_than = 0) {
  if (a.rgba.size() != b.rgba.size()) return SIZE_MAX;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) count += std::abs(int{a.rgba[i]} - int{b.rgba[i]}) > by_more_than;
  return count;
}

Renderer made(int width_px, int height_px, int samples = 1) {
  Result<Renderer> renderer =
      Renderer::create({.width_px = width_px, .height_px = height_px, .samples = samples, .validation = true});
  if (!renderer) throw std::runtime_error(renderer.error().text());
  if (!renderer->load_scene(yard()).ok()) throw std::runtime_error("the yard is a scene");
  renderer->set_beam(0, image_of(cut_off_table(PhotometricType::kA, GammaAxis::kGamma0)));
  return std::move(*renderer);
}

/// The yard from its side: sees the light on the wall.
ViewInput side_view() {
  ViewInput view = driver_view();
  view.name = "side";
  view.camera.eye_m = {12.0, -8.0, 4.0};
  view.camera.world_from_eye = aim_rotation(0.7, -0.15, 0.0);
  return view;
}

ViewInput looking_back() {
  ViewInput view = driver_view();
  view.name = "back";
  view.camera.world_from_eye = aim_rotation(std::numbers::pi, 0.0, 0.0);
  return view;
}

constexpr PicturePart kInset{.left_01 = 0.6, .top_01 = 0.05, .width_01 = 0.375, .height_01 = 0.4};
constexpr Pixels kInsetPixels{192, 9, 120, 72};

class Views : public testing::TestWithParam<int> {};

// Whatever a view calls for: what it draws into a part of the picture, or into one of its own, is bit for bit what a
// frame of that view alone draws there, and what lies around it is the frame's own view.
TEST_P(Views, EachIsWhatItIsAlone) {
  Renderer renderer = made(kFrameWidth, kFrameHeight, GetParam());
  Renderer small = made(kInsetPixels.width, kInsetPixels.height, GetParam());
  for (const bool depth_first : {false, true})
    for (const bool hdr : {false, true}) {
      const auto asked = [&](auto view) {
        view.effects[static_cast<std::size_t>(Effect::kDepthFirst)] = depth_first ? 1 : 0;
        view.want_hdr = hdr;
        view.want_image = true;
        return view;
      };
      FrameInput both = asked(driver_view());
      ViewInput inset = asked(side_view()), own = asked(side_view());
      inset.part = kInset;
      own.own_picture = {kInsetPixels.width, kInsetPixels.height};
      own.name = "own";
      both.more_views = {inset, own, asked(inset)};
      const FrameResult result = renderer.draw(both);
      const Image8 seen = renderer.read_image(), in_part = renderer.read_image(1), apart = renderer.read_image(2);
      const ImageF hdr_apart = hdr ? renderer.read_hdr(2) : ImageF{};
      const ImageF hdr_part = hdr ? renderer.read_hdr(1) : ImageF{};
      ASSERT_EQ(result.views.size(), 4u);
      EXPECT_EQ(result.views[1].name, "side");
      EXPECT_EQ(result.views[1].passes, 1u + depth_first + hdr);

      renderer.draw(asked(driver_view()));
      Image8 expected = renderer.read_image();
      FrameInput alone;
      static_cast<ViewInput&>(alone) = inset;
      renderer.draw(alone);
      const Image8 inset_alone = cut(renderer.read_image(), kInsetPixels);
      if (hdr) {
        EXPECT_EQ(renderer.read_hdr().rgba, hdr_part.rgba);
      }
      for (int y = 0; y < kInsetPixels.height; ++y)
        std::copy_n(
            &inset_alone.rgba[static_cast<std::size_t>(4 * y * kInsetPixels.width)], 4 * kInsetPixels.width,
            &expected.rgba[static_cast<std::size_t>(4 * ((kInsetPixels.top + y) * kFrameWidth + kInsetPixels.left))]);
      EXPECT_EQ(different(seen, expected), 0u) << "depth first " << depth_first << ", hdr " << hdr;
      EXPECT_EQ(different(in_part, inset_alone), 0u);

      FrameInput own_alone;
      static_cast<ViewInput&>(own_alone) = asked(side_view());
      small.draw(own_alone);
      EXPECT_EQ(different(apart, small.read_image()), 0u) << "depth first " << depth_first << ", hdr " << hdr;
      if (hdr) {
        EXPECT_EQ(hdr_apart.rgba, small.read_hdr().rgba);
      }
      // Elsewhere in a picture a view falls on other fractions of pixels: edges differ, surfaces do not.
      EXPECT_LT(different(in_part, apart, 2), in_part.rgba.size() / 50);
    }
  EXPECT_EQ(renderer.validation_messages() + small.validation_messages(), 0u);
}
INSTANTIATE_TEST_SUITE_P(Samples, Views, testing::Values(1, 4));

// The second pass finds the very depths that the first one left, whatever lights it.
class DepthFirst : public testing::TestWithParam<int> {};

TEST_P(DepthFirst, ThePictureIsTheSame) {
  Renderer renderer = made(kFrameWidth, kFrameHeight, GetParam());
  const auto drawn = [&](FrameInput input, std::size_t shadows, bool depth_first) {
    input.want_image = true;
    input.effects[static_cast<std::size_t>(Effect::kShadows)] = shadows;
    input.effects[static_cast<std::size_t>(Effect::kDepthFirst)] = depth_first ? 1 : 0;
    EXPECT_EQ(renderer.draw(input).effects.on(Effect::kDepthFirst), depth_first);
    return renderer.read_image();
  };
  FrameInput input = driver_view();
  std::vector<Image8> by_level;
  for (std::size_t level = 0; level < kShadowNames.size(); ++level) {
    by_level.push_back(drawn(input, level, false));
    EXPECT_EQ(different(drawn(input, level, true), by_level.back()), 0u) << kShadowNames[level];
  }
  EXPECT_GT(different(by_level.back(), by_level.front()), 0u) << "nothing casts a shadow";
  if (!renderer.no_reference()) {
    input.method = Method::kReference;
    EXPECT_EQ(different(drawn(input, 0, true), drawn(input, 0, false)), 0u);
  }
  EXPECT_EQ(renderer.validation_messages(), 0u);
}

INSTANTIATE_TEST_SUITE_P(Samples, DepthFirst, testing::Values(1, 4));

TEST(ViewCounts, NothingLitOneViewThreeViewsHdrOnAndOff) {
  Renderer renderer = made(kFrameWidth, kFrameHeight);
  FrameInput input = driver_view();
  input.want_hdr = true;
  renderer.draw(input);  // the buffer for reading back is there now
  input.want_hdr = false;
  renderer.draw(input);  // and the room for the beam's upload is not used any more
  const FrameResult one = renderer.draw(input);
  const std::uint64_t bytes = renderer.device_memory_bytes();
  EXPECT_EQ(one.pass_count, 1u);
  EXPECT_EQ(one.images, 2u) << "display and depth";
  EXPECT_EQ(one.shared_image_bytes, 0u);
  EXPECT_EQ(one.views.front().lamps, 2u);

  FrameInput dark = input;
  dark.lamps.clear();
  const FrameResult unlit = renderer.draw(dark);
  EXPECT_EQ(unlit.pass_count, 1u);
  EXPECT_EQ(unlit.images, 2u);
  EXPECT_EQ(unlit.views.front().lamps, 0u);

  FrameInput three = input;
  three.more_views = {side_view(), side_view()};
  three.more_views[0].part = kInset;
  three.more_views[1].part = {.left_01 = 0.0, .top_01 = 0.7, .width_01 = 0.3, .height_01 = 0.3};
  const FrameResult drawn = renderer.draw(three);
  EXPECT_EQ(drawn.pass_count, 3u);
  EXPECT_EQ(drawn.images, 2u) << "views of one picture share its images";
  EXPECT_EQ(drawn.image_bytes, one.image_bytes);
  EXPECT_EQ(drawn.draws, drawn.views[0].draws + drawn.views[1].draws + drawn.views[2].draws);
  EXPECT_EQ(drawn.triangles, drawn.views[0].triangles + drawn.views[1].triangles + drawn.views[2].triangles);
  EXPECT_EQ(drawn.passes.size(), 3u);
  EXPECT_EQ(drawn.passes[1].name, "side: lamps");
  EXPECT_EQ(renderer.device_memory_bytes(), bytes);

  // Pictures of their own take memory for themselves, but not for what they need besides.
  for (ViewInput& view : three.more_views) view.own_picture = {kFrameWidth, kFrameHeight};
  const FrameResult apart = renderer.draw(three);
  EXPECT_EQ(apart.pass_count, 3u);
  EXPECT_EQ(apart.images, 6u);
  EXPECT_LE(apart.image_bytes, one.image_bytes * 3 / 2) << "depth is shared, and the second picture has the first's";
  EXPECT_EQ(apart.image_bytes + apart.shared_image_bytes, 3 * one.image_bytes);
  EXPECT_EQ(renderer.draw(three).image_bytes, apart.image_bytes);

  three.more_views.clear();
  three.want_hdr = true;
  const FrameResult hdr = renderer.draw(three);
  EXPECT_EQ(hdr.pass_count, 2u);
  EXPECT_EQ(hdr.images, 3u);
  EXPECT_EQ(renderer.draw(input).image_bytes, one.image_bytes);
  EXPECT_EQ(renderer.device_memory_bytes(), bytes);
  EXPECT_EQ(renderer.validation_messages(), 0u);
}

TEST(ViewCounts, ThereIsNoLimitToTheNumberOfViews) {
  Renderer renderer = made(kFrameWidth, kFrameHeight);
  FrameInput input = driver_view();
  input.want_image = true;
  renderer.draw(input);
  const Image8 once = renderer.read_image();
  input.more_views.assign(40, driver_view());
  const FrameResult result = renderer.draw(input);
  EXPECT_EQ(result.pass_count, 41u);
  EXPECT_EQ(result.passes.size(), 42u) << "and one that reads back";
  EXPECT_EQ(result.views.back().name, "view 41");
  EXPECT_EQ(different(renderer.read_image(), once), 0u) << "41 times the same";
  EXPECT_EQ(renderer.draw(driver_view()).passes.size(), 1u);
  EXPECT_EQ(renderer.validation_messages(), 0u);
}

TEST(ViewLamps, TwoDesignsSideBySideDifferAsTheirLampsDo) {
  Renderer renderer = made(kFrameWidth, kFrameHeight);
  IntensityTable doubled = cut_off_table(PhotometricType::kA, GammaAxis::kGamma0);
  for (double& cd : doubled.candela) cd *= 2.0;
  renderer.set_beam(12, image_of(doubled));  // of another design, beyond what one view has
  FrameInput input = driver_view();
  input.part.width_01 = 0.5;
  input.want_hdr = true;
  ViewInput beside = input;
  beside.part.left_01 = 0.5;
  for (PlacedLamp& lamp : beside.lamps) lamp.beam = 12;
  input.more_views = {beside};
  renderer.draw(input);
  const ImageF a = renderer.read_hdr(0), b = renderer.read_hdr(1);
  ASSERT_EQ(a.width_px, kFrameWidth / 2);
  ASSERT_EQ(a.rgba.size(), b.rgba.size());
  std::size_t lit = 0, edges = 0;
  for (std::size_t i = 3; i < a.rgba.size(); i += 4) {
    const double lx = static_cast<double>(a.rgba[i]), other_lx = static_cast<double>(b.rgba[i]);
    if (lx <= 0.1) continue;
    ++lit;
    // Edges of surfaces may lie elsewhere in their pixel, where illuminance is that of another surface.
    const double beside_two = std::abs(other_lx / lx - 2.0);
    if (beside_two < 2e-3) continue;  // two roundings of 2^-11
    ++edges;
    EXPECT_LT(beside_two, 0.1) << i;
  }
  EXPECT_GT(lit, 5000u);
  EXPECT_LT(edges, lit / 50) << "more than lies along edges";
  EXPECT_EQ(renderer.validation_messages(), 0u);
}

// What is left out by bound changes no pixel, and the view costs what it costs without lamps.
TEST(ViewLamps, AViewThatSeesNothingLitCostsItsFixedPartOnly) {
  Renderer renderer = made(kFrameWidth, kFrameHeight);
  FrameInput back;
  static_cast<ViewInput&>(back) = looking_back();
  back.want_image = true;
  const FrameResult result = renderer.draw(back);
  EXPECT_EQ(result.views.front().lamps, 0u);
  EXPECT_EQ(result.views.front().lamps_unreached, 2u);
  EXPECT_EQ(result.views.front().lamps_over_limit, 0u);
  const Image8 picture = renderer.read_image();
  back.lamps.clear();
  const FrameResult bare = renderer.draw(back);
  EXPECT_EQ(bare.views.front().lamps_unreached, 0u);
  EXPECT_EQ(result.pass_count, bare.pass_count);
  EXPECT_EQ(result.draws, bare.draws);
  EXPECT_EQ(different(picture, renderer.read_image()), 0u);

  // A dark beam is no lamp at all.
  renderer.set_beam(3, compose_beam_image({}));
  FrameInput ahead = driver_view();
  ahead.lamps[1].beam = 3;
  EXPECT_EQ(renderer.draw(ahead).views.front().lamps, 1u);
  EXPECT_EQ(renderer.draw(ahead).views.front().lamps_unreached, 0u);
}

TEST(ViewLamps, MoreThanADrawHoldsAreCountedAndThoseThatReachNothingDoNotCount) {
  Renderer renderer = made(kFrameWidth, kFrameHeight);
  FrameInput input = driver_view();
  const PlacedLamp lamp = input.lamps.front();
  PlacedLamp behind = lamp;
  behind.world_from_image = aim_rotation(std::numbers::pi, 0.0, 0.0);
  behind.position_m.x = -4.0;
  input.lamps.assign(5, behind);
  input.lamps.insert(input.lamps.end(), kLampsPerDraw + 3, lamp);
  const ViewResult view = renderer.draw(input).views.front();
  EXPECT_EQ(view.lamps, kLampsPerDraw + 3);
  EXPECT_EQ(view.lamps_unreached, 5u);
  EXPECT_EQ(view.lamps_over_limit, 3u);
  EXPECT_EQ(renderer.validation_messages(), 0u);
}

// Fifteen lamps over a row of five plates, three above each: every plate is lit by its own alone, and every pixel has
// the light of all fifteen.
TEST(ViewLamps, ManyLampsLightEachBlockThatTheyReach) {
  constexpr double kApart_m = 200.0;
  Scene plates;
  plates.materials = {{.name = "plate", .reflectance = glm::vec3(0.3f)}};
  for (int k = 0; k < 5; ++k) {
    SceneChunk chunk{.node = "plate", .origin_m = {0, kApart_m * k, 0}, .low_m = {}, .high_m = {}};
    chunk.first_index = static_cast<std::uint32_t>(plates.indices.size());
    chunk.first_vertex = static_cast<std::uint32_t>(plates.vertices.size());
    for (const glm::vec3 p : {glm::vec3{0, 0, 0}, {80, 0, 0}, {80, 80, 0}, {0, 80, 0}})
      plates.vertices.push_back({p, {0, 0, 1}});
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) plates.indices.push_back(i);
    chunk.index_count = 6;
    chunk.vertex_count = 4;
    chunk.low_m = chunk.origin_m;
    chunk.high_m = chunk.origin_m + glm::dvec3(80, 80, 0);
    plates.chunks.push_back(chunk);
  }
  Renderer renderer = made(kFrameWidth, kFrameHeight);
  ASSERT_TRUE(renderer.load_scene(plates).ok());
  IntensityTable spot;  // 30° to each side
  for (double deg = -30.0; deg <= 30.0; deg += 1.5) spot.first_deg.push_back(deg);
  spot.second_deg = spot.first_deg;
  for (const double v : spot.second_deg)
    for (const double h : spot.first_deg) spot.candela.push_back(9000.0 * std::exp(-(h * h + v * v) / 200.0));
  renderer.set_beam(0, image_of(spot));

  FrameInput input;
  input.camera = {.eye_m = {40, 440, 800}, .world_from_eye = aim_rotation(0.0, -0.5 * std::numbers::pi, 0.0)};
  for (int k = 0; k < 15; ++k)
    input.lamps.push_back({.position_m = {40, kApart_m * (k / 3) + 20.0 * (k % 3), 30},
                           .world_from_image = aim_rotation(0.0, -0.5 * std::numbers::pi, 0.0)});
  const ViewResult view = renderer.draw(input).views.front();
  EXPECT_EQ(view.lamps, 15u);
  EXPECT_EQ(view.lamps_over_limit, 0u);
  double worst = 0.0;
  std::size_t judged = 0;
  for (const AuditSample& sample : renderer.audit(input, 500, 1)) {
    double expected = 0.0;
    for (const PlacedLamp& lamp : input.lamps)
      expected += illuminance_lx(lamp.position_m, lamp.world_from_image, spot, 1.0, sample.point.position_m,
                                 sample.point.normal);
    if (expected < 0.1) continue;
    ++judged;
    worst = std::max(worst, std::abs(sample.illuminance_lx / expected - 1.0));
  }
  EXPECT_GT(judged, 200u);
  // Seen from 900 m a place is known to two roundings of 2^-24 of that, 1e-4 m; at 25° from its axis a lamp's light
  // falls by 0.25 a degree, 0.4 a metre.
  EXPECT_LT(worst, 4e-5);
  EXPECT_EQ(renderer.validation_messages(), 0u);
}

// A pair of lamps of another vehicle beside four: where one of the two reaches what is seen no more, no pipeline is
// made for it, and the picture is the same.
TEST(ViewLamps, ByFewKindsAPairTakesNoPipelineForHowFarItReaches) {
  Renderer renderer = made(kFrameWidth, kFrameHeight);
  FrameInput four = driver_view();
  four.want_image = four.few_kinds = true;
  for (const double dz_m : {0.1, 0.2})
    for (const PlacedLamp& lamp : driver_view().lamps) {
      four.lamps.push_back(lamp);
      four.lamps.back().position_m.z += dz_m;
    }
  four.lamps.resize(4);
  renderer.draw(four);
  FrameInput six = four;
  for (const double y_m : {2.0, 3.0}) {
    six.lamps.push_back(four.lamps.front());
    six.lamps.back().position_m += glm::dvec3(30.0, y_m, 0.0);
  }
  EXPECT_EQ(renderer.draw(six).views.front().lamps, 6u);
  const Image8 by_both = renderer.read_image();

  FrameInput five = six;
  five.lamps.back().world_from_image = aim_rotation(std::numbers::pi, 0.0, 0.0);
  five.lamps.back().position_m.x = -4.0;
  const FrameResult few = renderer.draw(five);
  EXPECT_EQ(few.pipelines_made, 0u);
  const Image8 by_one = renderer.read_image();
  EXPECT_GT(different(by_one, by_both), 1000u);

  five.few_kinds = false;
  const FrameResult many = renderer.draw(five);
  EXPECT_GT(many.pipelines_made, 0u);
  EXPECT_EQ(many.views.front().lamps_unreached, 1u);
  EXPECT_EQ(different(renderer.read_image(), by_one), 0u);
  EXPECT_EQ(renderer.validation_messages(), 0u);
}

// What a surface does with light is no part of its illuminance: of false colours all kinds of surface are one.
TEST(ViewLamps, LuxByColourIsOfOneKindOfSurface) {
  Renderer renderer = made(kFrameWidth, kFrameHeight);
  FrameInput input = driver_view();
  const std::uint64_t photo = renderer.draw(input).pipelines_made;
  input.view = View::kFalseColour;
  const std::uint64_t lux = renderer.draw(input).pipelines_made;
  EXPECT_EQ(photo, 3u);
  EXPECT_EQ(lux, 1u);
  EXPECT_EQ(renderer.validation_messages(), 0u);
}

// A beam that changes is copied by a pass of the frame itself, one that does not by none.
TEST(ViewLamps, AChangedBeamIsAPassOfTheFrame) {
  Renderer renderer = made(kFrameWidth, kFrameHeight);
  const auto uploads = [](const FrameResult& result) {
    return std::ranges::count_if(result.passes, [](const PassTime& pass) { return pass.name == "beams"; });
  };
  FrameInput input = driver_view();
  input.more_views = {side_view()};
  EXPECT_EQ(uploads(renderer.draw(input)), 1) << "one for all views";
  EXPECT_EQ(uploads(renderer.draw(input)), 0);
  BeamImage image = image_of(cut_off_table(PhotometricType::kA, GammaAxis::kGamma0));
  const TexelRect all{0, 0, image.first_deg.size(), image.second_deg.size()};
  const TexelRect some{2, 3, 20, 30}, across{10, 20, 40, 60}, apart{60, 100, 70, 110};
  const std::uint64_t before = renderer.uploaded_texels();
  for (float& cd : image.candela) cd *= 1.5f;
  const std::array<TexelRect, 3> parts{some, across, apart};
  renderer.change_beam(0, image, parts);
  EXPECT_EQ(uploads(renderer.draw(input)), 1);
  EXPECT_LT(renderer.uploaded_texels() - before, all.texels() / 2);
  renderer.change_beam(0, image, std::span(&all, 1));
  renderer.set_beam(20, image);
  input.want_image = true;
  input.more_views.clear();
  EXPECT_EQ(uploads(renderer.draw(input)), 1);
  const Image8 changed = renderer.read_image();
  for (PlacedLamp& lamp : input.lamps) lamp.beam = 20;
  renderer.draw(input);
  EXPECT_EQ(different(renderer.read_image(), changed), 0u) << "changed in place, or set anew";
  EXPECT_EQ(renderer.validation_messages(), 0u);
}

TEST(ViewMirror, IsThePictureTurnedLeftForRight) {
  Renderer renderer = made(kFrameWidth, kFrameHeight);
  FrameInput input;
  static_cast<ViewInput&>(input) = side_view();
  input.want_image = true;
  renderer.draw(input);
  const Image8 plain = renderer.read_image();
  input.camera.world_from_eye[1] = -input.camera.world_from_eye[1];
  renderer.draw(input);
  const Image8 mirrored = renderer.read_image();
  Image8 turned = plain;
  for (int y = 0; y < kFrameHeight; ++y)
    for (int x = 0; x < kFrameWidth; ++x)
      std::copy_n(&plain.rgba[static_cast<std::size_t>(4 * (y * kFrameWidth + x))], 4,
                  &turned.rgba[static_cast<std::size_t>(4 * (y * kFrameWidth + kFrameWidth - 1 - x))]);
  EXPECT_LT(different(mirrored, turned, 2), turned.rgba.size() / 200) << "edges may fall on the other pixel";
  EXPECT_GT(different(mirrored, plain, 2), turned.rgba.size() / 20);
  EXPECT_EQ(renderer.validation_messages(), 0u);
}

}  // namespace
}  // namespace phare
