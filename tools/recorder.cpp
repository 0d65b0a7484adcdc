#include "tools/recorder.h"

namespace phare {

Result<std::unique_ptr<Recorder>> Recorder::open(const Rig& rig, const std::filesystem::path& out) {
  auto bus = Bus::open(rig, Role::kRecorder);
  if (!bus) return bus.error();
  auto writer = DriveWriter::create(out, rig.port_base);
  if (!writer) return writer.error();
  return std::unique_ptr<Recorder>(new Recorder(std::move(*bus), std::move(*writer)));
}

Recorder::Recorder(Bus bus, DriveWriter writer) : bus_(std::move(bus)), writer_(std::move(writer)) {
  bus_.on_datagram = [this](const Datagram& datagram, std::span<const std::byte> bytes) {
    if (failed_) return;
    if (const Status status = writer_.write(datagram, bytes); !status) {
      failed_ = status.error();
      return;
    }
    ++written_;
    if (const auto* vehicle = std::get_if<VehicleState>(&datagram.payload)) drive_ended_ = vehicle->drive_ended;
  };
}

Status Recorder::poll() {
  bus_.poll();
  if (failed_) return *failed_;
  return Done{};
}

}  // namespace phare
