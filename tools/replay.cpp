// phare replay: the datagrams of a drive file onto the bus again, in their time.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "config/base/input_files.h"
#include "config/finite_numbers.h"
#include "config/port_base.h"
#include "config/rig.h"
#include "net/channels.h"
#include "net/clock.h"
#include "net/drive_file.h"
#include "net/places.h"
#include "net/run_key.h"
#include "net/seal.h"
#include "net/udp.h"
#include "net/wire.h"
#include "tools/commands.h"

namespace phare {
namespace {

struct ReplayOptions {
  std::string file, rig_file = config_path("rigs/country_road.toml");
  double speed = 1.0;
  std::uint16_t port_base = 0;
  bool open_bus = false;
};

struct Receiver {
  std::string name;
  Endpoint at;
};

/// Who takes this datagram, but for those whose place a replay takes.
std::vector<Receiver> receivers_of(const Datagram& datagram, const Rig& rig) {
  const Channel& row = kChannels[datagram.payload.index()];
  std::vector<Receiver> all;
  const auto add = [&](Role role, std::string name, std::uint32_t channel = 0) {
    if (row.receivers.has(role)) all.push_back({std::move(name), endpoint_of(rig, role, channel)});
  };
  add(Role::kRecorder, "record");
  add(Role::kControl, "control");
  add(Role::kLaw, "law");
  const std::size_t channels = row.first_visual_only ? 1 : rig.channels.size();
  for (std::uint32_t channel = 0; channel < channels; ++channel)
    add(Role::kVisual, "visual-" + std::to_string(channel), channel);
  return all;
}

/// Whoever takes the place of the cockpit and the car speaks from their ports: beside those of a rig that runs it is
/// told so at once, where receivers would only refuse it as a second sender.
struct ReplayPorts {
  UdpSocket cockpit, dynamics, others;

  UdpSocket& of(Sender sender) {
    return sender == Sender::kCockpit ? cockpit : sender == Sender::kDynamics ? dynamics : others;
  }

