"""Drive files: every datagram of a drive in a pcap file (net/drive_file.h), read and written.

Link type RAW: IPv4 and UDP headers with loopback addresses, then the datagram. The record's stamp is the simulated time.
"""

from __future__ import annotations

import os
import struct
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Iterable, Iterator

import numpy as np
import pandas as pd

from . import phare_pb2 as pb
from . import wire
from .errors import BadInput, told

_MICRO, _NANO = 0xA1B2C3D4, 0xA1B23C4D
_RAW, _ETHERNET = 101, 1
_PORTS = {pb.SENDER_COCKPIT: 0, pb.SENDER_DYNAMICS: 1, pb.SENDER_CONTROL: 3, pb.SENDER_LAW: 4}
_RECORDER, _FIRST_VISUAL = 2, 10
_LAST_S = 0xFFFFFFFF  # that a record's stamp holds


def _is_list(of: Any) -> bool:
    """A field of a message: protobuf 7 has is_repeated in place of label, old releases have label alone."""
    return bool(of.is_repeated) if hasattr(of, "is_repeated") else bool(of.label == of.LABEL_REPEATED)


@dataclass
class Drive:
    """A drive file: its datagrams in the file's order, as the messages of net/phare.proto."""

    datagrams: list[pb.Datagram] = field(default_factory=list)
    cut: bool = False  # the file ends within a record; what came before is here
    refused: int = 0  # records that hold no datagram

    def payloads(self, name: str) -> Iterator[tuple[pb.Datagram, Any]]:
        """Envelope and message of each datagram with this payload: "vehicle_state", "cockpit_state", …"""
        for datagram in self.datagrams:
            if datagram.WhichOneof("payload") == name:
                yield datagram, getattr(datagram, name)

    def table(self, name: str) -> pd.DataFrame:
        """One row a datagram of this payload: sim_time_s as index, its numbers, flags and words as columns.

        Columns are named as in net/phare.proto, with their units at the end of the name; lists are left out. A datagram that
        was sent again stands once.
        """
        rows, times = [], []
        seen: set[tuple[int, int, int]] = set()
        for datagram, message in self.payloads(name):
            number = (datagram.start_id, datagram.sender_channel, datagram.sequence)
            if number in seen:
                continue
            seen.add(number)
            times.append(datagram.sim_time_ns * 1e-9)
            rows.append(
                {
                    of.name: getattr(message, of.name)
                    for of in message.DESCRIPTOR.fields
                    if not _is_list(of) and of.message_type is None
                }
            )
        return pd.DataFrame(rows, index=pd.Index(times, name="sim_time_s", dtype=float))

    @property
    def duration_s(self) -> float:
        """The newest simulated time, s."""
        return max((datagram.sim_time_ns for datagram in self.datagrams), default=0) * 1e-9


def _ip_payload(frame: bytes, link: int) -> bytes | None:
    if link == _ETHERNET:
        if frame[12:14] != b"\x08\x00":
            return None
        frame = frame[14:]
    if len(frame) < 28 or frame[0] >> 4 != 4 or frame[9] != 17:
        return None
    udp = (frame[0] & 15) * 4
    (length,) = struct.unpack_from("!H", frame, udp + 4)
    return frame[udp + 8 : udp + length] if length >= 8 and udp + length <= len(frame) else None


def read_drive(file: str | os.PathLike[str], *, key: bytes | None = None) -> Drive:
    """Reads a drive file (pcap, stamps in micro- or nanoseconds, link type RAW or Ethernet).

    key: of datagrams that were captured with their seal, as by tcpdump. A file cut anywhere is read up to its last whole
    record. Raises BadInput when it is no such file.
    """
    with told(file):
        data = Path(file).read_bytes()
    order = next((o for o in "<>" if len(data) >= 24 and struct.unpack_from(o + "I", data)[0] in (_MICRO, _NANO)), None)
    if order is None:
        raise BadInput(f"{file}: no pcap file (editcap -F nsecpcap makes one of a pcapng)")
    link = struct.unpack_from(order + "I", data, 20)[0] & 0x0FFFFFFF
    if link not in (_RAW, _ETHERNET):
        raise BadInput(f"{file}: link type {link}, expected 101 (RAW) or 1 (Ethernet)")
    drive, at = Drive(), 24
    while at < len(data):
        if at + 16 > len(data):
            drive.cut = True
            break
        kept = struct.unpack_from(order + "I", data, at + 8)[0]
        frame = data[at + 16 : at + 16 + kept]
        if len(frame) < kept:
            drive.cut = True
            break
        at += 16 + kept
        payload = _ip_payload(frame, link)
        try:
            opened = wire.unseal(payload, key) if payload else None
            if opened is None:
                raise BadInput("no datagram")
            drive.datagrams.append(wire.decode(opened))
        except BadInput:
            drive.refused += 1
    return drive


def _port(base: int, datagram: pb.Datagram) -> int:
    if datagram.sender == pb.SENDER_VISUAL:
        return base + _FIRST_VISUAL + datagram.sender_channel
    return base + _PORTS.get(datagram.sender, 3)


def _ip_checksum(header: bytes) -> int:
    words = int(np.frombuffer(header, dtype=">u2").sum(dtype=np.uint64))
    while words >> 16:
        words = (words & 0xFFFF) + (words >> 16)
    return ~words & 0xFFFF


