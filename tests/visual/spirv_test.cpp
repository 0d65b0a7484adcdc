// Unit: shaders without one of their functions.
#include "visual/gpu/spirv.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <iterator>
#include <vector>

#include "shaders/lamps_frag_4_shadows.h"

namespace phare::gpu {
namespace {

using Words = std::vector<std::uint32_t>;

std::uint32_t op(std::uint32_t instruction, std::uint32_t words) {
  return words << 16u | instruction;
}

/// float is 1, its function's kind 2, 1.0 is 3, the function 4: it returns -p of its argument 5, which is 7 and
/// decorated.
Words shader_with(const char (&name)[8], std::uint32_t constant) {
  Words words{0x07230203, 0x00010600, 0, 10, 0};
  const auto add = [&](const Words& more) { words.insert(words.end(), more.begin(), more.end()); };
  std::uint32_t letters[2];
  std::memcpy(letters, name, 8);
  add({op(5, 4), 4, letters[0], letters[1]});  // OpName
  add({op(71, 3), 7, 42});                     // OpDecorate NoContraction
  add({op(71, 3), 3, 42});
  add({op(22, 3), 1, 32});           // OpTypeFloat
  add({op(33, 4), 2, 1, 1});         // OpTypeFunction
  add({op(43, 4), 1, 3, constant});  // OpConstant
  add({op(54, 5), 1, 4, 0, 2});      // OpFunction
  add({op(55, 3), 1, 5});            // OpFunctionParameter
  add({op(248, 2), 6});              // OpLabel
  add({op(127, 4), 1, 7, 5});        // OpFNegate
  add({op(254, 2), 7});              // OpReturnValue
  add({op(56, 1)});                  // OpFunctionEnd
  return words;
}

constexpr std::uint32_t kOne = 0x3f800000;

TEST(ReturningOne, LeavesOfAFunctionItsHeadAndOneReturn) {
  const Words changed = returning_one(shader_with("ray(f1;", kOne), "ray");
  Words expected{0x07230203, 0x00010600, 0, 10, 0};
  const auto add = [&](const Words& more) { expected.insert(expected.end(), more.begin(), more.end()); };
  add({op(71, 3), 3, 42});  // what names or decorates what is gone is gone, too
  add({op(22, 3), 1, 32});
  add({op(33, 4), 2, 1, 1});
  add({op(43, 4), 1, 3, kOne});
  add({op(54, 5), 1, 4, 0, 2});
  add({op(55, 3), 1, 5});
  add({op(248, 2), 6});
  add({op(254, 2), 3});
  add({op(56, 1)});
  EXPECT_EQ(changed, expected);
}

TEST(ReturningOne, LeavesAShaderAsItWas) {
  const Words shader = shader_with("ray(f1;", kOne);
  EXPECT_EQ(returning_one(shader, "ra"), shader) << "another name";
  EXPECT_EQ(returning_one(shader_with("ray(f1;", 0), "ray"), shader_with("ray(f1;", 0)) << "no 1.0";
  const Words cut(shader.begin(), shader.end() - 1);
  EXPECT_EQ(returning_one(cut, "ray"), cut) << "no end of the function";
  const Words torn(shader.begin(), shader.end() - 2);
  EXPECT_EQ(returning_one(torn, "ray"), torn) << "an instruction that is cut off";
}

// If the function's name changed, shaders would be as slow to compile as before, and nothing else would tell.
TEST(ReturningOne, FindsTheRaysOfOurShaders) {
  EXPECT_LT(returning_one(k_lamps_frag_4_shadows, "reaching_by_rays").size(), std::size(k_lamps_frag_4_shadows));
}

}  // namespace
}  // namespace phare::gpu
