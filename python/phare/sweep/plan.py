"""A plan of drives: what is varied, what is measured, by what it is ranked. Reader of plan.toml (docs/sweep.md).

The jobs of a plan and their order follow from the plan alone: full grid, list, or Latin hypercube from its seed.
"""

from __future__ import annotations

import hashlib
import itertools
import json
import math
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from ..errors import BadInput
from ..toml_in import read_toml

# What a drive can be told. Of these the values are paths, relative to the plan.
FILES = ("rig", "lamp", "lamp_high", "lamp_fog", "drive", "script", "log", "vehicle", "road", "traffic")
WORDS = (
    "aim", "level", "friction", "roughness", "frames", "size", "law", "sensor_delay_s", "sensor_noise_deg", "sensor_miss_01",
    "sensor_seed", "sensor_red_range_m",
)
#: Numbers that a job's row has of its drive (phare.sweep.job); some of them where the job calls for them.
FIGURES = ("frames", "driven_s", "driven_m", "suspension_pitch_most_deg", "picture_mean", "high_share", "glare_s", "glare_of_s")
_TOP = ("name", "kind", "seed", "samples", "rank_by", "rank", "fixed", "vary", "run", "measure")
_KINDS = ("grid", "list", "latin-hypercube")


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
    """Of all that the figures of a job depend on but the programs: settings, contents of the files they name, measures."""
    contents = {}
    for key in (*FILES, "law"):
        value = job.settings.get(key)
        if value is not None and (key != "law" or is_fmu(value)):
            file = Path(str(value).split(",")[0])
            contents[key] = hashlib.sha256(file.read_bytes()).hexdigest() if file.is_file() else "none"
    text = json.dumps([job.settings, contents, [m.__dict__ for m in plan.measures]], sort_keys=True, default=str)
    return hashlib.sha256(text.encode()).hexdigest()


def read_plan(file: str | os.PathLike[str]) -> Plan:
    """Reads a plan; raises BadInput with file and reason."""
    here = Path(file)
    document = read_toml(file)
    _only(document, _TOP, str(file))
    kind = document.get("kind", "grid")
    if kind not in _KINDS:
        raise BadInput(f"{file}: kind {kind!r}: expected one of {', '.join(_KINDS)}")
    for key in ("seed", "samples"):
        if key in document and kind != "latin-hypercube":
            raise BadInput(f"{file}: {key} is of a Latin hypercube, and kind is {kind!r}")
    for key in document.get("fixed", {}):
        if key in document.get("vary", {}):
            raise BadInput(f"{file}: {key} is fixed, and varies")
    folder = here.resolve().parent
    fixed = _settings(document.get("fixed", {}), f"{file}: fixed", folder)
    varied = _varied(document, kind, str(file))
    jobs = []
    for number, values in enumerate(varied, 1):
        settings = {**fixed, **_settings(values, f"{file}: job {number}", folder)}
        if settings.get("law") is None and any(key in settings for key in WORDS[7:]):
            raise BadInput(f"{file}: job {number}: sensor_… is of a control law: give law")
        jobs.append(Job(number, settings, values))
    measures = [_measure(table, f"{file}: measure {n}") for n, table in enumerate(document.get("measure", []), 1)]
    names = [measure.name for measure in measures]
    if len(set(names)) < len(names):
        raise BadInput(f"{file}: two measures have one name")
    rank = document.get("rank", "most")
    if rank not in ("most", "least"):
        raise BadInput(f"{file}: rank {rank!r}: most or least is best")
    rank_by = str(document.get("rank_by", names[0] if names else ""))
    plan = Plan(here.resolve(), str(document.get("name", here.stem)), jobs, measures, rank_by, rank == "most")
    columns = [*names, *plan.axes(), *FIGURES]
    if rank_by and rank_by not in columns:
        raise BadInput(f"{file}: rank_by {rank_by!r} is no column of the table; there are {', '.join(columns)}")
    return plan


