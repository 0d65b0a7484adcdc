"""Lux in the frames of a recorded lockstep drive, or of any other course of lamps."""

from __future__ import annotations

import hashlib
import math
import tempfile
from dataclasses import dataclass, replace
from functools import lru_cache
from numbers import Real
from pathlib import Path
from typing import Any, Mapping, Sequence

import numpy as np
import pandas as pd

from .control.sensors import Pose
from .drive import Report
from .errors import BadInput
from .measuring import measure
from .rig import Design, LampPlace, Rig, Source, resolved


@dataclass(frozen=True)
class Lit:
    """How the lamps of a design were in each frame: by the control law, or without an answer the stalk."""

    answers: Mapping[int, Any]  # LawAnswer, by frame
    stalk: Mapping[int, Any]  # light_switch, flash, fog_front, lamp_aim_rad (CockpitState), by frame
    tilt_rad: Mapping[int, float]  # of the car's own levelling, by frame
    aims_deg: Mapping[str, float]  # by which a lamp is turned up


def designs_lit(report: Report) -> list[str]:
    """Names of the designs that the first picture of a drive showed, by its report: those with time of their own, else that of the stills."""
    listed = report.raw["processes"]["visual-0"]["designs"]
    return [each["name"] for each in listed if each["lit_s"] > 0.0] or [each["name"] for each in listed if each["in_the_stills"]]


def design_of_stills(report: Report) -> str:
    """The one whose stills a drive has kept, also where it showed several."""
    listed = report.raw["processes"]["visual-0"]["designs"]
    return str(next((each["name"] for each in listed if each["in_the_stills"]), listed[0]["name"]))


def design_of_frames(report: Report, rig: Rig, design: str | None = None) -> Mapping[int, Design]:
    """The design that shone in each frame of a lockstep drive; `design`: that one throughout, as if it had been driven.

    Raises BadInput where the rig is not the one that was driven, as far as report.json names it (scene; lamps, files and their content,
    scales), or where a control law answered and `design` is another than it led.
    """
    _same_scene(report, rig)
    names = designs_lit(report)
    if design is not None:
        if names != [design] and any(True for _ in report.drive.payloads("law_answer")):
            raise BadInput(f"design {design}: the control law led {' and '.join(names)} in {report.folder}")
        names = [design]
    chosen = {name: rig.design(name) for name in names}
    for each in chosen.values():
        _same_lamps(report, each)
    frames = [int(frame) for frame in report.car.frame_index]
    if len(chosen) == 1:
        return dict.fromkeys(frames, chosen[names[0]])
    shown = pd.read_csv(report.folder / "drive.csv", usecols=["frame", "design"])
    return {int(frame): chosen[name] for frame, name in zip(shown.frame, shown.design)}


def _same_scene(report: Report, rig: Rig) -> None:
    driven, given = report.raw["scene"]["file"], Path(rig.scene).name
    if driven != given:
        raise BadInput(f"{report.folder}: was driven in the scene {driven}, the rig has {given}")


def _same_lamps(report: Report, design: Design) -> None:
    driven = [each for each in report.raw["lamps"] if each["design"] == design.name]
    given = [(name, source) for place, name, _ in _lamps(design) for source in place.sources]
    if len(driven) != len(given):
        raise BadInput(f"{report.folder}: design {design.name} was driven with {len(driven)} sources, the rig has {len(given)}")
    for was, (name, source) in zip(driven, given):
        scale = source.scale if source.scale is not None else 1.0
        words = (name, source.function, Path(source.file).name, float(scale))
        if words != (was["lamp"], was["function"], was["file"], was["scale"]):
            had = f"{was['lamp']}: {was['function']} by {was['file']}, scale {was['scale']:g}"
            raise BadInput(f"{report.folder}: was driven with {had}; the rig has {name}: {words[1]} by {words[2]}, scale {scale:g}")
        for key, usual in (("lamp_set", 1), ("emitter", 1), ("mirror", False)):
            if source.more.get(key, usual) != was.get(key, usual):
                raise BadInput(f"{report.folder}: was driven with {key} {was.get(key, usual)} of {was['file']} as {name}; the rig has another")
        contents = [(source.file, was.get("content_hash"))]
        contents += [(source.more.get(key), was.get(key, {}).get("content_hash")) for key in ("pixels", "pixel_map")]
        for file, driven_hash in contents:
            if (file is None) != (driven_hash is None) or (file is not None and _content_hash(resolved(file)) != driven_hash):
                raise BadInput(f"{file or source.file}: is not what was driven as {name} of design {design.name} in {report.folder}")


