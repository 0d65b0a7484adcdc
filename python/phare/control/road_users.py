"""Other road users on their way along the lane, from a TOML file:

    [[road_user]]
    class = "car"             # car, lorry, motorcycle, bicycle, pedestrian, deer
    direction = "oncoming"    # oncoming, same (as we drive) or standing
    start_s_m = 420           # place of its middle along the lane at time 0
    speed_kmh = 80
    offset_m = 3.5            # from the line we drive on, positive left
    across_kmh = 0            # goes across the road, positive to the left, from across_from_s [0] until across_to_s [for ever]
    lights = true             # its lamps burn: true or "low", "high" (high beam besides), false or "off"
    brake = true              # its brake lamps burn, or (false) do not; without the key as it slows down
    low_beam, high_beam       # photometry files of its headlamps, for the picture: the sensors see that there is light, not how much
    tail_lamp, brake_lamp, third_brake_lamp     # the same of the lamps at its back; each a file or a table of file and colour
    speeds = [[0, 80], [5, 80], [8, 40]]   # in place of speed_kmh: s and km/h, straight between them
    path = "lead.csv"         # in place of direction, start_s_m, speeds, offset_m, across_*: its recorded way (recorded_path.py)
    from_s = 0.0              # when it is there, s of simulated time
    to_s = 1e9
    width_m, height_m, length_m   # default: by its class, chosen by eye

The picture shows them where a drive is given the file (docs/traffic.md); they hide nothing. config/traffic/road_users.h reads the same file
with the same meaning; both are held to the figures of tests/traffic/.
"""

from __future__ import annotations

import math
import os
from bisect import bisect_right
from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np
import pandas as pd

from ..errors import BadInput
from ..rig import resolved
from ..toml_in import place_in, read_toml
from .recorded_path import RecordedPath

# Width, height, length in m: usual sizes, chosen by eye.
SIZES_M = {
    "car": (1.8, 1.5, 4.3),
    "lorry": (2.5, 3.6, 10.0),
    "motorcycle": (0.8, 1.4, 2.1),
    "bicycle": (0.6, 1.7, 1.8),
    "pedestrian": (0.5, 1.75, 0.4),
    "deer": (0.3, 1.1, 1.2),
}
_DIRECTIONS = {"oncoming": -1.0, "same": 1.0, "standing": 0.0}
_MOTORS = ("car", "lorry", "motorcycle")
# Brake lamps burn while it loses more than 0.7 m/s² in the mean of half a second: config/traffic/road_users.h has the sources.
BRAKES_MPS2, BRAKES_WITHIN_S = 0.7, 0.5


@dataclass(frozen=True)
class RoadUserPose:
    """World frame, m, rad: the middle of its length and width on the road's line; heading is the way it looks. s_m and z of a way in the
    world are those of the lane where it comes nearest."""

    place_m: np.ndarray
    s_m: float
    heading_rad: float
    speed_mps: float
    brakes: bool

    @property
    def along(self) -> np.ndarray:
        """The way it looks, level."""
        return np.array([math.cos(self.heading_rad), math.sin(self.heading_rad), 0.0])


