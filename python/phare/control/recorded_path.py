"""The recorded way of a road user, from a CSV file: config/traffic/recorded_path.h has the columns and the curve between rows, with its source.
Both are held to tests/traffic/path_poses.csv.
"""

from __future__ import annotations

import math
import os
import re
from bisect import bisect_right
from dataclasses import dataclass

from ..errors import BadInput

_FARTHEST_M, _FASTEST_MPS, _LONGEST_S = 1e6, 1000.0 / 3.6, 1e9
_STANDS_MPS = 0.1  # slower, a way has no direction; chosen
_NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")  # as config/formats/csv_table.cpp has it


@dataclass(frozen=True)
class RecordedPath:
    """Rows of time, place and heading: on the lane (s_m, offset_m; heading against its line) or in the world (x_m, y_m)."""

    on_lane: bool
    time_s: tuple[float, ...]
    first_m: tuple[float, ...]
    second_m: tuple[float, ...]
    first_mps: tuple[float, ...]
    second_mps: tuple[float, ...]
    heading_rad: tuple[float, ...]

    @property
    def from_s(self) -> float:
        """Of its first row."""
        return self.time_s[0]

    @property
    def to_s(self) -> float:
        """Of its last row."""
        return self.time_s[-1]

    @classmethod
    def read(cls, file: str | os.PathLike[str]) -> RecordedPath:
        """Time rises from row to row; at least two rows. Raises BadInput with file, line and reason."""
        header_line, columns, rows = _table(file)
        lane, world = {"s_m", "offset_m"} & columns.keys(), {"x_m", "y_m", "heading_rad"} & columns.keys()
        header = f"{file}:{header_line}"
        if "time_s" not in columns:
            raise BadInput(f"{header}: has no column time_s")
        if lane and world:
            raise BadInput(f"{header}: has columns on the lane (s_m, offset_m) and in the world (x_m, y_m, heading_rad); one of both")
        if not lane and not world - {"heading_rad"}:
            raise BadInput(f"{header}: has neither columns s_m and offset_m nor x_m and y_m")
        names = ("s_m", "offset_m") if lane else ("x_m", "y_m")
        for name in names:
            if name not in columns:
                raise BadInput(f"{header}: has no column {name}")
        if len(rows) < 2:
            raise BadInput(f"{file}: a path has at least two rows")
        time, first, second = ([row[columns[name]] for _, row in rows] for name in ("time_s", *names))
        for i, (line, _) in enumerate(rows):
            place = f"{file}:{line}"
            if abs(time[i]) > _LONGEST_S:
                raise BadInput(f"{place}: time_s is outside -1e9 … 1e9")
            if max(abs(first[i]), abs(second[i])) > _FARTHEST_M:
                raise BadInput(f"{place}: a place is outside -1e6 … 1e6 m")
            if i and not time[i] > time[i - 1]:
                raise BadInput(f"{place}: time_s does not rise")
            if i and math.hypot(first[i] - first[i - 1], second[i] - second[i - 1]) > _FASTEST_MPS * (time[i] - time[i - 1]):
                raise BadInput(f"{place}: goes faster than 1000 km/h since the row before")
        first_mps, second_mps = _slopes(time, first), _slopes(time, second)
        heading = [row[columns["heading_rad"]] for _, row in rows] if "heading_rad" in columns else _along_the_way(first_mps, second_mps)
        for i in range(1, len(heading)):
            heading[i] = heading[i - 1] + math.remainder(heading[i] - heading[i - 1], 2.0 * math.pi)
        return cls(bool(lane), *(tuple(each) for each in (time, first, second, first_mps, second_mps, heading)))

    def at(self, time_s: float) -> tuple[float, float, float, float]:
        """Both places in m, heading in rad, speed in m/s; before the first row as there, behind the last as there."""
        then_s = min(max(time_s, self.from_s), self.to_s)
        b = min(bisect_right(self.time_s, then_s), len(self.time_s) - 1)
        a = b - 1
        step = self.time_s[b] - self.time_s[a]
        share = (then_s - self.time_s[a]) / step
        first, first_mps = _hermite(step, share, self.first_m[a], self.first_m[b], self.first_mps[a], self.first_mps[b])
        second, second_mps = _hermite(step, share, self.second_m[a], self.second_m[b], self.second_mps[a], self.second_mps[b])
        heading = self.heading_rad[a] + share * (self.heading_rad[b] - self.heading_rad[a])
        return first, second, heading, math.hypot(first_mps, second_mps)


