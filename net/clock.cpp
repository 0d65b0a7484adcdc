#include "net/clock.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <ctime>

namespace phare {
namespace {

std::int64_t now_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<std::int64_t>(now.tv_sec) * kNsPerSecond + now.tv_nsec;
}

// Set from a signal handler, hence lock-free.
std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void on_stop_signal(int) {
  stop_requested.store(true, std::memory_order_relaxed);
}

}  // namespace

std::int64_t wall_shift_ns() {
  static const std::int64_t shift_ns = [] {
    const char* text = std::getenv("PHARE_CLOCK_OFFSET_MS");
    constexpr double kMost_ms = 1e12;  // thirty years: no stamp leaves its range
    const double ms = text == nullptr ? 0.0 : std::clamp(std::strtod(text, nullptr), -kMost_ms, kMost_ms);
    return std::isfinite(ms) ? static_cast<std::int64_t>(ms * 1e6) : 0;
  }();
  return shift_ns;
}

WallTime wall_now() {
  return WallTime{now_of(CLOCK_REALTIME) + wall_shift_ns()};
}

Pacer::Pacer(std::chrono::nanoseconds period)
    : period_ns_(std::max<std::int64_t>(period.count(), 1)), deadline_ns_(now_of(CLOCK_MONOTONIC) + period_ns_) {}

std::int64_t Pacer::advance(std::int64_t now_ns) {
  late_ns_ = now_ns - deadline_ns_;
  const std::int64_t missed = late_ns_ / period_ns_;
  deadline_ns_ += (missed + 1) * period_ns_;
  return missed;
}

std::int64_t Pacer::wait() {
  std::int64_t now_ns = now_of(CLOCK_MONOTONIC);
  if (now_ns < deadline_ns_) {
    const timespec deadline{static_cast<time_t>(deadline_ns_ / kNsPerSecond),
                            static_cast<long>(deadline_ns_ % kNsPerSecond)};
    if (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr) != 0) return 0;
    now_ns = now_of(CLOCK_MONOTONIC);
  }
  return advance(now_ns);
}

std::chrono::nanoseconds Pacer::left() const {
  return std::chrono::nanoseconds(std::max<std::int64_t>(deadline_ns_ - now_of(CLOCK_MONOTONIC), 0));
}

bool Pacer::due() {
  const std::int64_t now_ns = now_of(CLOCK_MONOTONIC);
  if (now_ns < deadline_ns_) return false;
  advance(now_ns);
  return true;
}

void Pacer::restart() {
  deadline_ns_ = now_of(CLOCK_MONOTONIC) + period_ns_;
}

bool StopFlag::requested() const {
  return stop_requested.load(std::memory_order_relaxed);
}

void StopFlag::request() const {
  stop_requested.store(true, std::memory_order_relaxed);
}

StopFlag install_stop_signals() {
  struct sigaction action {};
  action.sa_handler = on_stop_signal;  // no SA_RESTART: a sleeping poll or clock_nanosleep shall return
  sigemptyset(&action.sa_mask);
  sigaction(SIGTERM, &action, nullptr);
  sigaction(SIGINT, &action, nullptr);
  // A terminal that is closed; under nohup it has been told to mean nothing.
  struct sigaction hang_up {};
  if (sigaction(SIGHUP, nullptr, &hang_up) == 0 && hang_up.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
  struct sigaction ignore {};
  ignore.sa_handler = SIG_IGN;
  sigemptyset(&ignore.sa_mask);
  sigaction(SIGPIPE, &ignore, nullptr);
  return StopFlag{};
}

}  // namespace phare
