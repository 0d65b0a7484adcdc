#include "net/drive_file.h"

#include <netinet/in.h>
#include <pcap/pcap.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "config/base/content_hash.h"
#include "net/channels.h"
#include "net/wire.h"

namespace phare {
namespace {

constexpr std::size_t kIpBytes = 20;
constexpr std::size_t kUdpBytes = 8;
constexpr std::size_t kEthernetBytes = 14;
constexpr int kSnapBytes = 65535;

void put16(std::uint8_t* at, std::size_t value) {
  at[0] = static_cast<std::uint8_t>(value >> 8);
  at[1] = static_cast<std::uint8_t>(value);
}

std::size_t get16(const std::uint8_t* at) {
  return static_cast<std::size_t>(at[0] << 8 | at[1]);
}

/// RFC 791: one's complement of the one's complement sum of the header's 16-bit words.
std::uint16_t ip_checksum(const std::uint8_t* header) {
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < kIpBytes; i += 2) sum += static_cast<std::uint32_t>(get16(header + i));
  while (sum >> 16 != 0) sum = (sum & 0xffff) + (sum >> 16);
  return static_cast<std::uint16_t>(~sum);
}

/// IPv4 and UDP headers of a datagram from 127.0.0.1 to 127.0.0.1. UDP's checksum 0 means none; the datagram has its
/// own.
void write_headers(std::uint8_t* at, std::uint16_t from_port, std::uint16_t to_port, std::size_t payload_bytes) {
  std::memset(at, 0, kIpBytes + kUdpBytes);
  at[0] = 0x45;  // version 4, five words of header
  put16(at + 2, kIpBytes + kUdpBytes + payload_bytes);
  put16(at + 6, 0x4000);  // do not fragment
  at[8] = 64;             // time to live
  at[9] = IPPROTO_UDP;
  constexpr std::uint8_t kLoopback[4] = {127, 0, 0, 1};
  std::memcpy(at + 12, kLoopback, 4);
  std::memcpy(at + 16, kLoopback, 4);
  put16(at + 10, ip_checksum(at));
  std::uint8_t* const udp = at + kIpBytes;
  put16(udp, from_port);
  put16(udp + 2, to_port);
  put16(udp + 4, kUdpBytes + payload_bytes);
}

/// What a packet carries over UDP, empty when it is no whole UDP packet.
std::span<const std::byte> udp_payload(int link_type, const std::uint8_t* packet, std::size_t size) {
  if (link_type == DLT_EN10MB) {
    if (size < kEthernetBytes || get16(packet + 12) != 0x0800) return {};
    packet += kEthernetBytes;
    size -= kEthernetBytes;
  }
  if (size < kIpBytes + kUdpBytes || packet[0] >> 4 != 4 || packet[9] != IPPROTO_UDP) return {};
  const std::size_t ip_bytes = static_cast<std::size_t>(packet[0] & 0x0f) * 4;
  if (ip_bytes < kIpBytes || size < ip_bytes + kUdpBytes) return {};
  const std::size_t udp_bytes = get16(packet + ip_bytes + 4);
  if (udp_bytes < kUdpBytes || udp_bytes > size - ip_bytes) return {};
  return std::as_bytes(std::span(packet + ip_bytes + kUdpBytes, udp_bytes - kUdpBytes));
}

using PcapPtr = std::unique_ptr<pcap_t, decltype(&pcap_close)>;

/// True when the file is the beginning of a pcap file header: what is left of a recorder killed at its start.
bool begins_like_pcap(const std::filesystem::path& path) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) return false;
  std::array<std::uint8_t, 25> bytes{};
  const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), file.get());
  if (count >= 24) return false;
  constexpr std::array<std::array<std::uint8_t, 4>, 5> kMagics{{{0x4d, 0x3c, 0xb2, 0xa1},  // nanoseconds, little-endian
                                                                {0xa1, 0xb2, 0x3c, 0x4d},  // and big-endian
                                                                {0xd4, 0xc3, 0xb2, 0xa1},  // microseconds
                                                                {0xa1, 0xb2, 0xc3, 0xd4},
                                                                {0x0a, 0x0d, 0x0d, 0x0a}}};  // pcapng
  return std::any_of(kMagics.begin(), kMagics.end(), [&](const auto& magic) {
    return std::equal(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(std::min(count, magic.size())),
                      magic.begin());
  });
}

}  // namespace

// ---- writing

struct DriveWriter::State {
  std::string place;
  std::uint16_t port_base = 0;
  pcap_t* handle = nullptr;
  pcap_dumper_t* dumper = nullptr;
  std::vector<std::uint8_t> packet;  // reused

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() { close(); }

  void close() {
    if (dumper != nullptr) pcap_dump_close(dumper);
    if (handle != nullptr) pcap_close(handle);
    dumper = nullptr;
    handle = nullptr;
  }
};

DriveWriter::DriveWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
DriveWriter::DriveWriter(DriveWriter&&) noexcept = default;
DriveWriter& DriveWriter::operator=(DriveWriter&&) noexcept = default;
DriveWriter::~DriveWriter() = default;

