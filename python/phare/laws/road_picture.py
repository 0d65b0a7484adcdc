"""What a pixel light draws onto the road ahead: the edges of the own lane, a symbol in it."""

from __future__ import annotations

import math
import os
import tempfile
from pathlib import Path
from typing import Any, Iterator

import numpy as np

from ..control.controller import Controller
from ..control.messages import Answer, Given, LampLight, LampOfLaw, lane_aside_m
from ..errors import BadInput
from .checks import not_negative, share_01


class LaneProjection(Controller):
    """Two lines on the road, along the lane ahead, brighter than what is around them.

    lamp: with a pixel light. columns, rows: its raster, which fills h_deg and v_deg evenly (its table's angles) and is turned up by
    up_deg (the source's pitch). from_m, to_m: ahead of the lamp; half_width_m: of the lines from the lane's middle; line_m: how wide
    they are, 0 for none. line_01, road_01, above_01: shares of full light of the lines, of the road beside them, and above the horizon. The lane
    is where the map's curvature ahead has it (straight without a map), the road a plane; sizes chosen by eye. Answers with
    frames in /dev/shm, one file a law. What it does well and not: docs/laws.md.
    """

    def __init__(
        self, lamp: str = "headlamp left", *, columns: int, rows: int, h_deg: tuple[float, float], v_deg: tuple[float, float],
        up_deg: float = 0.0, from_m: float = 8.0, to_m: float = 35.0, half_width_m: float = 1.1, line_m: float = 0.2,
        line_01: float = 1.0, road_01: float = 0.3, above_01: float = 0.6,
    ):
        if columns < 2 or rows < 2 or not (h_deg[0] < h_deg[1] and v_deg[0] < v_deg[1]):
            raise BadInput("a raster of 2 x 2 pixels at least, its angles ascending")
        name = type(self).__name__
        share_01(name, line_01=line_01, road_01=road_01, above_01=above_01)
        not_negative(name, from_m=from_m, to_m=to_m, half_width_m=half_width_m, line_m=line_m)
        if not math.isfinite(up_deg):
            raise BadInput(f"{name}: up_deg is {up_deg}")
        self.lamp, self.columns, self.rows = lamp, columns, rows
        self.from_m, self.to_m, self.half_width_m, self.line_m = from_m, to_m, half_width_m, line_m
        self.shares = [round(255 * share) for share in (line_01, road_01, above_01)]
        h = np.radians(h_deg[0] + (h_deg[1] - h_deg[0]) * (np.arange(columns) + 0.5) / columns)
        v = np.radians(v_deg[1] - (v_deg[1] - v_deg[0]) * (np.arange(rows) + 0.5) / rows) + math.radians(up_deg)
        self._down = np.tan(-v)  # of a row, > 0 meets the road
        self._left = -np.tan(h)  # of a column
        self._folder: tempfile.TemporaryDirectory | None = None
        self._place: LampOfLaw | None = None

    def begin(self, lamps: list[LampOfLaw]) -> None:
        self._place = next((lamp for lamp in lamps if lamp.lamp == self.lamp), None)
        if self._place is None:
            names = ", ".join(lamp.lamp for lamp in lamps)
            raise BadInput(f"{type(self).__name__}: no lamp {self.lamp!r}: the design has {names}")
        if self._folder is None:
            memory = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
            self._folder = tempfile.TemporaryDirectory(prefix="phare-lane-", dir=memory)

    def end(self) -> None:
        if self._folder is not None:
            self._folder.cleanup()
            self._folder = None

    def draw(self, given: Given, place: LampOfLaw) -> np.ndarray:
        """The picture, uint8 [row][column] from above."""
        line, road, above = self.shares
        picture = np.full((self.rows, self.columns), above, dtype=np.uint8)
        meets = self._down > 1e-4
        picture[meets] = road
        if self.line_m > 0:
            for row, ahead_m in self._rows(place, self.from_m, self.to_m):
                off_m = np.abs(np.abs(self._aside_m(given, place, ahead_m)) - self.half_width_m)
                picture[row, off_m <= self.line_m / 2] = line
        return picture

    def _rows(self, place: LampOfLaw, from_m: float, to_m: float) -> Iterator[tuple[int, float]]:
        """Rows that meet the road so far ahead of the lamp, and where."""
        meets = self._down > 1e-4
        ahead_m = np.where(meets, place.z_m / np.where(meets, self._down, 1.0), np.inf)
        for row in np.flatnonzero((ahead_m >= from_m) & (ahead_m <= to_m)):
            yield int(row), float(ahead_m[row])

    def _aside_m(self, given: Given, place: LampOfLaw, ahead_m: float) -> np.ndarray:
        """Of a row's columns, to the left of the lane's middle."""
        return place.y_m + ahead_m * self._left - lane_aside_m(given.ahead, place.x_m + ahead_m)

    def step(self, given: Given) -> Answer:
        if self._place is None or self._folder is None:
            return Answer()
        file = Path(self._folder.name) / "lane.pgm"
        beside = file.with_suffix(".new")
        beside.write_bytes(b"P5 %d %d 255\n" % (self.columns, self.rows) + self.draw(given, self._place).tobytes())
        beside.replace(file)  # never half a picture
        return Answer(lamps={self.lamp: LampLight(frame=str(file))})


