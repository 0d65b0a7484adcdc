"""The drive test of the IIHS as far as its text is public: reach of both beams, glare, and demerits by limits that the user brings.

Sources: receptors 0.25 and 1.10 m high, glare of the low beam only (two each); the right edge, ten visibility demerits a band of the
rating, high-beam assist credited only on approaches without excess glare where the high beam reaches further (one each).
Unconfirmed: bands at 10, 20, 30, and what edges.py names. Not public: targets, demerits a metre, the glare curve, weights, the amount of the
credit. So nothing of that is here: without a file of limits there is no rating, and with one it is the user's, not the institute's.
"""

from __future__ import annotations

import math
import os
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from .edges import APPROACHES, oncoming_glare, visibility
from .errors import BadInput

PathLike = str | os.PathLike[str]
_SIDES = {"right": "right edge", "left": "left edge"}
_KEYS = {
    "visibility": ("approach", "beam", "edge", "target_m", "demerits_per_m"),
    "glare": ("approach", "curve", "demerits"),
}
UNOFFICIAL = "no official rating: targets, demerits, glare curve, weights and credit are not public"


@dataclass(frozen=True)
class Iihs:
    """visibility: as phare.visibility, with `beam` before it, m from the car's origin. glare: lux over distance_m, one column an
    approach. demerits: approach, beam, what, demerits; None without limits, as rating and total are."""

    visibility: pd.DataFrame
    glare: pd.DataFrame
    demerits: pd.DataFrame | None = None
    total: float | None = None
    rating: str | None = None


def rating_of(demerits: float) -> str:
    """Good to 10, Acceptable to 20, Marginal to 30, else Poor: unconfirmed."""
    return next((name for most, name in ((10, "Good"), (20, "Acceptable"), (30, "Marginal")) if demerits <= most), "Poor")


def _number(value: Any, least: float) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value) and value >= least


def _checked(file: Path, kind: str, count: int, row: Any) -> dict[str, Any]:
    place = f"{file}: [[{kind}]] {count}"
    if not isinstance(row, dict) or set(row) != set(_KEYS[kind]):
        raise BadInput(f"{place}: expected the keys {', '.join(_KEYS[kind])}")
    if row["approach"] not in APPROACHES:
        raise BadInput(f"{place}: approach {row['approach']!r} is none of {', '.join(APPROACHES)}")
    if kind == "visibility":
        if row["beam"] not in ("low", "high") or row["edge"] not in _SIDES:
            raise BadInput(f"{place}: beam is low or high, edge is right or left")
        numbers = [row["target_m"], row["demerits_per_m"]]
    else:
        curve = row["curve"]
        if not isinstance(curve, list) or len(curve) < 2 or not all(isinstance(p, list) and len(p) == 2 for p in curve):
            raise BadInput(f"{place}: curve is a list of two or more [distance_m, lx]")
        numbers = [row["demerits"], *(value for point in curve for value in point)]
    if not all(_number(value, 0.0) for value in numbers):
        raise BadInput(f"{place}: a number is not finite or below 0")
    if kind == "visibility" and row["target_m"] > 250:
        raise BadInput(f"{place}: target_m is beyond the 250 m that are tried")
    if kind == "glare" and not all(10 <= d <= 120 for d, _ in row["curve"]):
        raise BadInput(f"{place}: the curve leaves the 10 to 120 m that are tried")
    if kind == "glare" and not (np.diff([d for d, _ in row["curve"]]) > 0).all():
        raise BadInput(f"{place}: the distances of the curve do not grow")
    return row


def read_limits(file: PathLike) -> dict[str, list[dict[str, Any]]]:
    """A TOML file of [[visibility]] and [[glare]] (docs/python.md); raises BadInput."""
    try:
        document = tomllib.loads(Path(file).read_text())
    except OSError as wrong:
        raise BadInput(f"{file}: {wrong.strerror}") from wrong
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as wrong:
        raise BadInput(f"{file}: {wrong}") from wrong
    if set(document) - set(_KEYS) or not document or not all(isinstance(rows, list) for rows in document.values()):
        raise BadInput(f"{file}: expected [[visibility]] and [[glare]] and nothing else")
    return {kind: [_checked(Path(file), kind, n, row) for n, row in enumerate(document.get(kind, []), 1)] for kind in _KEYS}


def demerits_of(reach: pd.DataFrame, glare: pd.DataFrame, limits: dict[str, list[dict[str, Any]]]) -> pd.DataFrame:
    """demerits_per_m for each metre short of target_m; `demerits` once where the low beam is above the curve anywhere within it (linear
    between its points)."""
    rows = []
    for row in limits["visibility"]:
        at = reach[(reach.approach == row["approach"]) & (reach.beam == row["beam"]) & reach.edge.str.startswith(_SIDES[row["edge"]])]
        short_m = max(0.0, row["target_m"] - float(at.distance_m.iloc[0]))
        rows.append([row["approach"], row["beam"], f"{row['edge']} edge", short_m * row["demerits_per_m"]])
    for row in limits["glare"]:
        d, lx = np.array(row["curve"], float).T
        within = glare.loc[d[0]:d[-1], row["approach"]]
        above = bool((within.to_numpy() > np.interp(within.index, d, lx)).any())
        rows.append([row["approach"], "low", "glare", float(row["demerits"]) if above else 0.0])
    return pd.DataFrame(rows, columns=["approach", "beam", "what", "demerits"])


def rate_iihs(rig: PathLike, *, design: str | None = None, limits: PathLike | None = None) -> Iihs:
    """Both beams of a rig file on a straight and four curves, in float64; with `limits` also demerits and a rating by them.

    The high beam is lit together with the low beam. High-beam assist is not credited: its formula is not public.
    """
    read = read_limits(limits) if limits is not None else None
    tables = []
    for beam, lit in (("low", ("low",)), ("high", ("low", "high"))):
        table = visibility(rig, beams=lit, design=design)
        table.insert(0, "beam", beam)
        tables.append(table)
    reach, glare = pd.concat(tables, ignore_index=True), oncoming_glare(rig, design=design)
    if read is None:
        return Iihs(reach, glare)
    demerits = demerits_of(reach, glare, read)
    total = float(demerits.demerits.sum())
    return Iihs(reach, glare, demerits, total, rating_of(total))
