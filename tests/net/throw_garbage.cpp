// phare-throw-garbage: a flood of datagrams that no process may take, against one port of the loopback.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <random>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "config/base/result.h"
#include "net/drive_file.h"
#include "net/seal.h"
#include "net/wire.h"
#include "tests/net/garbage.h"
#include "tests/net/sample.h"

int main(int argc, char** argv) {
  using namespace phare;
  CLI::App app{
      "Sends random, cut and bit-flipped datagrams to 127.0.0.1 and prints what it sent as one line of JSON.\n"
      "Example: phare-throw-garbage --port 47001 --count 10000000 --seed 7"};
  std::uint16_t port = 0;
  std::uint64_t count = 0;
  std::uint64_t seed = 1;
  double rate_hz = 0.0;
  std::string template_file;
  bool quiet = false;
  double on_s = 0.0, period_s = 0.0;
  app.add_option("--port", port, "UDP port")->required()->check(CLI::Range(1, 65535));
  app.add_option("--count", count, "how many")
      ->required()
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1'000'000'000}));
  app.add_option("--seed", seed, "of the random numbers");
  app.add_option("--rate", rate_hz, "datagrams a second, 0: as fast as it goes")->check(CLI::NonNegativeNumber);
  app.add_option("--on", on_s, "s of every --period, by the wall clock, in which it throws at the port; else at nobody")
      ->check(CLI::PositiveNumber);
  app.add_option("--period", period_s, "s, see --on; 0: all the time")->check(CLI::NonNegativeNumber);
  app.add_flag("--quiet", quiet, "print nothing");
  bool forge = false;
  app.add_flag("--forge", forge,
               "no garbage: datagrams that are right in all but the key, sent now, each by a new start");
  app.add_option("--template", template_file, "drive file whose datagrams are cut and flipped; else made-up ones");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitDone : kExitBadInput;
  }

  std::vector<Datagram> valid = test::samples(seed);
  if (!template_file.empty()) {
    Result<Drive> drive = read_drive(template_file);
    if (!drive || drive->datagrams.empty()) {
      std::fprintf(stderr, "%s\n",
                   drive ? (template_file + ": holds no datagram").c_str() : drive.error().text().c_str());
      return kExitBadInput;
    }
    valid = std::move(drive->datagrams);
    valid.resize(std::min<std::size_t>(valid.size(), 4096));
  }
  std::vector<std::string> encoded;
  for (const Datagram& datagram : valid) encoded.push_back(encode(datagram));
  test::Garbage garbage(std::move(encoded), seed);
  std::mt19937_64 random(seed);
  BusKey wrong_key{};
  for (auto& byte : wrong_key) byte = static_cast<std::uint8_t>(random());
  const Seal seal(wrong_key);
  std::string forged;
  const auto forge_next = [&] {
    Datagram& datagram = valid[random() % valid.size()];
    datagram.start_id = random() | 1u;
    datagram.sequence = 1 + random() % 1000;
    datagram.sent = wall_now();
    encode_into(datagram, forged);
    seal.close(forged);
    return std::as_bytes(std::span(forged.data(), forged.size()));
  };

  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(port);
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  // Outside its window the flood goes to a socket nobody reads, so that throwing costs the machine the same.
  const int dead_end = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in decoy{};
  socklen_t decoy_size = sizeof decoy;
  decoy.sin_family = AF_INET;
  decoy.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (fd < 0 || dead_end < 0 || bind(dead_end, reinterpret_cast<const sockaddr*>(&decoy), sizeof decoy) != 0 ||
      getsockname(dead_end, reinterpret_cast<sockaddr*>(&decoy), &decoy_size) != 0) {
    std::perror("socket");
    return kExitBadInput;
  }

  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  std::uint64_t failed = 0;
  const auto in_window = [&] {
    return period_s <= 0.0 || std::fmod(static_cast<double>(wall_now().ns) * 1e-9, period_s) < on_s;
  };
  bool on_target = in_window();
  std::uint64_t thrown = 0;  // decoys too
  for (std::uint64_t i = 0; i < count; ++thrown) {
    const auto bytes = forge ? forge_next() : garbage.next();
    const sockaddr_in& at = on_target ? to : decoy;
    const bool sent = sendto(fd, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&at), sizeof at) >= 0;
    if (on_target) {
      ++i;
      failed += sent ? 0 : 1;
    }
    if (thrown % 64 != 63) continue;
    const double ahead_s = rate_hz > 0.0 ? static_cast<double>(thrown + 1) / rate_hz - seconds() : 0.0;
    if (ahead_s > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(ahead_s));
    on_target = in_window();
  }
  const double took_s = seconds();
  close(fd);
  const nlohmann::json result = {{"port", port},      {"sent", count - failed},
                                 {"failed", failed},  {"seed", seed},
                                 {"seconds", took_s}, {"per_second", static_cast<double>(count - failed) / took_s}};
  if (!quiet) std::printf("%s\n", result.dump().c_str());
  return failed == 0 ? kExitDone : kExitCheckFailed;
}