def _content_hash(file: Path) -> str:
    try:
        stamp = file.stat()
        return _hash_of(file, stamp.st_mtime_ns, stamp.st_size)
    except OSError as wrong:
        raise BadInput(f"{file}: {wrong.strerror}") from wrong


@lru_cache(maxsize=4096)
def _hash_of(file: Path, changed_ns: int, size: int) -> str:
    return "sha256:" + hashlib.sha256(file.read_bytes()).hexdigest()


def lit_in_drive(report: Report, design: Design) -> Lit:
    """As a recorded lockstep drive has it."""
    answers = {answer.frame_index: answer for _, answer in report.drive.payloads("law_answer")}
    stalk = {int(c.frame_index): c for c in report.controls.itertuples()}
    tilt = {int(c.frame_index): c.lamp_tilt_rad for c in report.car.itertuples()}
    aims = {a["lamp"]: a["turned_deg"] for a in report.raw["processes"]["visual-0"]["aims"] if a["design"] == design.name}
    return Lit(answers, stalk, tilt, aims)


def lux_by_lamps(rows: pd.DataFrame, lit: Lit, rig: Rig, design: Design) -> np.ndarray:
    """Lux at points of frames by `phare measure` in float64, source by source.

    rows: frame; place x, y, z (m) and normal nx, ny, nz in the car's frame. Nothing stands in the way. A pixel light shines the picture of
    the rig file. Raises BadInput where one is lit to which the law has given pictures: what they were is not known here.
    """
    keeps_low = bool(rig.more.get("beams", {}).get("high_keeps_low", True))
    total = np.zeros(len(rows))
    for place, name, twin in _lamps(design):
        position = np.array(place.position_m, float) * [1, -1 if twin else 1, 1]
        aim_rad = math.radians(lit.aims_deg.get(name, place.aim if isinstance(place.aim, Real) else 0.0))
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
        plain = [i for i, source in enumerate(place.sources) if "pixels" not in source.more]
        if plain and len(rows):
            words = [_words(place.sources[i], position, twin) for i in plain]
            total += (measure(words, points, reference=True, each=True)[:, 1:] * weights[:, plain]).sum(axis=1)
        for i, source in enumerate(place.sources):
            lit_rows = weights[:, i] > 0.0
            if i in plain or not lit_rows.any():
                continue
            if any(each.lamp == name and each.frame for answer in lit.answers.values() for each in answer.lamps):
                raise BadInput(f"lamp {name!r}: the control law gave its pixel light pictures, whose light is not judged")
            total[lit_rows] += _pixel_lux(source, position, twin, points[lit_rows], rig) * weights[lit_rows, i]
    return total


def _pixel_lux(source: Source, position: np.ndarray, twin: bool, points: np.ndarray, rig: Rig) -> np.ndarray:
    """Of a source with a picture, which --lamp has no word for: by a rig that has nothing else."""
    side = -1.0 if twin else 1.0
    alone = replace(source, yaw_deg=side * (source.yaw_deg or 0.0), roll_deg=side * (source.roll_deg or 0.0))
    lamp = LampPlace("lamp", [float(value) for value in position], sources=[alone])
    with tempfile.TemporaryDirectory() as folder:
        of_it = Rig(rig.scene, rig.vehicle, rig.cockpit, [Design("alone", [lamp])], rig.channels)
        return measure(of_it.write(Path(folder) / "rig.toml"), points, beams=source.function, reference=True)


def lux_in_drive(rows: pd.DataFrame, report: Report, rig: Rig, design: Mapping[int, Design]) -> np.ndarray:
    """lux_by_lamps, by the lamps as a recorded lockstep drive had them. design: of each frame (design_of_frames)."""
    total, shone = np.zeros(len(rows)), [design[int(frame)] for frame in rows.frame]
    for each in {one.name: one for one in shone}.values():
        here = np.array([one is each for one in shone])
        total[here] = lux_by_lamps(rows[here], lit_in_drive(report, each), rig, each)
    return total


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