Result<DriveWriter> DriveWriter::create(const std::filesystem::path& path, std::uint16_t port_base) {
  auto state = std::make_unique<State>();
  state->place = path.string();
  state->port_base = port_base;
  // We open the file ourselves: libpcap would take "-" for standard output.
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return Error{state->place, std::string("cannot be written: ") + std::strerror(errno)};
  state->handle = pcap_open_dead_with_tstamp_precision(DLT_RAW, kSnapBytes, PCAP_TSTAMP_PRECISION_NANO);
  if (state->handle != nullptr) state->dumper = pcap_dump_fopen(state->handle, file);
  if (state->dumper == nullptr) {
    const std::string reason = state->handle != nullptr ? pcap_geterr(state->handle) : "no memory";
    std::fclose(file);
    return Error{state->place, "cannot be written: " + reason};
  }
  if (pcap_dump_flush(state->dumper) != 0)
    return Error{state->place, std::string("cannot be written: ") + std::strerror(errno)};
  return DriveWriter(std::move(state));
}

Status DriveWriter::write(const Datagram& datagram, std::span<const std::byte> bytes) {
  State& s = *state_;
  if (s.dumper == nullptr) return Error{s.place, "is closed"};
  if (bytes.size() > kSnapBytes - kIpBytes - kUdpBytes) return Error{s.place, "datagram too long"};
  if (datagram.sim_time.ns < 0)
    return Error{s.place, "a time before the start of the drive has no place in a pcap file"};

  const Channel& row = kChannels[datagram.payload.index()];
  const Role to = row.receivers.has(Role::kRecorder) ? Role::kRecorder : Role::kVisual;
  const auto from_port =
      static_cast<std::uint16_t>(s.port_base + port_offset_of_sender(datagram.sender, datagram.sender_channel));
  const auto to_port = static_cast<std::uint16_t>(s.port_base + port_offset(to));
  s.packet.resize(kIpBytes + kUdpBytes + bytes.size());
  write_headers(s.packet.data(), from_port, to_port, bytes.size());
  if (!bytes.empty()) std::memcpy(s.packet.data() + kIpBytes + kUdpBytes, bytes.data(), bytes.size());

  pcap_pkthdr header{};
  header.ts.tv_sec = static_cast<time_t>(datagram.sim_time.ns / kNsPerSecond);
  header.ts.tv_usec =
      static_cast<suseconds_t>(datagram.sim_time.ns % kNsPerSecond);  // nanoseconds in a file of that precision
  header.caplen = header.len = static_cast<bpf_u_int32>(s.packet.size());
  pcap_dump(reinterpret_cast<u_char*>(s.dumper), &header, s.packet.data());
  // Out of our hands at once: a killed recorder then loses at most the record it is writing.
  if (pcap_dump_flush(s.dumper) != 0 || std::ferror(pcap_dump_file(s.dumper)) != 0) {
    return Error{s.place, std::string("cannot be written: ") + std::strerror(errno)};
  }
  return Done{};
}

void DriveWriter::close() {
  if (state_) state_->close();
}

// ---- reading

Result<Drive> read_drive(const std::filesystem::path& path) {
  const std::string place = path.string();
  struct stat about {};
  if (stat(path.c_str(), &about) != 0) return Error{place, std::string("cannot be opened: ") + std::strerror(errno)};
  if (!S_ISREG(about.st_mode)) return Error{place, "is no file"};

  Drive drive;
  Result<std::string> hash = content_hash_of_file(path);
  if (!hash) return hash.error();
  drive.content_hash = *hash;

  if (begins_like_pcap(path)) {
    drive.cut = true;
    return drive;
  }
  std::array<char, PCAP_ERRBUF_SIZE> reason{};
  std::FILE* const file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) return Error{place, std::string("cannot be opened: ") + std::strerror(errno)};
  const PcapPtr pcap(pcap_fopen_offline_with_tstamp_precision(file, PCAP_TSTAMP_PRECISION_NANO, reason.data()),
                     &pcap_close);
  if (!pcap) {
    std::fclose(file);
    return Error{place, std::string("is no drive file (pcap): ") + reason.data()};
  }
  const int link_type = pcap_datalink(pcap.get());
  if (link_type != DLT_RAW && link_type != DLT_IPV4 && link_type != DLT_EN10MB) {
    const char* const name = pcap_datalink_val_to_name(link_type);
    return Error{place, std::string("has link type ") + (name != nullptr ? name : std::to_string(link_type)) +
                            ", expected RAW (a drive file) or EN10MB (tcpdump -i lo)"};
  }

  Datagram datagram;
  pcap_pkthdr* header = nullptr;
  const u_char* packet = nullptr;
  int status = 0;
  while ((status = pcap_next_ex(pcap.get(), &header, &packet)) == 1) {
    const std::span<const std::byte> bytes = udp_payload(link_type, packet, header->caplen);
    if (decode_into(bytes, datagram) != Refusal::kNone) {
      ++drive.refused;
      continue;
    }
    drive.duration = std::max(drive.duration, datagram.sim_time);
    drive.datagrams.push_back(datagram);
  }
  drive.cut = status != PCAP_ERROR_BREAK;  // BREAK is the file's proper end
  return drive;
}

}  // namespace phare
