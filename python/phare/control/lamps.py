"""The lamps of a rig as a law knows them: where they sit, and where each source shines."""

from __future__ import annotations

import math
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from numbers import Real
from typing import Any

import numpy as np

from ..lamp import Lamp
from ..rig import Design, LampPlace, Source, resolved
from .messages import LampOfLaw, SourceOfLaw

_READING = ("axis", "c0_deg", "lamp_set", "emitter", "distance_m", "mirror")


@lru_cache(maxsize=4096)
def _window_deg(file: str, changed_ns: int, reading: tuple[tuple[str, Any], ...]) -> tuple[float, float, float, float, float]:
    """Peak in cd, and from where to where (h, then v, degrees) more than a tenth of it shines, by the table's nodes."""
    table = Lamp.read(file, **dict(reading)).table()
    bright = table.intensity_cd > 0.1 * table.intensity_cd.max()
    h, v = table.h_deg[bright.any(axis=0)], table.v_deg[bright.any(axis=1)]
    return float(table.intensity_cd.max()), float(h.min()), float(h.max()), float(v.min()), float(v.max())


def _source(source: Source, aim_deg: float, twin: bool) -> SourceOfLaw:
    file = resolved(source.file)
    reading = tuple((key, source.more[key]) for key in _READING if key in source.more)
    peak, h_from, h_to, v_from, v_to = _window_deg(str(file), file.stat().st_mtime_ns, reading)
    left_deg = (source.yaw_deg or 0.0) * (-1 if twin else 1)
    up_deg = (source.pitch_deg or 0.0) + aim_deg
    rad = math.radians
    return SourceOfLaw(
        source.function, peak * (source.scale if source.scale is not None else 1.0), rad(h_from - left_deg), rad(h_to - left_deg),
        rad(v_from + up_deg), rad(v_to + up_deg),
    )


def lamps_of(design: Design) -> list[LampOfLaw]:
    """In the rig's order. Roll, and an aim by the cut-off, are not in the angles."""
    places: list[tuple[LampPlace, str, bool]] = []
    for lamp in design.lamps:
        names = [(f"{lamp.name} left", False), (f"{lamp.name} right", True)] if lamp.pair else [(lamp.name, False)]
        places += [(lamp, name, twin) for name, twin in names]
    with ThreadPoolExecutor(4) as pool:  # each table is a run of the bench
        list(pool.map(lambda s: _source(s, 0.0, False), [s for lamp in design.lamps for s in lamp.sources]))
    lamps = []
    for lamp, name, twin in places:
        aim_deg = float(lamp.aim) if isinstance(lamp.aim, Real) else 0.0
        x, y, z = np.asarray(lamp.position_m, float)
        lamps.append(LampOfLaw(name, x, -y if twin else y, z, [_source(s, aim_deg, twin) for s in lamp.sources]))
    return lamps
