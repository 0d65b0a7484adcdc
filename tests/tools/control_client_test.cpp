// process: the sender of commands against a rig that is played here: lost answers, refusals, silence, changes of
// design.
#include "tools/control_client.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <functional>

namespace phare {
namespace {

using namespace std::chrono_literals;
using Outcome = ControlClient::Outcome;

Rig rig_on_free_ports() {
  static std::uint16_t base = static_cast<std::uint16_t>(22000 + (getpid() % 1000) * 30);
  Rig rig;
  rig.channels.resize(1);
  for (int attempt = 0; attempt < 200; ++attempt) {
    base = static_cast<std::uint16_t>(base + 30 > 60000 ? 22000 : base + 30);
    bool free = true;
    for (std::uint16_t offset = 0; offset < 30 && free; ++offset)
      free = UdpSocket::open("127.0.0.1", static_cast<std::uint16_t>(base + offset)).ok();
    if (free) break;
  }
  rig.port_base = base;
  return rig;
}

/// Cockpit, dynamics and a picture for each channel, that answer when they are asked to look.
class PlayedRig {
 public:
  explicit PlayedRig(const Rig& rig) {
    open(rig, Role::kCockpit), open(rig, Role::kDynamics);
    for (std::uint32_t channel = 0; channel < rig.channels.size(); ++channel) open(rig, Role::kVisual, channel);
  }
  void look() {
    for (auto& member : members_)
      if (member->listens) member->bus.poll();
  }
  void silence(Role role) {
    for (auto& member : members_)
      if (member->bus.role() == role) member->listens = false;
  }

  std::function<ControlReply(Role, const RigControl&)> act;
  std::function<ControlReply(std::uint32_t channel)> picture;
  std::function<bool()> lose;
  std::vector<RigControl> done;  ///< by visual
  std::size_t heard = 0;

 private:
  struct Member {
    Bus bus;
    ControlDesk desk;
    bool listens;
  };
  void open(const Rig& rig, Role role, std::uint32_t channel = 0) {
    members_.push_back(std::make_unique<Member>(Member{std::move(*Bus::open(rig, role, channel)), {}, true}));
    Member& member = *members_.back();
    member.bus.on_datagram = [this, channel, &member](const Datagram& datagram, std::span<const std::byte>) {
      ++heard;
      if (lose && lose()) return;
      member.desk.serve(member.bus, datagram, [&](const RigControl& control) {
        if (member.bus.role() == Role::kVisual) done.push_back(control);
        if (picture) return picture(channel);
        return act ? act(member.bus.role(), control) : accepted("yes");
      });
    };
  }