@dataclass(frozen=True)
class RoadUser:
    """One road user, whose place is a function of time alone."""

    kind: str = "car"
    direction: str = "oncoming"
    start_s_m: float = 0.0
    speed_mps: float = 0.0
    offset_m: float = 0.0
    across_mps: float = 0.0
    across_from_s: float = 0.0
    across_to_s: float = math.inf
    lights: bool = True
    from_s: float = 0.0
    to_s: float = math.inf
    width_m: float = 1.8
    height_m: float = 1.5
    length_m: float = 4.3
    speeds: tuple[tuple[float, float], ...] = ()  # s and m/s, in place of speed_mps
    path: RecordedPath | None = None  # in place of all that says where it is
    brake: bool | None = None

    def pose(self, lane: Lane, time_s: float) -> RoadUserPose | None:
        """Where it is; None while it is not there."""
        if not self.from_s <= time_s <= self.to_s:
            return None
        if self.path is not None:
            return self._on_path(self.path, lane, time_s)
        along = _DIRECTIONS[self.direction]
        speed, way_m = (_speed_mps(self.speeds, time_s), _way_m(self.speeds, time_s)) if self.speeds else (self.speed_mps, self.speed_mps * time_s)
        across_s = min(max(time_s, self.across_from_s), self.across_to_s) - self.across_from_s
        s_m = self.start_s_m + along * way_m
        found = lane.at(s_m, self.offset_m + self.across_mps * across_s)
        if found is None:
            return None
        goes_across = self.across_mps != 0.0 and self.across_from_s <= time_s < self.across_to_s
        # Looks along its way; who stands until it goes across looks across before and after it too.
        turn = math.pi if self.direction == "oncoming" else 0.0
        if goes_across or (self.across_mps != 0.0 and not self.speeds and along * speed == 0.0):
            turn = math.atan2(self.across_mps, along * speed)
        now_mps = math.hypot(along * speed, self.across_mps if goes_across else 0.0)
        return RoadUserPose(found[0], s_m, found[1] + turn, now_mps, self.brakes(time_s))

    def brakes(self, time_s: float) -> bool:
        """Whether its brake lamps burn."""
        if self.kind not in _MOTORS:
            return False
        if self.brake is not None:
            return self.brake
        from_s, to_s = time_s - 0.5 * BRAKES_WITHIN_S, time_s + 0.5 * BRAKES_WITHIN_S
        if self.path is not None:
            from_s, to_s = max(from_s, self.path.from_s), min(to_s, self.path.to_s)
            return self.path.at(from_s)[3] - self.path.at(to_s)[3] > BRAKES_MPS2 * (to_s - from_s)
        return bool(self.speeds) and _speed_mps(self.speeds, from_s) - _speed_mps(self.speeds, to_s) > BRAKES_MPS2 * (to_s - from_s)

    def _on_path(self, path: RecordedPath, lane: Lane, time_s: float) -> RoadUserPose | None:
        first, second, heading, speed = path.at(time_s)
        if path.on_lane:
            found = lane.at(first, second)
            return None if found is None else RoadUserPose(found[0], first, found[1] + heading, speed, self.brakes(time_s))
        s_m, z_m = lane.nearest(first, second)
        return RoadUserPose(np.array([first, second, z_m]), s_m, heading, speed, self.brakes(time_s))


def _speed_mps(speeds: tuple[tuple[float, float], ...], time_s: float) -> float:
    """Straight between the times, before the first and behind the last as there."""
    behind = bisect_right(speeds, time_s, key=lambda at: at[0])
    if behind == 0:
        return speeds[0][1]
    (a_s, a), (b_s, b) = speeds[behind - 1], speeds[min(behind, len(speeds) - 1)]
    return a if behind == len(speeds) else a + (b - a) / (b_s - a_s) * (time_s - a_s)


def _way_m(speeds: tuple[tuple[float, float], ...], time_s: float) -> float:
    """How far it has come since time 0: the integral of its speeds."""

    def since_first_m(until_s: float) -> float:
        m = min(until_s - speeds[0][0], 0.0) * speeds[0][1]
        for (a_s, a), (b_s, b) in zip(speeds, speeds[1:]):
            if until_s > a_s:
                here_s = min(until_s, b_s) - a_s
                m += (a + 0.5 * (b - a) / (b_s - a_s) * here_s) * here_s
        return m + max(until_s - speeds[-1][0], 0.0) * speeds[-1][1]

    return since_first_m(time_s) - since_first_m(0.0)


_LIGHTS = {"off": False, "low": True, "high": True}
_KEYS = {
    "class": str, "direction": str, "start_s_m": float, "speed_kmh": float, "offset_m": float, "across_kmh": float,
    "across_from_s": float, "across_to_s": float, "lights": bool, "from_s": float,
    "to_s": float, "width_m": float, "height_m": float, "length_m": float, "brake": bool, "speeds": list, "path": str,
}
# For the picture, which reads their files and colours (docs/traffic.md): a file's name or a table.
_LAMPS = ("low_beam", "high_beam", "tail_lamp", "brake_lamp", "third_brake_lamp")
_OF_LAMP = ("file", "colour_temperature_k", "chromaticity_xy", "spectrum")
_COOLEST_K, _HOTTEST_K = 1667.0, 25000.0  # of a source, as config/rig.h has them
_NOT_WITH_PATH = ("direction", "start_s_m", "speed_kmh", "speeds", "offset_m", "across_kmh", "across_from_s", "across_to_s")

