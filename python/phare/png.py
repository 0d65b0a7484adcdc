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
    now = np.zeros_like(line)
    left, corner = np.zeros(line.shape[1], np.int32), np.zeros(line.shape[1], np.int32)
    for x in range(line.shape[0]):
        up = above[x].astype(np.int32)
        if kind == 3:
            guess = (left + up) >> 1
        else:
            near = np.abs(up - corner), np.abs(left - corner), np.abs(left + up - 2 * corner)
            guess = np.where((near[0] <= near[1]) & (near[0] <= near[2]), left, np.where(near[1] <= near[2], up, corner))
        left = (line[x] + guess) & 255
        now[x] = left
        corner = up
    return now
