"""Lane projection: a pixel light draws the edges of the own lane onto the road ahead."""

from __future__ import annotations

import math
import os
import tempfile
from pathlib import Path

import numpy as np

from ..control.controller import Controller
from ..control.messages import Answer, Given, LampLight, LampOfLaw, lane_aside_m


class LaneProjection(Controller):
    """Two lines on the road, along the lane ahead, brighter than what is around them.

    lamp: with a pixel light. columns, rows: its raster, which fills h_deg and v_deg evenly (its table's angles) and is turned up by
    up_deg (the source's pitch). from_m, to_m: ahead of the lamp; half_width_m: of the lines from the lane's middle; line_m: how wide
    they are. line_01, road_01, above_01: shares of full light of the lines, of the road beside them, and above the horizon. The lane
    is where the map's curvature ahead has it (straight without a map), the road a plane; sizes chosen by eye. Answers with
    frames in /dev/shm, one file a law. What it does well and not: docs/laws.md.
    """

    def __init__(
        self, lamp: str = "headlamp left", *, columns: int, rows: int, h_deg: tuple[float, float], v_deg: tuple[float, float],
        up_deg: float = 0.0, from_m: float = 8.0, to_m: float = 35.0, half_width_m: float = 1.1, line_m: float = 0.2,
        line_01: float = 1.0, road_01: float = 0.3, above_01: float = 0.6,
    ):
        if columns < 2 or rows < 2 or not (h_deg[0] < h_deg[1] and v_deg[0] < v_deg[1]):
            raise ValueError("a raster of 2 x 2 pixels at least, its angles ascending")
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
        ahead_m = np.where(meets, place.z_m / np.where(meets, self._down, 1.0), np.inf)
        for row in np.flatnonzero((ahead_m >= self.from_m) & (ahead_m <= self.to_m)):
            aside_m = place.y_m + ahead_m[row] * self._left - lane_aside_m(given.ahead, place.x_m + ahead_m[row])
            picture[row, np.abs(np.abs(aside_m) - self.half_width_m) <= self.line_m / 2] = line
        return picture

    def step(self, given: Given) -> Answer:
        if self._place is None or self._folder is None:
            return Answer()
        file = Path(self._folder.name) / "lane.pgm"
        beside = file.with_suffix(".new")
        beside.write_bytes(b"P5 %d %d 255\n" % (self.columns, self.rows) + self.draw(given, self._place).tobytes())
        beside.replace(file)  # never half a picture
        return Answer(lamps={self.lamp: LampLight(frame=str(file))})
