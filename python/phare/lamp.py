"""A photometry file, asked through the photometry bench (`phare lamp`).

Angles are those of the lamp: H to the right and V up as seen from the lamp, degrees, the axis at (0, 0).
"""

from __future__ import annotations

import contextlib
import io
import os
import tempfile
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Callable, Iterator, Mapping, Sequence

import numpy as np
import pandas as pd

from .errors import BadInput
from .programs import run, run_json

PathLike = str | os.PathLike[str]


_FLAGS = {"axis": "--axis", "c0_deg": "--c0", "lamp_set": "--lamp-set", "emitter": "--emitter", "distance_m": "--distance"}


def _words(reading: Mapping[str, Any]) -> list[str]:
    """As the commands of the bench have it, one reading for all their files."""
    words = [word for key, value in reading.items() if key in _FLAGS for word in (_FLAGS[key], str(value))]
    return words + (["--mirror"] if reading.get("mirror") else [])


@dataclass(frozen=True)
class Table:
    """A lamp's own nodes: intensity_cd[row, column] at v_deg[row], h_deg[column]."""

    h_deg: np.ndarray
    v_deg: np.ndarray
    intensity_cd: np.ndarray


@dataclass(frozen=True)
class Verdict:
    """What a rulebook says of a beam."""

    rule: str
    passed: bool
    failed: int  # rows
    no_data: int  # rows for which the file has no light to say
    rows: pd.DataFrame
    raw: dict[str, Any] = field(repr=False)


@dataclass(frozen=True)
class Comparison:
    """Beam B against beam A."""

    flux_a_lm: float
    flux_b_lm: float
    correlation: float
    mean_absolute_difference_cd: float
    points: pd.DataFrame  # name, h_deg, v_deg, a_cd, b_cd, difference_cd, ratio
    raw: dict[str, Any] = field(repr=False)


@dataclass(frozen=True)
class Hspr:
    """The headlamp safety performance rating of a pair (GTB CE-5815)."""

    points: float  # weighted, of the method
    score: float
    rating: str  # the method's class
    rows: pd.DataFrame
    raw: dict[str, Any] = field(repr=False)


