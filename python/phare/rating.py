"""The drive test of the IIHS as far as its text is public: reach of both beams, glare, and demerits by limits that the user brings.

Sources: receptors 0.25 and 1.10 m high, glare of the low beam only, a good low beam reaches 325 ft and a poor one 220 ft or less along
the right edge of the straight (two each); the right edge, speeds, ten visibility demerits a band of the rating, no better than Marginal with
excess glare on any approach, high-beam assist credited only on approaches without excess glare where the high beam reaches further
(one each). Unconfirmed: bands at 10, 20, 30, and what edges.py names. Not public: targets, demerits a metre, the glare curve and how
long it may be exceeded, weights, the amount of the credit. So nothing of that is here: without a file of limits there is no rating,
and with one it is the user's, not the institute's. What takes the credit's amount from a share is our own form.
"""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from .edges import APPROACHES, SPEEDS_MPS, oncoming_glare, visibility
from .errors import BadInput
from .rig import Rig, rig_of
from .toml_in import place_in, read_toml

PathLike = str | os.PathLike[str]
_SIDES = {"right": "right edge", "left": "left edge"}
_KEYS = {
    "visibility": ("approach", "beam", "edge", "target_m", "demerits_per_m"),
    "glare": ("approach", "curve", "demerits", "allowed_s"),
}
_CREDIT = "credit_share_01"
_BANDS = ((10, "Good"), (20, "Acceptable"), (30, "Marginal"))  # unconfirmed
GOOD_M, POOR_M = 325 * 0.3048, 220 * 0.3048  # low beam, straight, right edge
UNOFFICIAL = "no official rating: targets, demerits, glare curve, weights and credit are not public"


@dataclass(frozen=True)
class Limits:
    """What a user's file says: its rows, checked, and the share of the low beam's visibility demerits that assist gives back
    (None: not told)."""

    visibility: list[dict[str, Any]]
    glare: list[dict[str, Any]]
    credit_share_01: float | None = None


@dataclass(frozen=True)
class Iihs:
    """visibility: as phare.visibility, with `beam` before it, m from the car's origin. glare: lux over distance_m, one column an
    approach. Without limits the others are None. above: approach, above_m and above_s that the low beam spends above its curve, allowed_s,
    excess. demerits: approach, beam, what, demerits; a credit is negative. total: their sum, 0 at least."""

    visibility: pd.DataFrame
    glare: pd.DataFrame
    above: pd.DataFrame | None = None
    demerits: pd.DataFrame | None = None
    total: float | None = None
    rating: str | None = None


def rating_of(demerits: float, excess_glare: bool = False) -> str:
    """Good to 10, Acceptable to 20, Marginal to 30, else Poor: unconfirmed. With excess glare Marginal at best: one source, of
    2016."""
    better = _BANDS[2:] if excess_glare else _BANDS
    return next((name for most, name in better if demerits <= most), "Poor")


def _number(value: Any, least: float) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value) and value >= least


def _checked(file: Path, kind: str, count: int, row: Any) -> dict[str, Any]:
    place = f"{place_in(file, kind, count)}: [[{kind}]] {count}"
    if not isinstance(row, dict) or set(row) != set(_KEYS[kind]):
        raise BadInput(f"{place}: expected the keys {', '.join(_KEYS[kind])}")
    words = [row[key] for key in ("approach", "beam", "edge") if key in row]
    if not all(isinstance(word, str) for word in words):
        raise BadInput(f"{place}: {', '.join(map(repr, words))}: expected words")
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
        numbers = [row["demerits"], row["allowed_s"], *(value for point in curve for value in point)]
    if not all(_number(value, 0.0) for value in numbers):
        raise BadInput(f"{place}: a number is not finite or below 0")
    if kind == "visibility" and row["target_m"] > 250:
        raise BadInput(f"{place}: target_m is beyond the 250 m that are tried")
    if kind == "glare" and not all(10 <= d <= 120 for d, _ in row["curve"]):
        raise BadInput(f"{place}: the curve leaves the 10 to 120 m that are tried")
    if kind == "glare" and not (np.diff([d for d, _ in row["curve"]]) > 0).all():
        raise BadInput(f"{place}: the distances of the curve do not grow")
    return row


def _no_twice(file: Path, kind: str, rows: list[dict[str, Any]]) -> list[dict[str, Any]]:
    seen = set()
    for count, row in enumerate(rows, 1):
        what = tuple(row[key] for key in ("approach", "beam", "edge") if key in row)
        if what in seen:
            raise BadInput(f"{place_in(file, kind, count)}: [[{kind}]] {count}: {', '.join(what)} stands there twice")
        seen.add(what)
    return rows


