#include "net/bus.h"

#include <gtest/gtest.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <thread>

#include "net/stats.h"
#include "tests/net/garbage.h"
#include "tests/net/sample.h"

namespace phare {
namespace {

/// A rig whose ports are free; every test process tries its own.
Rig test_rig(std::size_t channels = 1) {
  static std::uint16_t base = static_cast<std::uint16_t>(20000 + (getpid() % 1000) * 30);
  Rig rig;
  rig.file = "test.toml";
  rig.channels.resize(channels);
  for (int attempt = 0; attempt < 200; ++attempt) {
    base = static_cast<std::uint16_t>(base + 30 > 60000 ? 20000 : base + 30);
    bool free = true;
    for (std::uint16_t offset = 0; offset < 30 && free; ++offset) {
      free = UdpSocket::open("127.0.0.1", static_cast<std::uint16_t>(base + offset)).ok();
    }
    if (free) break;
  }
  rig.port_base = base;
  return rig;
}

Bus open_bus(const Rig& rig, Role role, std::uint32_t channel = 0) {
  Result<Bus> bus = Bus::open(rig, role, channel);
  if (!bus) throw std::runtime_error(bus.error().text());
  return std::move(*bus);
}

FrameReport report(std::int64_t frame_index, std::uint32_t channel, std::uint32_t channels) {
  FrameReport r;
  r.frame_index = frame_index;
  r.channel = channel;
  r.channels = channels;
  return r;
}

TEST(Udp, LoopbackCarriesDatagramsOfEverySize) {
  auto a = UdpSocket::open("127.0.0.1", 0);
  auto b = UdpSocket::open("127.0.0.1", 0);
  ASSERT_TRUE(a && b);
  EXPECT_FALSE(b->receive());
  EXPECT_FALSE(b->wait(std::chrono::milliseconds(1)));
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{1472}, kMaxDatagramBytes}) {
    const std::string sent(size, 'x');
    ASSERT_TRUE(a->send_to(b->port(), test::view(sent)));
    ASSERT_TRUE(b->wait(std::chrono::seconds(5)));
    const auto received = b->receive();
    ASSERT_TRUE(received);
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(received->data()), received->size()), sent);
  }
  EXPECT_FALSE(a->send_to(b->port(), test::view(std::string(kMaxDatagramBytes + 1, 'x'))));
}

TEST(Udp, KeepsTheOrderOverManyBatches) {
  auto a = UdpSocket::open("127.0.0.1", 0);
  auto b = UdpSocket::open("127.0.0.1", 0);
  ASSERT_TRUE(a && b);
  for (int i = 0; i < 100; ++i) a->send_to(b->port(), test::view(std::to_string(i)));
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(b->wait(std::chrono::seconds(5)));
    const auto received = b->receive();
    ASSERT_TRUE(received);
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(received->data()), received->size()), std::to_string(i));
  }
}

TEST(Udp, SaysWhatIsWrongWithAnAddress) {
  EXPECT_FALSE(UdpSocket::open("localhost!", 0));
  auto a = UdpSocket::open("127.0.0.1", 0);
  ASSERT_TRUE(a);
  const auto again = UdpSocket::open("127.0.0.1", a->port());
  ASSERT_FALSE(again);
  EXPECT_NE(again.error().reason.find("taken"), std::string::npos);
}

TEST(Udp, TheKernelFilterLetsEveryValidDatagramThrough) {
  auto a = UdpSocket::open("127.0.0.1", 0);
  auto b = UdpSocket::open("127.0.0.1", 0);
  ASSERT_TRUE(a && b);
  if (!b->filter_in_kernel()) GTEST_SKIP() << "this kernel has no socket filters";
  for (std::uint64_t seed = 1; seed < 20; ++seed) {
    for (const Datagram& datagram : test::samples(seed)) {
      const std::string sent = encode(datagram);
      a->send_to(b->port(), test::view(sent));
      ASSERT_TRUE(b->wait(std::chrono::seconds(5))) << kChannels[datagram.payload.index()].message;
      ASSERT_EQ(b->receive()->size(), sent.size());
    }
  }
  EXPECT_EQ(b->dropped_in_kernel(), 0u);
  a->send_to(b->port(), test::view("hello, this is not a datagram of ours"));
  a->send_to(b->port(), test::view(""));
  EXPECT_FALSE(b->receive());
  EXPECT_EQ(b->dropped_in_kernel(), 2u);
}

