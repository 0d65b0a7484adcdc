"""One job of a sweep: an ordinary drive, and the figures taken of it."""

from __future__ import annotations

import importlib
import math
import shlex
from pathlib import Path
from typing import Any

import numpy as np

from ..control.controller import Controller
from ..control.fmu import Fmu
from ..control.road_users import read_road_users
from ..control.sensors import Sensors
from ..drive import Report, drive
from ..errors import BadInput, PhareError
from ..judge import judge_glare
from ..light_in_drive import design_of_stills
from ..measuring import measure
from ..rig import Rig, shipped_file
from .plan import Job, Measure, Plan, is_fmu

_RANGE_TO_M, _RANGE_STEP_M = 300.0, 0.5


def law_named(name: str) -> Controller:
    """A law by its class: "GlareFree" of phare.laws, or "package.module:Class", made without arguments; or the file of an FMU."""
    if is_fmu(name):
        return Fmu(name)
    module, _, cls = name.rpartition(":")
    try:
        made = getattr(importlib.import_module(module or "phare.laws"), cls)()
    except PhareError:
        raise
    except (ImportError, AttributeError) as wrong:
        raise BadInput(f"law {name}: {wrong}") from wrong
    except (Exception, SystemExit) as wrong:  # whatever its code raises
        raise BadInput(f"law {name}: {type(wrong).__name__}: {wrong}") from wrong
    if not isinstance(made, Controller):
        raise BadInput(f"law {name}: is no phare.Controller")
    return made


def drive_words(job: Job) -> dict[str, Any]:
    """The job as arguments of phare.drive."""
    s = job.settings
    words: dict[str, Any] = {
        key: s[key]
        for key in ("rig", "lamp", "lamp_high", "lamp_fog", "aim", "drive", "script", "log", "level", "frames", "size")
        if key in s
    }
    words["settings"] = {key[4:]: value for key, value in s.items() if key.startswith("set.")}
    more = ["--audit-every", "0"]
    for key in ("vehicle", "friction", "roughness", "road", "traffic"):
        more += [f"--{key}", str(s[key])] if key in s else []
    words["more"] = more
    if "law" in s:
        words["controller"] = law_named(str(s["law"]))
        seen_m = {**Sensors().range_m, **({"red": s["sensor_red_range_m"]} if "sensor_red_range_m" in s else {})}
        words["sensors"] = Sensors(
            s.get("traffic", ()), range_m=seen_m, delay_s=s.get("sensor_delay_s", 0.0), noise_angle_deg=s.get("sensor_noise_deg", 0.0),
            miss_01=s.get("sensor_miss_01", 0.0), seed=s.get("sensor_seed", 1),
        )
    return words


def command_of(job: Job, plan: Plan) -> str:
    """What repeats the job: `phare drive …`, or, with a control law, this package."""
    if "law" in job.settings:
        return shlex.join(["python3", "-m", "phare.sweep", str(plan.file), "--only", str(job.number), "--out", "out/again"])
    words = ["phare", "drive", "--headless", "--lockstep"]
    given = drive_words(job)
    for key in ("rig", "lamp", "lamp_high", "lamp_fog", "aim", "drive", "script", "log", "level", "frames", "size"):
        words += [f"--{key.replace('_', '-')}", str(given[key])] if key in given else []
    for key, value in given["settings"].items():
        words += ["--set", f"{key}={value}"]
    return shlex.join([*words, *given["more"], "--out", f"out/{job.name()}"])


def run_job(job: Job, plan: Plan, folder: Path) -> dict[str, Any]:
    """Drives into `folder` and returns the row: what was varied, the figures, the command."""
    report = drive(out=folder, lockstep=True, record=True, **drive_words(job))
    row: dict[str, Any] = {"job": job.number, **job.varied, **figures_of(report)}
    rig = folder / "rig.toml"
    rig_file = rig if rig.exists() else Path(job.settings.get("rig") or shipped_file("rigs/country_road.toml"))
    if "law" in job.settings and "traffic" in job.settings:
        glare = judge_glare(report, Rig.read(rig_file), read_road_users(job.settings["traffic"]))
        row["glare_s"], row["glare_of_s"] = round(glare.above_s, 9), round(glare.judged_s, 9)
        glare.write_page(folder / "glare.html")
    for wanted in plan.measures:
        row[wanted.name] = figure(wanted, rig_file, design_of_stills(report))
    row["command"] = command_of(job, plan)
    (folder / "drive.pcap").unlink(missing_ok=True)  # the largest file, and the same drive gives it again
    return row


def figures_of(report: Report) -> dict[str, Any]:
    """Figures that are the same whenever the drive is: no times of the clock on the wall."""
    car = report.car
    figures: dict[str, Any] = {
        "frames": int(report.figures["frames"]),
        "driven_s": round(float(car.index[-1]), 9),
        "driven_m": round(float(np.hypot(car.x_m.diff(), car.y_m.diff()).sum()), 6),
        "suspension_pitch_most_deg": round(math.degrees(float(car.suspension_pitch_rad.abs().max())), 9),
        "picture_hash": report.picture_hash,
    }
    files = report.frame_files
    if files:
        figures["picture_mean"] = round(float(report.frame(-1).mean()), 6)
    if report.led_by_law:
        steps = report.law_steps
        figures["high_share"] = round(float((steps.light == "high").mean()), 6)
    return figures


def figure(wanted: Measure, rig_file: Path, design: str) -> float:
    """In lux, or in metres ahead of the car's origin; 0 where so many lux are nowhere."""
    if wanted.at:
        return float(measure(rig_file, [wanted.at], beams=wanted.beams, design=design, reference=True)[0])
    x = np.arange(5.0, _RANGE_TO_M + 0.1, _RANGE_STEP_M)
    points = np.column_stack([x, *(np.full_like(x, value) for value in (wanted.y_m, wanted.z_m, -1.0, 0.0, 0.0))])
    lux = measure(rig_file, points, beams=wanted.beams, design=design, reference=True)
    bright = np.flatnonzero(lux >= wanted.range_lx)
    return float(x[bright[-1]]) if bright.size else 0.0
