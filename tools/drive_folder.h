// The folder that a drive fills: what an earlier one left there, what must not stay.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "config/rig.h"

namespace phare {

/// While one of these lives, no other drive begins to fill the folder, of whichever program run.
using FolderClaim = std::shared_ptr<void>;
/// Error when another drive is filling it, which has to be there.
Result<FolderClaim> claim_folder(const std::filesystem::path& out);

/// A process that is killed while it writes its counts leaves <name>.json.tmp<process id>.
void remove_half_written(const std::filesystem::path& out, const std::vector<std::string>& process_names);

/// What an earlier drive left in the folder; nothing else in it is touched.
void remove_earlier_output(const std::filesystem::path& out, const std::vector<std::string>& process_names);

/// Error where `file`, which the user names, is one that a drive of this rig writes into its folder `out`: two would
/// write it, and one be lost.
Status apart_from_output(const std::filesystem::path& file, const std::filesystem::path& out, const Rig& rig);

/// What an earlier drive of another command line has left in the folder, in words; empty: nothing.
std::string another_drive_in(const std::filesystem::path& out, const std::vector<std::string>& command);

/// "out" and "evening.pcap" of the second drive are "out-2" and "evening-2.pcap".
std::string numbered(const std::string& path, int number);

/// The topmost folder that has to be made for `out`; empty when it is there.
std::filesystem::path first_missing(std::filesystem::path out);

/// The folders from `out` up to `made`, as long as they are empty.
void remove_made(std::filesystem::path out, const std::filesystem::path& made);

/// After bad input: no count, no picture, and no folder from `made` down, which was not there before.
void remove_traces(const std::filesystem::path& out, const std::filesystem::path& made,
                   const std::vector<std::string>& process_names);

}  // namespace phare
