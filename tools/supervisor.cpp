#include "tools/supervisor.h"

#include <signal.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <thread>

namespace phare {

Supervisor::Supervisor(std::vector<ProcessSpec> specs) {
  for (ProcessSpec& spec : specs)
    processes_.push_back(Watched{.spec = std::move(spec), .child = {}, .due = {}, .restarted = {}});
}

Supervisor::~Supervisor() {
  end_all(std::chrono::seconds(2));
}

Status Supervisor::start() {
  started_ = Clock::now();
  for (Watched& process : processes_) {
    auto child = ChildProcess::start(process.spec.program, process.spec.arguments);
    if (!child) {
      end_all(std::chrono::seconds(2));
      return child.error();
    }
    process.child = *child;
    process.last_end = "running";
    spdlog::debug("started {} (pid {})", process.spec.name, child->pid());
  }
  return Done{};
}

bool Supervisor::step() {
  for (Watched& process : processes_) {
    if (!look_after(process)) return false;
  }
  const bool over = std::all_of(processes_.begin(), processes_.end(),
                                [](const Watched& process) { return process.done || !process.spec.ends_the_drive; });
  return !over;
}

bool Supervisor::look_after(Watched& process) {
  const auto now = Clock::now();
  if (process.due && now >= *process.due) {
    process.due.reset();
    std::vector<std::string> arguments = process.spec.arguments;
    arguments.insert(arguments.end(), process.spec.restart_arguments.begin(), process.spec.restart_arguments.end());
    auto child = ChildProcess::start(process.spec.program, arguments);
    if (!child) return give_up(kExitCheckFailed, child.error().text());
    process.child = *child;
    process.last_end = "running";
    return true;
  }
  if (!process.child) return true;
  const auto end = process.child->ended();
  if (!end) return true;
  process.child.reset();
  process.last_end = end->text();
  if (end->signal == 0 && end->exit_code == kExitDone) {
    process.done = true;
    return true;
  }
  // Bad input stays bad however often it is read again; the process has said what it is.
  if (end->signal == 0 && end->exit_code == kExitBadInput) {
    return give_up(kExitBadInput, process.spec.name + " refused its input (see above)");
  }
  while (!process.restarted.empty() && now - process.restarted.front() > kRestartWindow) process.restarted.pop_front();
  if (process.restarted.size() >= kMaxRestarts) {
    return give_up(kExitCheckFailed, process.spec.name + " ended with " + end->text() + " after " +
                                         std::to_string(kMaxRestarts) + " restarts within " +
                                         std::to_string(kRestartWindow.count()) + " s");
  }
  const auto backoff = kFirstBackoff * (1 << process.restarted.size());
  process.restarted.push_back(now);
  process.due = now + backoff;
  const double at_s = std::chrono::duration<double>(now - started_).count();
  restarts_.push_back({process.spec.name, at_s, end->text()});
  spdlog::warn("{} ended with {}; restarting it", process.spec.name, end->text());
  return true;
}

bool Supervisor::give_up(int exit_code, std::string why) {
  exit_code_ = exit_code;
  why_ = std::move(why);
  return false;
}

void Supervisor::end_all(std::chrono::milliseconds grace) {
  const auto deadline = Clock::now() + grace;
  for (Watched& process : processes_) {
    process.due.reset();
    if (process.child) process.child->send_signal(SIGTERM);
  }
  bool killed = false;
  for (;;) {
    bool any = false;
    for (Watched& process : processes_) {
      if (!process.child) continue;
      if (const auto end = process.child->ended()) {
        process.last_end = end->text();
        process.child.reset();
      } else {
        any = true;
      }
    }
    if (!any) return;
    if (!killed && Clock::now() >= deadline) {
      killed = true;
      for (Watched& process : processes_) {
        if (!process.child) continue;
        spdlog::warn("{} does not end; killing it", process.spec.name);
        process.child->send_signal(SIGKILL);
      }
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

std::vector<Supervisor::Ended> Supervisor::ends() const {
  std::vector<Ended> ends;
  for (const Watched& process : processes_) ends.push_back({process.spec.name, process.last_end});
  return ends;
}

}  // namespace phare