TEST(Bus, SendsToEveryReceiverOfTheTableAndToNobodyElse) {
  const Rig rig = test_rig(2);
  struct Endpoint {
    Role role;
    std::uint32_t channel;
    Bus bus;
  };
  std::vector<Endpoint> all;
  for (const Role role : {Role::kCockpit, Role::kDynamics, Role::kRecorder, Role::kControl, Role::kLaw})
    all.push_back({role, 0, open_bus(rig, role)});
  all.push_back({Role::kVisual, 0, open_bus(rig, Role::kVisual, 0)});
  all.push_back({Role::kVisual, 1, open_bus(rig, Role::kVisual, 1)});

  // A ControlReply goes to who asked, not to the receivers of a table: see AnAnswerGoesToWhoAsked.
  const std::array<Payload, 7> payloads = {CockpitState{}, VehicleState{}, report(3, 1, 2), RigControl{},
                                           ProbeRequest{}, ProbeReply{},   KeyInput{}};
  for (Endpoint& sender : all) {
    for (std::size_t i = 0; i < payloads.size(); ++i) {
      const bool may = kChannels[i].sender == sender_of(sender.role);
      if (!may || (sender.role == Role::kVisual && sender.channel == 0)) continue;
      sender.bus.send(SimTime{5}, payloads[i]);
    }
  }
  for (Endpoint& receiver : all) {
    receiver.bus.poll();
    for (std::size_t i = 0; i < payloads.size(); ++i) {
      const bool expected =
          kChannels[i].receivers.has(receiver.role) && !(kChannels[i].first_visual_only && receiver.channel != 0);
      EXPECT_EQ(receiver.bus.counters().received[i].received, expected ? 1u : 0u)
          << kChannels[i].message << " at role " << static_cast<int>(receiver.role) << " channel " << receiver.channel;
    }
    EXPECT_EQ(receiver.bus.counters().refused, 0u);
  }
  EXPECT_EQ(all[0].bus.newest<FrameReport>(0), nullptr);
  ASSERT_NE(all[0].bus.newest<FrameReport>(1), nullptr);
  EXPECT_EQ(all[0].bus.newest<FrameReport>(1)->value.frame_index, 3);
  EXPECT_EQ(all[0].bus.newest<FrameReport>(1)->sim_time.ns, 5);
  EXPECT_EQ(all[0].bus.newest<FrameReport>(2), nullptr);
}

TEST(Bus, ARepeatIsCountedAndAFrameReportCanBeTakenAgain) {
  const Rig rig = test_rig();
  Bus visual = open_bus(rig, Role::kVisual);
  Bus cockpit = open_bus(rig, Role::kCockpit);
  visual.send_again(kPayloadIndex<FrameReport>);  // nothing yet
  visual.send(SimTime{}, report(-1, 0, 1));
  EXPECT_EQ(cockpit.poll(), 1u);
  EXPECT_TRUE(cockpit.take<FrameReport>());
  EXPECT_FALSE(cockpit.take<FrameReport>());
  int repeats = 0;
  cockpit.on_repeat = [&](const Datagram&) { ++repeats; };
  visual.send_again(kPayloadIndex<FrameReport>);
  EXPECT_EQ(cockpit.poll(), 1u);
  EXPECT_EQ(repeats, 1);
  EXPECT_TRUE(cockpit.take<FrameReport>());
  cockpit.send(SimTime{}, CockpitState{});
  cockpit.send_again(kPayloadIndex<CockpitState>);
  EXPECT_EQ(visual.poll(), 1u);
  EXPECT_TRUE(visual.take<CockpitState>());
  EXPECT_FALSE(visual.take<CockpitState>());
  EXPECT_EQ(visual.counters().received[kPayloadIndex<CockpitState>], (InboxCounters{1, 0, 0, 1, 0}));
}

