#include "cockpit_io/dbc_multiplexors.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace phare {
namespace {

void problem(Dbc& dbc, const DbcMessage& message, const DbcSignal& signal, std::string reason) {
  dbc.problems.push_back({signal.line, message.name, signal.name, std::move(reason)});
}

/// SG_MUL_VAL_ can make two multiplexors hang on each other.
void drop_circles(Dbc& dbc, DbcMessage& message) {
  const auto ends = [&](const DbcSignal& s) {
    const DbcSignal* at = &s;
    for (std::size_t steps = 0; at != nullptr && steps <= message.signals.size(); ++steps) {
      if (at->multiplexor.empty()) return true;
      at = std::as_const(message).find(at->multiplexor);
    }
    return false;
  };
  std::vector<std::string> circular;
  for (const DbcSignal& s : message.signals) {
    if (ends(s)) continue;
    problem(dbc, message, s, "hangs on multiplexors that hang on each other or were left out; left out");
    circular.push_back(s.name);
  }
  std::erase_if(message.signals, [&](const DbcSignal& s) {
    return std::find(circular.begin(), circular.end(), s.name) != circular.end();
  });
}

}  // namespace

bool is_root_multiplexor(const DbcSignal& signal) {
  return signal.is_multiplexor && signal.multiplex_values.empty();
}

void hang_multiplexors(Dbc& dbc) {
  for (DbcMessage& message : dbc.messages) {
    const auto root = std::find_if(message.signals.begin(), message.signals.end(), is_root_multiplexor);
    const auto second =
        root == message.signals.end() ? root : std::find_if(root + 1, message.signals.end(), is_root_multiplexor);
    for (DbcSignal& s : message.signals) {
      if (s.multiplex_values.empty() || !s.multiplexor.empty()) continue;
      if (root == message.signals.end()) {
        problem(dbc, message, s, "is multiplexed, but its message has no multiplexor (M); left out");
      } else if (second != message.signals.end()) {
        problem(dbc, message, s,
                "is multiplexed, but its message has two multiplexors, " + root->name + " and " + second->name +
                    ", and no SG_MUL_VAL_ says by which; left out");
      } else {
        s.multiplexor = root->name;
      }
    }
    std::erase_if(message.signals,
                  [](const DbcSignal& s) { return !s.multiplex_values.empty() && s.multiplexor.empty(); });
    drop_circles(dbc, message);
  }
}

}  // namespace phare
