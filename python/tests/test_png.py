"""unit: PNG of every filter, against pixels that were written by hand."""

import struct
import zlib

import numpy as np
import pytest

import phare
from phare.png import read_png


def write_png(file, pixels: np.ndarray, kinds, depth=8) -> None:
    """Each row with the filter of `kinds`, as PNG 1.2, 6.2 to 6.6, defines them."""
    height, width, channels = pixels.shape
    rows, above = b"", np.zeros(width * channels, int)
    for y in range(height):
        line = pixels[y].reshape(-1).astype(int)
        left = np.concatenate([np.zeros(channels, int), line[:-channels]])
        corner = np.concatenate([np.zeros(channels, int), above[:-channels]])
        p = left + above - corner
        near = np.stack([abs(p - left), abs(p - above), abs(p - corner)])
        paeth = np.choose(near.argmin(axis=0), [left, above, corner])
        guess = [0 * line, left, above, (left + above) // 2, paeth][kinds[y % len(kinds)]]
        rows += bytes([kinds[y % len(kinds)]]) + ((line - guess) % 256).astype(np.uint8).tobytes()
        above = line

    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    colour = {1: 0, 2: 4, 3: 2, 4: 6}[channels]
    header = struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, 0)
    file.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")
    )


@pytest.mark.parametrize("channels", [1, 3, 4])
@pytest.mark.parametrize("kinds", [[0], [1], [2], [3], [4], [4, 0, 3, 1, 2]])
def test_pixels_come_back(tmp_path, channels, kinds):
    pixels = np.random.default_rng(1).integers(0, 256, (9, 14, channels), dtype=np.uint8)
    write_png(tmp_path / "a.png", pixels, kinds)
    np.testing.assert_array_equal(read_png(tmp_path / "a.png"), pixels)


def test_what_is_not_read_is_said(tmp_path):
    (tmp_path / "a.png").write_bytes(b"GIF89a")
    with pytest.raises(phare.BadInput, match="a.png: no PNG"):
        read_png(tmp_path / "a.png")
    write_png(tmp_path / "b.png", np.zeros((1, 1, 3), np.uint8), [0], depth=16)
    with pytest.raises(phare.BadInput, match="8 bits"):
        read_png(tmp_path / "b.png")
