// Keeps the processes of a rig running: starts them, restarts one that dies or hangs, ends them all in order.
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "net/alive.h"
#include "tools/child_process.h"
#include "tools/watchdog.h"

namespace phare {

struct ProcessSpec {
  std::string name;  ///< "cockpit", "dynamics", "visual-0"
  std::filesystem::path program;
  std::vector<std::string> arguments;
  bool ends_the_drive = false;                   ///< the drive is over when every such process has ended with exit 0
  std::vector<std::string> restart_arguments{};  ///< given as well when it is started again
  std::filesystem::path alive_file{};            ///< where it leaves its signs of life; empty: it is not watched
  HungAfter hung_after{};
};

struct Restart {
  std::string process;
  double at_s = 0.0;    ///< wall time since the start, of its end
  std::string because;  ///< how it ended: "SIGKILL", "exit 1"; why we ended it: "stopped: no sign of life for 3.0 s"
};

/// Not thread safe: one loop calls step().
class Supervisor {
 public:
  using Clock = std::chrono::steady_clock;

  /// Of one process, one after the other, none of which lived as long as this from its first sign of life on (of one
  /// that is not watched: from its start); one more and we give up.
  static constexpr std::size_t kMaxRestarts = 5;
  static constexpr std::chrono::seconds kShortLife{10};
  static constexpr std::chrono::milliseconds kFirstBackoff{50};  ///< doubled by every one of those
  /// One that left with exit 0 while pictures still go on after so long has not left because the drive ends.
  static constexpr std::chrono::seconds kLeftAlone{1};

  explicit Supervisor(std::vector<ProcessSpec> specs, std::chrono::milliseconds short_life = kShortLife);
  ~Supervisor();  ///< ends what still runs
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  /// Starts every process; on an error those already started are ended.
  Status start();

  /// Every process that is watched has read what it needs, and waits to be let go.
  bool all_ready() const;
  void let_go();

  /// Looks after the processes once. False when the drive is over: outcome() is then set and end_all() is due.
  bool step();
  /// Whether one that draws has ended by itself while others go on: its window was closed.
  bool one_has_left() const;

  /// SIGTERM to all, who are also set going again should they be stopped, SIGKILL to those still there after `grace`.
  /// Returns when none runs, or half a second after that at the latest: what the kernel itself does not let go of is
  /// left behind, and told. `hurry`: asked often; from then on `grace` is kHurried.
  void end_all(std::chrono::milliseconds grace, const std::function<bool()>& hurry = {});
  static constexpr std::chrono::milliseconds kHurried{1200};  ///< of the two seconds that Ctrl-C may take

  /// Exit code for the launcher, and why when it is not 0.
  int exit_code() const { return exit_code_; }
  const std::string& why() const { return why_; }
  /// Who did not end as asked when the drive was over: "dynamics ended with SIGSEGV". Our own signals are no fault.
  const std::string& ended_badly() const { return ended_badly_; }
  const std::vector<Restart>& restarts() const { return restarts_; }

  struct Ended {
    std::string process;
    std::string how;  ///< "exit 0"; "never started"
  };
  std::vector<Ended> ends() const;

 private:
  struct Watched {
    ProcessSpec spec;
    std::optional<ChildProcess> child;
    std::string last_end = "never started";
    bool done = false;                      ///< ended with exit 0, stays ended
    std::optional<Clock::time_point> left;  ///< when it ended with exit 0, though nobody ends the drive by that
    std::optional<Clock::time_point> due;   ///< next start
    Clock::time_point begun{};
    std::size_t short_lives = 0;  ///< restarts since it last lived long
    std::optional<Clock::time_point> first_sign{};  ///< of life, of the child that runs
    std::optional<AliveFile> alive;
    std::optional<Watchdog> watchdog;  ///< of the child that runs
    std::optional<Clock::time_point> looked{};  ///< for signs of life
    std::string ended_because;                  ///< we have ended it: why
  };
  Status begin(Watched& process, const std::vector<std::string>& arguments);
  void end_if_hung(Watched& process);
  bool look_after(Watched& process);
  static Clock::duration lived(const Watched& process);
  void add_ended_badly(const Watched& process);
  bool pictures_go_on_since(Clock::time_point then) const;
  bool restart(Watched& process, const std::string& because);
  bool give_up(int exit_code, std::string why);

  std::vector<Watched> processes_;
  std::chrono::milliseconds short_life_;
  std::vector<Restart> restarts_;
  Clock::time_point started_ = Clock::now();
  bool told_to_leave_ = false;  ///< by RigControl::Quit: whoever ends stays away
  int exit_code_ = kExitDone;
  std::string why_, ended_badly_;
};

}  // namespace phare