def read_limits(file: PathLike) -> Limits:
    """A TOML file of [[visibility]], [[glare]] and [assist] (docs/python.md); raises BadInput."""
    document = read_toml(file)
    assist = document.pop("assist", None)
    if set(document) - set(_KEYS) or not document or not all(isinstance(rows, list) for rows in document.values()):
        raise BadInput(f"{file}: expected [[visibility]], [[glare]], [assist] and nothing else")
    if assist is not None and (not isinstance(assist, dict) or set(assist) != {_CREDIT} or not _number(assist[_CREDIT], 0.0)
                               or assist[_CREDIT] > 1):
        raise BadInput(f"{place_in(file, 'assist')}: [assist]: expected {_CREDIT}, 0 to 1, and nothing else")
    rows = {
        kind: _no_twice(Path(file), kind, [_checked(Path(file), kind, n, row) for n, row in enumerate(document.get(kind, []), 1)])
        for kind in _KEYS
    }
    return Limits(rows["visibility"], rows["glare"], float(assist[_CREDIT]) if assist is not None else None)


def above_of(glare: pd.DataFrame, limits: Limits) -> pd.DataFrame:
    """How far and how long the low beam is above each curve: both linear between their points."""
    rows = []
    for row in limits.glare:
        d, lx = np.array(row["curve"], float).T
        lux = glare[row["approach"]]
        at = np.union1d(lux.index[(lux.index >= d[0]) & (lux.index <= d[-1])], d)
        over = np.interp(at, lux.index, lux) - np.interp(at, d, lx)
        a, b = over[:-1], over[1:]
        span = np.where(a != b, np.abs(a - b), 1.0)
        share = np.where((a > 0) & (b > 0), 1.0, np.maximum(np.maximum(a, b), 0.0) / span)
        above_m = float((share * np.diff(at)).sum())
        above_s = above_m / SPEEDS_MPS[row["approach"]]
        rows.append([row["approach"], above_m, above_s, float(row["allowed_s"]), above_s > row["allowed_s"]])
    return pd.DataFrame(rows, columns=["approach", "above_m", "above_s", "allowed_s", "excess"])


def _reach_m(reach: pd.DataFrame, approach: str, beam: str, edge: str) -> float:
    at = reach[(reach.approach == approach) & (reach.beam == beam) & reach.edge.str.startswith(_SIDES[edge])]
    return float(at.distance_m.iloc[0])


def demerits_of(reach: pd.DataFrame, above: pd.DataFrame, limits: Limits, *, assist: bool = False) -> pd.DataFrame:
    """demerits_per_m for each metre short of target_m; a curve's `demerits` once where glare is in excess. With assist the share of
    what the low beam lost against the high beam at its own targets comes back, on approaches with a curve and no excess."""
    rows, credits = [], dict[str, float]()
    for row in limits.visibility:
        where = (row["approach"], row["beam"], row["edge"])
        short_m = max(0.0, row["target_m"] - _reach_m(reach, *where))
        rows.append([row["approach"], row["beam"], f"{row['edge']} edge", short_m * row["demerits_per_m"]])
        if row["beam"] == "low":
            high_short_m = max(0.0, row["target_m"] - _reach_m(reach, row["approach"], "high", row["edge"]))
            regained = max(0.0, short_m - high_short_m) * row["demerits_per_m"]
            credits[row["approach"]] = credits.get(row["approach"], 0.0) + regained
    excess = dict(zip(above.approach, above.excess))
    rows += [[row["approach"], "low", "glare", float(row["demerits"]) if excess[row["approach"]] else 0.0] for row in limits.glare]
    if assist and limits.credit_share_01 is not None:
        share = limits.credit_share_01
        rows += [[a, "low", "assist credit", -share * lost] for a, lost in credits.items() if excess.get(a) is not None and not excess[a]]
    return pd.DataFrame(rows, columns=["approach", "beam", "what", "demerits"])


def rate_iihs(rig: Rig | PathLike, *, design: str | None = None, limits: PathLike | None = None, assist: bool = False) -> Iihs:
    """Both beams of a rig, or of a rig file, on a straight and four curves, in float64; with `limits` also demerits and a rating by them.

    The high beam is lit together with the low beam. assist: the car has high-beam assist; what it gives back is in the limits. Lamps
    stand still: no swivel, no roll of the body in curves. Raises BadInput.
    """
    read = read_limits(limits) if limits is not None else None
    if assist and (read is None or read.credit_share_01 is None):
        raise BadInput(f"{limits or 'assist'}: how much high-beam assist gives back is not public: give limits with [assist] {_CREDIT}")
    read_rig = rig_of(rig)
    lit_design = read_rig.design(design) if design else read_rig.designs[0]
    for beam in ("low", "high"):
        if not any(source.function == beam for lamp in lit_design.lamps for source in lamp.sources):
            raise BadInput(f"{'the rig' if isinstance(rig, Rig) else rig}: design {lit_design.name} has no {beam} beam")
    tables = []
    for beam, lit in (("low", ("low",)), ("high", ("low", "high"))):
        table = visibility(rig, beams=lit, design=design)
        table.insert(0, "beam", beam)
        tables.append(table)
    reach, glare = pd.concat(tables, ignore_index=True), oncoming_glare(rig, design=design)
    if read is None:
        return Iihs(reach, glare)
    above = above_of(glare, read)
    demerits = demerits_of(reach, above, read, assist=assist)
    total = max(0.0, float(demerits.demerits.sum()))
    return Iihs(reach, glare, above, demerits, total, rating_of(total, bool(above.excess.any())))