TEST(Bus, ARestartedSenderIsTakenAndCounted) {
  const Rig rig = test_rig();
  Bus dynamics = open_bus(rig, Role::kDynamics);
  for (int start = 0; start < 3; ++start) {
    Bus cockpit = open_bus(rig, Role::kCockpit);
    for (int i = 0; i < 4; ++i) cockpit.send(SimTime{}, CockpitState{});
    dynamics.poll();
  }
  EXPECT_EQ(dynamics.counters().received[kPayloadIndex<CockpitState>], (InboxCounters{12, 0, 0, 0, 2}));
}

// One datagram with a new start id, from anywhere, mutes nobody: neither the true cockpit nor for good whoever hung.
TEST(Bus, AStrangerDoesNotMuteTheCockpitThatSpeaks) {
  const Rig rig = test_rig();
  Bus visual = open_bus(rig, Role::kVisual), cockpit = open_bus(rig, Role::kCockpit);
  auto stranger = UdpSocket::open("127.0.0.1", 0);
  ASSERT_TRUE(stranger);
  const auto port = static_cast<std::uint16_t>(rig.port_base + port_offset(Role::kVisual));
  CockpitState high;
  high.light_switch = LightSwitch::kHigh;
  std::uint64_t stranger_sent = 0;
  const auto stray = [&] {
    Datagram datagram{Sender::kCockpit, 0, 99, ++stranger_sent, SimTime{}, wall_now(), high};
    stranger->send_to(port, test::view(encode(datagram)));
  };
  CockpitState low;
  low.light_switch = LightSwitch::kLow;
  const auto level = spdlog::get_level();
  spdlog::set_level(spdlog::level::off);
  for (int i = 0; i < 50; ++i) {
    cockpit.send(SimTime{}, low);
    stray();
    visual.poll();
    ASSERT_EQ(visual.newest<CockpitState>()->value.light_switch, LightSwitch::kLow) << i;
  }
  EXPECT_EQ(visual.counters().refused_because[static_cast<std::size_t>(Refusal::kSecond)], 50u);
  EXPECT_EQ(visual.counters().received[kPayloadIndex<CockpitState>], (InboxCounters{50, 0, 0, 0, 0}));
  EXPECT_EQ(stats_json("visual", visual)["bus"]["refused_because"]["second_sender"], 50);

  // The cockpit is silent for its time: who speaks then is taken, and gives way again.
  std::this_thread::sleep_for(taken_over_after(channel_of<CockpitState>()));
  stray();
  visual.poll();
  EXPECT_EQ(visual.newest<CockpitState>()->value.light_switch, LightSwitch::kHigh);
  std::this_thread::sleep_for(taken_over_after(channel_of<CockpitState>()));
  cockpit.send(SimTime{}, low);
  visual.poll();
  EXPECT_EQ(visual.newest<CockpitState>()->value.light_switch, LightSwitch::kLow);
  spdlog::set_level(level);
}

// A receiver that was busy for a while judges silence by when datagrams came, not by when it got round to them.
TEST(Bus, ADatagramArrivesWhenItComesAndNotWhenItIsRead) {
  const Rig rig = test_rig();
  Bus visual = open_bus(rig, Role::kVisual), cockpit = open_bus(rig, Role::kCockpit);
  visual.poll();
  cockpit.send(SimTime{}, CockpitState{});
  const auto sent = std::chrono::steady_clock::now();
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  visual.poll();
  ASSERT_NE(visual.newest<CockpitState>(), nullptr);
  EXPECT_LE(visual.newest<CockpitState>()->heard, sent);
  EXPECT_GE(std::chrono::steady_clock::now() - visual.newest<CockpitState>()->heard, std::chrono::milliseconds(60));
}