def _only(table: dict[str, Any], known: tuple[str, ...], place: str) -> None:
    for key in table:
        if key not in known:
            raise BadInput(f"{place}: unknown key {key}; there are {', '.join(known)}")


def _settings(table: dict[str, Any], place: str, folder: Path) -> dict[str, Any]:
    """One value a key; paths become absolute. A lamp may have `,KEY=VALUE` behind its file, as --lamp has."""
    settings = {}
    for key, value in table.items():
        if key not in FILES + WORDS and not key.startswith("set."):
            raise BadInput(f"{place}: unknown key {key}; there are {', '.join(FILES + WORDS)}, set.SETTING")
        if isinstance(value, (list, dict)) or (isinstance(value, float) and not math.isfinite(value)):
            raise BadInput(f"{place}: {key} = {value!r}: expected one value")
        if key in FILES or key == "law" and is_fmu(value):
            name, comma, rest = str(value).partition(",")
            there = (folder / name).resolve()
            if not there.is_file():
                raise BadInput(f"{place}: {key}: {there} is no file")
            value = str(there) + comma + rest
        settings[key] = value
    return settings


def _varied(document: dict[str, Any], kind: str, place: str) -> list[dict[str, Any]]:
    vary, runs = document.get("vary", {}), document.get("run", [])
    if (kind == "list") != bool(runs) or (kind == "list") == bool(vary):
        raise BadInput(f"{place}: a list has [[run]] tables and no [vary]; grid and latin-hypercube have [vary] and no [[run]]")
    if kind == "list":
        return [dict(run) for run in runs]
    if kind == "grid":
        for key, values in vary.items():
            if not isinstance(values, list) or not values:
                raise BadInput(f"{place}: vary: {key} = {values!r}: expected a list of values")
        return [dict(zip(vary, values)) for values in itertools.product(*vary.values())]
    return _latin_hypercube(vary, document, place)


def _latin_hypercube(vary: dict[str, Any], document: dict[str, Any], place: str) -> list[dict[str, Any]]:
    """Numbers are drawn from {from, to}, one in each of `samples` equal parts; lists are gone through in equal shares."""
    try:
        from scipy.stats import qmc
    except ImportError as wrong:
        raise BadInput(f"{place}: a Latin hypercube needs SciPy: apt-get install python3-scipy") from wrong
    samples, seed = document.get("samples", 0), document.get("seed", 1)
    if not isinstance(samples, int) or not 1 <= samples <= 1_000_000 or not isinstance(seed, int):
        raise BadInput(f"{place}: a Latin hypercube has samples = 1 to 1000000, and seed a whole number")
    shares = qmc.LatinHypercube(d=len(vary), seed=seed).random(samples)
    rows = []
    for row in shares:
        values = {}
        for (key, axis), share in zip(vary.items(), row):
            if isinstance(axis, list) and axis:
                values[key] = axis[int(share * len(axis))]
            elif isinstance(axis, dict) and set(axis) == {"from", "to"} and axis["from"] < axis["to"]:
                values[key] = round(axis["from"] + float(share) * (axis["to"] - axis["from"]), 9)
            else:
                raise BadInput(f"{place}: vary: {key} = {axis!r}: expected a list or {{ from = …, to = … }}")
        rows.append(values)
    return rows


def _measure(table: dict[str, Any], place: str) -> Measure:
    _only(table, tuple(Measure.__dataclass_fields__), place)
    name = table.get("name")
    if not isinstance(name, str) or not name:
        raise BadInput(f"{place}: has no name")
    at = tuple(float(value) for value in table.get("at", ()))
    range_lx = float(table.get("range_lx", 0.0))
    if (len(at) in (3, 6)) == (range_lx > 0):
        raise BadInput(f"{place}: either at = [x, y, z] or [x, y, z, nx, ny, nz], or range_lx above 0")
    beams = table.get("beams", ["low"])
    return Measure(
        name, tuple([beams] if isinstance(beams, str) else beams), at, range_lx, float(table.get("y_m", 0.0)),
        float(table.get("z_m", 0.25)),
    )
