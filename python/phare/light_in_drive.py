"""Lux in the frames of a recorded lockstep drive, or of any other course of lamps."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Mapping, Sequence

import numpy as np
import pandas as pd

from .control.sensors import Pose
from .drive import Report
from .measuring import measure
from .rig import Design, LampPlace, Rig, Source, resolved


@dataclass(frozen=True)
class Lit:
    """How the lamps of a design were in each frame: by the control law, or without an answer the stalk."""

    answers: Mapping[int, Any]  # LawAnswer, by frame
    stalk: Mapping[int, Any]  # light_switch, flash, fog_front, lamp_aim_rad (CockpitState), by frame
    tilt_rad: Mapping[int, float]  # of the car's own levelling, by frame
    aims_deg: Mapping[str, float]  # by which a lamp is turned up


def lit_in_drive(report: Report, design: Design) -> Lit:
    """As a recorded lockstep drive has it."""
    answers = {answer.frame_index: answer for _, answer in report.drive.payloads("law_answer")}
    stalk = {int(c.frame_index): c for c in report.controls.itertuples()}
    tilt = {int(c.frame_index): c.lamp_tilt_rad for c in report.car.itertuples()}
    aims = {a["lamp"]: a["turned_deg"] for a in report.raw["processes"]["visual-0"]["aims"] if a["design"] == design.name}
    return Lit(answers, stalk, tilt, aims)


def lux_by_lamps(rows: pd.DataFrame, lit: Lit, rig: Rig, design: Design) -> np.ndarray:
    """Lux at points of frames by `phare measure` in float64, source by source.

    rows: frame; place x, y, z (m) and normal nx, ny, nz in the car's frame. Nothing stands in the way.
    """
    keeps_low = bool(rig.more.get("beams", {}).get("high_keeps_low", True))
    total = np.zeros(len(rows))
    for place, name, twin in _lamps(design):
        position = np.array(place.position_m, float) * [1, -1 if twin else 1, 1]
        aim_rad = math.radians(lit.aims_deg.get(name, place.aim if isinstance(place.aim, (int, float)) else 0.0))
        points, weights = np.zeros((len(rows), 6)), np.zeros((len(rows), len(place.sources)))
        for i, row in enumerate(rows.itertuples()):
            answer, driver = lit.answers.get(row.frame), lit.stalk[row.frame]
            light = next((each for each in answer.lamps if each.lamp == name), None) if answer else None
            up = aim_rad + driver.lamp_aim_rad + lit.tilt_rad[row.frame] + (answer.levelling_rad if answer else 0.0)
            yaw, up = (light.yaw_rad, up + light.pitch_rad) if light else (0.0, up)
            turn = Pose(0, 0, 0, 0, -up, yaw).car_from_world()  # lamp from car: pitch is nose down there
            points[i, :3] = position + turn @ (np.array([row.x, row.y, row.z]) - position)
            points[i, 3:] = turn @ np.array([row.nx, row.ny, row.nz])
            weights[i] = _weights(place.sources, driver, answer, light, keeps_low)
        words = [_words(source, position, twin) for source in place.sources]
        each = measure(words, points, reference=True, each=True)[:, 1:]
        total += (each * weights).sum(axis=1)
    return total


def lux_in_drive(rows: pd.DataFrame, report: Report, rig: Rig, design: Design) -> np.ndarray:
    """lux_by_lamps, by the lamps as a recorded lockstep drive had them."""
    return lux_by_lamps(rows, lit_in_drive(report, design), rig, design)


def _lamps(design: Design) -> list[tuple[LampPlace, str, bool]]:
    return [
        (lamp, name, twin)
        for lamp in design.lamps
        for name, twin in ([(f"{lamp.name} left", False), (f"{lamp.name} right", True)] if lamp.pair else [(lamp.name, False)])
    ]


def _weights(sources: Sequence[Source], driver: Any, answer: Any, light: Any, keeps_low: bool) -> list[float]:
    """Share of each source's light, as a picture has it: the beam's functions (visual/process/lamps.h) by the law's dimming."""
    beam = driver.light_switch
    if answer and answer.light_switch and beam >= 2:
        beam = answer.light_switch
    high = beam == 3 or driver.flash
    lit = {"position": beam >= 1, "low": beam >= 2 and (not high or keeps_low), "high": high, "fog": driver.fog_front and beam >= 1}
    dims = list(light.dimming_01) if light else []
    dims = dims * len(sources) if len(dims) == 1 else dims or [1.0] * len(sources)
    return [dim if lit.get(source.function, False) else 0.0 for source, dim in zip(sources, dims)]


def _words(source: Source, position: np.ndarray, twin: bool) -> str:
    side = -1.0 if twin else 1.0
    words = {"x": position[0], "y": position[1], "z": position[2], "pitch_deg": source.pitch_deg or 0.0}
    words |= {"yaw_deg": side * (source.yaw_deg or 0.0), "roll_deg": side * (source.roll_deg or 0.0)}
    words["scale"] = source.scale if source.scale is not None else 1.0
    text = ",".join(f"{key}={float(value)!r}" for key, value in words.items())
    for key in ("axis", "c0_deg", "lamp_set", "emitter", "distance_m"):
        text += f",{key}={source.more[key]}" if key in source.more else ""
    text += ",mirror=1" if source.more.get("mirror") else ""
    file = str(resolved(source.file))
    return (f'"{file}"' if "," in file else file) + "," + text
