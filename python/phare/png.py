"""Reads the PNG files that Phare writes: 8 bits, grey, RGB or RGBA, not interlaced. No image library is needed for it."""

from __future__ import annotations

import os
import struct
import zlib
from pathlib import Path

import numpy as np

from .errors import BadInput

_CHANNELS = {0: 1, 2: 3, 4: 2, 6: 4}


def read_png(file: str | os.PathLike[str]) -> np.ndarray:
    """Pixels as uint8 of shape (height, width, channels), the top row first."""
    data = Path(file).read_bytes()
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise BadInput(f"{file}: no PNG file")
    at, packed, header = 8, bytearray(), None
    while at + 12 <= len(data):
        (length,) = struct.unpack_from(">I", data, at)
        kind, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            header = struct.unpack(">IIBBBBB", body)
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    if header is None or header[2] != 8 or header[3] not in _CHANNELS or header[6] != 0:
        raise BadInput(f"{file}: only PNG of 8 bits without palette and interlace is read")
    width, height, channels = header[0], header[1], _CHANNELS[header[3]]
    rows = np.frombuffer(zlib.decompress(bytes(packed)), np.uint8).reshape(height, 1 + width * channels)
    out = np.zeros((height + 1, width, channels), np.uint8)
    for y in range(height):
        out[y + 1] = _unfiltered(int(rows[y, 0]), rows[y, 1:].reshape(width, channels), out[y])
    return out[1:]


def _unfiltered(kind: int, line: np.ndarray, above: np.ndarray) -> np.ndarray:
    """One row without its filter (PNG 1.2, 6.2 to 6.6)."""
    if kind == 0:
        return line
    if kind == 1:
        return np.cumsum(line, axis=0, dtype=np.uint64).astype(np.uint8)
    if kind == 2:
        return line + above
    return np.frombuffer(_by_the_left(kind, line.tobytes(), above.tobytes(), line.shape[1]), np.uint8).reshape(line.shape)


def _by_the_left(kind: int, line: bytes, above: bytes, channels: int) -> bytes:
    """Average and Paeth, where each byte needs the one before it: plain numbers are five times as fast here as arrays."""
    now = bytearray(channels + len(line))  # with the pixel before the first, which is 0
    above = bytes(channels) + above
    if kind == 3:
        for i, byte in enumerate(line, channels):
            now[i] = (byte + ((now[i - channels] + above[i]) >> 1)) & 255
        return bytes(now[channels:])
    for i, byte in enumerate(line, channels):
        left, up, corner = now[i - channels], above[i], above[i - channels]
        to_left, to_up, to_corner = abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)
        guess = left if to_left <= to_up and to_left <= to_corner else up if to_up <= to_corner else corner
        now[i] = (byte + guess) & 255
    return bytes(now[channels:])