  std::vector<std::unique_ptr<Member>> members_;
};

ControlClient::Answer answer_of(ControlClient& client, PlayedRig* rig) {
  while (true) {
    client.step();
    if (rig != nullptr) rig->look();
    if (auto answer = client.next()) return *answer;
    usleep(200);
  }
}

RigControl dim(std::uint32_t source) {
  return RigControl{RigControl::Dim{"left", source, 0.0}};
}

TEST(ControlClient, TellsWhatHoldsNowOrWhyNot) {
  const Rig rig = rig_on_free_ports();
  PlayedRig played(rig);
  played.act = [](Role, const RigControl& control) {
    const auto* design = std::get_if<RigControl::Design>(&control.command);
    return design != nullptr ? refused("no design 7") : accepted("source 3 at 0 %");
  };
  ControlClient client(std::move(*Bus::open_to_send(rig, Role::kControl)), rig, 60s);
  client.put(dim(3));
  ControlClient::Answer answer = answer_of(client, &played);
  EXPECT_EQ(answer.outcome, Outcome::kDone);
  EXPECT_EQ(answer.text, "source 3 at 0 %");
  client.put(RigControl{RigControl::Design{7}});
  answer = answer_of(client, &played);
  EXPECT_EQ(answer.outcome, Outcome::kRefused);
  EXPECT_EQ(answer.text, "no design 7");
}

// Each picture has a desk of its own: what one refuses another has done, and the line says which.
TEST(ControlClient, SaysWhoHasDoneWhatAnotherRefuses) {
  Rig rig = rig_on_free_ports();
  rig.channels.resize(3);
  PlayedRig played(rig);
  played.picture = [](std::uint32_t channel) {
    return channel == 1 ? refused("halves taken") : accepted("compare split");
  };
  ControlClient client(std::move(*Bus::open_to_send(rig, Role::kControl)), rig, 60s);
  client.put(RigControl{RigControl::Set{"compare", "split"}});
  const ControlClient::Answer answer = answer_of(client, &played);
  EXPECT_EQ(answer.outcome, Outcome::kRefused);
  EXPECT_EQ(answer.text, "halves taken; done by visual-0, visual-2 all the same");
}

TEST(ControlClient, SaysThatNoRigRunsOrWhoIsSilent) {
  const Rig rig = rig_on_free_ports();
  {
    ControlClient client(std::move(*Bus::open_to_send(rig, Role::kControl)), rig, 50ms);
    client.put(dim(1));
    const ControlClient::Answer answer = answer_of(client, nullptr);
    EXPECT_EQ(answer.outcome, Outcome::kSilent);
    EXPECT_EQ(answer.text, "no rig answers on 127.0.0.1:" + std::to_string(rig.port_base) + "; is one running?");
  }
  PlayedRig played(rig);
  played.silence(Role::kVisual);
  ControlClient client(std::move(*Bus::open_to_send(rig, Role::kControl)), rig, 300ms);
  client.put(dim(1));
  const ControlClient::Answer answer = answer_of(client, &played);
  EXPECT_EQ(answer.outcome, Outcome::kSilent);
  EXPECT_NE(answer.text.find("visual-0"), std::string::npos) << answer.text;
  EXPECT_NE(answer.text.find("(cockpit, dynamics do); what was sent may still take effect"), std::string::npos)
      << answer.text;
}

TEST(ControlClient, SendsAgainUntilAllIsDoneOnceAndInOrder) {
  const Rig rig = rig_on_free_ports();
  PlayedRig played(rig);
  unsigned count = 0;
  played.lose = [&] { return ++count % 20 == 0; };
  ControlClient client(std::move(*Bus::open_to_send(rig, Role::kControl)), rig, 60s);
  constexpr std::uint32_t kCount = 3 * ControlDesk::kWindow;  // more than may be on their way
  for (std::uint32_t i = 1; i <= kCount; ++i) client.put(dim(i));
  for (std::uint32_t i = 1; i <= kCount; ++i) EXPECT_EQ(answer_of(client, &played).outcome, Outcome::kDone);
  ASSERT_EQ(played.done.size(), kCount);
  for (std::uint32_t i = 0; i < kCount; ++i) EXPECT_EQ(std::get<RigControl::Dim>(played.done[i].command).source, i + 1);
}

TEST(ControlClient, AfterAChangeOfDesignTheNextWaitsUntilItShines) {
  const Rig rig = rig_on_free_ports();
  PlayedRig played(rig);
  int asked = 0;
  std::vector<std::string> order;
  played.act = [&](Role role, const RigControl& control) {
    if (role != Role::kVisual) return accepted("");
    if (std::holds_alternative<RigControl::Design>(control.command)) {
      if (++asked < 3) return pending("still design 0");
      order.emplace_back("shines");
      return accepted("design 1");
    }
    order.emplace_back("dimmed");
    return accepted("dimmed");
  };
  ControlClient client(std::move(*Bus::open_to_send(rig, Role::kControl)), rig, 60s);
  client.put(RigControl{RigControl::Design{1}});
  client.put(dim(1));
  EXPECT_EQ(answer_of(client, &played).text, "design 1");
  EXPECT_EQ(answer_of(client, &played).text, "dimmed");
  EXPECT_EQ(order, (std::vector<std::string>{"shines", "dimmed"}));
}

TEST(ControlClient, ADesignThatNeverShinesIsToldAsSuch) {
  const Rig rig = rig_on_free_ports();
  PlayedRig played(rig);
  played.act = [](Role role, const RigControl&) {
    return role == Role::kVisual ? pending("still design 0") : accepted("");
  };
  ControlClient client(std::move(*Bus::open_to_send(rig, Role::kControl)), rig, 1s);
  client.put(RigControl{RigControl::Design{1}});
  const ControlClient::Answer answer = answer_of(client, &played);
  EXPECT_EQ(answer.outcome, Outcome::kDone);
  EXPECT_EQ(answer.text, "accepted; visual-0 shows still design 0");
}

}  // namespace
}  // namespace phare
