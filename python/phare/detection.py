"""From where a pedestrian is seen: visibility level after Adrian (1989), as IES RP-8-00 writes it.

A figure to compare lamps and laws by, and no more: what a driver who expects nothing notices lies well above threshold. Unconfirmed, each
from one source or memory: k = 2.6, c = 4.2841 (another source has 4.1925: 1.3 % of a threshold), the target of 18 cm seen for 0.2 s, its
reflectance 0.2, and that a darker target's threshold is half of a lighter one's up to log10 La = -2.4 (0.004 cd/m2). Just above, the share
is 0.83 (1 minute of arc) to 0.41 (20 minutes), so there is a step.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Sequence

import numpy as np
import pandas as pd

from .control.road_users import Lane, RoadUser
from .control.sensors import Pose
from .drive import Report
from .errors import BadInput
from .light_in_drive import design_of_frames, lux_in_drive
from .rig import Rig, resolved, rig_of

TARGET_M = 0.18
"""The target of the model: of a person, so much of each of HEIGHTS_M."""
HEIGHTS_M = (0.2, 0.6, 1.0, 1.4)
"""Middles of the targets on a person, above the road: shoe, knee, hand, chest."""
DARK_CDM2 = 0.002
"""What stands behind a target that the road does not, and the least that anything has: sky or trees of a moonless night, chosen."""
_K, _C = 2.6, 4.2841
_FARTHEST_M, _NEAREST_M, _EVERY_S, _ROAD_TO_M = 200.0, 5.0, 0.1, 300.0


def threshold_cdm2(adaptation_cdm2: float, alpha_min: float, *, lighter: bool = True, time_s: float = 0.2, age: float = 30.0) -> float:
    """Luminance difference that is just seen, cd/m2 (Adrian 1989; RP-8-00 Annex A).

    adaptation_cdm2: background and veil; alpha_min: size of the target in minutes of arc; lighter: than its background. Age from 19 on.
    """
    for name, value in (("adaptation", adaptation_cdm2), ("alpha", alpha_min), ("time", time_s)):
        if not (math.isfinite(value) and value > 0.0):
            raise BadInput(f"{name} = {value}: expected a number above 0")
    if not 19.0 <= age <= 120.0:
        raise BadInput(f"age = {age}: expected 19 to 120")
    la, log_la, log_alpha = adaptation_cdm2, math.log10(adaptation_cdm2), math.log10(alpha_min)
    if la >= 0.6:
        root_f = math.log10(_C * la**0.1556) + 0.1684 * la**0.5867
        root_l = 0.05946 * la**0.466
    elif la >= 0.00418:
        root_f = 10.0 ** (0.0866 * log_la**2 + 0.3372 * log_la - 0.072)
        root_l = 10.0 ** (0.319 * log_la - 1.256)
    else:
        root_f = 10.0 ** (0.173 * log_la + 0.028)
        root_l = 10.0 ** (0.0227 * log_la**2 + 0.5275 * log_la - 0.891)
    of_luminance = _K * (root_f / alpha_min + root_l) ** 2
    b, c = log_alpha + 0.523, log_la + 6.0
    of_size = 0.36 - 0.0972 * b**2 / (b**2 - 2.513 * b + 2.789)
    of_adaptation = 0.355 - 0.1217 * c**2 / (c**2 - 10.4 * c + 52.28)
    a_s = math.hypot(of_size, of_adaptation) / 2.1
    in_time = (a_s + time_s) / time_s if time_s < 2.0 else 1.0
    of_age = (age - 19.0) ** 2 / 2160.0 + 0.99 if age <= 64.0 else (age - 56.6) ** 2 / 116.3 + 1.43
    if not lighter:
        of_luminance *= _darker(log_la, alpha_min, of_luminance, a_s)
    return of_luminance * in_time * of_age


def _darker(log_la: float, alpha_min: float, of_luminance: float, a_s: float) -> float:
    """Contrast polarity factor F_CP: of the threshold of a lighter target, so much has one that is darker than its background."""
    if log_la <= -2.4:
        return 0.5  # F_CP itself, not the m of its formula
    q = 0.125 if log_la >= -1.0 else 0.075
    m = 10.0 ** -(10.0 ** -(q * (log_la + 1.0) ** 2 + 0.0245))
    beta = 0.6 * 10.0 ** (-0.1488 * log_la)
    return 1.0 - m * alpha_min**-beta / (2.4 * of_luminance * (a_s + 2.0) / 2.0)


def visibility_level(
    target_cdm2: float, background_cdm2: float, alpha_min: float, *, veil_cdm2: float = 0.0, time_s: float = 0.2, age: float = 30.0
) -> float:
    """How often its threshold a target differs from its background; below 0: it is darker."""
    for name, value in (("target", target_cdm2), ("background", background_cdm2), ("veil", veil_cdm2)):
        if not (math.isfinite(value) and value >= 0.0):
            raise BadInput(f"{name} = {value}: expected a number of 0 or more")
    difference = target_cdm2 - background_cdm2
    just_seen = threshold_cdm2(background_cdm2 + veil_cdm2, alpha_min, lighter=difference >= 0.0, time_s=time_s, age=age)
    return difference / just_seen


@dataclass(frozen=True)
class Detection:
    """From where the pedestrians of a drive are seen."""

    moments: pd.DataFrame  # time_s, user (from 1), distance_m from the eye, height_m, target_cdm2, background_cdm2, veil_cdm2, level
    seen: pd.DataFrame  # user, distance_m from which on the level is held, time_s of that; NaN: never


def detect_pedestrians(
    report: Report, rig: Rig, road_users: Sequence[RoadUser], design: str | None = None, *, level: float = 1.0,
    reflectance: float = 0.2, road_reflectance: float = 0.1, age: float = 30.0,
) -> Detection:
    """From where on a driver sees each pedestrian of a recorded lockstep drive, at `level` times the threshold, until he is passed.

    Ten times a second; of a person the best of HEIGHTS_M counts, which shine back rho E / pi. Behind a target lies the road that the line of
    sight meets next, as a plane through the car's wheels that shines back rho (E level + E upright h/e) / pi (docs/light.md, h and e the
    heights of lamp and eye). Target and background have DARK_CDM2 at least: who stands in the dark before the dark is not seen. The veil is
    that of others' lamps where the drive met any (drive.csv). Left out: what hides a person, markings and signs behind him, and all that
    moves the eye. design: of the rig [that was driven].
    """
    if not (math.isfinite(level) and level > 0.0):
        raise BadInput(f"level = {level}: expected a number above 0")
    for name, share in (("reflectance", reflectance), ("road_reflectance", road_reflectance)):
        if not 0.0 <= share <= 1.0:
            raise BadInput(f"{name} = {share}: expected 0 to 1")
    if not 19.0 <= age <= 120.0:
        raise BadInput(f"age = {age}: expected 19 to 120")
    car = report.car
    if (car.frame_index.to_numpy() < 0).any():
        raise BadInput(f"{report.folder}: a drive in real time has no frames that car, controls and law share: drive in lockstep")
    rig = rig_of(rig)
    lane_file = resolved(rig.scene)
    lane = Lane(lane_file.with_name(lane_file.stem + "_lane.csv"))
    lit = design_of_frames(report, rig, design)
    eye = np.array((rig.channels[0].eye_m if rig.channels else None) or (1.6, 0.37, 1.22), float)
    moments = _targets(car, lane, road_users, eye)
    if moments.empty:
        return Detection(moments, pd.DataFrame(columns=["user", "distance_m", "time_s"]))
    moments["target_cdm2"] = np.maximum(reflectance / math.pi * lux_in_drive(_toward_eye(moments, eye), report, rig, lit), DARK_CDM2)
    on_road = moments.road_x.notna()
    road = moments[on_road]
    level_lx = lux_in_drive(_road(road, (0.0, 0.0, 1.0)), report, rig, lit)
    upright_lx = lux_in_drive(_road(road, (-1.0, 0.0, 0.0)), report, rig, lit)
    lamp_m = np.array([min(lamp.position_m[2] for lamp in lit[int(frame)].lamps) for frame in road.frame])
    moments["background_cdm2"] = DARK_CDM2
    moments.loc[on_road, "background_cdm2"] = np.maximum(
        road_reflectance / math.pi * (level_lx + upright_lx * np.minimum(1.0, lamp_m / eye[2])), DARK_CDM2
    )
    moments["veil_cdm2"] = moments.frame.map(_veils(report)).fillna(0.0)
    moments["level"] = [
        visibility_level(m.target_cdm2, m.background_cdm2, 2.0 * 60.0 * math.degrees(math.atan(0.5 * TARGET_M / m.distance_m)),
                         veil_cdm2=m.veil_cdm2, age=age)
        for m in moments.itertuples()
    ]
    columns = ["time_s", "user", "distance_m", "height_m", "target_cdm2", "background_cdm2", "veil_cdm2", "level"]
    return Detection(moments[columns], _seen(moments, level))


def _targets(car: pd.DataFrame, lane: Lane, users: Sequence[RoadUser], eye: np.ndarray) -> pd.DataFrame:
    """A row a target and moment: its place in the car's frame, and where the line of sight meets the road behind it."""
    found, next_s = [], -math.inf
    for time_s, state in car.iterrows():
        if float(time_s) < next_s:
            continue
        next_s = float(time_s) + _EVERY_S - 1e-9
        turn = Pose(state.x_m, state.y_m, state.z_m, state.roll_rad, state.pitch_rad, state.yaw_rad).car_from_world()
        for number, user in enumerate(users, 1):
            there = user.pose(lane, float(time_s)) if user.kind == "pedestrian" else None
            if there is None:
                continue
            for height in HEIGHTS_M:
                at = turn @ (there.place_m + np.array([0.0, 0.0, height]) - np.array([state.x_m, state.y_m, state.z_m]))
                way = at - eye
                distance = float(np.linalg.norm(way))
                if at[0] < eye[0] + _NEAREST_M or distance > _FARTHEST_M:
                    continue
                behind = eye + way * (eye[2] / -way[2]) if way[2] < 0.0 else None
                on_road = behind is not None and at[0] < behind[0] < _ROAD_TO_M
                road = (behind[0], behind[1]) if on_road and behind is not None else (math.nan, math.nan)
                found.append([int(state.frame_index), float(time_s), number, distance, height, *at, *road])
    return pd.DataFrame(found, columns=["frame", "time_s", "user", "distance_m", "height_m", "x", "y", "z", "road_x", "road_y"])


