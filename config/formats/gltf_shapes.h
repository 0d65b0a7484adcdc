// Whether the numbers of a glTF file have the form that the standard gives them (glTF 2.0.1, 5.1 to 5.29): a parser
// that takes what it knows and leaves the rest would draw a node with a translation of two numbers at the origin. Pure.
#pragma once

#include <filesystem>
#include <string_view>

#include "config/base/result.h"

namespace phare {

/// Of what we read: version, nodes, primitives, materials, accessors and views of buffers. Error: which and why,
/// "nodes[3] \"barn\": translation has 2 numbers, not 3". Text that is no JSON object is left to the parser.
/// A buffer that is no file in `folder` is one too: whatever it is, a parser calls it not found, or reads on and on.
Status check_gltf_shapes(std::string_view json, const std::filesystem::path& folder);

}  // namespace phare