def write_drive(file: str | os.PathLike[str], datagrams: Iterable[pb.Datagram], *, port_base: int = 47000) -> None:
    """Writes a drive file that phare drive --drive replays and Wireshark opens. An existing one is replaced, whole."""
    if not 0 < port_base <= 65535 - 30:
        raise BadInput(f"port_base = {port_base}: expected 1 to 65505")
    out = bytearray(struct.pack("<IHHiIII", _NANO, 2, 4, 0, 0, 65535 + 28, _RAW))
    for datagram in datagrams:
        if not isinstance(datagram, pb.Datagram):
            raise BadInput(f"{file}: {datagram!r} is no datagram")
        if datagram.sim_time_ns < 0:
            raise BadInput(f"{file}: a time before the start of the drive has no place in a drive file")
        if datagram.sim_time_ns >= (_LAST_S + 1) * 1_000_000_000:
            raise BadInput(f"{file}: a time behind {_LAST_S} s has no place in a drive file")
        body = wire.encode(datagram)
        if len(body) > 65507:
            raise BadInput(f"{file}: a datagram of {len(body)} bytes, at most 65507 fit")
        ip = struct.pack("!BBHHHBBH4s4s", 0x45, 0, 28 + len(body), 0, 0x4000, 64, 17, 0, b"\x7f\0\0\1", b"\x7f\0\0\1")
        ip = ip[:10] + struct.pack("!H", _ip_checksum(ip)) + ip[12:]
        udp = struct.pack("!HHHH", _port(port_base, datagram), port_base + _RECORDER, 8 + len(body), 0)
        seconds, nanoseconds = divmod(datagram.sim_time_ns, 1_000_000_000)
        out += struct.pack("<IIII", seconds, nanoseconds, 28 + len(body), 28 + len(body)) + ip + udp + body
    beside = Path(f"{os.fspath(file)}.part")
    with told(file):
        beside.write_bytes(out)
        beside.replace(file)


def poses(
    time_s: Any,
    *,
    x_m: Any,
    y_m: Any,
    z_m: Any = 0.0,
    yaw_rad: Any = 0.0,
    pitch_rad: Any = 0.0,
    roll_rad: Any = 0.0,
    speed_mps: Any = 0.0,
    yaw_rate_radps: Any = 0.0,
    light: str | list[str] = "low",
    start_id: int = 1,
) -> list[pb.Datagram]:
    """Datagrams of a drive of one's own for write_drive: at each time (s, rising, from 0) the car's pose in the world and the
    light switch ("off", "position", "low", "high"; one word, or one for each time).

    Frames as in net/phare.proto: x forward, y left, z up; pitch nose down.
    """
    try:
        times = np.asarray(time_s, float)
    except (TypeError, ValueError) as error:
        raise BadInput(f"poses: time_s: {error}") from error
    if times.ndim != 1 or times.size < 2 or not np.isfinite(times).all() or times[0] < 0 or (np.diff(times) <= 0).any():
        raise BadInput("poses: time_s must be one list, finite, rise, begin at 0 or later, and have two values or more")
    if times[-1] > _LAST_S:
        raise BadInput(f"poses: time_s is {times[-1]:g}, and a drive file ends at {_LAST_S} s")
    if not isinstance(start_id, (int, np.integer)) or not 0 <= start_id < 1 << 64:
        raise BadInput(f"poses: start_id = {start_id!r}: expected a whole number of 64 bits, 0 or more")
    given = dict(
        x_m=x_m, y_m=y_m, z_m=z_m, yaw_rad=yaw_rad, pitch_rad=pitch_rad, roll_rad=roll_rad, speed_mps=speed_mps,
        yaw_rate_radps=yaw_rate_radps,
    )
    columns = {}
    for name, value in given.items():
        try:
            columns[name] = np.broadcast_to(np.asarray(value, float), times.shape)
        except (TypeError, ValueError) as error:
            raise BadInput(f"poses: {name}: {error}") from error
        if not np.isfinite(columns[name]).all():
            raise BadInput(f"poses: {name} is not finite")
    words = [light] * times.size if isinstance(light, str) else list(light) if isinstance(light, Iterable) else []
    switches = {"off": 0, "position": 1, "low": 2, "high": 3}
    if len(words) != times.size or any(not isinstance(word, str) or word not in switches for word in words):
        raise BadInput("poses: light is off, position, low or high, one or one for each time")
    drive = []
    for i, time in enumerate(times):
        common = dict(
            protocol_version=wire.PROTOCOL_VERSION, start_id=start_id, sequence=i + 1, sim_time_ns=int(round(time * 1e9)),
            sent_wall_ns=1 + int(round(time * 1e9)),
        )
        last = i + 1 == times.size
        controls = pb.CockpitState(frame_index=-1, light_switch=switches[words[i]], drive_ended=last, source="drive")
        if i > 0 and words[i] != words[i - 1]:
            controls.light_changes = sum(a != b for a, b in zip(words[:i], words[1 : i + 1]))
            controls.light_change_sim_ns = common["sim_time_ns"]
        state = pb.VehicleState(frame_index=-1, level="pose", drive_ended=last)
        for name, values in columns.items():
            setattr(state, name, float(values[i]))
        drive.append(pb.Datagram(sender=pb.SENDER_COCKPIT, cockpit_state=controls, **common))
        drive.append(pb.Datagram(sender=pb.SENDER_DYNAMICS, vehicle_state=state, **common))
    return drive
