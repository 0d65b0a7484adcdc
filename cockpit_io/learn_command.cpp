#include "cockpit_io/learn_command.h"

#include <poll.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <thread>
#include <vector>

#include "cockpit_io/can_log.h"
#include "cockpit_io/can_socket.h"
#include "cockpit_io/candump.h"
#include "cockpit_io/gamepad_source.h"
#include "cockpit_io/learn.h"
#include "config/base/fail.h"
#include "config/base/result.h"

namespace phare {

namespace {

using Clock = std::chrono::steady_clock;

void show(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) std::printf("%s\n", line.c_str());
  if (!lines.empty()) std::fflush(stdout);
}

int finish(const Learner& learner) {
  const std::vector<std::string> summary = learner.summary();
  show(summary);
  return summary.size() > 1 ? kExitDone : kExitCheckFailed;
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

int learn_from_log(const LearnOptions& options, Learner learner) {
  Result<CanLog> read = read_can_log(options.log_file);
  if (!read) return fail("phare-cockpit", read.error());
  CandumpLog* const log = &read->log;
  if (log->broken_lines > 0) {
    std::fprintf(stderr, "%s:%d: %s; %llu broken lines, the rest is used\n", options.log_file.c_str(),
                 log->problems.front().line, log->problems.front().reason.c_str(),
                 static_cast<unsigned long long>(log->broken_lines));
  }
  const auto chosen = choose_interface(*log, options.interface, true);
  if (!chosen) return fail("phare-cockpit", chosen.error());
  if (!chosen->empty()) std::fprintf(stderr, "%s\n", chosen->c_str());
  for (const std::string& doubt : doubts(*log)) std::fprintf(stderr, "%s\n", doubt.c_str());
  for (const CandumpEntry& entry : log->entries) {
    show(learner.take(entry.frame, entry.stamp_ns - log->entries.front().stamp_ns));
  }
  return finish(learner);
}

int learn_from_bus(const LearnOptions& options, Learner learner, const StopFlag& stop) {
  Result<CanSocket> socket = CanSocket::open_to_all(options.interface);
  if (!socket) return fail("phare-cockpit", socket.error());
  std::printf("Touch nothing for %.0f s.\n", options.rest_s);
  std::fflush(stdout);
  const auto start = Clock::now();
  bool told = false;
  while (!stop && (options.seconds <= 0.0 || seconds_since(start) < options.seconds)) {
    pollfd wait{socket->fd(), POLLIN, 0};
    poll(&wait, 1, 100);
    const double at_s = seconds_since(start);
    if (at_s >= options.rest_s && !told) {
      told = true;
      std::printf("Now move the stalk, one thing at a time. Ctrl-C ends.\n");
      std::fflush(stdout);
    }
    while (const auto received = socket->receive()) {
      show(learner.take(received->frame, static_cast<std::int64_t>(at_s * 1e9)));
    }
    if (socket->why() == CanSocket::Nothing::kGone)
      return fail("phare-cockpit", {options.interface, "the interface is gone"});
  }
  return finish(learner);
}

int learn_gamepad(const LearnOptions& options, const StopFlag& stop) {
  constexpr float kMoved = 0.3f;  // of an axis that runs from -1 to 1
  Result<GamepadSource::Reader> reader = open_glfw_gamepad("");
  if (!reader) return fail("phare-cockpit", reader.error());
  std::printf("Move one thing at a time. Ctrl-C ends.\n");
  std::optional<GamepadReading> last;
  const auto start = Clock::now();
  bool moved = false;
  while (!stop && (options.seconds <= 0.0 || seconds_since(start) < options.seconds)) {
    const auto now = (*reader)();
    if (now && last) {
      for (std::size_t i = 0; i < now->axes.size() && i < last->axes.size(); ++i) {
        if (std::abs(now->axes[i] - last->axes[i]) < kMoved) continue;
        std::printf("axis = %zu   %.2f -> %.2f\n", i, static_cast<double>(last->axes[i]),
                    static_cast<double>(now->axes[i]));
        last->axes[i] = now->axes[i];
        moved = true;
      }
      for (std::size_t i = 0; i < now->buttons.size() && i < last->buttons.size(); ++i) {
        if (now->buttons[i] == last->buttons[i]) continue;
        std::printf("button = %zu   %s\n", i, now->buttons[i] != 0 ? "pressed" : "released");
        moved = true;
      }
      for (std::size_t i = 0; i < now->hats.size() && i < last->hats.size(); ++i) {
        if (now->hats[i] == last->hats[i]) continue;
        for (const auto& [bit, way] :
             {std::pair(1, "up"), std::pair(2, "right"), std::pair(4, "down"), std::pair(8, "left")}) {
          if ((now->hats[i] & bit) != 0) std::printf("hat = \"%zu.%s\"\n", i, way);
        }
        moved = true;
      }
      last->buttons = now->buttons;
      last->hats = now->hats;
      std::fflush(stdout);
    } else if (now) {
      last = now;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  if (!last) return fail("phare-cockpit", {"gamepad", "none is there"});
  return moved ? kExitDone : kExitCheckFailed;
}

}  // namespace

int learn(const LearnOptions& options, const StopFlag& stop) {
  if (options.gamepad) return learn_gamepad(options, stop);
  Dbc dbc;
  if (!options.dbc_file.empty()) {
    Result<Dbc> read = read_dbc(options.dbc_file);
    if (!read) return fail("phare-cockpit", read.error());
    dbc = std::move(*read);
    if (!dbc.problems.empty()) {
      std::fprintf(stderr, "%s:%d: %s; %zu such lines, the rest is used\n", options.dbc_file.c_str(),
                   dbc.problems.front().line, dbc.problems.front().reason.c_str(), dbc.problems.size());
    }
  }
  Learner learner(std::move(dbc), static_cast<std::int64_t>(options.rest_s * 1e9));
  if (!options.log_file.empty()) return learn_from_log(options, std::move(learner));
  if (options.interface.empty())
    return fail("phare-cockpit", {"--learn", "needs --interface IF, --log FILE or --gamepad"});
  return learn_from_bus(options, std::move(learner), stop);
}

}  // namespace phare
