"""A control law on the eight track tests of FMVSS 108 S9.4.1.6 for adaptive beams: light at a fixture at the roadside, by range.

Directions, radii, speeds, measured ranges and limits: one source, a test laboratory's tooling that cites the CFR of April 2025. Not found in
public text: receptor places, the fixture's lamps, how far beside the lane it stands. So it stands one lane to the left (oncoming) or to the right
(same direction) by eye, its receptors are those of judge.py, and this compares laws and lamps and approves none. Unconfirmed, and not
applied: that being above a limit for 0.1 s or 1 m is ignored.

The course is computed, not driven: a level road, the middle of speeds and radii, a rigid car in the middle of its lane, 60 frames a second. So
nothing pitches, and the rule's filter for pitch has nothing to drop. Lux by `phare measure` in float64, as the law has the lamps in each frame.
"""

from __future__ import annotations

import html
import math
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Callable

import numpy as np
import pandas as pd

from .control.controller import Controller, ended, failed
from .control.lamps import lamps_of
from .control.messages import Given
from .control.road_users import Lane, RoadUser
from .control.sensors import Eyes, Pose, Sensors
from .errors import BadInput, LawFailed, told
from .judge import LIMITS, judged, plot, receptors_of
from .light_in_drive import Lit, lux_by_lamps
from .rig import Rig, rig_of


@dataclass(frozen=True)
class Track:
    """One of the tests. radius_m: from, to, positive to the left; None: straight."""

    oncoming: bool
    radius_m: tuple[float, float] | None
    mph: tuple[float, float]
    measured_m: tuple[float, float]

    @property
    def curvature_1pm(self) -> float:
        """Of the middle of the radii, positive left."""
        return 2.0 / sum(self.radius_m) if self.radius_m else 0.0

    @property
    def speed_mps(self) -> float:
        """The middle of the speeds."""
        return sum(self.mph) / 2 * 0.44704

    @property
    def words(self) -> str:
        """As a table names it."""
        middle_m = abs(1.0 / self.curvature_1pm) if self.radius_m else 0.0
        way = "straight" if not self.radius_m else f"{'left' if self.curvature_1pm > 0 else 'right'} {middle_m:.0f} m"
        return f"{'oncoming' if self.oncoming else 'same direction'}, {way}, {self.speed_mps * 3.6:.0f} km/h"


TRACKS = (
    Track(True, None, (60, 70), (15, 220)),
    Track(True, (85, 115), (25, 30), (15, 60)),
    Track(True, (210, 250), (40, 45), (15, 150)),
    Track(True, (335, 400), (50, 55), (15, 220)),
    Track(True, (-210, -250), (40, 45), (15, 50)),
    Track(True, (-335, -400), (50, 55), (15, 70)),
    Track(False, None, (60, 70), (15, 100)),
    Track(False, (210, 250), (40, 45), (15, 100)),
)
LANE_M = 3.6
_RATE_HZ, _BEFORE_M, _BEGIN_M = 60, 100.0, 20.0  # frames; driven before what is measured; where on the lane it begins


@dataclass(frozen=True)
class TrackTests:
    """What came of them."""

    rows: pd.DataFrame  # track (from 1), words, from_m, to_m, most_lx (rounded to 0.1, as the rule does), at_m, limit_lx, passed
    moments: pd.DataFrame  # track, time_s, range_m, lx, limit_lx, above
    above_s: float  # seconds above a limit, all tracks together
    measured_s: float

    @property
    def failed(self) -> int:
        """Of `rows`."""
        return int((~self.rows.passed).sum())

    def write_page(self, file: str | Path, title: str = "Track tests of adaptive beams") -> None:
        """Lux over range on each track with its limits, and the table."""
        plots = "".join(plot(one, TRACKS[track - 1].oncoming, f"{track}: {TRACKS[track - 1].words}") for track, one in self.moments.groupby("track"))
        table = self.rows.to_html(index=False, float_format=lambda value: f"{value:.1f}")
        page = (
            f'<!doctype html><html lang="en"><head><meta charset="utf-8"><title>{html.escape(title)}</title></head>'
            f'<body style="font:15px sans-serif;margin:2rem"><h1>{html.escape(title)}</h1><p>{self.failed} of {len(self.rows)} above the limit, '
            f"for {self.above_s:.2f} s of {self.measured_s:.2f} s. FMVSS 108 S9.4.1.6, Table XXI; receptors and the fixture's place are chosen "
            f"by eye, the course is computed: this compares, and approves nothing.</p>{plots}{table}</body></html>\n"
        )
        with told(file):
            Path(file).write_text(page)


