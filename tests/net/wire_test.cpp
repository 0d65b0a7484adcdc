#include "net/wire.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <functional>
#include <limits>

#include "net/channels.h"
#include "phare.pb.h"
#include "tests/net/garbage.h"
#include "tests/net/sample.h"

namespace phare {
namespace {

Refusal refusal_of(const std::string& bytes) {
  Datagram datagram;
  return decode_into(test::view(bytes), datagram);
}

/// Adds the check field, as a foreign encoder would.
std::string sealed(std::string bytes) {
  const auto crc = static_cast<std::uint32_t>(
      crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
  bytes += "\x85\x01";
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(crc >> shift);
  return bytes;
}

/// A valid datagram after a change at protobuf's level.
Refusal refusal_after(std::size_t payload_index, const std::function<void(wire::Datagram&)>& change) {
  std::mt19937_64 random(5);
  const std::string bytes = encode(test::sample(payload_index, random));
  wire::Datagram message;
  if (!message.ParseFromString(bytes)) return Refusal::kMalformed;
  message.clear_check();
  change(message);
  return refusal_of(sealed(message.SerializeAsString()));
}

TEST(Wire, EveryMessageComesBackAsItWas) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    for (const Datagram& sent : test::samples(seed)) {
      const std::string bytes = encode(sent);
      const Result<Datagram> received = decode(test::view(bytes));
      ASSERT_TRUE(received) << kChannels[sent.payload.index()].message << ": " << received.error().text();
      ASSERT_TRUE(test::equal(sent, *received)) << kChannels[sent.payload.index()].message;
    }
  }
}

TEST(Wire, EncodingIsDeterministicWhateverWasEncodedBefore) {
  std::mt19937_64 random(9);
  Datagram reused;
  for (int i = 0; i < 2000; ++i) {
    const Datagram datagram = test::sample(random() % kChannels.size(), random);
    const std::string bytes = encode(datagram);
    ASSERT_EQ(bytes, encode(datagram));
    ASSERT_EQ(decode_into(test::view(bytes), reused), Refusal::kNone);
    ASSERT_EQ(bytes, encode(reused));
  }
}

TEST(Wire, TheDefaultsAndZerosComeBackBitForBit) {
  Datagram d{Sender::kDynamics, 0, 1, 1, SimTime{0}, WallTime{0}, VehicleState{}};
  std::get<VehicleState>(d.payload).x_m = -0.0;
  const Result<Datagram> back = decode(test::view(encode(d)));
  ASSERT_TRUE(back) << back.error().text();
  EXPECT_TRUE(std::signbit(std::get<VehicleState>(back->payload).x_m));
  std::get<VehicleState>(d.payload).x_m = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(std::get<VehicleState>(decode(test::view(encode(d)))->payload).x_m,
            std::numeric_limits<double>::denorm_min());
}

TEST(Wire, WiresharkAndPythonReadTheCheckAsAField) {
  const std::string bytes = encode(test::samples(1).front());
  wire::Datagram message;
  ASSERT_TRUE(message.ParseFromString(bytes));
  EXPECT_TRUE(message.GetReflection()->GetUnknownFields(message).empty());
  EXPECT_EQ(message.check(),
            crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size() - 6)));
  EXPECT_EQ(message.SerializeAsString(), bytes);
}

TEST(WireRefuses, EveryCut) {
  for (const Datagram& datagram : test::samples(2)) {
    const std::string bytes = encode(datagram);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      ASSERT_NE(refusal_of(bytes.substr(0, size)), Refusal::kNone) << size << " of " << bytes.size();
    }
  }
}

TEST(WireRefuses, EveryFlippedBit) {
  for (const Datagram& datagram : test::samples(3)) {
    std::string bytes = encode(datagram);
    for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
      const auto mask = static_cast<char>(1 << (bit % 8));
      bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ mask);
      ASSERT_NE(refusal_of(bytes), Refusal::kNone) << "bit " << bit;
      bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ mask);
    }
  }
}