def _toward_eye(moments: pd.DataFrame, eye: np.ndarray) -> pd.DataFrame:
    way = eye - moments[["x", "y", "z"]].to_numpy()
    way /= np.linalg.norm(way, axis=1)[:, None]
    return moments[["frame", "x", "y", "z"]].assign(nx=way[:, 0], ny=way[:, 1], nz=way[:, 2])


def _road(moments: pd.DataFrame, normal: tuple[float, float, float]) -> pd.DataFrame:
    return pd.DataFrame(
        {"frame": moments.frame, "x": moments.road_x, "y": moments.road_y, "z": 0.0, "nx": normal[0], "ny": normal[1], "nz": normal[2]}
    )


def _veils(report: Report) -> dict[int, float]:
    """Others' veil by frame; empty: the drive met nobody."""
    file = report.folder / "drive.csv"
    if not file.is_file():
        return {}
    rows = pd.read_csv(file)
    return dict(zip(rows.frame, rows.veil_cdm2)) if "veil_cdm2" in rows else {}


def _seen(moments: pd.DataFrame, level: float) -> pd.DataFrame:
    rows = []
    best = moments.assign(level=moments.level.abs()).groupby(["user", "time_s"], as_index=False).agg(
        level=("level", "max"), distance_m=("distance_m", "min"))
    for user, of_user in best.groupby("user"):
        of_user = of_user.sort_values("time_s")
        short = np.flatnonzero(~(of_user.level.to_numpy() >= level))  # what is no number is not seen
        first = short[-1] + 1 if len(short) else 0
        held = of_user.iloc[first] if first < len(of_user) else None
        rows.append([int(user), held.distance_m if held is not None else math.nan, held.time_s if held is not None else math.nan])
    return pd.DataFrame(rows, columns=["user", "distance_m", "time_s"])
