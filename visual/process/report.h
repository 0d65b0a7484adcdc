// What a visual process tells about itself.
#pragma once

#include "visual/process/session.h"

namespace phare {

/// stats_json of the bus, and: version, device, validation messages, frame times over all frames and over those whose
/// picture was not read back (ms), per pass, draws, passes, triangles, beam compositions, self-audit, switch-to-photon,
/// content hashes of scene and lamps, hash of the kept frames.
nlohmann::json report_json(const Session& session, SimTime now);

}  // namespace phare
