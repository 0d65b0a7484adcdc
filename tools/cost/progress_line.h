// How far a measurement is: a line that is written over, and silent when nobody looks at it.
#pragma once

#include <unistd.h>

#include <cstdio>
#include <string>

namespace phare::cost {

class ProgressLine {
 public:
  ~ProgressLine() {
    if (written_) std::fputs("\r\033[K", stderr);
  }
  void show(const std::string& doing, double share_01) {
    if (isatty(STDERR_FILENO) == 0) return;
    written_ = true;
    constexpr int kWide = 24;
    const int done = static_cast<int>(kWide * share_01);
    std::fprintf(stderr, "\r\033[K[%.*s%.*s] %3.0f %%  %s", done, "########################", kWide - done,
                 "........................", 100.0 * share_01, doing.c_str());
    std::fflush(stderr);
  }

 private:
  bool written_ = false;
};

}  // namespace phare::cost