TEST(Bus, TheRecorderHearsOfACauseBeforeAnyoneAnswersIt) {
  const Rig rig = test_rig();
  Bus visual = open_bus(rig, Role::kVisual), recorder = open_bus(rig, Role::kRecorder);
  Bus dynamics = open_bus(rig, Role::kDynamics), cockpit = open_bus(rig, Role::kCockpit);
  for (int i = 0; i < 50; ++i) {
    visual.send(SimTime{i}, report(i, 0, 1));
    recorder.poll();
    const std::int64_t recorded_ns = recorder.newest<FrameReport>()->received.ns;
    for (Bus* bus : {&dynamics, &cockpit}) {
      bus->poll();
      ASSERT_EQ(bus->newest<FrameReport>()->value.frame_index, i);
      EXPECT_LE(recorded_ns, bus->newest<FrameReport>()->received.ns);
    }
  }
}

TEST(Bus, NeverSendsWhatNobodyWouldTake) {
  const Rig rig = test_rig();
  Bus cockpit = open_bus(rig, Role::kCockpit);
  Bus dynamics = open_bus(rig, Role::kDynamics);
  VehicleState broken;
  broken.x_m = std::numeric_limits<double>::quiet_NaN();
  dynamics.send(SimTime{}, broken);
  dynamics.send(SimTime{}, CockpitState{});  // not ours to send
  EXPECT_EQ(dynamics.counters().not_sent, 2u);
  dynamics.send(SimTime{}, VehicleState{});
  EXPECT_EQ(cockpit.poll(), 1u);
  EXPECT_EQ(cockpit.counters().received[kPayloadIndex<VehicleState>].lost, 0u);
}

TEST(Bus, AValidDatagramForAnotherIsRefused) {
  const Rig rig = test_rig();
  Bus cockpit = open_bus(rig, Role::kCockpit);
  auto stranger = UdpSocket::open("127.0.0.1", 0);
  ASSERT_TRUE(stranger);
  std::mt19937_64 random(1);
  stranger->send_to(rig.port_base, test::view(encode(test::sample(kPayloadIndex<ProbeRequest>, random))));
  Datagram of_absent_channel = test::sample(kPayloadIndex<FrameReport>, random);
  of_absent_channel.sender_channel = 5;
  std::get<FrameReport>(of_absent_channel.payload).channel = 5;
  stranger->send_to(rig.port_base, test::view(encode(of_absent_channel)));
  EXPECT_EQ(cockpit.poll(), 0u);
  EXPECT_EQ(cockpit.counters().refused_because[static_cast<std::size_t>(Refusal::kNotForUs)], 2u);
}

TEST(Bus, RefusesAndCountsEveryPieceOfGarbageWithFewWords) {
  const Rig rig = test_rig();
  Bus dynamics = open_bus(rig, Role::kDynamics);
  Bus cockpit = open_bus(rig, Role::kCockpit);
  auto stranger = UdpSocket::open("127.0.0.1", 0);
  ASSERT_TRUE(stranger);
  std::vector<std::string> templates;
  for (const Datagram& datagram : test::samples(8)) templates.push_back(encode(datagram));
  test::Garbage garbage(templates, 8);
  constexpr std::uint64_t kCount = 100'000;
  constexpr std::uint64_t kGood = 100;
  const auto port = static_cast<std::uint16_t>(rig.port_base + port_offset(Role::kDynamics));
  const auto level = spdlog::get_level();
  spdlog::set_level(spdlog::level::off);
  for (std::uint64_t i = 0; i < kCount; ++i) {
    ASSERT_TRUE(stranger->send_to(port, garbage.next()));
    if (i % (kCount / kGood) == 0) cockpit.send(SimTime{}, CockpitState{});
    if (i % 64 == 63) dynamics.poll();
  }
  while (dynamics.wait(std::chrono::milliseconds(0))) dynamics.poll();
  dynamics.poll();
  spdlog::set_level(level);
  EXPECT_EQ(dynamics.counters().refused, kCount);
  EXPECT_EQ(dynamics.counters().received[kPayloadIndex<CockpitState>], (InboxCounters{kGood, 0, 0, 0, 0}));
}