class SymbolProjection(LaneProjection):
    """A symbol on the own lane, drawn as a driver reads paint on the road, and the lane's edges where line_m is more than 0.

    symbol: shares of full light, 0 to 1, [row][column], its top farthest away; at_m: ahead of the lamp, where it begins; length_m along the
    lane and width_m across; painted bilinear. Everything else as LaneProjection has it.
    """

    def __init__(
        self, lamp: str = "headlamp left", *, symbol: np.ndarray | None = None, at_m: float = 14.0, length_m: float = 10.0,
        width_m: float = 1.4, line_m: float = 0.0, **words: Any,
    ):
        super().__init__(lamp, line_m=line_m, **words)
        self.symbol = arrow() if symbol is None else np.asarray(symbol, float)
        if self.symbol.ndim != 2 or min(self.symbol.shape) < 2 or not ((self.symbol >= 0) & (self.symbol <= 1)).all():
            raise BadInput("a symbol is a table of shares, 0 to 1, of 2 x 2 at least")
        if not (at_m > 0 and length_m > 0 and width_m > 0):
            raise BadInput("at_m, length_m and width_m are more than 0")
        self.at_m, self.length_m, self.width_m = at_m, length_m, width_m

    def draw(self, given: Given, place: LampOfLaw) -> np.ndarray:
        picture = super().draw(given, place)
        line, road, _ = (float(share) for share in self.shares)
        high, wide = self.symbol.shape
        for row, ahead_m in self._rows(place, self.at_m, self.at_m + self.length_m):
            down = (1.0 - (ahead_m - self.at_m) / self.length_m) * high - 0.5
            along = (0.5 - self._aside_m(given, place, ahead_m) / self.width_m) * wide - 0.5
            inside = (along > -0.5) & (along < wide - 0.5)
            above = min(max(int(math.floor(down)), 0), high - 2)
            share = min(max(down - above, 0.0), 1.0)
            of_row = (1 - share) * self.symbol[above] + share * self.symbol[above + 1]
            drawn = np.interp(along[inside], np.arange(wide), of_row)
            picture[row, inside] = np.maximum(picture[row, inside], np.round(road + (line - road) * drawn)).astype(np.uint8)
        return picture


def arrow(turn_deg: float = 0.0, size: int = 64) -> np.ndarray:
    """An arrow straight on, turned to the left by turn_deg: shares 0 and 1, size x size. Its shape is chosen by eye."""
    at = (np.arange(size) + 0.5) / size - 0.5
    x, y = np.meshgrid(at, -at)  # right, up
    turn = math.radians(turn_deg)
    x, y = x * math.cos(turn) + y * math.sin(turn), y * math.cos(turn) - x * math.sin(turn)
    shaft = (np.abs(x) < 0.09) & (y > -0.45) & (y < 0.1)
    head = (y >= 0.1) & (y < 0.45) & (np.abs(x) < 0.3 * (0.45 - y) / 0.35)
    return (shaft | head).astype(float)
