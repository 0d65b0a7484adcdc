"""Judges a drive by the light at the eyes and mirrors of other road users (docs/laws.md).

Limits: FMVSS 108 S9.4.1.6, Table XXI, lux at the receptor from the whole vehicle, by range; one source each but the last bin's, which has
two. They belong to track tests with fixtures whose receptors are prescribed; here receptors sit where the eyes and mirrors of RECEPTORS_M
are by eye, and every moment of any drive counts. Who drives or rides is judged; pedestrians and deer are not, for whom the rule has no
limit. So this compares laws, and approves none. Shadows are left out, but for the road's own crests.

UN R123, Table 7, candela, half the sum of both sides, for states of a lamp in the laboratory: one transcription; that UN R149 has the
same is unconfirmed. Here they are held against what shines at a receptor as it passes 50, 100 and 200 m, where it lies within the angles of
the line; elsewhere they say nothing.
"""

from __future__ import annotations

import html
import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Sequence

import numpy as np
import pandas as pd

from .control.road_users import Lane, RoadUser
from .control.sensors import Eyes, Pose, Sensors
from .drive import Report
from .errors import BadInput, told
from .light_in_drive import design_of_frames, lux_in_drive
from .rig import Rig, resolved, rig_of

# Range from, to in m; limit in lx for oncoming and for preceding drivers (None: there is no limit).
LIMITS: tuple[tuple[float, float, float, float | None], ...] = (
    (15.0, 30.0, 3.1, 18.9),
    (30.0, 60.0, 1.8, 18.9),
    (60.0, 120.0, 0.6, 4.0),
    (120.0, 220.0, 0.3, None),
)
# Oncoming, at m, from and to degrees to the right of the car's axis, candela of half the sum of both sides. Traffic on the right.
UN_LINES: tuple[tuple[bool, float, float, float, float], ...] = (
    (True, 50.0, -4.8, -2.0, 625.0),
    (True, 100.0, -2.4, -1.0, 1750.0),
    (True, 200.0, -1.2, -0.5, 5450.0),
    (False, 50.0, -1.7, 1.0, 1850.0),
    (False, 50.0, 1.0, 1.7, 2500.0),
    (False, 100.0, -0.9, 0.5, 5300.0),
    (False, 100.0, 0.5, 0.9, 7000.0),
    (False, 200.0, -0.45, 0.45, 16000.0),
)
Places = tuple[tuple[float, float, float], ...]
# Of the body's middle: along its heading, to its left, above the road; m. A driver's eyes in a car that keeps right, and the
# three mirrors of one that drives before us; those of a lorry are higher, and get less light, so a car's stand for them. Riders sit in the
# middle: a motorcycle has a mirror at each handle, a bicycle none. Chosen by eye.
EYES_M: Places = ((0.0, 0.35, 1.2),)
MIRRORS_M: Places = ((0.6, 0.0, 1.25), (0.8, 0.95, 1.0), (0.8, -0.95, 1.0))
RECEPTORS_M: dict[str, tuple[Places, Places]] = {
    "car": (EYES_M, MIRRORS_M),
    "lorry": (EYES_M, MIRRORS_M),
    "motorcycle": (((0.0, 0.0, 1.35),), ((0.4, 0.4, 1.1), (0.4, -0.4, 1.1))),
    "bicycle": (((0.0, 0.0, 1.55),), ()),
}

