// The drive file: every datagram of a drive in a pcap file that Wireshark, tshark, editcap and tcpdump read.
//
// Link type RAW (101): IPv4 and UDP headers with loopback addresses and the ports of net/channels.h, then the datagram
// as it was on the wire. The record's stamp is the datagram's SimTime in nanoseconds since the start of the drive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "config/base/result.h"
#include "net/messages.h"
#include "net/sim_time.h"

namespace phare {

class DriveWriter {
 public:
  /// Creates or overwrites the file. `port_base`: rig.port_base, from which the ports in the headers are counted.
  static Result<DriveWriter> create(const std::filesystem::path& path, std::uint16_t port_base);

  DriveWriter(DriveWriter&&) noexcept;
  DriveWriter& operator=(DriveWriter&&) noexcept;
  ~DriveWriter();  // closes

  /// Appends a datagram as it came from the bus; `bytes` is its encoding. Handed to the kernel before the call returns,
  /// so a killed recorder loses nothing. Error when the disk does not take it, or the writer is closed.
  Status write(const Datagram& datagram, std::span<const std::byte> bytes);

  void close();

 private:
  struct State;
  explicit DriveWriter(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

struct Drive {
  std::vector<Datagram> datagrams;  ///< valid ones, in the file's order
  bool cut = false;                 ///< the file ends within a record; what came before is here
  std::size_t refused = 0;          ///< whole records that hold no valid datagram
  SimTime duration;                 ///< newest SimTime of all datagrams
  std::string content_hash;         ///< of the file's bytes, see config/base/content_hash.h
};

/// Reads pcap and pcapng files with micro- or nanosecond stamps, link type RAW or Ethernet (tcpdump -i lo). A file cut
/// anywhere opens up to its last whole record; one that is no capture file at all is an Error.
Result<Drive> read_drive(const std::filesystem::path& path);

}  // namespace phare
