#include "net/stats.h"

#include <unistd.h>

#include <chrono>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <system_error>

namespace phare {
namespace {

/// A line "VmRSS:   1234 kB" of /proc/self/status; 0 where there is none.
std::uint64_t status_kib(const char* key) {
  std::ifstream status("/proc/self/status");
  const std::string wanted = std::string(key) + ":";
  for (std::string word; status >> word;) {
    std::uint64_t kib = 0;
    if (word == wanted && status >> kib) return kib;
  }
  return 0;
}

std::string hex(std::uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof text, "%016" PRIx64, value);
  return text;
}

const char* refusal_key(Refusal refusal) {
  switch (refusal) {
    case Refusal::kNone:
      break;
    case Refusal::kSize:
      return "size";
    case Refusal::kHeader:
      return "header";
    case Refusal::kChecksum:
      return "checksum";
    case Refusal::kMalformed:
      return "malformed";
    case Refusal::kEnvelope:
      return "envelope";
    case Refusal::kSender:
      return "sender";
    case Refusal::kNotFinite:
      return "not_finite";
    case Refusal::kRange:
      return "range";
    case Refusal::kArrays:
      return "arrays";
    case Refusal::kNotForUs:
      return "not_for_us";
    case Refusal::kKey:
      return "key";
    case Refusal::kReplay:
      return "replay";
    case Refusal::kSecond:
      return "second_sender";
  }
  return "none";
}

/// By process: how its clock stands against ours.
nlohmann::json clocks_json(const PeerClocks& clocks) {
  nlohmann::json all = nlohmann::json::object();
  const auto now = std::chrono::steady_clock::now();
  for (const PeerClocks::Peer& peer : clocks.peers()) {
    nlohmann::json& clock = all[peer.name];
    clock = {{"asked", peer.asked_count}, {"answered", peer.clock.exchanges()}, {"set", peer.clock.steps()}};
    const auto estimate = peer.clock.at(now);
    if (!estimate) continue;
    clock["ahead_ms"] = static_cast<double>(estimate->ahead_ns) * 1e-6;
    clock["within_ms"] = static_cast<double>(estimate->within_ns) * 1e-6;
    if (!std::isfinite(estimate->drift_within_ppm)) continue;
    clock["drift_ppm"] = estimate->drift_ppm;
    clock["drift_within_ppm"] = estimate->drift_within_ppm;
  }
  return all;
}

}  // namespace

nlohmann::json stats_json(const char* process, const Bus& bus) {
  const BusCounters& counters = bus.counters();
  nlohmann::json on_bus = nlohmann::json::object();
  nlohmann::json sent = nlohmann::json::object();
  for (std::size_t i = 0; i < kChannels.size(); ++i) {
    const std::string message(kChannels[i].message);
    if (kChannels[i].receivers.has(bus.role())) {
      const InboxCounters& c = counters.received[i];
      on_bus[message] = {{"received", c.received},
                         {"lost", c.lost},
                         {"late", c.late},
                         {"duplicate", c.duplicate},
                         {"restarted", c.restarted}};
    }
    if (kChannels[i].may_send(sender_of(bus.role()))) sent[message] = counters.sent[i];
  }
  nlohmann::json because = nlohmann::json::object();
  for (std::size_t i = 1; i < kRefusals; ++i) {
    if (counters.refused_because[i] > 0) because[refusal_key(static_cast<Refusal>(i))] = counters.refused_because[i];
  }
  if (bus.clocks()) on_bus["clocks"] = clocks_json(*bus.clocks());
  on_bus["refused"] = counters.refused;
  on_bus["refused_in_kernel"] = counters.refused_in_kernel;
  on_bus["refused_because"] = because;
  on_bus["sent"] = sent;
  on_bus["not_sent"] = counters.not_sent;
  on_bus["send_failures"] = counters.send_failures;
  return {{"process", process},
          {"start_id", hex(bus.start_id())},
          {"bus", on_bus},
          {"memory", {{"rss_kib", status_kib("VmRSS")}, {"peak_kib", status_kib("VmHWM")}}}};
}

bool write_json(const std::filesystem::path& path, const nlohmann::json& json) {
  // The name has our process id, so that two writers do not meet in it.
  std::filesystem::path beside = path;
  beside += ".tmp" + std::to_string(getpid());
  {
    std::ofstream file(beside);
    // Replaces broken UTF-8 instead of throwing.
    file << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
    file.flush();
    if (!file) {
      std::error_code ignored;
      std::filesystem::remove(beside, ignored);
      return false;
    }
  }
  std::error_code error;
  std::filesystem::rename(beside, path, error);
  if (error) {
    std::error_code ignored;
    std::filesystem::remove(beside, ignored);
  }
  return !error;
}

}  // namespace phare
