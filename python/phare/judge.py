"""Judges a drive by the light at the eyes and mirrors of other road users (docs/laws.md).

Limits: FMVSS 108 S9.4.1.6, Table XXI, lux at the receptor from the whole vehicle, by range; one source each but the last bin's, which has
two. They belong to track tests with fixtures whose receptors are prescribed; here receptors sit where a driver's eyes and a car's mirrors
are by eye, and every moment of any drive counts. So this compares laws, and approves none. Shadows are left out, but for the road's
own crests.
"""

from __future__ import annotations

import html
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Sequence

import numpy as np
import pandas as pd

from .control.road_users import Lane, RoadUser
from .control.sensors import Eyes, Pose, Sensors
from .drive import Report
from .errors import BadInput
from .light_in_drive import lux_in_drive
from .rig import Rig, resolved

# Range from, to in m; limit in lx for oncoming and for preceding drivers (None: there is no limit).
LIMITS: tuple[tuple[float, float, float, float | None], ...] = (
    (15.0, 30.0, 3.1, 18.9),
    (30.0, 60.0, 1.8, 18.9),
    (60.0, 120.0, 0.6, 4.0),
    (120.0, 220.0, 0.3, None),
)
# Of the body's middle: along its heading, to its left, above the road; m. A driver's eyes in a car that keeps right, and the
# three mirrors of one that drives before us. Chosen by eye.
EYES_M = ((0.0, 0.35, 1.2),)
MIRRORS_M = ((0.6, 0.0, 1.25), (0.8, 0.95, 1.0), (0.8, -0.95, 1.0))


def limit_lx(range_m: float, oncoming: bool) -> float | None:
    """The limit at this range; None where there is none."""
    for from_m, to_m, towards, before in LIMITS:
        if from_m <= range_m < to_m or range_m == to_m == 220.0:
            return towards if oncoming else before
    return None


@dataclass(frozen=True)
class Glare:
    """Light at other road users over a drive."""

    moments: pd.DataFrame  # time_s, user (from 1), oncoming, range_m, lx (the brightest of its receptors), limit_lx, above
    bins: pd.DataFrame  # of each of LIMITS and direction: the most lux, rounded to 0.1 as the rule does, limit, passed
    above_s: float  # seconds in which anybody is above a limit
    judged_s: float  # seconds in which anybody is where a limit holds

    def write_page(self, file: str | Path, title: str = "Light at other road users") -> None:
        """Lux over range for each road user, with the limits, and the table of bins; a page of its own."""
        plots = "".join(_plot(of_user, f"road user {user}") for user, of_user in self.moments.groupby("user"))
        table = self.bins.to_html(index=False, na_rep="–", float_format=lambda value: f"{value:.2f}")
        Path(file).write_text(
            f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>{html.escape(title)}</title></head>'
            f'<body style="font:15px sans-serif;margin:2rem"><h1>{html.escape(title)}</h1><p>Above a limit for {self.above_s:.2f} s '
            f"of {self.judged_s:.2f} s in which one holds. Limits: FMVSS 108 Table XXI; receptors and course are not those of "
            f"its track tests, so this compares, and approves nothing.</p>{plots}{table}</body></html>\n"
        )


def judge_glare(report: Report, rig: Rig, road_users: Sequence[RoadUser], design: str | None = None) -> Glare:
    """Lux at every road user in every frame of a recorded lockstep drive, by the lamps as the control law, or without one the
    stalk, had them.

    rig: that was driven; design: of it [its first]. Illuminance is by `phare measure` in float64, source by source.
    """
    car = report.car
    lane_file = resolved(rig.scene)
    lane = Lane(lane_file.with_name(lane_file.stem + "_lane.csv"))
    frames = car.frame_index.to_numpy()
    if (frames < 0).any():
        raise BadInput(f"{report.folder}: a drive in real time has no frames that car, controls and law share: drive in lockstep")
    lit = rig.design(design) if design else rig.designs[0]
    rows = _receptors(car, lane, road_users)
    if rows.empty:
        return Glare(rows.assign(lx=[], limit_lx=[], above=[]), _bins(rows.assign(lx=[])), 0.0, 0.0)
    rows["lx"] = lux_in_drive(rows, report, rig, lit)
    keys = ["frame", "time_s", "user", "oncoming"]
    moments = rows.groupby(keys, as_index=False).agg(range_m=("range_m", "min"), lx=("lx", "max"))
    moments["limit_lx"] = [limit_lx(r, o) or float("nan") for r, o in zip(moments.range_m, moments.oncoming)]
    moments["above"] = moments.lx.round(1) > moments.limit_lx
    judged = moments[moments.limit_lx.notna()]
    step_s = 1.0 / rig.frame_rate_hz
    above_s = judged[judged.above].frame.nunique() * step_s
    return Glare(moments.drop(columns="frame"), _bins(moments), above_s, judged.frame.nunique() * step_s)