TEST(WireRefuses, HundredThousandPiecesOfGarbage) {
  std::vector<std::string> templates;
  for (const Datagram& datagram : test::samples(4)) templates.push_back(encode(datagram));
  test::Garbage garbage(templates, 4);
  Datagram datagram;
  for (int i = 0; i < 100'000; ++i) ASSERT_NE(decode_into(garbage.next(), datagram), Refusal::kNone) << i;
}

TEST(WireRefuses, OrTakesWhatIsValidWhenGarbageCarriesAFittingCheck) {
  // Behind the checksum the parser must stand on its own.
  std::vector<std::string> templates;
  for (const Datagram& datagram : test::samples(6)) {
    const std::string bytes = encode(datagram);
    templates.push_back(bytes.substr(0, bytes.size() - 6));
  }
  test::Garbage garbage(templates, 6);
  Datagram datagram;
  int taken = 0;
  for (int i = 0; i < 100'000; ++i) {
    const auto bytes = garbage.next();
    const std::string signed_bytes = sealed(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    if (decode_into(test::view(signed_bytes), datagram) != Refusal::kNone) continue;
    ++taken;
    ASSERT_EQ(check(datagram), Refusal::kNone);
    ASSERT_EQ(encode(datagram), signed_bytes);
  }
  EXPECT_GT(taken, 0);
}

TEST(WireRefuses, TrailingBytesAndSecondDatagrams) {
  const std::string bytes = encode(test::samples(1)[1]);
  EXPECT_EQ(refusal_of(bytes + '\0'), Refusal::kChecksum);
  EXPECT_EQ(refusal_of(bytes + bytes), Refusal::kChecksum);
  const std::string body = bytes.substr(0, bytes.size() - 6);
  EXPECT_EQ(refusal_of(sealed(body)), Refusal::kNone);
  EXPECT_EQ(refusal_of(sealed(bytes)), Refusal::kMalformed);                              // a check before the check
  EXPECT_EQ(refusal_of(sealed(body + body)), Refusal::kMalformed);                        // every field twice
  EXPECT_EQ(refusal_of(sealed(body + "\xf8\x01\x05")), Refusal::kMalformed);              // field 31
  EXPECT_EQ(refusal_of(sealed(body + std::string("\x18\x00", 2))), Refusal::kMalformed);  // a default written out
}

TEST(WireRefuses, WrongSizes) {
  EXPECT_EQ(refusal_of(""), Refusal::kSize);
  EXPECT_EQ(refusal_of(std::string(65508, '\x08')), Refusal::kSize);
}

TEST(WireRefuses, OtherVersionsAndUnknownSenders) {
  constexpr std::size_t kVehicle = kPayloadIndex<VehicleState>;
  EXPECT_EQ(refusal_after(kVehicle, [](auto&) {}), Refusal::kNone);
  EXPECT_EQ(refusal_after(kVehicle, [](auto& m) { m.set_protocol_version(2); }), Refusal::kHeader);
  EXPECT_EQ(refusal_after(kVehicle, [](auto& m) { m.clear_protocol_version(); }), Refusal::kHeader);
  EXPECT_EQ(refusal_after(kVehicle, [](auto& m) { m.clear_sender(); }), Refusal::kHeader);
  EXPECT_EQ(refusal_after(kVehicle, [](auto& m) { m.set_sender(static_cast<wire::Sender>(6)); }), Refusal::kHeader);
}

TEST(WireRefuses, BrokenEnvelopes) {
  constexpr std::size_t kVehicle = kPayloadIndex<VehicleState>;
  EXPECT_EQ(refusal_after(kVehicle, [](auto& m) { m.clear_start_id(); }), Refusal::kEnvelope);
  EXPECT_EQ(refusal_after(kVehicle, [](auto& m) { m.clear_sequence(); }), Refusal::kEnvelope);
  EXPECT_EQ(refusal_after(kVehicle, [](auto& m) { m.set_sequence(~std::uint64_t{0}); }), Refusal::kEnvelope);
  EXPECT_EQ(refusal_after(kVehicle, [](auto& m) { m.set_sim_time_ns(-1); }), Refusal::kEnvelope);
  EXPECT_EQ(refusal_after(kVehicle, [](auto& m) { m.set_sim_time_ns(std::numeric_limits<std::int64_t>::max()); }),
            Refusal::kEnvelope);
  EXPECT_EQ(refusal_after(kVehicle, [](auto& m) { m.set_sender_channel(1); }), Refusal::kEnvelope);
  EXPECT_EQ(refusal_after(kPayloadIndex<FrameReport>, [](auto& m) { m.set_sender_channel(99); }), Refusal::kEnvelope);
  EXPECT_NE(refusal_after(kVehicle, [](auto& m) { m.clear_payload(); }), Refusal::kNone);
}

TEST(WireRefuses, SendersThatMayNotSendThePayload) {
  for (std::size_t index = 0; index < kChannels.size(); ++index) {
    for (int sender = 1; sender <= 4; ++sender) {
      const Refusal refusal = refusal_after(index, [&](auto& m) {
        m.set_sender(static_cast<wire::Sender>(sender));
        m.set_sender_channel(0);
        if (m.has_frame_report()) m.mutable_frame_report()->set_channel(0);
      });
      const bool allowed = kChannels[index].may_send(static_cast<Sender>(sender));
      EXPECT_EQ(refusal, allowed ? Refusal::kNone : Refusal::kSender) << kChannels[index].message << " from " << sender;
    }
  }
}

TEST(WireRefuses, NumbersThatAreNotFinite) {
  // Every double of every message, found by protobuf's reflection.
  using google::protobuf::FieldDescriptor;
  const std::function<int(std::size_t, const std::function<google::protobuf::Message*(wire::Datagram&)>&)> try_all =
      [](std::size_t index, const auto& message_of) {
        int tried = 0;
        wire::Datagram empty;
        const auto* descriptor = message_of(empty)->GetDescriptor();
        for (int i = 0; i < descriptor->field_count(); ++i) {
          const FieldDescriptor* field = descriptor->field(i);
          if (field->cpp_type() != FieldDescriptor::CPPTYPE_DOUBLE) continue;
          for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                                   -std::numeric_limits<double>::infinity()}) {
            ++tried;
            const Refusal refusal = refusal_after(index, [&](wire::Datagram& m) {
              google::protobuf::Message* message = message_of(m);
              if (field->is_repeated()) {
                message->GetReflection()->SetRepeatedDouble(message, field, 0, bad);
              } else {
                message->GetReflection()->SetDouble(message, field, bad);
              }
            });
            EXPECT_EQ(refusal, Refusal::kNotFinite) << field->full_name() << " = " << bad;
          }
        }
        return tried;
      };
  EXPECT_EQ(try_all(0, [](wire::Datagram& m) { return m.mutable_cockpit_state(); }), 6 * 3);
  EXPECT_EQ(try_all(1, [](wire::Datagram& m) { return m.mutable_vehicle_state(); }), 21 * 3);
  EXPECT_EQ(try_all(2, [](wire::Datagram& m) { return m.mutable_frame_report(); }), 2 * 3);
  EXPECT_EQ(try_all(2, [](wire::Datagram& m) { return m.mutable_frame_report()->mutable_drawn(); }), 21 * 3);
  EXPECT_EQ(try_all(3, [](wire::Datagram& m) { return m.mutable_rig_control(); }), 2 * 3);
  EXPECT_EQ(try_all(4, [](wire::Datagram& m) { return m.mutable_probe_request(); }), 6 * 3);
  EXPECT_EQ(try_all(5, [](wire::Datagram& m) { return m.mutable_probe_reply(); }), 1 * 3);
}

