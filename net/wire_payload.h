// Inside of wire.cpp: between the structs of messages.h and the messages of phare.proto, field by field.
#pragma once

#include "net/messages.h"
#include "phare.pb.h"

namespace phare {

template <typename Enum>
Enum to_wire_enum(int value) {
  return static_cast<Enum>(value);
}

/// Sets the payload of a message that has none.
void fill_payload(wire::Datagram& message, const Payload& payload);

/// Unknown fields, at any depth.
bool any_unknown(const wire::Datagram& message);

/// Into the payload of the last datagram, whose memory is used again where the type fits. False: a part is missing.
bool read_payload(const wire::Datagram& message, Payload& payload);

}  // namespace phare
