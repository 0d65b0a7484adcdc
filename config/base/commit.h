// Which commit this program was built from.
#pragma once

namespace phare {

/// "6ba9b5b", "6ba9b5b-dirty" with changes that are not committed, "unknown" where there was no git to ask.
const char* build_commit();

}  // namespace phare
