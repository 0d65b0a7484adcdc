// phare bus-relay: a bad network for one's own rig - loss, delay, jitter, reordering, by a seed.
#include <chrono>
#include <memory>

#include "config/base/paths.h"
#include "config/finite_numbers.h"
#include "config/port_base.h"
#include "config/rig.h"
#include "net/channels.h"
#include "net/clock.h"
#include "tools/commands.h"
#include "tools/relay.h"

namespace phare {
namespace {

struct RelayOptions {
  std::string listen, to, rig_file = config_path("rigs/country_road.toml");
  std::uint16_t port_base = 0;
  double loss_percent = 0.0, duplicate_percent = 0.0, reorder_percent = 0.0, delay_ms = 0.0, jitter_ms = 0.0;
  double seconds = 0.0;
  std::uint64_t seed = 1;
};

int relay_bus(const RelayOptions& options) {
  const auto rig = read_rig(options.rig_file);
  if (!rig) return bad_input(rig.error());
  const std::uint16_t port_base = options.port_base != 0 ? options.port_base : rig->port_base;
  const auto ms = [](double value) { return std::chrono::nanoseconds(static_cast<std::int64_t>(value * 1e6)); };
  auto opened = Relay::open(options.listen, options.to, port_base, kMaxPortOffset + 1,
                            {.loss_01 = 0.01 * options.loss_percent,
                             .duplicate_01 = 0.01 * options.duplicate_percent,
                             .reorder_01 = 0.01 * options.reorder_percent,
                             .delay = ms(options.delay_ms),
                             .jitter = ms(options.jitter_ms),
                             .seed = options.seed});
  if (!opened) return bad_input(opened.error());
  std::printf("from %s to %s, ports %u to %u; Ctrl-C ends it\n", options.listen.c_str(), options.to.c_str(), port_base,
              port_base + kMaxPortOffset);
  std::fflush(stdout);
  const StopFlag stop = install_stop_signals();
  const auto begin = std::chrono::steady_clock::now();
  while (!stop && (options.seconds <= 0.0 ||
                   std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() < options.seconds))
    opened->step(std::chrono::milliseconds(20));
  const RelayCounts& c = opened->counts();
  std::printf("%llu datagrams received, %llu passed on, %llu lost, %llu doubled, %llu held back, %llu not taken\n",
              static_cast<unsigned long long>(c.received), static_cast<unsigned long long>(c.passed_on),
              static_cast<unsigned long long>(c.lost), static_cast<unsigned long long>(c.duplicated),
              static_cast<unsigned long long>(c.held_back), static_cast<unsigned long long>(c.not_taken));
  return kExitDone;
}

}  // namespace

void add_bus_relay(CLI::App& app, Command& chosen) {
  auto options = std::make_shared<RelayOptions>();
  CLI::App* command = app.add_subcommand("bus-relay", "A bad network for a rig: loss, delay and reordering by a seed");
  command->footer(
      "It listens on every port of the rig and passes on to the same ports at the other address. send_to in the rig\n"
      "names its address for those that are to be reached through it, bind their own (docs/two-machines.md).\n"
      "Example:\n  phare bus-relay --listen 127.0.0.9 --to 127.0.0.1 --loss 1 --delay-ms 5 --jitter-ms 5 --seconds 2");
  command->add_option("--listen", options->listen, "Address to listen on, on every port of the rig")->required();
  command->add_option("--to", options->to, "Address of the rig behind")->required();
  command->add_option("--rig", options->rig_file, "Rig file: its first port")->capture_default_str();
  command->add_option("--port-base", options->port_base, "First UDP port, instead of the rig's")
      ->check(CLI::Range(kLowestPortBase, kHighestPortBase));
  const auto share = [&](const char* name, double& value, const char* what) {
    command->add_option(name, value, what)->check(number_within(0.0, 100.0))->capture_default_str();
  };
  share("--loss", options->loss_percent, "Percent of datagrams that never arrive");
  share("--duplicate", options->duplicate_percent, "Percent that arrive twice");
  share("--reorder", options->reorder_percent, "Percent that are held back until others have passed");
  command->add_option("--delay-ms", options->delay_ms, "Delay of every datagram")->check(number_within(0.0, 60000.0));
  command->add_option("--jitter-ms", options->jitter_ms, "Up to so much more")->check(number_within(0.0, 60000.0));
  command->add_option("--seed", options->seed, "Of the faults")->capture_default_str();
  command->add_option("--seconds", options->seconds, "End after so long [never]")->check(number_within(0.0, 1e6));
  command->callback([options, &chosen] { chosen = [options] { return relay_bus(*options); }; });
}

}  // namespace phare