# Bounds that no road reaches, as in config/traffic/road_users.cpp: they catch a mistyped exponent.
_RANGES = {
    "start_s_m": (-1e6, 1e6), "speed_kmh": (0.0, 1000.0), "offset_m": (-1e6, 1e6), "across_kmh": (-1000.0, 1000.0),
    "across_from_s": (-1e9, 1e9), "across_to_s": (-1e9, 1e9), "from_s": (-1e9, 1e9), "to_s": (-1e9, 1e9),
    "width_m": (0.01, 100.0), "height_m": (0.01, 100.0), "length_m": (0.01, 100.0),
}


def read_road_users(file: str | os.PathLike[str]) -> list[RoadUser]:
    """Reads such a file; raises BadInput with file, which road user, and reason."""
    document = read_toml(file)
    listed = document.get("road_user")
    if set(document) != {"road_user"} or not isinstance(listed, list) or not all(isinstance(table, dict) for table in listed):
        raise BadInput(f"{file}: expected [[road_user]] and nothing else")
    folder = Path(file).resolve().parent
    users = []
    for number, table in enumerate(listed, 1):
        try:
            users.append(_road_user(table, f"road_user {number}", folder))
        except BadInput as wrong:
            raise BadInput(f"{place_in(file, 'road_user', number)}: {wrong}") from wrong
    return users


def _speeds(table: dict[str, object], place: str) -> tuple[tuple[float, float], ...]:
    rows = table.get("speeds", [])
    number = (int, float)
    assert isinstance(rows, list)
    if "speeds" not in table:
        return ()
    if "speed_kmh" in table:
        raise BadInput(f"{place}: speeds: there is speed_kmh, too; one of both")
    if table.get("direction") == "standing":
        raise BadInput(f"{place}: speeds: who is standing has none")
    if not rows or not all(
        isinstance(row, list) and len(row) == 2 and all(isinstance(x, number) and not isinstance(x, bool) and math.isfinite(x) for x in row) for row in rows
    ):
        raise BadInput(f"{place}: speeds: expected an array of arrays of 2 finite numbers")
    if any(abs(row[0]) > 1e9 for row in rows):
        raise BadInput(f"{place}: speeds: a time is outside -1e9 … 1e9 s")
    if any(not 0.0 <= row[1] <= 1000.0 for row in rows):
        raise BadInput(f"{place}: speeds: a speed is outside 0 … 1000 km/h")
    if any(not after[0] > before[0] for before, after in zip(rows, rows[1:])):
        raise BadInput(f"{place}: speeds: times do not rise")
    return tuple((float(time_s), float(kmh) / 3.6) for time_s, kmh in rows)


