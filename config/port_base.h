// The first UDP port of a rig, as rig files and --port-base may have it.
#pragma once

namespace phare {

inline constexpr int kLowestPortBase = 1024;
/// Above it there is no room for the ports of every process (kMaxPortOffset of net/channels.h).
inline constexpr int kHighestPortBase = 65500;

}  // namespace phare
