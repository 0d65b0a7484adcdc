"""A plan of drives: what is varied, what is measured, by what it is ranked. Reader of plan.toml (docs/sweep.md).

The jobs of a plan and their order follow from the plan alone: full grid, list, or Latin hypercube from its seed.
"""

from __future__ import annotations

import hashlib
import itertools
import json
import math
import os
import re
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..errors import BadInput
from ..toml_in import place_in, read_toml
from .named_files import digest_of, digest_of_module

# What a drive can be told. Of these the values are paths, relative to the plan.
FILES = ("rig", "lamp", "lamp_high", "lamp_fog", "drive", "script", "log", "vehicle", "road", "traffic")
WORDS = (
    "aim", "level", "friction", "roughness", "frames", "size", "law", "sensor_delay_s", "sensor_noise_deg", "sensor_miss_01",
    "sensor_seed", "sensor_red_range_m",
)
#: What `phare drive` takes of them, said before the first drive: a plan runs for hours.
_EXPECTED: dict[str, tuple[Callable[[Any], bool], str]] = {
    "aim": (lambda v: v in ("cut-off", "as-filed") or _is_number(v), "cut-off, as-filed or degrees up"),
    "level": (lambda v: v in _LEVELS, "one of pose, kinematic, single-track, full, auto"),
    "roughness": (lambda v: str(v) in tuple("ABCDE"), "a class of ISO 8608, A to E"),
    "frames": (lambda v: _is_whole(v) and 1 <= v <= 1_000_000, "a whole number from 1 to 1000000"),
    "size": (lambda v: re.fullmatch(r"[1-9]\d*x[1-9]\d*", str(v)) is not None, "WIDTHxHEIGHT, such as 1280x720"),
    "sensor_seed": (lambda v: _is_whole(v) and v >= 0, "a whole number from 0 on"),
    **{key: (lambda v: _is_number(v) and v >= 0, "a number from 0 on") for key in ("sensor_delay_s", "sensor_noise_deg", "sensor_red_range_m")},
    "sensor_miss_01": (lambda v: _is_number(v) and 0 <= v <= 1, "a number from 0 to 1"),
}
_LEVELS = ("pose", "kinematic", "single-track", "full", "auto")
#: Numbers that a job's row has of its drive (phare.sweep.job); some of them where the job has a law, or traffic too.
FIGURES = ("frames", "driven_s", "driven_m", "suspension_pitch_most_deg", "picture_mean", "high_share", "glare_s", "glare_of_s")
_TOP = ("name", "kind", "seed", "samples", "rank_by", "rank", "fixed", "vary", "run", "measure")
_KINDS = ("grid", "list", "latin-hypercube")
_MOST_JOBS = 1_000_000
_BEAMS = ("position", "low", "high", "fog", "daytime", "cornering")


Place = Callable[[str], str]  # of a key: "file:line", and which table


@dataclass(frozen=True)
class Measure:
    """A figure of a job's lamps on a level road, the car at the origin: lux at a point, or how far so many lux reach."""

    name: str
    beams: tuple[str, ...] = ("low",)
    at: tuple[float, ...] = ()  # x, y, z in m, and the unit normal of the surface; without one it is horizontal
    range_lx: float = 0.0  # instead: the farthest place ahead with so many lux, at y_m, z_m, facing the car
    y_m: float = 0.0
    z_m: float = 0.25


@dataclass(frozen=True)
class Job:
    """One drive of a plan."""

    number: int  # counted from 1
    settings: dict[str, Any]  # all of it, paths absolute
    varied: dict[str, Any]  # as the plan has it: what makes this job another than the rest

    def name(self) -> str:
        """Of its folder and its row."""
        return f"{self.number:05d}"


@dataclass(frozen=True)
class Plan:
    """A plan as read."""

    file: Path
    name: str
    jobs: list[Job]
    measures: list[Measure] = field(default_factory=list)
    rank_by: str = ""
    most_is_best: bool = True

    def axes(self) -> list[str]:
        """Keys that vary, in the plan's order."""
        return list(dict.fromkeys(key for job in self.jobs for key in job.varied))


def is_fmu(law: Any) -> bool:
    """A law that is the file of an FMU, and no class."""
    return str(law).endswith(".fmu")


def job_hash(job: Job, plan: Plan) -> str:
    """Of all that the figures of a job depend on but the programs and what a law opens by itself: settings, measures, contents of the
    files that settings name, of those that these name (a rig's lamps, scene and vehicle, ways of traffic), and a law's code."""
    contents = {}
    for key in (*FILES, "law"):
        value = job.settings.get(key)
        if value is not None and (key != "law" or is_fmu(value)):
            file, *words = str(value).split(",")
            named = [Path(word.partition("=")[2]) for word in words]  # spectrum=, pixels= of a lamp
            contents[key] = [digest_of(Path(file)), *(digest_of(other) for other in named if other.is_absolute())]
        elif value is not None and ":" in str(value):
            contents[key] = [digest_of_module(str(value).rpartition(":")[0])]
    text = json.dumps([job.settings, contents, [m.__dict__ for m in plan.measures]], sort_keys=True, default=str)
    return hashlib.sha256(text.encode()).hexdigest()