def track_tests(rig: Rig | str | Path, law: Callable[[], Controller], *, sensors: Sensors | None = None, design: str | None = None) -> TrackTests:
    """All eight, the stalk at low beam.

    rig: a Rig, or a rig file. law: makes one that begins anew (a class of phare.laws, or a lambda), once a track. sensors: the camera; its road users are the
    fixtures. design: of the rig [its first]; a lamp aimed by its cut-off needs degrees instead, for nothing is drawn that could find it.
    """
    rig = rig_of(rig)
    lit = rig.design(design) if design else rig.designs[0]
    for lamp in lit.lamps:
        if lamp.aim == "cut-off":
            raise BadInput(f"lamp {lamp.name!r} is aimed by its cut-off: give degrees")
    lamps, courses, receptors, answers = lamps_of(lit), [], [], {}
    for number, track in enumerate(TRACKS, 1):
        lane = _lane(track)
        user = RoadUser(
            direction="oncoming" if track.oncoming else "same", offset_m=LANE_M if track.oncoming else -LANE_M,
            start_s_m=_BEGIN_M + 3.45 + track.measured_m[1] + _BEFORE_M,
        )
        car = _course(track, lane, user, 1_000_000 * number)
        rows = receptors_of(car, lane, [user])
        rows = rows[(rows.range_m >= track.measured_m[0]) & (rows.range_m <= track.measured_m[1])]
        receptors.append(rows.assign(user=number))
        answers.update(_answers(law(), car, lamps, Eyes(_seeing(sensors or Sensors(), user), lane)))
        courses.append(car)
    rows = pd.concat(receptors, ignore_index=True)
    frames = [int(frame) for car in courses for frame in car.frame_index]
    stalk = SimpleNamespace(light_switch=2, flash=False, fog_front=False, lamp_aim_rad=0.0)
    rows["lx"] = lux_by_lamps(rows, Lit(answers, dict.fromkeys(frames, stalk), dict.fromkeys(frames, 0.0), {}), rig, lit)
    glare = judged(rows, 1.0 / _RATE_HZ)
    moments = glare.moments.rename(columns={"user": "track"})
    return TrackTests(_rows(moments), moments.drop(columns="oncoming"), glare.above_s, glare.judged_s)


def _seeing(sensors: Sensors, user: RoadUser) -> Sensors:
    return Sensors(**{**{name: getattr(sensors, name) for name in sensors.__dataclass_fields__}, "road_users": [user]})


def _lane(track: Track) -> Lane:
    """A straight, or a circle, from (0, 0) along x."""
    s = np.arange(0.0, _BEGIN_M + track.measured_m[1] + _BEFORE_M + 200.0, 0.5)
    k = track.curvature_1pm
    x, y = (np.sin(k * s) / k, (1 - np.cos(k * s)) / k) if k else (s, np.zeros_like(s))
    return Lane(pd.DataFrame({"s_m": s, "x_m": x, "y_m": y, "z_m": 0.0, "heading_rad": k * s, "curvature_1pm": k}))


def _course(track: Track, lane: Lane, user: RoadUser, first_frame: int) -> pd.DataFrame:
    """Poses until the fixture is passed; exact, not from the lane's points. By time_s, of the car itself; its speed stays."""
    t = np.arange(0.0, (user.start_s_m - _BEGIN_M - 10.0) / track.speed_mps, 1.0 / _RATE_HZ)
    k, s = track.curvature_1pm, _BEGIN_M + track.speed_mps * t
    x, y = (np.sin(k * s) / k, (1 - np.cos(k * s)) / k) if k else (s, np.zeros_like(s))
    zero = np.zeros_like(s)
    return pd.DataFrame({
        "frame_index": first_frame + np.arange(len(t)), "x_m": x, "y_m": y, "z_m": zero, "roll_rad": zero, "pitch_rad": zero, "yaw_rad": k * s,
        "speed_mps": track.speed_mps, "curvature_1pm": k,
    }, index=pd.Index(t, name="time_s"))


def _answers(law: Controller, car: pd.DataFrame, lamps: list[Any], eyes: Eyes) -> dict[int, Any]:
    """What the law says in each frame, given what link.py would give it."""
    answers: dict[int, Any] = {}
    fault: LawFailed | None = None
    number = 0
    try:
        law.begin(lamps)
        for number, state in enumerate(car.itertuples()):
            yaw_rate = state.speed_mps * state.curvature_1pm
            given = Given(
                frame_index=number, time_s=state.Index, step_s=1.0 / _RATE_HZ if number else 0.0, speed_mps=state.speed_mps,
                yaw_rate_radps=yaw_rate, steer_rad=math.atan(2.63 * state.curvature_1pm), ay_mps2=state.speed_mps * yaw_rate,
                seen_time_s=state.Index, lamps=lamps,
            )
            velocity = state.speed_mps * np.array([math.cos(state.yaw_rad), math.sin(state.yaw_rad), 0.0])
            eyes.fill(given, Pose(state.x_m, state.y_m, 0.0, 0.0, 0.0, state.yaw_rad), velocity)
            answers[state.frame_index] = law.step(given).to_proto(lamps)
    except (Exception, SystemExit) as wrong:
        fault = failed(wrong, f"in frame {number}")
    why = ended(law)
    fault = fault or why
    if fault is not None:
        raise fault
    return answers


def _rows(moments: pd.DataFrame) -> pd.DataFrame:
    found = []
    for number, track in enumerate(TRACKS, 1):
        here = moments[moments.track == number]
        for from_m, to_m, towards, before in LIMITS:
            limit = towards if track.oncoming else before
            there = here[(here.range_m >= from_m) & ((here.range_m < to_m) | (to_m == 220.0))]
            if limit is None or there.empty:
                continue
            worst = there.loc[there.lx.idxmax()]
            most = round(float(worst.lx), 1)
            found.append([number, track.words, from_m, min(to_m, track.measured_m[1]), most, worst.range_m, limit, most <= limit])
    return pd.DataFrame(found, columns=["track", "words", "from_m", "to_m", "most_lx", "at_m", "limit_lx", "passed"])
