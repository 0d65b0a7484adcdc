// Bytes as text (RFC 4648, clause 4), by libnettle.
#pragma once

#include <string>
#include <string_view>

namespace phare {

std::string base64(std::string_view bytes);

}  // namespace phare
