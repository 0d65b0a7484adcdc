// Unit: shaders with their specialization constants set for good.
#include "visual/gpu/spirv.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <iterator>
#include <map>
#include <stdexcept>
#include <vector>

#include "shaders/lamps.h"
#include "shaders/lamps_frag_4_shadows.h"
#include "visual/passes/constants.h"

namespace phare::gpu {
namespace {

using Words = std::vector<std::uint32_t>;

/// How many instructions of each kind (SPIR-V 1.6, 3.52), after the header of five words.
std::map<std::uint32_t, std::size_t> instructions_of(std::span<const std::uint32_t> code) {
  std::map<std::uint32_t, std::size_t> counts;
  for (std::size_t at = 5; at < code.size(); at += code[at] >> 16u) {
    ++counts[code[at] & 0xffffu];
    if (code[at] >> 16u == 0) break;
  }
  return counts;
}

constexpr std::uint32_t kConstant = 43, kSpecConstant = 50, kSpecConstantOp = 52, kFunction = 54;

/// Two lamps that look ahead, asphalt, maps.
SpecConstants two_lamps(std::uint32_t taps) {
  SpecConstants constants;
  constants.put(shader::kSpecLampCount, 2);
  constants.put(shader::kSpecSurface, 1);
  constants.put(shader::kSpecShadowMaps, 0x21);
  constants.put(shader::kSpecShadowTaps, taps);
  constants.put(shader::kSpecTables, shader::kLookupDecimals);
  constants.put(shader::kSpecTables + shader::kSpecPerTable, shader::kLookupDecimals);
  constants.put(shader::kSpecTables + 1, std::bit_cast<std::uint32_t>(1145.5f));
  return constants;
}

TEST(Specialised, KeepsNoConstantThatCouldBeOtherwise) {
  const Words less = specialised(k_lamps_frag_4_shadows, two_lamps(4).info());
  std::map<std::uint32_t, std::size_t> before = instructions_of(k_lamps_frag_4_shadows), after = instructions_of(less);
  EXPECT_GT(before[kSpecConstant], 40u);
  EXPECT_EQ(after[kSpecConstant], 0u);
  EXPECT_EQ(after[kSpecConstantOp], 0u);
}

// What a device compiles for a pipeline follows from this: if a condition were no longer one of constants alone,
// nothing else would tell but the time.
TEST(Specialised, LeavesWhatTheConstantsCallFor) {
  const Words by_map = specialised(k_lamps_frag_4_shadows, two_lamps(4).info()),
              by_rays = specialised(k_lamps_frag_4_shadows, two_lamps(shader::kTapsOfRays + 1).info());
  SpecConstants none;
  none.put(shader::kSpecLampCount, 0);
  const Words dark = specialised(k_lamps_frag_4_shadows, none.info());
  const std::size_t whole = std::size(k_lamps_frag_4_shadows);
  EXPECT_LT(3 * by_map.size(), whole) << "one kind of table of seven, two lamps of four, no rays";
  EXPECT_LT(by_map.size(), by_rays.size());
  EXPECT_LT(3 * dark.size(), 2 * by_map.size());
  EXPECT_LT(instructions_of(by_map)[kFunction], instructions_of(by_rays)[kFunction]);
}

TEST(Specialised, ValuesAreTheirWordsWhateverTheirType) {
  const auto holds = [](std::span<const std::uint32_t> code, std::uint32_t value) {
    for (std::size_t at = 5; at < code.size() && code[at] >> 16u != 0; at += code[at] >> 16u)
      if ((code[at] & 0xffffu) == kConstant && code[at] >> 16u == 4 && code[at + 3] == value) return true;
    return false;
  };
  const std::uint32_t steps = std::bit_cast<std::uint32_t>(1145.5f);
  EXPECT_FALSE(holds(k_lamps_frag_4_shadows, steps));
  EXPECT_TRUE(holds(specialised(k_lamps_frag_4_shadows, two_lamps(4).info()), steps));
}

TEST(Specialised, IsTheSameEachTime) {
  EXPECT_EQ(specialised(k_lamps_frag_4_shadows, two_lamps(4).info()),
            specialised(k_lamps_frag_4_shadows, two_lamps(4).info()));
}

TEST(Specialised, WhatIsNoShaderIsRefused) {
  const Words none{1, 2, 3}, torn(std::begin(k_lamps_frag_4_shadows), std::begin(k_lamps_frag_4_shadows) + 100);
  EXPECT_THROW((void)specialised(none, {}), std::runtime_error);
  EXPECT_THROW((void)specialised({}, {}), std::runtime_error);
  EXPECT_THROW((void)specialised(torn, {}), std::runtime_error);
  const vk::SpecializationMapEntry half{.constantID = 0, .offset = 0, .size = 2};
  const std::uint16_t two = 2;
  EXPECT_THROW((void)specialised(k_lamps_frag_4_shadows,
                                 {.mapEntryCount = 1, .pMapEntries = &half, .dataSize = 2, .pData = &two}),
               std::runtime_error);
}

}  // namespace
}  // namespace phare::gpu
