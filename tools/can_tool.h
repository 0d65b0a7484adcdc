// What a CAN engineer asks of a file: which signals it has, what a log says, which control moves when. Output is text
// on a stream; errors carry file, line and reason. Which check fits: crc_search.h. The commands are in can_command.cpp.
#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

#include "cockpit_io/candump.h"
#include "cockpit_io/dbc.h"
#include "config/base/result.h"
#include "config/cockpit.h"

namespace phare {

/// Broken lines of a DBC file or log that are named; beyond that they are counted.
inline constexpr std::size_t kProblemsNamed = 20;

/// "file:line: reason", the first kProblemsNamed, then how many more; of a log also its doubts().
void tell_problems(const Dbc& dbc, std::ostream& out);
void tell_problems(const CandumpLog& log, std::ostream& out);

/// Every message and signal: id, length, bits, scaling, range, unit, value names.
void list_dbc(const Dbc& dbc, std::ostream& out);

struct DecodeAsked {
  std::vector<std::string> signals;  ///< "SIGNAL" or "MESSAGE.SIGNAL"; empty: all
  bool csv = false;                  ///< t_s,message,signal,value,unit,name; of several buses then interface
};
/// Every frame of the log that the DBC knows, in the log's order. Error for a signal that is not there: all of them.
Status decode_log(const Dbc& dbc, const CandumpLog& log, const DecodeAsked& asked, std::ostream& out);

/// Which control moves when, by this cockpit file; what is refused, what falls silent, what never moves.
Status check_cockpit(const CockpitConfig& config, const Dbc& dbc, const CandumpLog& log, std::ostream& out);

}  // namespace phare
