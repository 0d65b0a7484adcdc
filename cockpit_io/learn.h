// phare-cockpit --learn: which signals change while the stalk is moved.
//
// For a while nobody touches anything: what changes then (speed, counters, checksums, clocks) is the car's own. After
// that each signal that was at rest is reported when it moves. Without a DBC the same with single bits, and the end is
// a draft of the DBC file: bits of a byte that moved and lie side by side are one signal.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cockpit_io/can_frame.h"
#include "cockpit_io/dbc.h"

namespace phare {

class Learner {
 public:
  /// `dbc`: without messages bits are reported. `rest_ns`: how long nobody touches anything.
  Learner(Dbc dbc, std::int64_t rest_ns) : dbc_(std::move(dbc)), rest_ns_(rest_ns) {}

  /// Takes a frame; the lines to show for it: "12.345 s  LIGHT_STALK.LOW_BEAM  0 -> 1 (on)". `at_ns` since the start.
  std::vector<std::string> take(const CanFrame& frame, std::int64_t at_ns);

  /// What moved, those with few values first, and a draft of the cockpit file; without a DBC, of the DBC file.
  std::vector<std::string> summary() const;

  std::size_t frames() const { return frames_; }
  std::size_t ids() const { return ids_.size(); }

 private:
  struct Key {
    std::uint32_t id;
    bool extended;
    std::uint32_t index;  ///< of the signal in its message, or of the bit
    auto operator<=>(const Key&) const = default;
  };
  struct Watched {
    std::uint64_t raw = 0;
    std::uint64_t at_rest = 0;            ///< while nobody touched anything, or when it first came
    bool restless = false;                ///< changed while nobody touched anything
    std::uint64_t moves = 0;              ///< after that
    std::map<std::uint64_t, int> values;  ///< raw values and how often they came, after that
  };
  /// Of a message: its length, and how long it paused at most.
  struct Heard {
    std::uint32_t length = 0;
    std::int64_t last_ns = 0, longest_ns = 0;
  };
  using Moved = std::vector<std::pair<const Key*, const Watched*>>;
  std::vector<std::string> draft_cockpit(const Moved& moved) const;
  std::vector<std::string> draft_dbc(const Moved& moved) const;
  std::optional<std::string> watch(Key key, std::uint64_t raw, const DbcSignal* signal, std::int64_t at_ns);
  std::string name_of(const Key& key) const;

  Dbc dbc_;
  std::int64_t rest_ns_;
  std::size_t frames_ = 0;
  std::map<Key, Watched> watched_;
  std::map<std::pair<std::uint32_t, bool>, Heard> ids_;
};

}  // namespace phare
