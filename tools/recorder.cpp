#include "tools/recorder.h"

namespace phare {

Status no_recording_at(const std::filesystem::path& out) {
  std::error_code unreadable;
  if (std::filesystem::is_regular_file(out, unreadable) && !std::filesystem::is_empty(out, unreadable))
    return Error{out.string(), "is there already; a recording is not written over"};
  return Done{};
}

Result<std::unique_ptr<Recorder>> Recorder::open(const Rig& rig) {
  auto bus = Bus::open(rig, Role::kRecorder);
  if (!bus) return bus.error();
  return std::unique_ptr<Recorder>(new Recorder(std::move(*bus), rig.port_base));
}

Status Recorder::create(const std::filesystem::path& out) {
  auto writer = DriveWriter::create(out, port_base_);
  if (!writer) return writer.error();
  writer_.emplace(std::move(*writer));
  return Done{};
}

Recorder::Recorder(Bus bus, std::uint16_t port_base) : bus_(std::move(bus)), port_base_(port_base) {
  bus_.on_datagram = [this](const Datagram& datagram, std::span<const std::byte> bytes) {
    if (failed_ || !writer_) return;
    if (const Status status = writer_->write(datagram, bytes); !status) {
      failed_ = status.error();
      return;
    }
    ++written_;
    if (const auto* vehicle = std::get_if<VehicleState>(&datagram.payload)) drive_ended_ = vehicle->drive_ended;
  };
}

Status Recorder::poll() {
  if (!writer_) return Done{};
  bus_.poll();
  if (failed_) return *failed_;
  return Done{};
}

}  // namespace phare
