"""Datagrams of the bus: encoding, check and seal (net/wire.h, docs/send.md)."""

from __future__ import annotations

import hmac
import os
import struct
import tempfile
import zlib
from pathlib import Path

from google.protobuf.message import DecodeError

from . import phare_pb2 as pb
from .errors import BadInput

PROTOCOL_VERSION = 1
_CHECK_TAG = b"\x85\x01"
_CHECK_BYTES = 6
TAG_BYTES = 32


def encode(datagram: pb.Datagram) -> bytes:
    """The bytes on the wire before the seal: the message, then its CRC-32 as field 16."""
    body: bytes = datagram.SerializeToString(deterministic=True)
    return body + _CHECK_TAG + struct.pack("<I", zlib.crc32(body))


def decode(data: bytes) -> pb.Datagram:
    """The datagram of bytes without a seal; BadInput when they are none."""
    body, check = data[:-_CHECK_BYTES], data[-_CHECK_BYTES:]
    if len(check) < _CHECK_BYTES or check[:2] != _CHECK_TAG or struct.unpack("<I", check[2:])[0] != zlib.crc32(body):
        raise BadInput("datagram: checksum does not fit: cut short or changed on the way")
    datagram = pb.Datagram()
    try:
        datagram.ParseFromString(body)
    except DecodeError as wrong:
        raise BadInput(f"datagram: not the encoding of a datagram: {wrong}") from wrong
    if datagram.protocol_version != PROTOCOL_VERSION:
        raise BadInput(f"datagram: protocol version {datagram.protocol_version}, here {PROTOCOL_VERSION}")
    return datagram


def seal(data: bytes, key: bytes | None) -> bytes:
    """Adds the tag of the rig's key."""
    return data + hmac.digest(key, data, "sha512")[:TAG_BYTES] if key else data


def unseal(data: bytes, key: bytes | None) -> bytes | None:
    """The bytes without their tag; None when it is not that of this key."""
    if not key:
        return data
    body, tag = data[:-TAG_BYTES], data[-TAG_BYTES:]
    return body if hmac.compare_digest(hmac.digest(key, body, "sha512")[:TAG_BYTES], tag) else None


def run_folder() -> Path:
    """Where the keys of this user's runs lie (net/run_key.h)."""
    named = os.environ.get("PHARE_RUN_DIR")
    if named:
        return Path(named)
    of_user = Path(f"/run/user/{os.getuid()}")
    return of_user / "phare" if of_user.is_dir() else Path(tempfile.gettempdir()) / f"phare-{os.getuid()}"


def read_key(file: str | os.PathLike[str]) -> bytes:
    """64 hexadecimal digits; BadInput when the file holds something else."""
    text = Path(file).read_text().strip()
    try:
        key = bytes.fromhex(text)
    except ValueError:
        key = b""
    if len(key) != 32:
        raise BadInput(f"{file}: expected 64 hexadecimal digits")
    return key
