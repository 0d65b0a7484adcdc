#include "visual/process/governor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

namespace phare {
namespace {

/// Steps in a report: a drive of a day may have more, and the newest tell most.
constexpr std::size_t kMostSteps = 1000;

template <typename Names>
std::optional<std::size_t> index_of(const Names& names, const std::string& name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

std::string GovernorLevel::text() const {
  std::string text =
      fmt::format("{}, shadows {}", kMethodNames[static_cast<std::size_t>(method)], kShadowNames[shadows]);
  if (fog) text += fmt::format(", fog {}", kFogNames[*fog]);
  return text;
}

std::string words_of(const GovernorLevel& level) {
  return fmt::format("{} {} {} {}", kMethodNames[static_cast<std::size_t>(level.method)], kShadowNames[level.shadows],
                     level.fog ? kFogNames[*level.fog] : "-", level.p95_ms);
}

std::optional<GovernorLevel> governor_level(const std::string& words) {
  std::istringstream stream(words);
  std::string method, shadows, fog, rest;
  GovernorLevel level;
  if (!(stream >> method >> shadows >> fog >> level.p95_ms) || stream >> rest || !(level.p95_ms > 0.0))
    return std::nullopt;
  const auto m = index_of(kMethodNames, method), s = index_of(kShadowNames, shadows);
  if (!m || !s) return std::nullopt;
  level.method = static_cast<Method>(*m);
  level.shadows = *s;
  if (fog == "-") return level;
  level.fog = index_of(kFogNames, fog);
  return level.fog ? std::optional(level) : std::nullopt;
}

Governor::Governor(double budget_ms, std::vector<GovernorLevel> levels, std::size_t begin_at)
    : budget_ms_(budget_ms),
      levels_(std::move(levels)),
      now_(std::min(begin_at, levels_.size() - 1)),
      waits_(levels_.size(), kUpAfter) {
  window_.reserve(kWindow);
}

std::optional<Governor::Step> Governor::step_to(std::size_t level, double time_s, double p95_ms) {
  const Step step{time_s, std::exchange(now_, level), level, p95_ms};
  over_ = room_ = 0;
  if (steps_.size() == kMostSteps) steps_.erase(steps_.begin());
  steps_.push_back(step);
  return step;
}

std::optional<Governor::Step> Governor::add(double time_s, double frame_ms) {
  if (!on()) return std::nullopt;
  window_.push_back(frame_ms);
  if (window_.size() < kWindow) return std::nullopt;
  // 38 of 40 frames do not take longer.
  const auto at = static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(kWindow))) - 1;
  std::nth_element(window_.begin(), window_.begin() + static_cast<std::ptrdiff_t>(at), window_.end());
  const double p95_ms = window_[at];
  window_.clear();
  // What went up and stayed has earned the short wait again.
  if (since_up_ <= kTakenBackWithin && ++since_up_ > kTakenBackWithin) waits_[now_] = kUpAfter;

  over_ = p95_ms > budget_ms_ ? over_ + 1 : 0;
  if (over_ >= kDownAfter && now_ + 1 < levels_.size()) {
    // What went up and did not stay waits twice as long, however many steps down it takes.
    if (since_up_ <= kTakenBackWithin) waits_[now_] = std::min(2 * waits_[now_], kLongestWait);
    since_up_ = kTakenBackWithin + 1;
    return step_to(now_ + 1, time_s, p95_ms);
  }
  if (now_ == 0) return std::nullopt;
  const double finer_ms = p95_ms * levels_[now_ - 1].p95_ms / levels_[now_].p95_ms;
  room_ = finer_ms < kUpBelow * budget_ms_ ? room_ + 1 : 0;
  if (room_ < waits_[now_ - 1]) return std::nullopt;
  since_up_ = 0;
  return step_to(now_ - 1, time_s, p95_ms);
}

std::string Governor::text(const Step& step) const {
  return fmt::format("{:.2f} s: {} -> {}: p95 of {} frames {:.3g} ms, budget {:.4g} ms", step.time_s,
                     levels_[step.from].text(), levels_[step.to].text(), kWindow, step.p95_ms, budget_ms_);
}

nlohmann::json Governor::json() const {
  nlohmann::json json{
      {"budget_ms", budget_ms_}, {"levels", nlohmann::json::array()}, {"steps", nlohmann::json::array()}};
  for (const GovernorLevel& level : levels_)
    json["levels"].push_back({{"level", level.text()}, {"p95_ms", level.p95_ms}});
  if (on()) json["now"] = levels_[now_].text();
  for (const Step& step : steps_)
    json["steps"].push_back({{"time_s", step.time_s},
                             {"from", levels_[step.from].text()},
                             {"to", levels_[step.to].text()},
                             {"p95_ms", step.p95_ms}});
  return json;
}

}  // namespace phare
