// Time and the bus, where programs of several processes break. In a moment, with the classes that the processes use,
// and no socket: the network is made up, by a seed.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <span>

#include "net/inbox.h"
#include "net/peer_clock.h"
#include "net/silence.h"
#include "net/sim_time.h"
#include "net/wire.h"
#include "tools/hard_cases/hard_case.h"
#include "visual/process/pose_buffer.h"

namespace phare::hard {
namespace {

constexpr double kMessage_s = 0.004;  // VehicleState, 250 a second

/// What the network does to each message.
struct Weather {
  double lost = 0.0, twice = 0.0;         ///< shares
  double least_s = 2e-4, jitter_s = 0.0;  ///< on its way
};

struct Arriving {
  double at_s = 0.0;
  std::uint64_t sequence = 0;  ///< from 1; sent at (sequence − 1) · 4 ms
};

/// What of `count` messages arrives and when, in the order in which it does. The first and the last arrive.
std::vector<Arriving> through(const Weather& weather, std::uint64_t count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<Arriving> all;
  for (std::uint64_t sequence = 1; sequence <= count; ++sequence) {
    const bool edge = sequence == 1 || sequence == count;
    if (!edge && share(random) < weather.lost) continue;
    const int copies = share(random) < weather.twice ? 2 : 1;
    for (int copy = 0; copy < copies; ++copy)
      all.push_back(
          {kMessage_s * static_cast<double>(sequence - 1) + weather.least_s + weather.jitter_s * share(random),
           sequence});
  }
  std::ranges::stable_sort(all, {}, &Arriving::at_s);
  return all;
}

/// A car at 30 m/s round a circle of 100 m.
VehicleState on_circle(double time_s) {
  constexpr double kSpeed_mps = 30.0, kRadius_m = 100.0, kRate = kSpeed_mps / kRadius_m;
  VehicleState car;
  car.x_m = kRadius_m * std::sin(kRate * time_s);
  car.y_m = kRadius_m * (1.0 - std::cos(kRate * time_s));
  car.yaw_rad = std::remainder(kRate * time_s, 2.0 * 3.141592653589793);
  car.vx_mps = kSpeed_mps * std::cos(kRate * time_s), car.vy_mps = kSpeed_mps * std::sin(kRate * time_s);
  car.ay_mps2 = kSpeed_mps * kRate;  // of the car
  car.yaw_rate_radps = kRate;
  car.speed_mps = kSpeed_mps;
  return car;
}

double apart_m(const VehicleState& a, const VehicleState& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

SimTime at_s(double seconds) {
  return {std::llround(1e9 * seconds)};
}
WallTime wall_s(double seconds) {
  return {1'700'000'000'000'000'000 + std::llround(1e9 * seconds)};
}

/// 30 % lost, a fifth twice, each 0 to 50 ms late, so that a message overtakes twelve.
constexpr Weather kStorm{.lost = 0.3, .twice = 0.2, .jitter_s = 0.05};

/// Counts that are not what happened.
Outcome counts(const Bench& bench) {
  Outcome outcome;
  std::mt19937_64 random(bench.seed);
  for (int round = 0; round < 10; ++round) {
    constexpr std::uint64_t kCount = 5000;
    SequenceTracker tracker;
    InboxCounters expected;
    std::set<std::uint64_t> seen;
    std::uint64_t newest = 0, first = 0;
    for (const Arriving& one : through(kStorm, kCount, random)) {
      tracker.arrived(7, one.sequence);
      if (first == 0) first = one.sequence;
      if (!seen.insert(one.sequence).second)
        ++expected.duplicate;
      else if (one.sequence > newest)
        newest = one.sequence, ++expected.received;
      else
        ++expected.late;
    }
    // What was sent before the first that came is not missed.
    const auto before = static_cast<std::uint64_t>(std::distance(seen.begin(), seen.lower_bound(first)));
    expected.lost = newest - first + 1 - (seen.size() - before);
    const InboxCounters& found = tracker.counters();
    const auto off = [](std::uint64_t a, std::uint64_t b) {
      return std::abs(static_cast<double>(a) - static_cast<double>(b));
    };
    outcome.float64.push_back(
        {static_cast<double>(round), off(found.received, expected.received) + off(found.late, expected.late) +
                                         off(found.duplicate, expected.duplicate) + off(found.lost, expected.lost)});
  }
  return outcome;
}

/// A picture that goes back to an older pose because that came later.
Outcome newest_wins(const Bench& bench) {
  Outcome outcome;
  std::mt19937_64 random(bench.seed);
  for (int round = 0; round < 10; ++round) {
    Inbox<VehicleState> inbox;
    Datagram datagram;
    datagram.start_id = 7;
    double wrong = 0.0;
    std::uint64_t newest = 0;
    for (const Arriving& one : through(kStorm, 5000, random)) {
      datagram.sequence = one.sequence;
      datagram.sim_time = at_s(kMessage_s * static_cast<double>(one.sequence - 1));
      ArrivalTime arrived;
      arrived.steady += std::chrono::hours(1) + std::chrono::nanoseconds(at_s(one.at_s).ns);
      inbox.deliver(datagram, on_circle(datagram.sim_time.seconds()), arrived, Endpoint{}, false);
      newest = std::max(newest, one.sequence);
      if (inbox.newest()->sim_time != at_s(kMessage_s * static_cast<double>(newest - 1))) ++wrong;
    }
    outcome.float64.push_back({static_cast<double>(round), wrong});
  }
  return outcome;
}

/// Numbers at and over the ends of 8, 16, 32 and 64 bits: messages in order that are not taken.
Outcome wrap(const Bench&) {
  Outcome outcome;
  for (const int bits : {8, 16, 31, 32, 53, 63, 64}) {
    SequenceTracker tracker;
    // Of 64 bits nothing lies beyond: up to the last number, and then the sender begins anew.
    const bool last = bits == 64;
    const std::uint64_t end = last ? std::numeric_limits<std::uint64_t>::max() : std::uint64_t{1} << bits;
    const std::uint64_t begin = end - (last ? 199 : 100);
    double wrong = 0.0;
    for (std::uint64_t k = 0; k < 200; ++k) wrong += tracker.arrived(7, begin + k) == Arrival::kNewest ? 0.0 : 1.0;
    for (std::uint64_t k = 1; last && k < 200; ++k) wrong += tracker.arrived(8, k) == Arrival::kNewest ? 0.0 : 1.0;
    outcome.float64.push_back({static_cast<double>(bits), wrong + static_cast<double>(tracker.counters().lost)});
  }
  return outcome;
}

/// A sender that is killed and starts again with number 1, its old messages still on their way.
Outcome restart(const Bench& bench) {
  Outcome outcome;
  std::mt19937_64 random(bench.seed);
  for (int round = 0; round < 10; ++round) {
    SequenceTracker tracker;
    double wrong = 0.0;
    const std::uint64_t stragglers = 1 + random() % 40;
    for (std::uint64_t k = 1; k <= 1000; ++k) tracker.arrived(7, k);
    for (std::uint64_t k = 1; k <= 200; ++k) {
      wrong += tracker.arrived(8, k) == Arrival::kNewest ? 0.0 : 1.0;
      if (k <= stragglers) wrong += tracker.arrived(7, 1001 - k) == Arrival::kNewest ? 1.0 : 0.0;
    }
    wrong += std::abs(static_cast<double>(tracker.counters().restarted) - 1.0);
    outcome.float64.push_back({static_cast<double>(stragglers), wrong});
  }
  return outcome;
}

/// Pictures of ten seconds at 60 a second: how far the car is drawn from where it is at the time that is shown. `sent`:
/// of a message by when it was sent, whether it was sent at all.
Outcome drive(const Bench& bench, const Weather& weather, double seconds,
              const std::function<bool(double sent_s)>& sent,
              const std::function<double(double time_s, const PoseBuffer::Drawn& drawn, double off_m)>& value) {
  Outcome outcome;
  std::mt19937_64 random(bench.seed);
  const auto count = static_cast<std::uint64_t>(seconds / kMessage_s);
  const std::vector<Arriving> all = through(weather, count, random);
  PoseBuffer poses;
  DisplayClock clock;
  SequenceTracker tracker;
  std::optional<SimTime> shown;
  std::size_t next = 0;
  for (double now_s = 0.1; now_s < seconds; now_s += 1.0 / 60.0) {
    for (; next < all.size() && all[next].at_s <= now_s; ++next) {
      const double sent_s = kMessage_s * static_cast<double>(all[next].sequence - 1);
      if (!sent(sent_s) || tracker.arrived(7, all[next].sequence) != Arrival::kNewest) continue;
      poses.push(at_s(sent_s), on_circle(sent_s));
      clock.observe(at_s(sent_s), wall_s(all[next].at_s));
    }
    const auto time = clock.at(wall_s(now_s));
    if (!time || !poses.at(*time)) continue;
    const SimTime show = poses.time_to_show(*time, shown);
    PoseBuffer::Drawn drawn = *poses.at(show);
    drawn.stale = poses.at(*time)->stale;
    const double back_s = shown ? std::max(0.0, shown->seconds() - show.seconds()) : 0.0;
    shown = show;
    // A picture that goes back in time is wrong by as far as the car came in it.
    outcome.float64.push_back(
        {now_s, value(now_s, drawn, apart_m(drawn.pose, on_circle(show.seconds())) + 30.0 * back_s)});
  }
  return outcome;
}

Outcome storm(const Bench& bench) {
  return drive(
      bench, kStorm, 20.0, [](double) { return true; },
      [](double, const PoseBuffer::Drawn&, double off_m) { return off_m; });
}

/// Silence from 5 s on, for as long: the picture coasts 200 ms, then holds and says so, and is right again at once.
Outcome stall(const Bench& bench, double silent_s) {
  const double begin_s = 5.0, end_s = begin_s + silent_s;
  std::optional<VehicleState> held;
  return drive(
      bench, {.jitter_s = 0.002}, end_s + 3.0, [=](double sent_s) { return sent_s < begin_s || sent_s >= end_s; },
      [=](double time_s, const PoseBuffer::Drawn& drawn, double off_m) mutable {
        // 10 ms about the edges: a message on its way, and a frame's time.
        const bool quiet = time_s > begin_s + PoseBuffer::kCoast_s + 0.03 && time_s < end_s;
        const bool live = time_s < begin_s + PoseBuffer::kCoast_s - 0.03 || time_s > end_s + 0.25;
        if (live) return off_m + (drawn.stale ? 1.0 : 0.0);
        if (!quiet) return 0.0;
        if (!held) held = drawn.pose;
        return apart_m(*held, drawn.pose) + (drawn.stale ? 0.0 : 1.0);
      });
}

/// The wall clock is set, forth and back, by an hour: how far the time that is shown is off a tenth of a second later.
Outcome clock_steps(const Bench& bench) {
  Outcome outcome;
  std::mt19937_64 random(bench.seed);
  DisplayClock clock;
  double wall_off_s = 0.0, since_s = 0.0;
  std::uniform_real_distribution<double> late_s(2e-4, 1.2e-3);
  for (double now_s = 0.0; now_s < 40.0; now_s += kMessage_s) {
    if (now_s - since_s > 5.0) {
      since_s = now_s;
      wall_off_s += (random() % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, static_cast<double>(random() % 5)) * 0.36;
    }
    const double heard_s = now_s + late_s(random) + wall_off_s;
    clock.observe(at_s(now_s), wall_s(heard_s));
    if (now_s - since_s < 0.1) continue;
    outcome.float64.push_back({now_s, std::abs(clock.at(wall_s(now_s + wall_off_s))->seconds() - now_s)});
  }
  return outcome;
}

/// Another machine's clock, set in the midst: estimate against truth, as a share of what the estimate allows itself.
Outcome peer_steps(const Bench& bench) {
  Outcome outcome;
  std::mt19937_64 random(bench.seed);
  PeerClock clock;
  double ahead_ns = 2e8;
  const auto way_ns = [&] { return 1e6 * std::uniform_real_distribution<double>(1.0, 6.0)(random); };
  for (int i = 0; i < 300; ++i) {
    if (i % 60 == 59) ahead_ns += (random() % 2 == 0 ? 1.0 : -1.0) * 3.6e12;
    const double asked = 1e9 * i, heard_there = asked + way_ns(), answered = heard_there + 2e5,
                 heard = answered + way_ns();
    const auto wall = [](double ns) { return WallTime{1'700'000'000'000'000'000 + std::llround(ns)}; };
    clock.add({wall(asked), wall(heard_there + ahead_ns), wall(answered + ahead_ns), wall(heard)},
              PeerClock::Time(std::chrono::nanoseconds(std::llround(heard))));
    const auto estimate = clock.at(PeerClock::Time(std::chrono::nanoseconds(std::llround(heard))));
    outcome.float64.push_back({static_cast<double>(i), std::abs(static_cast<double>(estimate->ahead_ns) - ahead_ns) /
                                                           static_cast<double>(estimate->within_ns)});
  }
  return outcome;
}

/// A high beam that nobody takes back.
Outcome silent_stalk(const Bench&) {
  Outcome outcome;
  CockpitState controls;
  controls.light_switch = LightSwitch::kHigh;
  controls.flash = controls.fog_front = true;
  for (const double silent_s : {0.0, 0.05, 0.15, 0.19, 0.21, 0.25, 0.5, 1.0, 60.0, 86400.0}) {
    const CockpitState shown = after_silence(controls, std::chrono::nanoseconds(at_s(silent_s).ns));
    const bool low = shown.light_switch == LightSwitch::kLow && !shown.flash && shown.fail_safe;
    const bool high = shown.light_switch == LightSwitch::kHigh && shown.flash && !shown.fail_safe;
    outcome.float64.push_back({silent_s, (silent_s > 0.2 ? low : high) ? 0.0 : 1.0});
  }
  return outcome;
}

/// Times of the frames of a day: against the exact quotient, in whole nanoseconds.
Outcome day(const Bench&) {
  Outcome outcome;
  for (const std::int64_t rate_hz : {24, 60, 90, 144}) {
    std::int64_t worst_ns = 0;
    for (std::int64_t k = 0; k <= 86'400 * rate_hz; k += k < 1000 ? 1 : 97) {
      const SimTime time = frame_time(k, rate_hz), next = frame_time(k + 1, rate_hz);
      // floor(k·1e9 / rate) and no other: rate·t ≤ k·1e9 < rate·(t + 1).
      const std::int64_t exact = k * 1'000'000'000;
      if (rate_hz * time.ns > exact || rate_hz * (time.ns + 1) <= exact || next <= time)
        worst_ns = std::max<std::int64_t>(worst_ns, std::abs(time.ns - exact / rate_hz) + 1);
    }
    outcome.float64.push_back({static_cast<double>(rate_hz), static_cast<double>(worst_ns)});
  }
  return outcome;
}

/// Random bytes, and datagrams of ours with a few bytes changed: how many are taken that are none.
Outcome garbage(const Bench& bench) {
  Outcome outcome;
  std::mt19937_64 random(bench.seed);
  Datagram good;
  good.sender = Sender::kDynamics;
  good.start_id = good.sequence = 1;
  good.payload = on_circle(1.0);
  const std::string whole = encode(good);
  for (int kind = 0; kind < 3; ++kind) {
    // Beside them one that is whole, or refusing all would hold.
    Datagram whole_one;
    double taken = decode_into(std::as_bytes(std::span(whole)), whole_one) == Refusal::kNone ? 0.0 : 1.0;
    for (int k = 0; k < 20'000; ++k) {
      std::string bytes = whole;
      if (kind == 0) bytes.resize(random() % (whole.size() + 200));
      if (kind == 1) bytes.resize(random() % whole.size());  // cut short
      if (kind == 0)
        for (char& byte : bytes) byte = static_cast<char>(random());
      if (kind == 2) bytes[random() % bytes.size()] ^= static_cast<char>(1u << random() % 8);
      Datagram read;
      taken += decode_into(std::as_bytes(std::span(bytes)), read) == Refusal::kNone ? 1.0 : 0.0;
    }
    outcome.float64.push_back({static_cast<double>(kind), taken});
  }
  return outcome;
}

/// Every number of a pose in turn, in a datagram that is whole otherwise.
Outcome no_numbers_in_a_pose(const Bench&) {
  using S = VehicleState;
  constexpr double S::*kNumbers[] = {&S::x_m,
                                     &S::y_m,
                                     &S::z_m,
                                     &S::roll_rad,
                                     &S::pitch_rad,
                                     &S::yaw_rad,
                                     &S::vx_mps,
                                     &S::vy_mps,
                                     &S::vz_mps,
                                     &S::roll_rate_radps,
                                     &S::pitch_rate_radps,
                                     &S::yaw_rate_radps,
                                     &S::ax_mps2,
                                     &S::ay_mps2,
                                     &S::speed_mps,
                                     &S::steer_rad,
                                     &S::suspension_pitch_rad,
                                     &S::suspension_roll_rad,
                                     &S::suspension_heave_m,
                                     &S::lag_s,
                                     &S::lamp_tilt_rad};
  constexpr double kInf = std::numeric_limits<double>::infinity();
  Outcome outcome;
  const auto taken = [](const VehicleState& pose) {
    Datagram datagram, read;
    datagram.sender = Sender::kDynamics;
    datagram.start_id = datagram.sequence = 1;
    datagram.payload = pose;
    const std::string bytes = encode(datagram);
    return decode_into(std::as_bytes(std::span(bytes)), read) == Refusal::kNone;
  };
  for (std::size_t i = 0; i < std::size(kNumbers); ++i) {
    double wrong = taken(on_circle(1.0)) ? 0.0 : 1.0;  // or refusing all would hold
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), kInf, -kInf, 1e308, -1e308}) {
      VehicleState pose = on_circle(1.0);
      pose.*kNumbers[i] = bad;
      wrong += taken(pose) ? 1.0 : 0.0;
    }
    outcome.float64.push_back({static_cast<double>(i), wrong});
  }
  return outcome;
}

}  // namespace