class Lamp:
    """A photometry file (IES LM-63, EULUMDAT, TM-33, CSV) as Phare reads it."""

    def __init__(self, file: PathLike, info: dict[str, Any], reading: Mapping[str, Any] | None = None):
        self.file = Path(file)
        self.info = info
        self.reading = dict(reading or {})  # how it was read: the arguments of `read` that were given

    @classmethod
    def read(
        cls,
        file: PathLike,
        *,
        axis: str | None = None,
        c0_deg: float | None = None,
        lamp_set: int | None = None,
        emitter: int | None = None,
        distance_m: float | None = None,
        mirror: bool = False,
    ) -> Lamp:
        """Reads a file; raises BadInput with file, line and reason.

        axis: "gamma0" or "gamma90", and c0_deg in degrees, for type C and EULUMDAT; lamp_set (EULUMDAT) and emitter (TM-33)
        count from 1; distance_m for a CSV in lx that states none; mirror turns left and right round.
        """
        given = {"axis": axis, "c0_deg": c0_deg, "lamp_set": lamp_set, "emitter": emitter, "distance_m": distance_m}
        reading = {key: value for key, value in given.items() if value is not None} | ({"mirror": True} if mirror else {})
        return cls(file, run_json(["lamp", "info", file, *_words(reading)]), reading)

    def __repr__(self) -> str:
        return f"Lamp({str(self.file)!r}, {self.flux_lm:.0f} lm, {self.peak_cd:.0f} cd)"

    @property
    def flux_lm(self) -> float:
        """Luminous flux of the whole table, lm."""
        return float(self.info["flux_lm"])

    @property
    def peak_cd(self) -> float:
        """The most intensity of the table, cd."""
        return float(self.info["peak_cd"])

    @property
    def peak_deg(self) -> tuple[float, float]:
        """Where that is: (h, v), degrees."""
        return float(self.info["peak_h_deg"]), float(self.info["peak_v_deg"])

    @property
    def content_hash(self) -> str:
        """Of the file's bytes: the name of a beam in reports."""
        return str(self.info["content_hash"])

    @property
    def cutoff(self) -> dict[str, Any] | None:
        """The cut-off of a passing beam, degrees; None where there is none."""
        return self.info.get("cutoff") or None

    @property
    def findings(self) -> list[str]:
        """What is odd about the file."""
        return [finding["text"] for finding in self.info.get("findings", [])]

    def intensity(self, h_deg: Any, v_deg: Any) -> np.ndarray:
        """Intensity, cd, at directions in degrees (arrays of one shape, or what NumPy makes one of them).

        The angles are the table's own (those of type B where the file is of type B); between its nodes as Phare lights the
        road. Outside the table a lamp is dark: 0.
        """
        try:
            h, v = np.broadcast_arrays(np.asarray(h_deg, float), np.asarray(v_deg, float))
        except (TypeError, ValueError) as wrong:
            raise BadInput(f"intensity: {wrong}") from wrong
        if not (np.isfinite(h).all() and np.isfinite(v).all()):
            raise BadInput("intensity: a direction is not finite")
        if h.size == 0:
            return np.zeros(h.shape)
        lines = ["h_deg,v_deg", *(f"{a!r},{b!r}" for a, b in zip(h.ravel().tolist(), v.ravel().tolist()))]
        with tempfile.TemporaryDirectory() as folder:
            at = Path(folder) / "at.csv"
            at.write_text("\n".join(lines) + "\n")
            answer = run_json(["lamp", "table", self.file, "--at", at, *_words(self.reading)])
        return np.array([row["intensity_cd"] for row in answer["rows"]]).reshape(h.shape)

    def table(self) -> Table:
        """The nodes of the table, turned into horizontal and vertical angles (type A) where the file has others."""
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "table.csv"
            run(["lamp", "convert", self.file, "--out", out, *_words(self.reading)])
            text = "".join(line for line in out.read_text().splitlines(keepends=True) if not line.startswith("#"))
        grid = pd.read_csv(io.StringIO(text), header=None)
        values = grid.to_numpy(dtype=object)
        return Table(values[0, 1:].astype(float), values[1:, 0].astype(float), values[1:, 1:].astype(float))

    def check(self, rule: str, right: Lamp | PathLike | None = None, **options: Any) -> Verdict:
        """Judges the beam by a rulebook of config/rules or a .toml file; `right`: the other lamp or its file, for rules of both.

        Options are those of `phare lamp check` by their names: traffic="left", aim_up=0.1 (degrees), led_module=True.
        """
        lamps = [self] + ([_lamp_of(right)] if right is not None else [])
        words = _option_words(options)
        raw = _asked(lamps, lambda files: ["check", *files, "--rule", rule, *words], fine=(0, 1))
        rows = pd.DataFrame(raw.get("rows", []))
        failed, no_data = int(raw["failed"]), int(raw["no_data"])
        return Verdict(str(raw["name"]), failed == 0 and no_data == 0, failed, no_data, rows, raw)

    def compare(self, other: Lamp | PathLike, *, align: bool = True, height_m: float = 0.65) -> Comparison:
        """This beam as A, the other (or that of a file) as B, aligned by their cut-offs (as filed with align=False)."""
        words = ["--height", str(height_m)] + ([] if align else ["--no-align"])
        raw = _asked([self, _lamp_of(other)], lambda files: ["compare", *files, *words])
        return Comparison(
            float(raw["flux_a_lm"]),
            float(raw["flux_b_lm"]),
            float(raw["correlation"]),
            float(raw["mean_absolute_difference_cd"]),
            pd.DataFrame(raw["points"]),
            raw,
        )

    def hspr(
        self, right: Lamp | PathLike | None = None, *, high: tuple[Lamp | PathLike, Lamp | PathLike] | None = None,
        height_m: float = 0.75, spacing_m: float = 1.5,
    ) -> Hspr:
        """Rates a pair of this as the left lamp and `right` (without it, this one twice), with a driving beam beside it."""
        words = ["--height", str(height_m), "--spacing", str(spacing_m)]
        if high is not None and (not isinstance(high, (tuple, list)) or len(high) != 2):
            raise BadInput("hspr: high is two lamps, the left one and the right one")
        lamps = [self, self if right is None else _lamp_of(right), *map(_lamp_of, high or ())]
        raw = _asked(lamps, lambda files: ["hspr", *files[:2], *words, *(["--high", *files[2:]] if high else [])])
        return Hspr(
            float(raw["weighted_points"]), float(raw["score"]), str(raw["class"]), pd.DataFrame(raw["rows"]), raw
        )