  static Result<ReplayPorts> open(const Rig& rig) {
    const auto held = [&](Role role) {
      return UdpSocket::open(address_to_bind(rig, role), static_cast<std::uint16_t>(rig.port_base + port_offset(role)));
    };
    auto cockpit = held(Role::kCockpit), dynamics = held(Role::kDynamics);
    for (const auto* taken : {&cockpit, &dynamics})
      if (!*taken)
        return Error{taken->error().place, taken->error().reason + "; a replay takes the place of cockpit and car"};
    auto others = UdpSocket::open(off_loopback(rig) ? "0.0.0.0" : rig.bind_address, 0);
    if (!others) return others.error();
    for (UdpSocket* socket : {&*cockpit, &*dynamics, &*others}) socket->hear_refusals();
    return ReplayPorts{std::move(*cockpit), std::move(*dynamics), std::move(*others)};
  }
};

/// As long nobody may have taken anything before that is told: of a drive of an hour not only at its end.
constexpr std::chrono::milliseconds kTellAfter{1500};

std::string nobody_listens(const Rig& rig) {
  return fmt::format("nobody listens at {}: no phare-visual of this rig and port base runs",
                     text_of(endpoint_of(rig, Role::kVisual)));
}

int replay(const ReplayOptions& options) {
  if (is_standard_input(options.file)) return bad_input({options.file, "a drive is read from a file"});
  auto rig = read_rig(options.rig_file);
  if (!rig) return bad_input(rig.error());
  if (options.port_base != 0) rig->port_base = options.port_base;
  if (options.open_bus) rig->run_key = false;
  if (const Status key = take_run_key(*rig); !key) return bad_input(key.error());
  auto drive = read_drive(options.file);
  if (!drive) return bad_input(drive.error());
  if (drive->datagrams.empty()) return bad_input({options.file, "holds no valid datagram"});
  if (drive->cut) spdlog::warn("{}: cut off, read up to its last whole record", options.file);
  auto ports = ReplayPorts::open(*rig);
  if (!ports) return bad_input(ports.error());
  const StopFlag stop = install_stop_signals();
  const Seal seal(rig->bus_key);

  std::stable_sort(drive->datagrams.begin(), drive->datagrams.end(),
                   [](const Datagram& a, const Datagram& b) { return a.sim_time < b.sim_time; });
  // A new start id: a receiver that has seen this drive before takes it for a new start, not for repeats.
  const std::uint64_t run_id = static_cast<std::uint64_t>(wall_now().ns) | 1u;
  const auto begin = std::chrono::steady_clock::now();
  std::uint64_t sent = 0;
  SimTime sent_until{};
  bool told = false;
  std::map<std::string, std::uint64_t> taken;
  for (Datagram& datagram : drive->datagrams) {
    const auto due = begin + std::chrono::nanoseconds(
                                 static_cast<std::int64_t>(static_cast<double>(datagram.sim_time.ns) / options.speed));
    while (!stop && std::chrono::steady_clock::now() < due) {
      std::this_thread::sleep_until(std::min(due, std::chrono::steady_clock::now() + std::chrono::milliseconds(50)));
      const bool long_alone = sent > 0 && taken.empty() && std::chrono::steady_clock::now() - begin > kTellAfter;
      if (long_alone && !std::exchange(told, true)) spdlog::warn("{}; the replay goes on", nobody_listens(*rig));
    }
    if (stop) break;
    datagram.start_id = datagram.start_id == run_id ? run_id : datagram.start_id ^ run_id;
    datagram.sent = wall_now();
    // In real time there are no frames to wait for.
    if (auto* cockpit = std::get_if<CockpitState>(&datagram.payload)) cockpit->frame_index = -1;
    if (auto* vehicle = std::get_if<VehicleState>(&datagram.payload)) vehicle->frame_index = -1;
    std::string bytes = encode(datagram);
    seal.close(bytes);
    ++sent;
    sent_until = datagram.sim_time;
    for (const auto& [name, at] : receivers_of(datagram, *rig))
      if (ports->of(datagram.sender).send_to(at, std::as_bytes(std::span(bytes)))) ++taken[name];
  }
  std::string heard;
  for (const auto& [name, count] : taken) heard += fmt::format(", {} by {}", count, name);
  std::printf("%llu datagrams sent%s; %.3f s of drive\n", static_cast<unsigned long long>(sent), heard.c_str(),
              sent_until.seconds());
  if (sent > 0 && taken.empty()) {
    std::fflush(stdout);
    std::fprintf(stderr, "phare: %s\n", nobody_listens(*rig).c_str());
    if (!stop) return kExitCheckFailed;
  }
  return stop ? kExitInterrupted : kExitDone;
}

}  // namespace

void add_replay(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App* command = app.add_subcommand("replay", "Send the datagrams of a drive file again, in real time");
  command->footer(
      "Takes the place of phare-cockpit and phare-dynamics for a phare-visual that runs. Exit codes: 1 nobody "
      "listens,\n130 interrupted.\n"
      "Example:\n  phare replay config/drives/country_road.pcap --speed 0.5");
  command->add_option("file", options->file, "Drive file")->required();
  command->add_option("--rig", options->rig_file, "Rig file: address, ports and channels")->capture_default_str();
  command->add_option("--speed", options->speed, "Times real time")
      ->check(number_within(0.01, 100.0))
      ->capture_default_str();
  command->add_option("--port-base", options->port_base, "First UDP port, instead of the rig's")
      ->check(CLI::Range(kLowestPortBase, kHighestPortBase));
  command->add_flag("--open-bus", options->open_bus, "Of a rig that runs with --open-bus: no key");
  command->callback([options, &chosen] { chosen = [options] { return replay(*options); }; });
}

}  // namespace phare
