// What a program has printed is there when it ends, or it says so.
#pragma once

#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>

#include "config/base/fail.h"

namespace phare {

/// The reader of a pipe has left (`| head`): whoever ignores SIGPIPE meets an error there, and nobody misses anything.
inline bool nobody_reads_output() {
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  return ::poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

/// The end of main(): the exit code of `program`, which would end with `exit_code`. Where standard output could not be
/// written, std::cout and printf alike, that is told in one line, unless what was wrong is told already.
inline int end_of_output(const char* program, int exit_code) {
  bool flushed = std::fflush(stdout) == 0;
  if (flushed && std::ferror(stdout) == 0) return exit_code;
  if (exit_code == kExitBadInput || nobody_reads_output()) return exit_code;
  // It was an earlier flush that failed, and nobody has kept why: what is broken off is tried once more.
  if (flushed) flushed = std::fputc('\n', stdout) != EOF && std::fflush(stdout) == 0;
  const std::string cause = flushed ? "" : std::string(": ") + std::strerror(errno);
  return fail(program, {"standard output", "cannot be written" + cause});
}

}  // namespace phare