def _lamp_of(lamp: Lamp | PathLike) -> Lamp:
    return lamp if isinstance(lamp, Lamp) else Lamp.read(lamp)


def _asked(lamps: Sequence[Lamp], command: Callable[[list[str]], list[str]], fine: tuple[int, ...] = (0,)) -> Any:
    """The answer of `phare lamp` about several lamps, each as it was read; command: its words, from the names of their files."""
    with _read_alike(lamps) as (files, reading):
        written = {file: str(lamp.file) for file, lamp in zip(files, lamps)}
        try:
            return _renamed(run_json(["lamp", *command(files), *_words(reading)], fine=fine), written)
        except BadInput as wrong:
            raise BadInput(_renamed(str(wrong), written)) from wrong.__cause__


@contextlib.contextmanager
def _read_alike(lamps: Sequence[Lamp]) -> Iterator[tuple[list[str], dict[str, Any]]]:
    """Files of these lamps and the one reading that the command line has for all of them. Where they were read in different ways, each
    that was read in a way of its own is written anew as it was read: LM-63 keeps nodes and candela to 1e-14 of the peak, and the axis
    of type C, which is then asked for."""
    if all(lamp.reading == lamps[0].reading for lamp in lamps):
        yield [str(lamp.file) for lamp in lamps], lamps[0].reading
        return
    axes = {lamp.reading.get("axis", "gamma0"): lamp for lamp in lamps if lamp.info.get("photometric_type") == "C"}
    if len(axes) > 1:
        told = " and ".join(f"{lamp.file} with {axis}" for axis, lamp in axes.items())
        raise BadInput(f"{told}: lamps of type C that are read with different axes cannot be asked for together")
    with tempfile.TemporaryDirectory(prefix="phare-lamps-") as folder:
        files = []
        for number, lamp in enumerate(lamps):
            there = Path(folder) / str(number) / lamp.file.name
            if lamp.reading:
                there.parent.mkdir()
                run(["lamp", "convert", lamp.file, "--out", there, "--to", "lm63", *_words(lamp.reading)])
            files.append(str(there if lamp.reading else lamp.file))
        yield files, {"axis": axis for axis in axes if axis != "gamma0"}


def _renamed(answer: Any, written: Mapping[str, str]) -> Any:
    """With the names of the lamps' own files."""
    if isinstance(answer, str):
        for file, own in written.items():
            answer = answer.replace(file, own)
        return answer
    if isinstance(answer, dict):
        return {key: _renamed(value, written) for key, value in answer.items()}
    return [_renamed(value, written) for value in answer] if isinstance(answer, list) else answer


def _option_words(options: dict[str, Any]) -> list[str]:
    words: list[str] = []
    for name, value in options.items():
        flag = "--" + name.replace("_", "-")
        if value is True:
            words.append(flag)
        elif value is not False and value is not None:
            words += [flag, str(value)]
    return words
