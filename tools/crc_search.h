// Which known checksum the messages of a log carry: every kind that a cockpit file knows, in every place of a message.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "cockpit_io/can_frame.h"
#include "cockpit_io/candump.h"

namespace phare {

/// A check that all frames of a message carry.
struct CrcFound {
  CanId id;
  std::size_t frames = 0;            ///< different ones that fit, all of them
  std::string scheme;                ///< as a cockpit file says it: crc_kind = "crc8-h2f", data_id = 90
  std::string where;                 ///< "byte 0"
  std::string note;                  ///< what the frames leave open; empty: nothing
  std::vector<std::string> signals;  ///< lines of a DBC file, for under the message's BO_
  std::vector<std::string> table;    ///< lines of a cockpit file, for under [check.MESSAGE]
};

/// Looks at each message with so many different frames at least.
std::vector<CrcFound> find_crcs(const CandumpLog& log, std::size_t least = 24);

}  // namespace phare