TEST(WireRefuses, ValuesOutOfRange) {
  using D = wire::Datagram;
  constexpr std::size_t kCockpit = kPayloadIndex<CockpitState>;
  constexpr std::size_t kVehicle = kPayloadIndex<VehicleState>;
  constexpr std::size_t kReport = kPayloadIndex<FrameReport>;
  constexpr std::size_t kControl = kPayloadIndex<RigControl>;
  constexpr std::size_t kRequest = kPayloadIndex<ProbeRequest>;
  constexpr std::size_t kReply = kPayloadIndex<ProbeReply>;
  constexpr std::size_t kAnswer = kPayloadIndex<ControlReply>;
  constexpr std::size_t kClock = kPayloadIndex<ClockProbe>;
  constexpr std::size_t kLaw = kPayloadIndex<LawAnswer>;
  constexpr std::size_t kLamps = kPayloadIndex<LampState>;
  constexpr std::size_t kStart = kPayloadIndex<FrameStart>;
  const std::vector<std::pair<std::size_t, std::function<void(D&)>>> wrong = {
      {kCockpit, [](D& m) { m.mutable_cockpit_state()->set_accelerator_01(1.0000001); }},
      {kCockpit, [](D& m) { m.mutable_cockpit_state()->set_brake_01(-1e-9); }},
      {kCockpit, [](D& m) { m.mutable_cockpit_state()->set_steering_wheel_rad(20.1); }},
      {kCockpit, [](D& m) { m.mutable_cockpit_state()->set_light_switch(static_cast<wire::LightSwitch>(4)); }},
      {kCockpit, [](D& m) { m.mutable_cockpit_state()->set_light_switch(static_cast<wire::LightSwitch>(-1)); }},
      {kCockpit, [](D& m) { m.mutable_cockpit_state()->set_gear(static_cast<wire::Gear>(7)); }},
      {kCockpit, [](D& m) { m.mutable_cockpit_state()->set_design_index(4'000'000'000u); }},
      {kCockpit, [](D& m) { m.mutable_cockpit_state()->set_frame_index(-2); }},
      {kCockpit, [](D& m) { m.mutable_cockpit_state()->set_source(std::string(1000, 'x')); }},
      {kVehicle, [](D& m) { m.mutable_vehicle_state()->set_x_m(1.01e8); }},
      {kVehicle, [](D& m) { m.mutable_vehicle_state()->set_z_m(-1e300); }},
      {kVehicle, [](D& m) { m.mutable_vehicle_state()->set_speed_mps(1e6); }},
      {kVehicle, [](D& m) { m.mutable_vehicle_state()->set_steer_rad(2.0); }},
      {kVehicle, [](D& m) { m.mutable_vehicle_state()->set_lag_s(-1.0); }},
      {kVehicle, [](D& m) { m.mutable_vehicle_state()->set_lamp_tilt_rad(1.7); }},
      {kReport, [](D& m) { m.mutable_frame_report()->mutable_drawn()->set_y_m(2e8); }},
      {kReport, [](D& m) { m.mutable_frame_report()->set_channels(0); }},
      {kReport, [](D& m) { m.mutable_frame_report()->set_channels(17); }},
      {kReport, [](D& m) { m.mutable_frame_report()->set_frame_ms(-1.0); }},
      {kControl, [](D& m) { m.mutable_rig_control()->set_seek_s(-1.0); }},
      {kControl, [](D& m) { m.mutable_rig_control()->set_aim_pitch_rad(3.0); }},
      {kControl, [](D& m) { m.mutable_rig_control()->mutable_dim()->set_dimming_01(0.5); }},  // of no lamp
      {kControl,
       [](D& m) {
         m.mutable_rig_control()->mutable_dim()->set_lamp("left");
         m.mutable_rig_control()->mutable_dim()->set_dimming_01(1.5);
       }},
      {kControl,
       [](D& m) {
         m.mutable_rig_control()->mutable_dim()->set_lamp("left");
         m.mutable_rig_control()->mutable_dim()->set_source(10001);
       }},
      {kControl,
       [](D& m) {
         m.mutable_rig_control()->mutable_swivel()->set_lamp("left");
         m.mutable_rig_control()->mutable_swivel()->set_yaw_rad(1.7);
       }},
      {kControl,
       [](D& m) {
         m.mutable_rig_control()->mutable_place()->set_lamp("left");
         m.mutable_rig_control()->mutable_place()->set_x_m(51.0);
       }},
      {kControl, [](D& m) { m.mutable_rig_control()->mutable_mount()->set_value(101.0); }},
      {kControl, [](D& m) { m.mutable_rig_control()->mutable_mount()->set_lamp(std::string(65, 'x')); }},
      {kControl,
       [](D& m) {
         m.mutable_rig_control()->mutable_mount()->set_quantity(wire::MOUNT_YAW);
         m.mutable_rig_control()->mutable_mount()->set_value(1.7);
       }},
      {kControl,
       [](D& m) { m.mutable_rig_control()->mutable_mount()->set_quantity(static_cast<wire::MountQuantity>(7)); }},
      {kControl, [](D& m) { m.mutable_rig_control()->mutable_undo()->set_steps(0); }},
      {kControl, [](D& m) { m.mutable_rig_control()->mutable_save()->set_file(std::string(5000, 'x')); }},
      {kLamps, [](D& m) { m.mutable_lamp_state()->set_x_m(0, 51.0); }},
      {kStart, [](D& m) { m.mutable_frame_start()->set_number(0); }},
      {kStart, [](D& m) { m.mutable_frame_start()->mutable_controls()->set_brake_01(1.5); }},
      {kStart, [](D& m) { m.mutable_frame_start()->mutable_pose()->set_x_m(1e9); }},
      {kLamps, [](D& m) { m.mutable_lamp_state()->set_roll_rad(0, 1.7); }},
      {kLamps, [](D& m) { m.mutable_lamp_state()->set_aim_pitch_rad(1.7); }},
      {kControl, [](D& m) { m.mutable_rig_control()->set_request_id(5), m.mutable_rig_control()->set_first_open(6); }},
      {kControl, [](D& m) { m.mutable_rig_control()->set_request_id(5), m.mutable_rig_control()->set_first_open(0); }},
      {kAnswer, [](D& m) { m.mutable_control_reply()->set_request_id(0); }},
      {kAnswer, [](D& m) { m.mutable_control_reply()->set_verdict(static_cast<wire::ControlVerdict>(4)); }},
      {kAnswer, [](D& m) { m.mutable_control_reply()->set_now(std::string(5000, 'x')); }},
      {kLaw, [](D& m) { m.mutable_law_answer()->set_levelling_rad(1.7); }},
      {kLaw, [](D& m) { m.mutable_law_answer()->set_frame_index(-2); }},
      {kLaw, [](D& m) { m.mutable_law_answer()->set_light_switch(static_cast<wire::LightSwitch>(4)); }},
      {kLaw, [](D& m) { m.mutable_law_answer()->add_lamps(); }},  // without a name
      {kLaw,
       [](D& m) {
         wire::LampLight* lamp = m.mutable_law_answer()->add_lamps();
         lamp->set_lamp("left");
         lamp->add_dimming_01(1.0001);
       }},
      {kClock, [](D& m) { m.mutable_clock_probe()->set_asked_wall_ns(0); }},
      {kClock, [](D& m) { m.mutable_clock_probe()->set_asked_wall_ns(std::numeric_limits<std::int64_t>::max()); }},
      {kClock, [](D& m) { m.mutable_clock_probe()->set_heard_wall_ns(-1); }},
      {kRequest, [](D& m) { m.mutable_probe_request()->set_nx(0, 1.1); }},
      {kRequest,
       [](D& m) {
         auto& request = *m.mutable_probe_request();
         request.set_nx(0, 0.0), request.set_ny(0, 0.0), request.set_nz(0, 0.0);
       }},
      {kRequest, [](D& m) { m.mutable_probe_request()->set_x_m(0, 1e9); }},
      {kReply, [](D& m) { m.mutable_probe_reply()->set_illuminance_lx(0, -1.0); }},
  };
  for (std::size_t i = 0; i < wrong.size(); ++i) {
    EXPECT_EQ(refusal_after(wrong[i].first, wrong[i].second), Refusal::kRange) << "case " << i;
  }
  EXPECT_EQ(refusal_after(kControl, [](D& m) { m.mutable_rig_control()->clear_command(); }), Refusal::kMalformed);
  EXPECT_EQ(refusal_after(kControl, [](D& m) { m.mutable_rig_control()->set_quit(false); }), Refusal::kMalformed);
  EXPECT_EQ(refusal_after(kReport, [](D& m) { m.mutable_frame_report()->clear_drawn(); }), Refusal::kMalformed);
  EXPECT_EQ(refusal_after(kStart, [](D& m) { m.mutable_frame_start()->clear_pose(); }), Refusal::kMalformed);
  EXPECT_EQ(refusal_after(kStart, [](D& m) { m.mutable_frame_start()->clear_controls(); }), Refusal::kMalformed);
}

TEST(WireRefuses, LampStatesOfDifferentLengthOfNoneAndOfTooMany) {
  constexpr std::size_t kLamps = kPayloadIndex<LampState>;
  EXPECT_EQ(refusal_after(kLamps, [](auto& m) { m.mutable_lamp_state()->add_roll_rad(0.0); }), Refusal::kArrays);
  const auto of_length = [](int lamps) {
    return [lamps](auto& m) {
      m.mutable_lamp_state()->Clear();
      for (int i = 0; i < lamps; ++i) {
        m.mutable_lamp_state()->add_x_m(1.0), m.mutable_lamp_state()->add_y_m(1.0);
        m.mutable_lamp_state()->add_z_m(1.0), m.mutable_lamp_state()->add_yaw_rad(0.0);
        m.mutable_lamp_state()->add_pitch_rad(0.0), m.mutable_lamp_state()->add_roll_rad(0.0);
      }
    };
  };
  EXPECT_EQ(refusal_after(kLamps, of_length(0)), Refusal::kArrays);
  EXPECT_EQ(refusal_after(kLamps, of_length(16)), Refusal::kNone);
  EXPECT_EQ(refusal_after(kLamps, of_length(17)), Refusal::kArrays);
}

TEST(WireRefuses, ProbeArraysOfDifferentOrExcessiveLength) {
  constexpr std::size_t kRequest = kPayloadIndex<ProbeRequest>;
  EXPECT_EQ(refusal_after(kRequest, [](auto& m) { m.mutable_probe_request()->add_nz(0.5); }), Refusal::kArrays);
  EXPECT_EQ(refusal_after(kRequest, [](auto& m) { m.mutable_probe_request()->mutable_y_m()->Clear(); }),
            Refusal::kArrays);

  Datagram d{Sender::kControl, 0, 1, 1, SimTime{}, WallTime{}, ProbeRequest{}};
  auto& request = std::get<ProbeRequest>(d.payload);
  for (auto* array : {&request.x_m, &request.y_m, &request.z_m, &request.nx, &request.ny, &request.nz})
    array->assign(1000, 0.5);
  EXPECT_TRUE(decode(test::view(encode(d))));
  EXPECT_LE(encode(d).size(), 65507u);
  for (auto* array : {&request.x_m, &request.y_m, &request.z_m, &request.nx, &request.ny, &request.nz})
    array->push_back(0.5);
  EXPECT_EQ(refusal_of(encode(d)), Refusal::kArrays);
}

TEST(WireRefuses, KeysThatNoKeyboardHas) {
  constexpr std::size_t kKeys = kPayloadIndex<KeyInput>;
  const auto refusal_with = [&](const std::function<void(wire::KeyInput&)>& change) {
    return refusal_after(kKeys, [&](wire::Datagram& m) {
      m.mutable_key_input()->Clear();
      m.mutable_key_input()->set_events(5);
      change(*m.mutable_key_input());
    });
  };
  EXPECT_EQ(refusal_with([](auto& k) { k.add_held(265), k.add_event(265), k.add_event(-265); }), Refusal::kNone);
  EXPECT_EQ(refusal_with([](auto& k) { k.add_held(0); }), Refusal::kRange);
  EXPECT_EQ(refusal_with([](auto& k) { k.add_held(512); }), Refusal::kRange);
  EXPECT_EQ(refusal_with([](auto& k) { k.add_held(265), k.add_held(264); }), Refusal::kRange) << "not ascending";
  EXPECT_EQ(refusal_with([](auto& k) { k.add_held(265), k.add_held(265); }), Refusal::kRange) << "twice";
  EXPECT_EQ(refusal_with([](auto& k) { k.add_event(0); }), Refusal::kRange);
  EXPECT_EQ(refusal_with([](auto& k) { k.add_event(512); }), Refusal::kRange);
  EXPECT_EQ(refusal_with([](auto& k) { k.add_event(-512); }), Refusal::kRange);
  EXPECT_EQ(refusal_with([](auto& k) { k.set_events(0), k.add_event(1); }), Refusal::kRange) << "more than there were";
  EXPECT_EQ(refusal_with([](auto& k) {
              for (int i = 1; i <= 17; ++i) k.add_held(static_cast<unsigned>(i));
            }),
            Refusal::kArrays);
}

TEST(WireRefuses, MoreHashesThanStepsFitAMessage) {
  constexpr std::size_t kVehicle = kPayloadIndex<VehicleState>;
  const auto with = [](int count) {
    return [count](wire::Datagram& m) {
      m.mutable_vehicle_state()->clear_step_hash();
      for (int i = 0; i < count; ++i) m.mutable_vehicle_state()->add_step_hash(7);
    };
  };
  EXPECT_EQ(refusal_after(kVehicle, with(kMaxStepHashes)), Refusal::kNone);
  EXPECT_EQ(refusal_after(kVehicle, with(kMaxStepHashes + 1)), Refusal::kArrays);
}

TEST(WireRefuses, TextThatIsNotUtf8WithoutAWordOnStandardError) {
  const std::string bytes = encode(test::samples(1)[0]);
  std::string body = bytes.substr(0, bytes.size() - 6);
  const std::size_t at = body.find("can0");
  ASSERT_NE(at, std::string::npos);
  body[at] = '\xff';
  testing::internal::CaptureStderr();
  EXPECT_EQ(refusal_of(sealed(body)), Refusal::kMalformed);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace phare
