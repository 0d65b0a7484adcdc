// EXT_meshopt_compression of glTF: buffer views that meshoptimizer has packed, unpacked by it. Vertex attributes,
// triangles and index sequences, with the filters for octahedral normals, quaternions and exponents.
#pragma once

#include <tiny_gltf.h>

#include <vector>

#include "config/base/result.h"

namespace phare {

inline constexpr const char* kMeshoptExtension = "EXT_meshopt_compression";

/// In the file's bytes: buffers that are only there for readers without the extension need not come with the file,
/// which tinygltf asks for; they get a byte of their own. Likewise spot lamps without their cone (KHR_lights_punctual)
/// get an empty one. Where there is none of them the bytes stay as they are.
Status stand_in_for_what_is_left_out(std::vector<unsigned char>& file, bool glb);

/// Every packed view gets a buffer of its own. Error: place is the view, with the reason.
Status unpack_meshopt(tinygltf::Model& model);

}  // namespace phare