def _check_lamp(key: str, value: object, kind: str, place: str, folder: Path) -> None:
    """Raises what config/traffic/road_users.cpp refuses, but for what stands in the files."""
    lit = kind in (*_MOTORS, "bicycle")
    has, lamps = {
        "low_beam": (lit, "headlamps"), "high_beam": (kind in _MOTORS, "high beam" if lit else "headlamps"), "tail_lamp": (lit, "tail lamps"),
        "brake_lamp": (kind in _MOTORS, "brake lamps"), "third_brake_lamp": (kind == "car", "third brake lamp"),
    }[key]
    if not has:
        raise BadInput(f"{place}: {key}: a {kind} has no {lamps}")
    if not isinstance(value, str | dict):
        raise BadInput(f"{place}: {key} = {value!r}: expected the name of a file, or a table of {', '.join(_OF_LAMP)}")
    lamp: dict[str, object] = value if isinstance(value, dict) else {"file": value}
    for unknown in set(lamp) - set(_OF_LAMP):
        raise BadInput(f"{place}: {key}: unknown key {unknown}; there are {', '.join(_OF_LAMP)}")
    for name in ("file", "spectrum"):
        file = lamp.get(name, "-")
        if not isinstance(file, str) or not file:
            raise BadInput(f"{place}: {key}: {name} = {file!r}: expected the name of a file")
        there = resolved(file) if file.startswith("generated/") else folder / file
        if name in lamp and not there.is_file():
            raise BadInput(f"{place}: {key}: {there}: {'is a folder' if there.is_dir() else 'no such file'}")
    colours = [name for name in _OF_LAMP[1:] if name in lamp]
    if len(colours) > 1:
        raise BadInput(f"{place}: {key}: a light has one of {', '.join(colours)}")
    kelvin, xy = lamp.get("colour_temperature_k", _COOLEST_K), lamp.get("chromaticity_xy", [0.3, 0.3])
    if not _is_number(kelvin) or not _COOLEST_K <= float(str(kelvin)) <= _HOTTEST_K:
        raise BadInput(f"{place}: {key}: colour_temperature_k = {kelvin}: expected {_COOLEST_K:g} to {_HOTTEST_K:g}")
    if not isinstance(xy, list) or len(xy) != 2 or not all(map(_is_number, xy)) or xy[0] < 0.0 or xy[1] < 0.01 or xy[0] + xy[1] > 1.0:
        raise BadInput(f"{place}: {key}: chromaticity_xy = {xy}: x and y of CIE 1931: x >= 0, y >= 0.01, x + y <= 1")


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def _road_user(table: dict[str, object], place: str, folder: Path) -> RoadUser:
    given: dict[str, object] = {}
    for key, value in table.items():
        if key in _LAMPS:
            continue  # below, when its class is known
        if key not in _KEYS:
            raise BadInput(f"{place}: unknown key {key}; there are {', '.join([*_KEYS, *_LAMPS])}")
        wanted = _KEYS[key]
        if key == "lights" and isinstance(value, str):
            if value not in _LIGHTS:
                raise BadInput(f"{place}: lights {value}: expected one of {', '.join(_LIGHTS)}")
            value = _LIGHTS[value]
        if wanted is float and isinstance(value, int) and not isinstance(value, bool):
            value = float(value)
        if not isinstance(value, wanted) or (isinstance(value, float) and math.isnan(value)):
            raise BadInput(f"{place}: {key} = {value!r}: expected a {wanted.__name__}")
        given[key] = value
    for key in _NOT_WITH_PATH if "path" in table else ():
        if key in table:
            raise BadInput(f"{place}: {key}: there is a path, too, which says where it is; one of both")
    kind, direction = str(given.pop("class", "car")), str(given.pop("direction", "oncoming"))
    if kind not in SIZES_M:
        raise BadInput(f"{place}: class {kind}: expected one of {', '.join(SIZES_M)}")
    if direction not in _DIRECTIONS:
        raise BadInput(f"{place}: direction {direction}: expected one of {', '.join(_DIRECTIONS)}")
    for key, (least, most) in _RANGES.items():
        if key in table and not least <= float(str(table[key])) <= most:
            why = ": direction says which way it drives" if key == "speed_kmh" else ""
            raise BadInput(f"{place}: {key} = {table[key]}: expected {least:g} to {most:g}{why}")
    size = dict(zip(("width_m", "height_m", "length_m"), SIZES_M[kind]))
    if float(str(table.get("across_to_s", math.inf))) < float(str(table.get("across_from_s", 0.0))):
        raise BadInput(f"{place}: across_to_s = {table['across_to_s']}: expected across_from_s or more")
    if direction == "standing" and float(str(table.get("speed_kmh", 0.0))) != 0.0:
        raise BadInput(f"{place}: speed_kmh: who is standing has none")
    if float(str(table.get("to_s", math.inf))) < float(str(table.get("from_s", 0.0))):
        raise BadInput(f"{place}: to_s = {table['to_s']}: expected from_s or more")
    for key in ("across_from_s", "across_to_s"):
        if key in table and float(str(table.get("across_kmh", 0.0))) == 0.0:
            raise BadInput(f"{place}: {key}: nobody goes across: there is no across_kmh")
    if table.get("lights") == "high" and kind not in _MOTORS:
        raise BadInput(f"{place}: lights: a {kind} has no high beam")
    if kind in ("pedestrian", "deer") and given.get("lights", False):
        raise BadInput(f"{place}: lights: a {kind} has none")
    speed_mps, across_mps = (float(str(given.pop(key, 0.0))) / 3.6 for key in ("speed_kmh", "across_kmh"))
    known = {each.name for each in fields(RoadUser)}
    words = {key: value for key, value in {**size, **given}.items() if key in known}
    if kind in ("pedestrian", "deer"):
        words["lights"] = False
    if "brake" in table and kind not in _MOTORS:
        raise BadInput(f"{place}: brake: a {kind} has no brake lamps")
    for key in _LAMPS:
        if key in table:
            _check_lamp(key, table[key], kind, place, folder)
    words["speeds"] = _speeds(table, place)
    if "path" in table:
        if not table["path"]:
            raise BadInput(f"{place}: path: expected the name of a file")
        try:
            path = RecordedPath.read(folder / str(table["path"]))
        except BadInput as wrong:
            raise BadInput(f"{place}: path: {wrong}") from wrong
        words |= {
            "path": path, "from_s": max(float(str(words.get("from_s", 0.0))), path.from_s), "to_s": min(float(str(words.get("to_s", math.inf))), path.to_s),
        }
    return RoadUser(kind=kind, direction=direction, speed_mps=speed_mps, across_mps=across_mps, **words)  # type: ignore[arg-type]


