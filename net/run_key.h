// The key of a run on loopback, so that nothing there is trusted by accident: another user's program, or one of ours
// that belongs to another rig, speaks to nobody.
//
// A rig without a key_file has a key of its own for the run, in a file that only its user can read:
// /run/user/UID/phare/ADDRESS-PORT_BASE.key, or below /tmp/phare-UID where there is no /run/user, or below
// $PHARE_RUN_DIR. phare drive makes a new one at every start; whoever else comes first makes one; all others, and
// control, record and replay, read it. It holds 64 hexadecimal digits, as a key_file does (docs/send.md).
// [bus] run_key = false in the rig, or --open-bus, goes without.
#pragma once

#include <filesystem>

#include "config/base/result.h"
#include "config/rig.h"

namespace phare {

/// Where the runs of this user keep what is theirs; made where it is not there. Error when it is another user's, a
/// link, or others may enter it.
Result<std::filesystem::path> run_folder();

/// The file of the key of a run on these ports.
Result<std::filesystem::path> run_key_file(const Rig& rig);

enum class RunKey {
  kUse,  ///< the one that is there, or a new one
  kMake  ///< a new one, unless a process that runs holds the one that is there
};

/// Puts the key of the run into `rig`, whose ports are settled; nothing where it has a key_file or goes without. The
/// file stays locked (shared) until this process ends.
Status take_run_key(Rig& rig, RunKey how = RunKey::kUse);

}  // namespace phare
