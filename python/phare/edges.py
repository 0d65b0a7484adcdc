"""How far a rig lights the edges of the road, and what it sends to the oncoming lane: on a straight and in four curves.

After the drive test of the IIHS, as far as its text is public: receptors 0.25 m above the road for visibility, 1.10 m for glare, curves of
150 and 250 m (two sources each: summary of the protocol, version II of November 2016, and Brumbelow's slides of 2 November 2016); 5 lx, the
right edge on every approach (the institute's page); glare over the middle of the oncoming lane, and speeds (the slides). Unconfirmed: the
second edge (left edge of the lane in curves, of the road on the straight), glare from 10 to 120 m. By eye: lanes of 3.6 m on a level road,
the car in the middle of its own. Demerits and weights are not public, so this gives distances and lux, and no rating.
"""

from __future__ import annotations

import math
from typing import Sequence

import numpy as np
import pandas as pd

from .errors import BadInput
from .measuring import PathLike, measure
from .rig import Rig

# Radius in m, positive to the left; 0: straight.
APPROACHES: dict[str, float] = {
    "straight": 0.0, "gradual left": 250.0, "gradual right": -250.0, "sharp left": 150.0, "sharp right": -150.0,
}
_MPH_MPS = 0.44704
SPEEDS_MPS: dict[str, float] = {name: (50 if abs(radius_m) == 250.0 else 40) * _MPH_MPS for name, radius_m in APPROACHES.items()}
LANE_M, EDGE_HEIGHT_M, GLARE_HEIGHT_M = 3.6, 0.25, 1.10
_STEP_M, _TO_M = 0.5, 250.0


def along(radius_m: float, distance_m: np.ndarray, aside_m: float, height_m: float) -> np.ndarray:
    """Receptors (x, y, z, nx, ny, nz) beside the way of a car at the origin, so far along it and to its left; they face back
    along the way. radius_m: positive to the left, 0 straight."""
    d = np.asarray(distance_m, float)
    if radius_m == 0.0:
        x, y, heading = d, np.full_like(d, aside_m), np.zeros_like(d)
    else:
        heading = d / radius_m
        x, y = (radius_m - aside_m) * np.sin(heading), radius_m - (radius_m - aside_m) * np.cos(heading)
    return np.column_stack([x, y, np.full_like(d, height_m), -np.cos(heading), -np.sin(heading), np.zeros_like(d)])


def visibility(
    rig: Rig | PathLike, *, beams: Sequence[str] = ("low",), lx: float = 5.0, design: str | None = None
) -> pd.DataFrame:
    """The farthest distance along the way, m from the car's origin, at which an edge has so many lux; 0: nowhere.

    One row an approach and edge: approach, radius_m, edge, distance_m, and open_end where the last distance tried, 250 m, is lit
    still. rig: a Rig, or a rig file; beams, design: of it. In float64.
    """
    if not lx > 0:
        raise BadInput(f"visibility: {lx} lx")
    d = np.arange(5.0, _TO_M + _STEP_M / 2, _STEP_M)
    cases = []
    for name, radius_m in APPROACHES.items():
        left = ("left edge of the road", 1.5 * LANE_M) if radius_m == 0.0 else ("left edge of the lane", 0.5 * LANE_M)
        cases += [(name, radius_m, "right edge", -0.5 * LANE_M), (name, radius_m, *left)]
    points = np.vstack([along(radius_m, d, aside_m, EDGE_HEIGHT_M) for _, radius_m, _, aside_m in cases])
    lux = measure(rig, points, beams=beams, design=design, reference=True).reshape(len(cases), -1)
    rows = []
    for (name, radius_m, edge, _), of_case in zip(cases, lux):
        lit = np.flatnonzero(of_case >= lx)
        far = float(d[lit[-1]]) if lit.size else 0.0
        rows.append([name, radius_m if radius_m else math.inf, edge, far, far == d[-1]])
    return pd.DataFrame(rows, columns=["approach", "radius_m", "edge", "distance_m", "open_end"])


def oncoming_glare(
    rig: Rig | PathLike, *, beams: Sequence[str] = ("low",), design: str | None = None
) -> pd.DataFrame:
    """Lux 1.10 m above the middle of the oncoming lane, from 10 to 120 m: distance_m as index, one column an approach."""
    d = np.arange(10.0, 120.0 + _STEP_M / 2, _STEP_M)
    points = np.vstack([along(radius_m, d, LANE_M, GLARE_HEIGHT_M) for radius_m in APPROACHES.values()])
    lux = measure(rig, points, beams=beams, design=design, reference=True).reshape(len(APPROACHES), -1)
    return pd.DataFrame(lux.T, index=pd.Index(d, name="distance_m"), columns=list(APPROACHES))