_LAMPS_M = (3.45, 0.66)  # of the headlamps: ahead of the rear axle, above the ground; as the shipped rigs have them


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
    un: pd.DataFrame = field(default_factory=pd.DataFrame)  # of each of UN_LINES that anybody has passed: the most candela, limit, passed

    @property
    def share_01(self) -> float:
        """Of the time in which a limit holds, how much of it somebody is above one; NaN where none ever does."""
        return self.above_s / self.judged_s if self.judged_s else float("nan")

    def write_page(self, file: str | Path, title: str = "Light at other road users") -> None:
        """Lux over range for each road user, with the limits, and the table of bins; a page of its own."""
        plots = "".join(_of_user(user, of_user) for user, of_user in self.moments.groupby("user"))
        table = self.bins.to_html(index=False, na_rep="–", float_format=lambda value: f"{value:.2f}")
        un = self.un.to_html(index=False, float_format=lambda value: f"{value:.0f}") if len(self.un) else "<p>Nobody has passed them.</p>"
        page = (
            f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>{html.escape(title)}</title></head>'
            f'<body style="font:15px sans-serif;margin:2rem"><h1>{html.escape(title)}</h1><p>Above a limit for {self.above_s:.2f} s '
            f"of {self.judged_s:.2f} s in which one holds. Limits: FMVSS 108 Table XXI; receptors and course are not those of "
            f"its track tests, so this compares, and approves nothing.</p>{plots}{table}<h2>At 50, 100 and 200 m</h2><p>Candela of half the "
            f"sum of both sides, against UN R123 Table 7 (one transcription; that UN R149 has the same is unconfirmed), whose lines are "
            f"states of a lamp in the laboratory.</p>{un}</body></html>\n"
        )
        with told(file):
            Path(file).write_text(page)


def judge_glare(report: Report, rig: Rig | str | Path, road_users: Sequence[RoadUser], design: str | None = None) -> Glare:
    """Lux at every road user in every frame of a recorded lockstep drive, by the lamps as the control law, or without one the
    stalk, had them.

    rig: that was driven, or its file; design: of it [that was driven]. Illuminance is by `phare measure` in float64, source by source.
    """
    rig, car = rig_of(rig), report.car
    lane_file = resolved(rig.scene)
    lane = Lane(lane_file.with_name(lane_file.stem + "_lane.csv"))
    frames = car.frame_index.to_numpy()
    if (frames < 0).any():
        raise BadInput(f"{report.folder}: a drive in real time has no frames that car, controls and law share: drive in lockstep")
    lit = design_of_frames(report, rig, design)
    rows = receptors_of(car, lane, road_users)
    if rows.empty:
        return Glare(rows.assign(lx=[], limit_lx=[], above=[]), _bins(rows.assign(lx=[])), 0.0, 0.0, _un_table([]))
    rows["lx"] = lux_in_drive(rows, report, rig, lit)
    return judged(rows, 1.0 / rig.frame_rate_hz)


def judged(rows: pd.DataFrame, step_s: float) -> Glare:
    """The judgement of receptors (receptors_of) with their `lx`, in frames of step_s."""
    keys = ["frame", "time_s", "user", "oncoming"]
    moments = rows.groupby(keys, as_index=False).agg(range_m=("range_m", "min"), lx=("lx", "max"))
    moments["limit_lx"] = [limit_lx(r, o) or float("nan") for r, o in zip(moments.range_m, moments.oncoming)]
    moments["above"] = moments.lx.round(1) > moments.limit_lx
    held = moments[moments.limit_lx.notna()]
    above_s = held[held.above].frame.nunique() * step_s
    return Glare(moments.drop(columns="frame"), _bins(moments), above_s, held.frame.nunique() * step_s, _un_lines(rows))


def _un_lines(rows: pd.DataFrame) -> pd.DataFrame:
    """The most candela towards a receptor in the frames between which it passes the distance of a line, within its angles."""
    dx, dy, dz = rows.x - _LAMPS_M[0], rows.y, rows.z - _LAMPS_M[1]
    r = np.sqrt(dx**2 + dy**2 + dz**2)
    cos = -(rows.nx * dx + rows.ny * dy + rows.nz * dz) / r
    seen = rows.assign(cd=rows.lx * r**2 / cos / 2, right_deg=np.degrees(np.arctan2(-dy, dx)))[cos > 0.5]
    found = []
    for oncoming, at_m, from_deg, to_deg, limit_cd in UN_LINES:
        most = []
        for _, one in seen[seen.oncoming == oncoming].sort_values("frame").groupby(["user", "receptor"]):
            near = np.flatnonzero(np.diff(np.sign(one.range_m.to_numpy() - at_m)) != 0)
            around = one.iloc[sorted({*near, *(near + 1)})]
            most += list(around.cd[(around.right_deg > from_deg) & (around.right_deg <= to_deg)])
        if most:
            found.append(["oncoming" if oncoming else "preceding", at_m, from_deg, to_deg, max(most), limit_cd, max(most) <= limit_cd])
    return _un_table(found)


