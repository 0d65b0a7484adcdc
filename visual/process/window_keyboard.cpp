#include "visual/process/window_keyboard.h"

#include <algorithm>
#include <utility>

namespace phare {

void WindowKeyboard::tell(std::int32_t event, Time now) {
  events_.push_back({event, now});
  ++count_;
  news_ = true;
}

void WindowKeyboard::key(int physical, KeyCode code, bool down, Time now) {
  if (!down) {
    const auto held = down_.find(physical);
    if (held == down_.end()) return;
    tell(-static_cast<std::int32_t>(held->second), now);
    down_.erase(held);
    return;
  }
  any_ = true;
  const auto bound = bound_code(code);
  if (!bound || down_.contains(physical)) return;
  const KeyBinding& binding = *binding_of(*bound);
  presses_.push_back(binding.action);
  if (binding.actor == KeyActor::kPicture) return;  // stays here
  down_[physical] = *bound;
  tell(static_cast<std::int32_t>(*bound), now);
}

void WindowKeyboard::repeat(KeyCode code) {
  const auto bound = bound_code(code);
  if (bound && repeats(binding_of(*bound)->action)) presses_.push_back(binding_of(*bound)->action);
}

void WindowKeyboard::character(KeyCode code, Time now) {
  constexpr int kNoKey = -1;
  key(kNoKey, code, true, now);
  key(kNoKey, code, false, now);
}

void WindowKeyboard::focus_lost(Time now) {
  for (const auto& [physical, code] : down_) tell(-static_cast<std::int32_t>(code), now);
  down_.clear();
}

std::vector<KeyAction> WindowKeyboard::take_presses() {
  return std::exchange(presses_, {});
}

bool WindowKeyboard::take_any() {
  return std::exchange(any_, false);
}

std::optional<KeyInput> WindowKeyboard::message(Time now) {
  while (!events_.empty() && now - events_.front().at > kTell) events_.pop_front();
  while (events_.size() > kMostKeys) events_.pop_front();
  if (!news_ && ((down_.empty() && events_.empty()) || now - sent_ < kSendEvery)) return std::nullopt;
  news_ = false;
  sent_ = now;
  KeyInput message;
  for (const auto& [physical, code] : down_) message.held.push_back(code);
  std::ranges::sort(message.held);
  message.held.erase(std::ranges::unique(message.held).begin(), message.held.end());
  if (message.held.size() > kMostKeys) message.held.resize(kMostKeys);  // more than hands have fingers
  for (const Event& event : events_) message.event.push_back(event.event);
  message.events = count_;
  return message;
}

}  // namespace phare
