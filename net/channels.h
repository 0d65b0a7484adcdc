// Who sends what to whom, on which port, how often, and after how long silence means something.
//
// One UDP port per process: rig.port_base + port_offset(role, channel). A visual process is one channel of the picture.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>
#include <variant>

#include "net/messages.h"

namespace phare {

/// The processes of a rig. The recorder listens and never sends; the law is the control law of the lamps, where there
/// is one.
enum class Role { kCockpit, kDynamics, kRecorder, kControl, kLaw, kVisual };
inline constexpr std::array<Role, 6> kAllRoles{Role::kCockpit, Role::kDynamics, Role::kRecorder,
                                               Role::kControl, Role::kLaw,      Role::kVisual};

/// Most visual channels a rig may have.
inline constexpr std::uint32_t kMaxChannels = 16;

/// Offset to rig.port_base; `channel` counts for visual processes only.
constexpr std::uint16_t port_offset(Role role, std::uint32_t channel = 0) {
  switch (role) {
    case Role::kCockpit:
      return 0;
    case Role::kDynamics:
      return 1;
    case Role::kRecorder:
      return 2;
    case Role::kControl:
      return 3;
    case Role::kLaw:
      return 4;
    case Role::kVisual:
      break;
  }
  return static_cast<std::uint16_t>(10 + channel);
}

/// The highest port offset a rig can need.
inline constexpr std::uint16_t kMaxPortOffset = port_offset(Role::kVisual, kMaxChannels - 1);

/// A set of roles.
class Roles {
 public:
  template <typename... R>
  constexpr explicit Roles(R... roles) : bits_((0u | ... | (1u << static_cast<unsigned>(roles)))) {}
  constexpr bool has(Role role) const { return ((bits_ >> static_cast<unsigned>(role)) & 1u) != 0; }

 private:
  unsigned bits_;
};

struct Channel {
  std::string_view message;  ///< name of the oneof field in phare.proto
  Sender sender;             ///< the only process that may send it
  Roles receivers;
  bool first_visual_only;                ///< of the visual processes only channel 0 receives it; nobody hears himself
  double rate_hz;                        ///< in real time; 0: when there is a reason
  std::chrono::nanoseconds stale_after;  ///< older than this the receiver acts on silence; 0: never stale
  bool repeat_is_news;       ///< a repeat of the newest datagram asks for an answer, so take() gives it again
  bool many_starts = false;  ///< several starts speak at the same time, each with a sequence of its own (ManyStarts)
  bool any_process = false;  ///< every process of the rig may send it, `sender` is only the first; to who asked alone

  constexpr bool may_send(Sender who) const {
    const bool of_the_rig = who == Sender::kCockpit || who == Sender::kDynamics || who == Sender::kVisual;
    return who == sender || (any_process && of_the_rig);
  }
};

/// In the order of the alternatives of Payload.
/// CockpitState goes stale when 20 are missing: pedals fade, low beam stays on. VehicleState goes stale when 50 are
/// missing: until then the picture coasts, then it holds and says so.
inline constexpr std::array<Channel, 12> kChannels{{
    // clang-format off
    // message          sender             receivers                                                                first  Hz   stale after                    repeat
    {"cockpit_state",   Sender::kCockpit,  Roles(Role::kDynamics, Role::kVisual, Role::kRecorder, Role::kLaw),       false, 100, std::chrono::milliseconds(200), false},
    {"vehicle_state",   Sender::kDynamics, Roles(Role::kCockpit, Role::kVisual, Role::kRecorder, Role::kLaw),        false, 250, std::chrono::milliseconds(200), false},
    {"frame_report",    Sender::kVisual,   Roles(Role::kCockpit, Role::kDynamics, Role::kRecorder, Role::kControl, Role::kVisual), true, 60, std::chrono::seconds(1), true},
    {"rig_control",     Sender::kControl,  Roles(Role::kCockpit, Role::kDynamics, Role::kVisual, Role::kRecorder),   false, 0,   std::chrono::seconds(0),        false, true},
    {"probe_request",   Sender::kControl,  Roles(Role::kVisual),                                                     true,  0,   std::chrono::seconds(0),        false, true},
    {"probe_reply",     Sender::kVisual,   Roles(Role::kControl, Role::kRecorder),                                   false, 0,   std::chrono::seconds(0),        false},
    {"key_input",       Sender::kVisual,   Roles(Role::kCockpit, Role::kControl),                                    false, 0,   std::chrono::seconds(1),        false},
    {"control_reply",   Sender::kCockpit,  Roles(Role::kControl),                                                    false, 0,   std::chrono::seconds(0),        false, true, true},
    {"clock_probe",     Sender::kCockpit,  Roles(Role::kCockpit, Role::kDynamics, Role::kVisual),                    false, 1,   std::chrono::seconds(0),        false, true, true},
    {"law_answer",      Sender::kLaw,      Roles(Role::kVisual, Role::kRecorder),                                    false, 60,  std::chrono::milliseconds(200), false},
    {"lamp_state",      Sender::kVisual,   Roles(Role::kVisual, Role::kRecorder),                                    false, 1,   std::chrono::seconds(0),        false},
    {"frame_start",     Sender::kVisual,   Roles(Role::kVisual),                                                     false, 60,  std::chrono::milliseconds(250), true},
    // clang-format on
}};
static_assert(kChannels.size() == std::variant_size_v<Payload>);

namespace channels_detail {
template <typename T, std::size_t index = 0>
constexpr std::size_t index_of() {
  static_assert(index < std::variant_size_v<Payload>, "not a payload of the bus");
  if constexpr (std::is_same_v<T, std::variant_alternative_t<index, Payload>>) {
    return index;
  } else {
    return index_of<T, index + 1>();
  }
}
}  // namespace channels_detail

/// Index of a payload type in Payload and in kChannels.
template <typename T>
inline constexpr std::size_t kPayloadIndex = channels_detail::index_of<T>();

/// The row of a payload type.
template <typename T>
constexpr const Channel& channel_of() {
  return kChannels[kPayloadIndex<T>];
}

/// The sender a role signs with; kUnknown for the recorder.
constexpr Sender sender_of(Role role) {
  switch (role) {
    case Role::kCockpit:
      return Sender::kCockpit;
    case Role::kDynamics:
      return Sender::kDynamics;
    case Role::kControl:
      return Sender::kControl;
    case Role::kVisual:
      return Sender::kVisual;
    case Role::kLaw:
      return Sender::kLaw;
    case Role::kRecorder:
      break;
  }
  return Sender::kUnknown;
}

/// Offset to rig.port_base of the port a sender speaks from.
constexpr std::uint16_t port_offset_of_sender(Sender sender, std::uint32_t sender_channel) {
  switch (sender) {
    case Sender::kCockpit:
      return port_offset(Role::kCockpit);
    case Sender::kDynamics:
      return port_offset(Role::kDynamics);
    case Sender::kVisual:
      return port_offset(Role::kVisual, sender_channel);
    case Sender::kLaw:
      return port_offset(Role::kLaw);
    case Sender::kControl:
    case Sender::kUnknown:
      break;
  }
  return port_offset(Role::kControl);
}

}  // namespace phare
