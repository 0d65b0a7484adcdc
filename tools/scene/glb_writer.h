// Writes a Model as binary glTF 2.0 (.glb). Equal models give equal bytes.
#pragma once

#include <string>

#include "tools/scene/mesh.h"

namespace phare::scene {

/// The whole file. One glTF node and mesh per Node, one primitive per material; vertices float32 about the node's
/// middle, in glTF's y-up axes (x = world x, y = world z, z = -world y); indices 16 bit where they fit. Material extras
/// as read by visual/scene: {"phare": {"surface": …, "retro": …, "retroreflection_cd_per_lx_m2": …}}.
std::string glb_bytes(const Model& model);

}  // namespace phare::scene