def read_plan(file: str | os.PathLike[str]) -> Plan:
    """Reads a plan; raises BadInput with file, line and reason."""
    here = Path(file)
    document = read_toml(file)

    def at(key: str) -> str:
        return place_in(file, key=key)

    _only(document, _TOP, at)
    _kinds(document, at)
    kind = document.get("kind", "grid")
    if kind not in _KINDS:
        raise BadInput(f"{at('kind')}: kind {kind!r}: expected one of {', '.join(_KINDS)}")
    for key in ("seed", "samples"):
        if key in document and kind != "latin-hypercube":
            raise BadInput(f"{at(key)}: {key} is of a Latin hypercube, and kind is {kind!r}")
    for key in document.get("fixed", {}):
        if key in document.get("vary", {}):
            raise BadInput(f"{place_in(file, 'fixed', key=key)}: {key} is fixed, and varies")
    folder = here.resolve().parent
    fixed = _settings(document.get("fixed", {}), lambda key: f"{place_in(file, 'fixed', key=key)}: fixed", folder)
    jobs = []
    for number, values in enumerate(_varied(document, kind, str(file)), 1):

        def of_job(key: str, number: int = number) -> str:
            there = place_in(file, "run", number, key) if kind == "list" else place_in(file, "vary", key=key)
            return f"{there}: job {number}"

        settings = {**fixed, **_settings(values, of_job, folder)}
        sensor = next((key for key in WORDS[7:] if key in settings), None)
        if settings.get("law") is None and sensor:
            raise BadInput(f"{of_job(sensor)}: sensor_… is of a control law: give law")
        jobs.append(Job(number, settings, values))
    measures = [
        _measure(table, lambda key, n=n: f"{place_in(file, 'measure', n, key)}: measure {n}")
        for n, table in enumerate(document.get("measure", []), 1)
    ]
    names = [measure.name for measure in measures]
    rank = document.get("rank", "most")
    if rank not in ("most", "least"):
        raise BadInput(f"{at('rank')}: rank {rank!r}: most or least is best")
    rank_by = document.get("rank_by", names[0] if names else "")
    plan = Plan(here.resolve(), document.get("name", here.stem), jobs, measures, rank_by, rank == "most")
    columns = [*names, *plan.axes(), *_figures(jobs)]
    for number, name in enumerate(names, 1):
        if columns.count(name) > 1:
            raise BadInput(f"{place_in(file, 'measure', number, 'name')}: measure {number}: {name!r} is another column's name already")
    if rank_by and rank_by not in columns:
        raise BadInput(f"{at('rank_by')}: rank_by {rank_by!r} is no column of the table; there are {', '.join(columns)}")
    if any(rank_by in job.varied and not _is_number(job.varied[rank_by]) for job in jobs):
        raise BadInput(f"{at('rank_by')}: rank_by {rank_by!r} is no column of numbers")
    return plan


def _figures(jobs: list[Job]) -> list[str]:
    """Those that a job of these has."""
    law = any("law" in job.settings for job in jobs)
    glare = any("law" in job.settings and "traffic" in job.settings for job in jobs)
    return [name for name in FIGURES if (law or name != "high_share") and (glare or not name.startswith("glare_"))]


def _only(table: dict[str, Any], known: tuple[str, ...], at: Place) -> None:
    for key in table:
        if key not in known:
            raise BadInput(f"{at(key)}: unknown key {key}; there are {', '.join(known)}")


