"""Other road users on their way along the lane, from a TOML file:

    [[road_user]]
    class = "car"             # car, lorry, motorcycle, bicycle, pedestrian, deer
    direction = "oncoming"    # oncoming, same (as we drive) or standing
    start_s_m = 420           # place of its middle along the lane at time 0
    speed_kmh = 80
    offset_m = 3.5            # from the line we drive on, positive left
    across_kmh = 0            # goes across the road, positive to the left, from across_from_s [0] until across_to_s [for ever]
    lights = true             # its lamps burn: true or "low", "high" (high beam besides), false or "off"
    low_beam, high_beam       # photometry files of its headlamps, for the picture: the sensors see that there is light, not how much
    from_s = 0.0              # when it is there, s of simulated time
    to_s = 1e9
    width_m, height_m, length_m   # default: by its class, chosen by eye

The picture shows them where a drive is given the file (docs/traffic.md); they hide nothing. config/traffic/road_users.h reads the same file
with the same meaning; both are held to the figures of tests/traffic/.
"""

from __future__ import annotations

import math
import os
from dataclasses import dataclass, fields

import numpy as np
import pandas as pd

from ..errors import BadInput
from ..toml_in import read_toml

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

    def s_m(self, time_s: float) -> float:
        """Place of its middle along the lane."""
        return self.start_s_m + _DIRECTIONS[self.direction] * self.speed_mps * time_s

    def aside_m(self, time_s: float) -> float:
        """Place beside the lane's line, positive left: its offset, and how far it has gone across."""
        return self.offset_m + self.across_mps * (min(max(time_s, self.across_from_s), self.across_to_s) - self.across_from_s)

    @property
    def heading(self) -> float:
        """1: as the lane goes, -1: against it."""
        return -1.0 if self.direction == "oncoming" else 1.0


_LIGHTS = {"off": False, "low": True, "high": True}
_KEYS = {
    "class": str, "direction": str, "start_s_m": float, "speed_kmh": float, "offset_m": float, "across_kmh": float,
    "across_from_s": float, "across_to_s": float, "lights": bool, "from_s": float,
    "to_s": float, "width_m": float, "height_m": float, "length_m": float, "low_beam": str, "high_beam": str,
}

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
    return [_road_user(table, f"{file}: road_user {number}") for number, table in enumerate(listed, 1)]


def _road_user(table: dict[str, object], place: str) -> RoadUser:
    given: dict[str, object] = {}
    for key, value in table.items():
        if key not in _KEYS:
            raise BadInput(f"{place}: unknown key {key}; there are {', '.join(_KEYS)}")
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
    speed_mps, across_mps = (float(str(given.pop(key, 0.0))) / 3.6 for key in ("speed_kmh", "across_kmh"))
    known = {each.name for each in fields(RoadUser)}
    words = {key: value for key, value in {**size, **given}.items() if key in known}
    if kind in ("pedestrian", "deer"):
        words["lights"] = False
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

    def nearest_s_m(self, x_m: float, y_m: float) -> float | None:
        """Where along the line a place lies, to the nearest point of the file; None when it is more than 15 m off."""
        square = (self.x_m - x_m) ** 2 + (self.y_m - y_m) ** 2
        nearest = int(square.argmin())
        return float(self.s_m[nearest]) if square[nearest] < 15.0**2 else None
