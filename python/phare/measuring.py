"""Illuminance at points (`phare measure`)."""

from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Iterable, Sequence

import numpy as np
import pandas as pd

from .errors import BadInput
from .lamp import Lamp
from .programs import run

PathLike = str | os.PathLike[str]


@dataclass(frozen=True)
class Mounted:
    """A lamp in its place: metres in the car's frame (x forward, y left, z up), degrees (yaw left, pitch up, roll right side
    down)."""

    lamp: Lamp | PathLike
    x_m: float
    y_m: float
    z_m: float
    yaw_deg: float = 0.0
    pitch_deg: float = 0.0
    roll_deg: float = 0.0
    scale: float = 1.0

    def words(self) -> str:
        """As --lamp of the programs has it."""
        file = os.fspath(self.lamp.file if isinstance(self.lamp, Lamp) else self.lamp)
        quoted = '"' + file.replace('"', '""') + '"' if "," in file or '"' in file else file
        places = {"x": self.x_m, "y": self.y_m, "z": self.z_m}
        turns = {"yaw_deg": self.yaw_deg, "pitch_deg": self.pitch_deg, "roll_deg": self.roll_deg}
        words = [f"{key}={float(value)!r}" for key, value in places.items()]
        words += [f"{key}={float(value)!r}" for key, value in turns.items() if value]
        words += [f"scale={float(self.scale)!r}"] if self.scale != 1.0 else []
        return ",".join([quoted, *words])


def measure(
    lamps: Mounted | str | Sequence[Mounted | str] | PathLike,
    points: Any,
    *,
    beams: str | Sequence[str] = "low",
    design: str | None = None,
    reference: bool = False,
    each: bool = False,
    scene: PathLike | None = None,
) -> np.ndarray:
    """Illuminance in lux at points, of shape (points,).

    lamps: Mounted lamps, or their words as --lamp of `phare measure` takes them; a rig file (.toml) stands for all its lamps,
    with `beams` ("low", "high", "fog") of `design`, the car at the origin.
    points: positions in m, three numbers each, or six with the unit normal of the surface; without one it is horizontal,
        (0, 0, 1). A list may hold both.
    reference: float64 on the processor instead of the shader that draws the frame (relative difference below 1e-5).
    each: of each lamp alone besides: shape (points, 1 + lamps), the sum first.
    scene: a glTF file whose shadows count; a lamp that something hides from a point gives it nothing.
    """
    at = _points(points)
    if len(at) == 0:
        return np.zeros(0)
    words = _lamp_words(lamps, beams, design)
    with tempfile.TemporaryDirectory() as folder:
        file, out = Path(folder) / "points.csv", Path(folder) / "lux.csv"
        lines = ["x_m,y_m,z_m,nx,ny,nz", *(",".join(repr(value) for value in row) for row in at.tolist())]
        file.write_text("\n".join(lines) + "\n")
        method = ["--method", "reference"] if reference else []
        shadows = ["--scene", os.fspath(scene)] if scene is not None else []
        run(["measure", *words, "--points", file, "--out", out, *method, *shadows])
        answer = pd.read_csv(out, float_precision="round_trip")
    columns = [name for name in answer.columns if name.startswith("illuminance_lx")]
    lux = answer[columns].to_numpy(float)
    return lux if each else lux[:, 0]


def _points(points: Any) -> np.ndarray:
    """Positions and normals, of shape (points, 6)."""
    if not isinstance(points, Iterable) or isinstance(points, (str, bytes)):
        raise BadInput(f"measure: points are {points!r}, expected (n, 3) or (n, 6)")
    rows = list(points.to_numpy() if isinstance(points, pd.DataFrame) else points)
    if rows and all(isinstance(number, (int, float, np.number)) for number in rows):
        rows = [rows]
    at = np.zeros((len(rows), 6))
    for i, row in enumerate(rows):
        try:
            numbers = np.asarray(row, float)
        except (TypeError, ValueError) as error:
            raise BadInput(f"measure: point {i}: {error}") from error
        if numbers.shape not in ((3,), (6,)):
            raise BadInput(f"measure: point {i} is of shape {numbers.shape}, expected three numbers, or six with a normal")
        if not np.isfinite(numbers).all():
            raise BadInput(f"measure: point {i} is not finite")
        at[i] = numbers if len(numbers) == 6 else [*numbers, 0.0, 0.0, 1.0]
    return at


def _lamp_words(lamps: Any, beams: str | Sequence[str], design: str | None) -> list[str]:
    one = isinstance(lamps, (str, os.PathLike, Mounted))
    listed = [lamps] if one else list(lamps)
    if not listed:
        raise BadInput("measure: no lamp")
    if one and not isinstance(lamps, Mounted) and os.fspath(lamps).endswith(".toml"):
        lit = beams if isinstance(beams, str) else ",".join(beams)
        return ["--rig", os.fspath(lamps), "--beams", lit] + (["--design", design] if design else [])
    words: list[str] = []
    for lamp in listed:
        words += ["--lamp", lamp.words() if isinstance(lamp, Mounted) else os.fspath(lamp)]
    return words