def _kinds(document: dict[str, Any], at: Place) -> None:
    """Tables are tables, and words are words."""
    for key, value in document.items():
        if key in ("fixed", "vary") and not isinstance(value, dict):
            raise BadInput(f"{at(key)}: {key} = {value!r}: expected a table")
        if key in ("run", "measure") and not (isinstance(value, list) and all(isinstance(row, dict) for row in value)):
            raise BadInput(f"{at(key)}: {key} = {value!r}: expected [[{key}]] tables")
        if key in ("name", "rank_by") and not isinstance(value, str):
            raise BadInput(f"{at(key)}: {key} = {value!r}: expected a text")


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def _is_whole(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def _settings(table: dict[str, Any], at: Place, folder: Path) -> dict[str, Any]:
    """One value a key; paths become absolute. A lamp may have `,KEY=VALUE` behind its file, as --lamp has."""
    settings = {}
    for key, value in table.items():
        if key not in FILES + WORDS and not key.startswith("set."):
            raise BadInput(f"{at(key)}: unknown key {key}; there are {', '.join(FILES + WORDS)}, set.SETTING")
        if isinstance(value, (list, dict)) or (isinstance(value, float) and not math.isfinite(value)):
            raise BadInput(f"{at(key)}: {key} = {value!r}: expected one value")
        allows, words = _EXPECTED.get(key, (lambda _: True, ""))
        if not allows(value):
            raise BadInput(f"{at(key)}: {key} = {value!r}: expected {words}")
        if key in FILES or key == "law" and is_fmu(value):
            name, comma, rest = str(value).partition(",")
            there = (folder / name).resolve()
            if not there.is_file():
                raise BadInput(f"{at(key)}: {key}: {there} is no file")
            value = str(there) + comma + rest
        settings[key] = value
    return settings


def _varied(document: dict[str, Any], kind: str, file: str) -> list[dict[str, Any]]:
    vary, runs = document.get("vary", {}), document.get("run", [])
    if (kind == "list") != bool(runs) or (kind == "list") == bool(vary):
        raise BadInput(f"{file}: a list has [[run]] tables and no [vary]; grid and latin-hypercube have [vary] and no [[run]]")
    if kind == "list":
        return [dict(run) for run in runs]
    if kind == "grid":
        for key, values in vary.items():
            if not isinstance(values, list) or not values:
                raise BadInput(f"{place_in(file, 'vary', key=key)}: vary: {key} = {values!r}: expected a list of values")
        if math.prod(map(len, vary.values())) > _MOST_JOBS:
            raise BadInput(f"{place_in(file, 'vary')}: vary: makes more than {_MOST_JOBS} jobs")
        return [dict(zip(vary, values)) for values in itertools.product(*vary.values())]
    return _latin_hypercube(vary, document, file)


def _latin_hypercube(vary: dict[str, Any], document: dict[str, Any], file: str) -> list[dict[str, Any]]:
    """Numbers are drawn from {from, to}, one in each of `samples` equal parts; lists are gone through in equal shares."""
    try:
        from scipy.stats import qmc
    except ImportError as wrong:
        raise BadInput(f"{file}: a Latin hypercube needs SciPy: apt-get install python3-scipy") from wrong
    samples, seed = document.get("samples", 0), document.get("seed", 1)
    if not _is_whole(samples) or not 1 <= samples <= _MOST_JOBS:
        raise BadInput(f"{place_in(file, key='samples')}: a Latin hypercube has samples = 1 to {_MOST_JOBS}")
    if not _is_whole(seed) or seed < 0:
        raise BadInput(f"{place_in(file, key='seed')}: seed = {seed!r}: expected a whole number from 0")
    shares = qmc.LatinHypercube(d=len(vary), seed=seed).random(samples)
    rows = []
    for row in shares:
        values = {}
        for (key, axis), share in zip(vary.items(), row):
            if isinstance(axis, list) and axis:
                values[key] = axis[int(share * len(axis))]
            elif isinstance(axis, dict) and set(axis) == {"from", "to"} and _rises(axis["from"], axis["to"]):
                values[key] = round(axis["from"] + float(share) * (axis["to"] - axis["from"]), 9)
            else:
                place = place_in(file, "vary", key=key)
                raise BadInput(f"{place}: vary: {key} = {axis!r}: expected a list or {{ from = …, to = … }}, rising")
        rows.append(values)
    return rows


def _rises(first: Any, last: Any) -> bool:
    return _is_number(first) and _is_number(last) and first < last


def _measure(table: dict[str, Any], place: Place) -> Measure:
    _only(table, tuple(Measure.__dataclass_fields__), place)
    name = table.get("name")
    if not isinstance(name, str) or not name:
        raise BadInput(f"{place('name')}: has no name")
    for key in ("range_lx", "y_m", "z_m"):
        if key in table and not _is_number(table[key]):
            raise BadInput(f"{place(key)}: {key} = {table[key]!r}: expected a finite number")
    at, range_lx = table.get("at", []), float(table.get("range_lx", 0.0))
    if not isinstance(at, list) or not all(_is_number(value) for value in at):
        raise BadInput(f"{place('at')}: at = {at!r}: expected finite numbers")
    if (len(at) in (3, 6)) == (range_lx > 0):
        raise BadInput(f"{place('at')}: either at = [x, y, z] or [x, y, z, nx, ny, nz], or range_lx above 0")
    beams = table.get("beams", ["low"])
    beams = [beams] if isinstance(beams, str) else beams
    if not isinstance(beams, list) or not beams or not all(beam in _BEAMS for beam in beams):
        raise BadInput(f"{place('beams')}: beams = {beams!r}: expected some of {', '.join(_BEAMS)}")
    return Measure(
        name, tuple(beams), tuple(map(float, at)), range_lx, float(table.get("y_m", 0.0)), float(table.get("z_m", 0.25))
    )