class Lane:
    """The line we drive on: the CSV beside a scene (config/road/lane.h), or a table of its columns. World frame, m, rad; curvature
    positive left."""

    def __init__(self, file: str | os.PathLike[str] | pd.DataFrame):
        try:
            table = file if isinstance(file, pd.DataFrame) else pd.read_csv(file)
            self.s_m, self.x_m, self.y_m, self.z_m = (table[name].to_numpy(float) for name in ("s_m", "x_m", "y_m", "z_m"))
            self.heading_rad = np.unwrap(table["heading_rad"].to_numpy(float))
            self.curvature_1pm = table["curvature_1pm"].to_numpy(float)
        except (OSError, KeyError, ValueError) as wrong:
            raise BadInput(f"{file}: no lane: {wrong}") from wrong

    def at(self, s_m: float, offset_m: float) -> tuple[np.ndarray, float] | None:
        """Place (x, y, z) beside the line, on the height of the line, and the line's heading; None before and behind it."""
        if not self.s_m[0] <= s_m <= self.s_m[-1]:
            return None
        heading = float(np.interp(s_m, self.s_m, self.heading_rad))
        place = np.array([np.interp(s_m, self.s_m, line) for line in (self.x_m, self.y_m, self.z_m)])
        return place + offset_m * np.array([-math.sin(heading), math.cos(heading), 0.0]), heading

    def nearest(self, x_m: float, y_m: float) -> tuple[float, float]:
        """Where along the line it comes nearest to a place, and how high it is there."""
        along_x, along_y = np.diff(self.x_m), np.diff(self.y_m)
        square = along_x**2 + along_y**2
        foot = ((x_m - self.x_m[:-1]) * along_x + (y_m - self.y_m[:-1]) * along_y) / np.where(square > 0.0, square, 1.0)
        share = np.where(square > 0.0, np.clip(foot, 0.0, 1.0), 0.0)
        off = (self.x_m[:-1] + share * along_x - x_m) ** 2 + (self.y_m[:-1] + share * along_y - y_m) ** 2
        i = int(off.argmin())
        s_m = float(self.s_m[i] + share[i] * (self.s_m[i + 1] - self.s_m[i]))
        return s_m, float(np.interp(s_m, self.s_m, self.z_m))

    def nearest_s_m(self, x_m: float, y_m: float) -> float | None:
        """Where along the line a place lies, to the nearest point of the file; None when it is more than 15 m off."""
        square = (self.x_m - x_m) ** 2 + (self.y_m - y_m) ** 2
        nearest = int(square.argmin())
        return float(self.s_m[nearest]) if square[nearest] < 15.0**2 else None
