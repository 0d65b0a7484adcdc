#include "tools/supervisor.h"

#include <signal.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <thread>

namespace phare {

Supervisor::Supervisor(std::vector<ProcessSpec> specs, std::chrono::milliseconds short_life) : short_life_(short_life) {
  for (ProcessSpec& spec : specs)
    processes_.push_back(Watched{
        .spec = std::move(spec), .child = {}, .left = {}, .due = {}, .alive = {}, .watchdog = {}, .ended_because = {}});
}

Supervisor::~Supervisor() {
  end_all(std::chrono::seconds(2));
}

Status Supervisor::start() {
  started_ = Clock::now();
  for (Watched& process : processes_) {
    if (const Status begun = begin(process, process.spec.arguments); !begun) {
      end_all(std::chrono::seconds(2));
      return begun.error();
    }
  }
  return Done{};
}

Status Supervisor::begin(Watched& process, const std::vector<std::string>& arguments) {
  if (!process.spec.alive_file.empty()) {
    auto alive = AliveFile::open(process.spec.alive_file);
    if (!alive) return alive.error();
    process.alive.emplace(std::move(*alive));
    process.watchdog.emplace(process.spec.hung_after);
  }
  auto child = ChildProcess::start(process.spec.program, arguments);
  if (!child) return child.error();
  process.child = *child;
  process.begun = Clock::now(), process.first_sign.reset();
  process.last_end = "running";
  process.ended_because.clear();
  spdlog::debug("started {} (pid {})", process.spec.name, child->pid());
  return Done{};
}

bool Supervisor::all_ready() const {
  return std::all_of(processes_.begin(), processes_.end(),
                     [](const Watched& process) { return !process.alive || process.alive->newest(); });
}

void Supervisor::let_go() {
  for (Watched& process : processes_)
    if (process.alive) process.alive->let_go();
}

/// One that hangs cannot be asked to end.
void Supervisor::end_if_hung(Watched& process) {
  if (!process.watchdog || !process.ended_because.empty()) return;
  constexpr auto kEvery = std::chrono::milliseconds(50);  // it is long against a look, and short against what hangs
  const auto now = Clock::now();
  if (process.looked && now - *process.looked < kEvery) return;
  process.looked = now;
  const auto why = process.watchdog->hung(now, process.alive->newest(), use_of(process.child->pid()));
  if (!why) return;
  process.ended_because = *why;
  spdlog::error("{} is {}; ending it", process.spec.name, *why);
  process.child->send_signal(SIGKILL);
}

bool Supervisor::step() {
  for (Watched& process : processes_) {
    if (!look_after(process)) return false;
  }
  const bool over = std::all_of(processes_.begin(), processes_.end(),
                                [](const Watched& process) { return process.done || !process.spec.ends_the_drive; });
  return !over;
}

bool Supervisor::one_has_left() const {
  return std::ranges::any_of(processes_, [](const Watched& process) { return process.done; });
}

bool Supervisor::look_after(Watched& process) {
  const auto now = Clock::now();
  told_to_leave_ = told_to_leave_ || (process.alive && process.alive->left_as_told());
  if (told_to_leave_) {  // nobody comes back: the command is sent once
    process.left.reset();
    if (process.due.has_value()) process.done = true;
    process.due.reset();
  }
  if (process.due && now >= *process.due) {
    process.due.reset();
    std::vector<std::string> arguments = process.spec.arguments;
    arguments.insert(arguments.end(), process.spec.restart_arguments.begin(), process.spec.restart_arguments.end());
    if (const Status begun = begin(process, arguments); !begun) return give_up(kExitCheckFailed, begun.error().text());
    return true;
  }
  if (process.left && pictures_go_on_since(*process.left + kLeftAlone)) {
    process.left.reset();
    return restart(process, "exit 0, while the pictures go on");
  }
  if (!process.child) return true;
  if (!process.first_sign && process.alive && process.alive->newest() > process.begun) process.first_sign = now;
  const auto end = process.child->ended();
  if (!end) {
    end_if_hung(process);
    return true;
  }
  process.child.reset();
  process.last_end = end->text();
  if (end->signal == 0 && end->exit_code == kExitDone) {
    if (process.spec.ends_the_drive)
      process.done = true;
    else
      process.left = now;
    return true;
  }
  // Bad input stays bad however often it is read again; the process has said what it is.
  if (end->signal == 0 && end->exit_code == kExitBadInput) {
    return give_up(kExitBadInput, process.spec.name + " refused its input (see above)");
  }
  if (told_to_leave_) {
    process.done = true;
    add_ended_badly(process);
    return true;
  }
  return restart(process, process.ended_because.empty() ? end->text() : process.ended_because);
}

/// What took long to begin and ended at its first frame would begin again for ever.
Supervisor::Clock::duration Supervisor::lived(const Watched& process) {
  const auto now = Clock::now();
  return process.alive ? now - process.first_sign.value_or(now) : now - process.begun;
}

/// One that draws has looked at the bus since: told to end, it would not.
bool Supervisor::pictures_go_on_since(Clock::time_point then) const {
  return std::ranges::any_of(processes_, [&](const Watched& process) {
    return process.spec.ends_the_drive && process.child && process.alive && process.alive->newest() > then;
  });
}

bool Supervisor::restart(Watched& process, const std::string& because) {
  const auto now = Clock::now();
  if (lived(process) >= short_life_) process.short_lives = 0;
  if (process.short_lives >= kMaxRestarts) {
    return give_up(kExitCheckFailed,
                   process.spec.name + " ended with " + because + " after " + std::to_string(kMaxRestarts) +
                       " restarts, none of which lasted " +
                       std::to_string(std::chrono::duration_cast<std::chrono::seconds>(short_life_).count()) + " s");
  }
  process.due = now + kFirstBackoff * (1 << process.short_lives++);
  const double at_s = std::chrono::duration<double>(now - started_).count();
  restarts_.push_back({process.spec.name, at_s, because});
  spdlog::warn("{} ended with {}; restarting it", process.spec.name, because);
  return true;
}

bool Supervisor::give_up(int exit_code, std::string why) {
  exit_code_ = exit_code;
  why_ = std::move(why);
  return false;
}

void Supervisor::add_ended_badly(const Watched& process) {
  ended_badly_ += (ended_badly_.empty() ? "" : "; ") + process.spec.name + " ended with " + process.last_end;
}

void Supervisor::end_all(std::chrono::milliseconds grace, const std::function<bool()>& hurry) {
  constexpr std::chrono::milliseconds kReaped(500);
  auto deadline = Clock::now() + grace;
  for (Watched& process : processes_) {
    process.due.reset();
    if (!process.child) continue;
    process.child->send_signal(SIGTERM);
    process.child->send_signal(SIGCONT);  // a stopped one would keep the signal for later
  }
  bool killed = false;
  for (;;) {
    if (hurry && hurry()) deadline = std::min(deadline, Clock::now() + kHurried);
    bool any = false;
    for (Watched& process : processes_) {
      if (!process.child) continue;
      if (const auto end = process.child->ended()) {
        process.last_end = end->text();
        process.child.reset();
        const bool as_asked = end->signal == 0 ? end->exit_code == kExitDone : end->signal == SIGTERM || killed;
        if (!as_asked) add_ended_badly(process);
      } else {
        any = true;
      }
    }
    if (!any) return;
    for (Watched& process : processes_) {
      if (Clock::now() < deadline || !process.child) continue;
      if (!killed) {
        spdlog::warn("{} does not end; killing it", process.spec.name);
        process.child->send_signal(SIGKILL);
      } else if (Clock::now() >= deadline + kReaped) {
        spdlog::error("{} (pid {}) does not go though it was killed; it is left behind", process.spec.name,
                      process.child->pid());
        process.last_end = "left behind";
        process.child.reset();
      }
    }
    killed = Clock::now() >= deadline;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

std::vector<Supervisor::Ended> Supervisor::ends() const {
  std::vector<Ended> ends;
  for (const Watched& process : processes_) ends.push_back({process.spec.name, process.last_end});
  return ends;
}

}  // namespace phare
