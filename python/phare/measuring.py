"""Illuminance at points (`phare measure`)."""

from __future__ import annotations

import contextlib
import csv
import os
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Iterable, Iterator, Sequence

import numpy as np
import pandas as pd

from .errors import BadInput
from .lamp import Lamp
from .programs import run
from .rig import Rig, file_of

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
        file, reading = (self.lamp.file, self.lamp.reading) if isinstance(self.lamp, Lamp) else (self.lamp, {})
        file = os.fspath(file)
        quoted = '"' + file.replace('"', '""') + '"' if "," in file or '"' in file else file
        places = {"x": self.x_m, "y": self.y_m, "z": self.z_m}
        turns = {"yaw_deg": self.yaw_deg, "pitch_deg": self.pitch_deg, "roll_deg": self.roll_deg}
        words = [f"{key}={_number(key, value)!r}" for key, value in places.items()]
        words += [f"{key}={_number(key, value)!r}" for key, value in turns.items() if value]
        words += [f"scale={_number('scale', self.scale)!r}"] if self.scale != 1.0 else []
        words += [f"{key}={1 if value is True else value}" for key, value in reading.items()]  # as the lamp was read
        return ",".join([quoted, *words])


def _number(name: str, value: Any) -> float:
    try:
        return float(value)
    except (TypeError, ValueError) as wrong:
        raise BadInput(f"Mounted: {name} is {value!r}, expected a number") from wrong


def measure(
    lamps: Mounted | Rig | str | Sequence[Mounted | str] | PathLike,
    points: Any,
    *,
    beams: str | Sequence[str] | None = None,
    design: str | None = None,
    reference: bool = False,
    each: bool = False,
    scene: PathLike | None = None,
) -> np.ndarray:
    """Illuminance in lux at points, of shape (points,).

    lamps: Mounted lamps, or their words as --lamp of `phare measure` takes them; a Rig or its file (.toml) stands for all its lamps,
    with `beams` ("low", "high", "fog") of `design`, the car at the origin.
    points: positions in m, three numbers each, or six with the unit normal of the surface; without one it is horizontal,
        (0, 0, 1). A list may hold both.
    reference: float64 on the processor instead of the shader that draws the frame (relative difference below 1e-5).
    each: of each lamp alone besides: shape (points, 1 + lamps), the sum first.
    scene: a glTF file whose shadows count; a lamp that something hides from a point gives it nothing.
    """
    at = _points(points)
    with tempfile.TemporaryDirectory() as folder, _lamp_words(lamps, beams, design) as words:
        if len(at) == 0:
            return np.zeros(0)
        file, out = Path(folder) / "points.csv", Path(folder) / "lux.csv"
        lines = ["x_m,y_m,z_m,nx,ny,nz", *(",".join(repr(value) for value in row) for row in at.tolist())]
        file.write_text("\n".join(lines) + "\n")
        method = ["--method", "reference"] if reference else []
        shadows = ["--scene", os.fspath(scene)] if scene is not None else []
        run(["measure", *words, "--points", file, "--out", out, *method, *shadows])
        with out.open(newline="") as answer:
            header, *rows = csv.reader(answer)
    columns = [i for i, name in enumerate(header) if name.startswith("illuminance_lx")]
    lux = np.array([[float(row[i]) for i in columns] for row in rows])
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


@contextlib.contextmanager
def _lamp_words(lamps: Any, beams: str | Sequence[str] | None, design: str | None) -> Iterator[list[str]]:
    if isinstance(lamps, Rig) or isinstance(lamps, (str, os.PathLike)) and os.fspath(lamps).endswith(".toml"):
        lit = "low" if beams is None else beams if isinstance(beams, str) else ",".join(beams)
        with file_of(lamps) as file:
            yield ["--rig", str(file), "--beams", lit] + (["--design", design] if design else [])
        return
    for name, value in (("beams", beams), ("design", design)):
        if value is not None:
            raise BadInput(f"measure: {name} = {value!r}: are of a rig file, and lamps are given")
    listed = list(lamps) if isinstance(lamps, Iterable) and not isinstance(lamps, (str, os.PathLike)) else [lamps]
    if not listed:
        raise BadInput("measure: no lamp")
    words: list[str] = []
    for lamp in listed:
        if isinstance(lamp, Lamp):
            raise BadInput(f"measure: {lamp} has no place: give Mounted(lamp, x_m, y_m, z_m)")
        if not isinstance(lamp, (Mounted, str, os.PathLike)):
            raise BadInput(f"measure: {lamp!r} is neither a Mounted lamp nor the words of one")
        words += ["--lamp", lamp.words() if isinstance(lamp, Mounted) else os.fspath(lamp)]
    yield words