std::vector<HardCase> bus_cases() {
  const auto bus = std::bind_front(float64_case, "Time and the bus");
  const char* const time = "time, s";
  // Off by what the car does between two poses, or past the newest: jerk v·ω² = 2.7 m/s³ over at most 0.1 s, by six.
  const char* const curve = "jerk of 2.7 m/s³ over 0.1 s between poses: 4.5e-4 m; twice that";
  const char* const coast = "jerk of 2.7 m/s³ over the coast of 0.2 s: 3.6e-3 m";
  return {
      bus("loss-duplicates-reordering", "counts of lost messages that are guesses, and a late one counted as lost",
          "5000 messages, 30 % lost, a fifth twice, each up to 50 ms late, ten times", "counts that are wrong", "round",
          0.0, "each message is one of received, late, duplicate, lost", counts),
      bus("newest-wins", "the picture jumps back to an older pose because it came later",
          "the same storm; after each arrival the pose that is kept", "poses that are not the newest", "round", 0.0,
          "none may be", newest_wins),
      bus("sequence-wrap", "after 65,536 or 2^32 messages every one looks old: the link is mute",
          "200 messages over the ends of 8, 16, 31, 32, 53 and 63 bits, and to the last number of 64, then a new start",
          "messages not taken", "bits", 0.0, "none may be", wrap),
      bus("sender-restart", "a process that starts again is taken for old, or its stragglers for new",
          "1000 messages, a restart with number 1, up to 40 stragglers between", "messages judged wrong", "stragglers",
          0.0, "none may be", restart),
      bus("storm-on-a-curve", "the car jerks to and fro where messages are lost or late",
          "30 m/s round 100 m, 250 poses a second through the same storm, 60 pictures a second",
          "m from the car's path", time, 9e-4, curve, storm),
      bus("stall-500ms", "the car flies on, or stands and nobody says so",
          "half a second without a pose: coasts 0.2 s, holds and says so, goes on",
          "m moved while held or off the path, 1 more where it does not say so", time, 4e-3, coast,
          [](const Bench& bench) { return stall(bench, 0.5); }),
      bus("stall-60s", "as above, and the clock has drifted off meanwhile", "the same for a minute",
          "m moved while held or off the path, 1 more where it does not say so", time, 4e-3, coast,
          [](const Bench& bench) { return stall(bench, 60.0); }),
      bus("wall-clock-set", "somebody sets the clock: the picture freezes, or runs away",
          "the wall clock set by 0.36 s to an hour, forth or back, every five seconds; a tenth of a second later",
          "s that the shown time is off", time, 2e-3, "messages come 0.2 to 1.2 ms late; the least of 25 counts",
          clock_steps),
      bus("other-machines-clock-set", "stamps of another machine are read as if its clock were still the old one",
          "another machine's clock set by an hour every minute, ways of 1 to 6 ms",
          "of what the estimate allows itself", "exchange", 1.0, "an estimate says how far it may be off (RFC 5905)",
          peer_steps),
      bus("stalk-falls-silent", "a high beam stays on because the one who would switch it off is dead",
          "high beam, flash and fog lamps, then nothing for up to a day", "moments with the wrong beam", "silence, s",
          0.0, "low beam after 200 ms, not before", silent_stalk),
      bus("day-of-frames", "times of frames are added up in floating point: a day later pictures and car are apart",
          "24 h at 24, 60, 90 and 144 frames a second", "ns off the exact quotient", "frames a second", 0.0,
          "whole nanoseconds, computed and not added", day),
      bus("garbage", "a broken datagram is read as a pose", "20,000 each of random bytes, cut ones, one bit flipped",
          "taken, or a whole one refused", "kind", 0.0,
          "CRC-32 finds every single flipped bit; of random bytes 2^-32 pass, and then protobuf", garbage),
      bus("no-numbers-in-a-pose", "one NaN from the car and the picture is black until it is begun anew",
          "NaN, infinity and 1e308 in each of the 21 numbers of a pose", "taken, or a right one refused", "number", 0.0,
          "none may be", no_numbers_in_a_pose)};
}

}  // namespace phare::hard
