// unit: depths of what casts that the processor draws, against the definition, texel by texel.
#include "visual/caster_depths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "shaders/lamps.h"

namespace phare {
namespace {

CastBounds bounds_of(const std::array<glm::vec3, 3>& triangle) {
  CastBounds bounds{.least = glm::vec2(1e30f), .most = glm::vec2(-1e30f), .nearest_m = 1e30f};
  for (const glm::vec3& corner : triangle) {
    bounds.beside = bounds.beside || corner.x < shader::kShadowNear_m;
    const glm::vec2 tangents = glm::vec2(corner.y, corner.z) / corner.x;
    bounds.least = glm::min(bounds.least, tangents), bounds.most = glm::max(bounds.most, tangents);
    bounds.nearest_m = std::min(bounds.nearest_m, corner.x);
  }
  return bounds;
}

void add(WholeCasters& casters, const std::array<glm::vec3, 3>& triangle) {
  casters.corners.insert(casters.corners.end(), triangle.begin(), triangle.end());
  casters.bounds.push_back(bounds_of(triangle));
}

/// What a ray from the lamp meets of a triangle: how far forward, and how far within it is the ray, as the least
/// barycentric coordinate.
struct Met {
  double ahead_m = 0.0, within = -1.0;
};
Met met(const std::array<glm::vec3, 3>& triangle, const glm::dvec3& ray) {
  const glm::dvec3 a = triangle[0], ab = glm::dvec3(triangle[1]) - a, ac = glm::dvec3(triangle[2]) - a;
  const glm::dvec3 across = glm::cross(ray, ac);
  const double size = glm::dot(ab, across);
  const double u = glm::dot(-a, across) / size;
  const double v = glm::dot(ray, glm::cross(-a, ab)) / size;
  return {glm::dot(ac, glm::cross(-a, ab)) / size * ray.x, std::min({u, v, 1.0 - u - v})};
}

/// The change of 1 over the way forward across a texel, the larger of both ways, times kShadowNear_m.
double slope(const std::array<glm::vec3, 3>& triangle, const DepthPicture& picture) {
  const glm::dvec3 a = triangle[0], normal = glm::cross(glm::dvec3(triangle[1]) - a, glm::dvec3(triangle[2]) - a);
  const glm::dvec2 per_texel = glm::dvec2(normal.y, normal.z) / glm::dot(normal, a) / picture.texels;
  return shader::kShadowNear_m * std::max(std::abs(per_texel.x), std::abs(per_texel.y));
}

struct Drawn {
  std::vector<float> texels;
  std::size_t held = 0;  ///< that something was drawn into
};

/// Draws the triangles and asks for each texel whether it holds the nearest over its middle. Where a side passes within
/// a 256th of a texel of the middle either answer counts.
Drawn expect_depths(const DepthPicture& picture, const std::vector<std::array<glm::vec3, 3>>& triangles,
                    bool both_sides) {
  CastBy cast;
  for (const auto& triangle : triangles) add(both_sides ? cast.both_sides : cast.far_sides, triangle);
  Drawn drawn{std::vector<float>(std::size_t{picture.width} * picture.height)};
  std::vector<float> plain(drawn.texels.size());
  raise_depths(picture, cast, false, drawn.texels);
  raise_depths_one_by_one(picture, cast, false, plain);
  std::size_t wrong = 0, differ = 0;
  for (std::uint32_t row = 0; row < picture.height; ++row)
    for (std::uint32_t column = 0; column < picture.width; ++column) {
      const std::size_t i = std::size_t{row} * picture.width + column;
      const auto ray_at = [&](double right, double down) {
        return glm::dvec3(1.0, (0.5 * picture.width - (column + 0.5 + right)) / picture.texels.x,
                          (0.5 * picture.height - (row + 0.5 + down)) / picture.texels.y);
      };
      const bool open = column >= picture.margin && row >= picture.margin && column + picture.margin < picture.width &&
                        row + picture.margin < picture.height;
      // Over the middle surely, and over a place beside it at least.
      double least = 0.0, most = 0.0;
      for (const auto& triangle : triangles) {
        const double back = both_sides ? 1.5 * slope(triangle, picture) : 0.0;
        bool surely = true, perhaps = false;
        for (const double right : {-1.0 / 256, 0.0, 1.0 / 256})
          for (const double down : {-1.0 / 256, 0.0, 1.0 / 256}) {
            const Met at = met(triangle, ray_at(right, down));
            const bool is = at.within >= 0.0 && at.ahead_m >= shader::kShadowNear_m;
            surely = surely && is, perhaps = perhaps || is;
          }
        const double depth = std::max(0.0, shader::kShadowNear_m / met(triangle, ray_at(0, 0)).ahead_m - back);
        if (open && surely) least = std::max(least, depth);
        if (open && perhaps) {
          // Just outside of a steep triangle its plane may be far off: no nearer than its nearest corner.
          double nearest_m = 1e30;
          for (const glm::vec3& corner : triangle) nearest_m = std::min(nearest_m, double{corner.x});
          nearest_m = std::max(nearest_m, double{shader::kShadowNear_m});
          most = std::max(most, std::min(depth < 0.0 ? 1.0 : depth, shader::kShadowNear_m / nearest_m));
        }
      }
      const double is = drawn.texels[i], room = 1e-6 + 1e-5 * is;  // as the header says: float32 adds up
      if (is < least - room || is > most + room) ++wrong;
      if (is > 0.0) ++drawn.held;
      // Both add up a row's depths in their own way.
      if (std::abs(is - double{plain[i]}) > room) ++differ;
    }
  EXPECT_EQ(wrong, 0u);
  EXPECT_LE(differ, drawn.held / 500) << "sides on the middle of a texel";
  return drawn;
}

std::array<glm::vec3, 3> some(std::mt19937& random, float size_m) {
  std::uniform_real_distribution<float> ahead_m(2.0f, 60.0f), tangent(-1.1f, 1.1f), off_m(-size_m, size_m);
  const float x = ahead_m(random);
  const glm::vec3 at(x, tangent(random) * x, tangent(random) * x);
  std::array<glm::vec3, 3> triangle;
  for (glm::vec3& corner : triangle) corner = at + glm::vec3(off_m(random), off_m(random), off_m(random));
  for (glm::vec3& corner : triangle) corner.x = std::max(corner.x, 0.1f);
  return triangle;
}

constexpr DepthPicture kPicture{.width = 90, .height = 60, .texels = {44.0, 29.0}};

TEST(CasterDepths, OfTrianglesSmallAndLargeAreThoseOfTheNearestOverEachTexel) {
  std::mt19937 random(5);
  std::size_t held = 0;
  for (const float size_m : {0.3f, 2.0f, 15.0f})  // of a texel or none, narrow, wider than the lanes
    for (const bool both_sides : {false, true}) {
      std::vector<std::array<glm::vec3, 3>> triangles;
      for (int i = 0; i < 60; ++i) triangles.push_back(some(random, size_m));
      held += expect_depths(kPicture, triangles, both_sides).held;
    }
  std::printf("%zu texels hold one\n", held);
  EXPECT_GT(held, 5000u);
}

TEST(CasterDepths, OfWhatReachesPastTheLampAreOfThePartBeforeIt) {
  // A wall along the road from behind the lamp to far ahead, a roof over it, and a plate that cuts its plane.
  const std::vector<std::array<glm::vec3, 3>> walls{{{{-5, 2, -1}, {40, 2, -1}, {40, 2, 3}}},
                                                    {{{-5, 2, -1}, {40, 2, 3}, {-5, 2, 3}}},
                                                    {{{-3, -4, 2}, {30, -4, 2.5}, {30, 4, 2.2}}},
                                                    {{{-1, -3, -0.5}, {3, -1, -0.7}, {9, -3, 0.4}}}};
  for (const bool both_sides : {false, true}) EXPECT_GT(expect_depths(kPicture, walls, both_sides).held, 500u);
}

TEST(CasterDepths, LeaveTheMarginAndAllThatIsNotOverAMiddleAsItWas) {
  DepthPicture picture = kPicture;
  picture.margin = 1;
  const std::vector<std::array<glm::vec3, 3>> large{{{{5, -20, -20}, {5, 60, -20}, {5, -20, 60}}}};
  const Drawn drawn = expect_depths(picture, large, false);
  EXPECT_EQ(drawn.held, (picture.width - 2) * (picture.height - 2));
  // A sliver between two columns of middles, and one whose corners are one.
  const float x = 10.0f, y = -0.1f / 44.0f * x;
  const std::vector<std::array<glm::vec3, 3>> slivers{{{{x, y, -5}, {x, y, 5}, {x, y * 1.5f, 0}}},
                                                      {{{x, 1, 1}, {x, 1, 1}, {x, 1, 1}}},
                                                      {{{x, 1, -5}, {x, 1, 5}, {x, 1, 0}}}};
  EXPECT_EQ(expect_depths(picture, slivers, false).held, 0u);
}

TEST(CasterDepths, OfTheMiddleOfAPictureThatIsNotReadAreNotDrawn) {
  DepthPicture picture = kPicture;
  CastBy cast;
  add(cast.far_sides, {{{20, 1, 1}, {20, -1, 1}, {20, 0, -1}}});
  std::vector<float> texels(std::size_t{picture.width} * picture.height);
  const auto held = [&] {
    std::ranges::fill(texels, 0.0f);
    raise_depths(picture, cast, false, texels);
    return std::ranges::count_if(texels, [](float depth) { return depth > 0.0f; });
  };
  EXPECT_GT(held(), 2);
  picture.half_unread = {10, 10};
  EXPECT_EQ(held(), 0);
  add(cast.far_sides, {{{20, 20, 1}, {20, -1, 1}, {20, 0, -1}}});
  EXPECT_GT(held(), 20) << "it reaches out of there";
}

TEST(CasterDepths, OfHolesAreDrawnWhereTheyAreAskedForAsIfThereWereNone) {
  CastBy cast;
  const std::array<glm::vec3, 3> triangle{{{20, 2, 2}, {20, -2, 2}, {20, 0, -2}}};
  CutCasters& cut = cast.cut.emplace_back();
  for (const glm::vec3& corner : triangle) cut.corners.push_back({corner, {0.0f, 0.0f}});
  cut.bounds.push_back(bounds_of(triangle));
  std::vector<float> with(std::size_t{kPicture.width} * kPicture.height), without = with, whole = with;
  raise_depths(kPicture, cast, true, with);
  raise_depths(kPicture, cast, false, without);
  EXPECT_EQ(std::ranges::count(without, 0.0f), std::ssize(without));
  CastBy as_whole;
  add(as_whole.both_sides, triangle);
  raise_depths(kPicture, as_whole, false, whole);
  EXPECT_EQ(with, whole);
  EXPECT_LT(std::ranges::count(with, 0.0f), std::ssize(with));
}

}  // namespace
}  // namespace phare