def _receptors(car: pd.DataFrame, lane: Lane, users: Sequence[RoadUser]) -> pd.DataFrame:
    """A row a receptor and frame: place and normal in the car's frame."""
    eyes, found = Eyes(Sensors(users), lane), []
    for time_s, state in car.iterrows():
        pose = Pose(state.x_m, state.y_m, state.z_m, state.roll_rad, state.pitch_rad, state.yaw_rad)
        origin, turn = np.array([state.x_m, state.y_m, state.z_m]), pose.car_from_world()
        ego_s_m = lane.nearest_s_m(state.x_m, state.y_m)
        for number, user in enumerate(users, 1):
            there = lane.at(user.s_m(float(time_s)), user.aside_m(float(time_s)))
            if user.direction == "standing" or there is None or not user.from_s <= float(time_s) <= user.to_s:
                continue
            place, lane_heading = there
            heading = lane_heading + (math.pi if user.heading < 0 else 0.0)
            along = np.array([math.cos(heading), math.sin(heading), 0.0])
            left = np.array([-math.sin(heading), math.cos(heading), 0.0])
            oncoming = float(np.dot(along, origin - place)) > 0
            if ego_s_m is not None and eyes._behind_a_crest(ego_s_m, user.s_m(float(time_s)), pose, place[2] + 1.2):
                continue
            for a, b, up in EYES_M if oncoming else MIRRORS_M:
                at = turn @ (place + a * along + b * left + np.array([0, 0, up]) - origin)
                normal = turn @ (along if oncoming else -along)
                if at[0] > 4.0:
                    found.append([int(state.frame_index), float(time_s), number, oncoming, *at, *normal])
    columns = ["frame", "time_s", "user", "oncoming", "x", "y", "z", "nx", "ny", "nz"]
    rows = pd.DataFrame(found, columns=columns)
    rows["range_m"] = np.hypot(rows.x - 3.45, rows.y) if len(rows) else []
    return rows


def _bins(moments: pd.DataFrame) -> pd.DataFrame:
    rows = []
    for from_m, to_m, towards, before in LIMITS:
        for oncoming, limit in ((True, towards), (False, before)):
            there = moments[(moments.oncoming == oncoming) & (moments.range_m >= from_m) & (moments.range_m < to_m)]
            most = round(float(there.lx.max()), 1) if len(there) else float("nan")
            passed = None if limit is None or most != most else most <= limit
            who = "oncoming" if oncoming else "preceding"
            rows.append([who, from_m, to_m, most, limit if limit is not None else float("nan"), passed])
    return pd.DataFrame(rows, columns=["receptor", "from_m", "to_m", "most_lx", "limit_lx", "passed"])


def _plot(moments: pd.DataFrame, title: str) -> str:
    """Lux over range on a logarithmic scale of lux, 0.01 to 100; the limit as a line."""

    def at(range_m: float, lx: float) -> str:
        return f"{60 + range_m / 220 * 520:.1f},{20 + (2 - math.log10(min(max(lx, 0.01), 100.0))) * 50:.1f}"

    near = moments[moments.range_m <= 220].sort_values("time_s")
    line = " ".join(at(r, lx) for r, lx in zip(near.range_m, near.lx))
    oncoming = bool(moments.oncoming.iloc[0])
    limits = "".join(
        f'<path d="M{at(a, towards if oncoming else before or 0)} L{at(b, towards if oncoming else before or 0)}"/>'
        for a, b, towards, before in LIMITS
        if oncoming or before is not None
    )
    ticks = "".join(f'<text x="52" y="{24 + (2 - e) * 50}" text-anchor="end">{10.0**e:g}</text>' for e in (-2, -1, 0, 1, 2))
    ranges = "".join(f'<text x="{60 + r / 220 * 520:.0f}" y="236" text-anchor="middle">{r}</text>' for r in (0, 60, 120, 180, 220))
    return (
        f'<h2>{html.escape(title)}, {"oncoming" if oncoming else "preceding"}</h2><svg width="620" height="250" font-size="12">'
        f'<path d="M60 20V220H580" fill="none" stroke="#555"/><g stroke="#b00" stroke-width="2">{limits}</g>'
        f'<polyline points="{line}" fill="none" stroke="#2a6f97" stroke-width="2"/>{ticks}{ranges}'
        f'<text x="64" y="16">lx</text><text x="600" y="236">m</text></svg>'
    )
