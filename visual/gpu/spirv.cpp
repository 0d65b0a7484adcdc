#include "visual/gpu/spirv.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <set>

namespace phare::gpu {
namespace {

using Words = std::span<const std::uint32_t>;

enum Op : std::uint32_t {
  kName = 5,
  kMemberName = 6,
  kConstant = 43,
  kFunction = 54,
  kFunctionParameter = 55,
  kFunctionEnd = 56,
  kStore = 62,
  kDecorate = 71,
  kLoopMerge = 246,
  kSelectionMerge = 247,
  kLabel = 248,
  kBranch = 249,
  kBranchConditional = 250,
  kSwitch = 251,
  kKill = 252,
  kReturn = 253,
  kReturnValue = 254,
  kUnreachable = 255
};

constexpr std::size_t kHeaderWords = 5;

std::uint32_t op_of(Words instruction) {
  return instruction[0] & 0xffffu;
}

/// One after the other; none of a shader that is cut off.
std::vector<Words> instructions_of(Words code) {
  std::vector<Words> all;
  for (std::size_t at = kHeaderWords; at < code.size(); at += all.back().size()) {
    const std::size_t words = code[at] >> 16u;
    if (words == 0 || at + words > code.size()) return {};
    all.push_back(code.subspan(at, words));
  }
  return all;
}

/// What it makes; 0: nothing. Of instructions of a function's body.
std::uint32_t result_of(Words instruction) {
  switch (op_of(instruction)) {
    case kStore:
    case kLoopMerge:
    case kSelectionMerge:
    case kBranch:
    case kBranchConditional:
    case kSwitch:
    case kKill:
    case kReturn:
    case kReturnValue:
    case kUnreachable:
      return 0;
    case kLabel:
      return instruction[1];
    default:
      return instruction.size() > 2 ? instruction[2] : 0;
  }
}

bool is_named(Words instruction, std::string_view function) {
  if (op_of(instruction) != kName || instruction.size() < 3) return false;
  const char* name = reinterpret_cast<const char*>(instruction.data() + 2);
  const std::string_view text(name, strnlen(name, 4 * (instruction.size() - 2)));
  return text.starts_with(function) && text.substr(function.size()).starts_with('(');
}

}  // namespace

std::vector<std::uint32_t> returning_one(Words code, std::string_view function) {
  const std::vector<std::uint32_t> as_it_was(code.begin(), code.end());
  const std::vector<Words> all = instructions_of(code);
  const auto name = std::ranges::find_if(all, [&](Words one) { return is_named(one, function); });
  if (name == all.end()) return as_it_was;
  const auto begin =
      std::ranges::find_if(all, [&](Words one) { return op_of(one) == kFunction && one[2] == (*name)[1]; });
  if (begin == all.end()) return as_it_was;
  const auto one = std::ranges::find_if(all, [&](Words each) {
    return op_of(each) == kConstant && each[1] == (*begin)[1] && each[3] == std::bit_cast<std::uint32_t>(1.0f);
  });
  const auto label = std::find_if(begin, all.end(), [](Words each) { return op_of(each) == kLabel; });
  const auto end = std::find_if(begin, all.end(), [](Words each) { return op_of(each) == kFunctionEnd; });
  if (one == all.end() || end == all.end() || label >= end) return as_it_was;

  std::set<std::uint32_t> gone;
  for (auto each = label + 1; each != end; ++each) gone.insert(result_of(*each));
  std::vector<std::uint32_t> changed(code.begin(), code.begin() + kHeaderWords);
  for (auto each = all.begin(); each != all.end(); ++each) {
    const std::uint32_t op = op_of(*each);
    if (op == kName || op == kMemberName || (op == kDecorate && gone.contains((*each)[1]))) continue;
    changed.insert(changed.end(), each->begin(), each->end());
    if (each != label) continue;
    changed.insert(changed.end(), {2u << 16u | kReturnValue, (*one)[2]});
    each = end - 1;
  }
  return changed;
}

}  // namespace phare::gpu