def _un_table(found: list[list[object]]) -> pd.DataFrame:
    return pd.DataFrame(found, columns=["receptor", "at_m", "from_deg", "to_deg", "most_cd", "limit_cd", "passed"])


def receptors_of(car: pd.DataFrame, lane: Lane, users: Sequence[RoadUser]) -> pd.DataFrame:
    """A row a receptor and frame: place and normal in the car's frame. Whose kind has no RECEPTORS_M is nobody to dazzle.

    car: by time_s, frame_index, x_m, y_m, z_m, roll_rad, pitch_rad, yaw_rad.
    """
    eyes, found = Eyes(Sensors(users), lane), []
    for time_s, state in car.iterrows():
        pose = Pose(state.x_m, state.y_m, state.z_m, state.roll_rad, state.pitch_rad, state.yaw_rad)
        origin, turn = np.array([state.x_m, state.y_m, state.z_m]), pose.car_from_world()
        ego_s_m = lane.nearest_s_m(state.x_m, state.y_m)
        for number, user in enumerate(users, 1):
            there = user.pose(lane, float(time_s))
            if user.direction == "standing" or there is None or user.kind not in RECEPTORS_M:
                continue
            place, along = there.place_m, there.along
            left = np.array([-along[1], along[0], 0.0])
            oncoming = float(np.dot(along, origin - place)) > 0
            if ego_s_m is not None and eyes._behind_a_crest(ego_s_m, there.s_m, pose, place[2] + 1.2):
                continue
            for receptor, (a, b, up) in enumerate(RECEPTORS_M[user.kind][0 if oncoming else 1]):
                at = turn @ (place + a * along + b * left + np.array([0, 0, up]) - origin)
                normal = turn @ (along if oncoming else -along)
                if at[0] > 4.0:
                    found.append([int(state.frame_index), float(time_s), number, oncoming, receptor, *at, *normal])
    columns = ["frame", "time_s", "user", "oncoming", "receptor", "x", "y", "z", "nx", "ny", "nz"]
    rows = pd.DataFrame(found, columns=columns)
    rows["range_m"] = np.hypot(rows.x - _LAMPS_M[0], rows.y) if len(rows) else []
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


def _of_user(user: object, moments: pd.DataFrame) -> str:
    oncoming = bool(moments.oncoming.iloc[0])
    return plot(moments, oncoming, f'road user {user}, {"oncoming" if oncoming else "preceding"}')


def plot(moments: pd.DataFrame, oncoming: bool, title: str) -> str:
    """Lux over range on a logarithmic scale of lux, 0.01 to 100, red where above; the limit as a line. An SVG with its heading."""

    def at(range_m: float, lx: float) -> str:
        return f"{60 + range_m / 220 * 520:.1f},{20 + (2 - math.log10(min(max(lx, 0.01), 100.0))) * 50:.1f}"

    near = moments[moments.range_m <= 220].sort_values("time_s")
    line = " ".join(at(r, lx) for r, lx in zip(near.range_m, near.lx))
    above = "".join(f'<circle cx="{x}" cy="{y}" r="2"/>' for x, y in (
        at(r, lx).split(",") for r, lx in zip(near.range_m[near.above], near.lx[near.above])))
    limits = "".join(
        f'<path d="M{at(a, towards if oncoming else before or 0)} L{at(b, towards if oncoming else before or 0)}"/>'
        for a, b, towards, before in LIMITS
        if oncoming or before is not None
    )
    ticks = "".join(f'<text x="52" y="{24 + (2 - e) * 50}" text-anchor="end">{10.0**e:g}</text>' for e in (-2, -1, 0, 1, 2))
    ranges = "".join(f'<text x="{60 + r / 220 * 520:.0f}" y="236" text-anchor="middle">{r}</text>' for r in (0, 60, 120, 180, 220))
    return (
        f'<h2>{html.escape(title)}</h2><svg width="620" height="250" font-size="12">'
        f'<path d="M60 20V220H580" fill="none" stroke="#555"/><g stroke="#b00" stroke-width="2">{limits}</g>'
        f'<polyline points="{line}" fill="none" stroke="#2a6f97" stroke-width="2"/><g fill="#b00">{above}</g>{ticks}{ranges}'
        f'<text x="64" y="16">lx</text><text x="600" y="236">m</text></svg>'
    )
