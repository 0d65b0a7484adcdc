// candump logs: "(46408.584930) can0 260#08FFFB0000001884", one frame a line, as candump -l writes and canplayer reads.
//
// Also read: 29-bit ids (eight digits), remote frames "123#R" and "123#R4", CAN FD "123##1AABB" (one digit of flags),
// error frames (id with bit 0x20000000), dots between data bytes, a direction " R" or " T" at the end, empty lines and
// "# comments". What candump shows on the screen is refused and named: without -t it has no stamps.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "cockpit_io/can_frame.h"
#include "config/base/result.h"

namespace phare {

struct CandumpEntry {
  std::int64_t stamp_ns = 0;  ///< as logged: wall clock, or any clock of the logger
  CanFrame frame;
  std::uint32_t interface = 0;  ///< index in CandumpLog::interfaces
  int line = 0;                 ///< counted from 1
};

/// A line that holds no frame, and why; the rest of the log was kept.
struct CandumpProblem {
  int line = 0;
  std::string reason;
};

struct CandumpLog {
  static constexpr std::size_t kProblemsKept = 100;

  std::filesystem::path file;
  std::vector<CandumpEntry> entries;     ///< in the file's order
  std::vector<CandumpProblem> problems;  ///< the first kProblemsKept
  std::uint64_t broken_lines = 0;        ///< all of them
  std::vector<std::string> interfaces;   ///< of the entries, as they come
  std::uint64_t backward_stamps = 0;     ///< entries stamped before the entry above them
  bool counts_frames = false;            ///< read by another program: `line` of an entry is its number among the frames
};

/// One line of a log. Error (place empty) when it holds no frame.
Result<CandumpEntry> parse_candump_line(std::string_view line);

/// Reads a log. Error when it cannot be read or has not one valid line (place: file, and the first broken line).
Result<CandumpLog> read_candump(const std::filesystem::path& file);

/// The same from text; `name` stands for the file in messages.
Result<CandumpLog> parse_candump(std::string_view text, const std::string& name);

/// Of a log of several buses the frames of one. `named`: the interface that is wished for; empty: none. One that the
/// log has not is an Error where it `must_be_there`; else all frames stay. Returns what to tell; empty: nothing.
Result<std::string> choose_interface(CandumpLog& log, const std::string& named, bool must_be_there);

/// What is doubtful about the frames, a line each: stamps that go back, the same ids from several interfaces.
std::vector<std::string> doubts(const CandumpLog& log);

}  // namespace phare