def _table(file: str | os.PathLike[str]) -> tuple[int, dict[str, int], list[tuple[int, list[float]]]]:
    """Line of the header, its columns, and each row with its line; empty lines and those with # are passed over. As
    config/formats/csv_table.cpp reads it: no cell is quoted."""
    columns: dict[str, int] = {}
    rows: list[tuple[int, list[float]]] = []
    header_line = 1
    try:
        with open(file, encoding="utf-8-sig", newline="\n") as text:
            for line, row in enumerate(text, 1):
                row = row.removesuffix("\n").strip(" \t\r")
                if "\r" in row:
                    raise BadInput(f"{file}:{line}: has carriage returns within; a line ends with a line feed")
                if not row or row.startswith("#"):
                    continue
                cells = [cell.strip(" \t\r") for cell in row.split(",")]
                if not columns:
                    if twice := next((name for i, name in enumerate(cells) if name in cells[:i]), None):
                        raise BadInput(f'{file}:{line}: column "{twice}" comes twice')
                    header_line, columns = line, {name: i for i, name in enumerate(cells)}
                    continue
                if len(cells) != len(columns):
                    raise BadInput(f"{file}:{line}: {len(cells)} cells, the header has {len(columns)}")
                rows.append((line, [_number(cell, f"{file}:{line}") for cell in cells]))
    except BadInput:
        raise
    except (OSError, ValueError) as wrong:
        raise BadInput(f"{file}: cannot be read: {wrong}") from wrong
    if not columns:
        raise BadInput(f"{file}: has no header line")
    return header_line, columns, rows


def _number(cell: str, place: str) -> float:
    value = float(cell) if _NUMBER.fullmatch(cell) else math.nan
    if not math.isfinite(value):
        raise BadInput(f'{place}: "{cell[:40]}" is not a finite number')
    return value


def _slopes(time: list[float], place: list[float]) -> list[float]:
    step = [b - a for a, b in zip(time, time[1:])]
    secant = [(b - a) / h for a, b, h in zip(place, place[1:], step)]
    if len(secant) == 1:
        return [secant[0], secant[0]]
    inner = [_inner(*each) for each in zip(step, step[1:], secant, secant[1:])]
    return [_end(step[0], step[1], secant[0], secant[1]), *inner, _end(step[-1], step[-2], secant[-1], secant[-2])]


def _inner(step_before: float, step_behind: float, before: float, behind: float) -> float:
    if before * behind <= 0.0:
        return 0.0
    w, v = 2.0 * step_behind + step_before, step_behind + 2.0 * step_before
    return (w + v) / (w / before + v / behind)


def _end(step_near: float, step_far: float, near: float, far: float) -> float:
    slope = ((2.0 * step_near + step_far) * near - step_near * far) / (step_near + step_far)
    if slope * near <= 0.0:
        return 0.0
    return 3.0 * near if near * far <= 0.0 and abs(slope) > 3.0 * abs(near) else slope


def _along_the_way(first_mps: list[float], second_mps: list[float]) -> list[float]:
    """Who stands looks as he came; before he first moves, as he will go; who never moves, along the first axis."""
    ways = [math.atan2(b, a) if math.hypot(a, b) >= _STANDS_MPS else None for a, b in zip(first_mps, second_mps)]
    heading = next((way for way in ways if way is not None), 0.0)
    found = []
    for way in ways:
        heading = heading if way is None else way
        found.append(heading)
    return found


def _hermite(step: float, share: float, a: float, b: float, slope_a: float, slope_b: float) -> tuple[float, float]:
    secant = (b - a) / step
    square = (3.0 * secant - 2.0 * slope_a - slope_b) * step
    cube = (slope_a + slope_b - 2.0 * secant) * step
    value = a + share * (slope_a * step + share * (square + share * cube))
    return value, slope_a + share * (2.0 * square + share * 3.0 * cube) / step