TEST(Bus, APollEndsThoughTheFloodDoesNot) {
  const Rig rig = test_rig();
  Bus dynamics = open_bus(rig, Role::kDynamics);
  auto stranger = UdpSocket::open("127.0.0.1", 0);
  ASSERT_TRUE(stranger);
  std::mt19937_64 random(3);
  std::string flipped = encode(test::sample(kPayloadIndex<CockpitState>, random));
  flipped[10] = static_cast<char>(flipped[10] ^ 4);  // passes the kernel's filter
  const auto port = static_cast<std::uint16_t>(rig.port_base + port_offset(Role::kDynamics));
  for (int i = 0; i < 20'000; ++i) stranger->send_to(port, test::view(flipped));
  const auto level = spdlog::get_level();
  spdlog::set_level(spdlog::level::off);
  dynamics.poll();
  EXPECT_LE(dynamics.counters().refused - dynamics.counters().refused_in_kernel, 4096u);
  while (dynamics.wait(std::chrono::milliseconds(0))) dynamics.poll();
  dynamics.poll();
  spdlog::set_level(level);
  EXPECT_EQ(dynamics.counters().refused, 20'000u);
}

TEST(Bus, OpensOnlyWhatTheRigHas) {
  Rig rig = test_rig(2);
  EXPECT_FALSE(Bus::open(rig, Role::kVisual, 2));
  EXPECT_FALSE(Bus::open(rig, Role::kCockpit, 1));
  rig.bind_address = "0.0.0.0";
  EXPECT_FALSE(Bus::open(rig, Role::kCockpit));
  rig.bind_address = "127.0.0.1";
  rig.port_base = 65530;
  EXPECT_FALSE(Bus::open(rig, Role::kCockpit));
  rig = test_rig();
  const Bus first = open_bus(rig, Role::kCockpit);
  const auto second = Bus::open(rig, Role::kCockpit);
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().text().find("taken"), std::string::npos);
}

TEST(Stats, HaveTheAgreedShapeAndAreWrittenWhole) {
  const Rig rig = test_rig();
  Bus cockpit = open_bus(rig, Role::kCockpit);
  const nlohmann::json json = stats_json("cockpit", cockpit);
  EXPECT_EQ(json["process"], "cockpit");
  EXPECT_EQ(json["start_id"].get<std::string>().size(), 16u);
  for (const char* count : {"received", "lost", "late", "duplicate", "restarted"}) {
    EXPECT_EQ(json["bus"]["vehicle_state"][count], 0) << count;
  }
  EXPECT_FALSE(json["bus"].contains("cockpit_state"));
  EXPECT_EQ(json["bus"]["refused"], 0);
  EXPECT_GT(json["memory"]["rss_kib"].get<int>(), 100);
  EXPECT_GE(json["memory"]["peak_kib"].get<int>(), json["memory"]["rss_kib"].get<int>());

  const auto path = std::filesystem::temp_directory_path() / ("phare_stats_" + std::to_string(getpid()) + ".json");
  ASSERT_TRUE(write_json(path, json));
  std::ifstream file(path);
  EXPECT_EQ(nlohmann::json::parse(file), json);
  std::filesystem::remove(path);
  EXPECT_FALSE(write_json("/nowhere/at/all.json", json));
}

}  // namespace
}  // namespace phare
