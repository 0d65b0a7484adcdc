"""One drive through the night (`phare drive`), and what came out of it."""

from __future__ import annotations

import contextlib
import json
import os
import random
import signal
import socket
import subprocess
import tempfile
import threading
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Iterator, Mapping, Sequence

import numpy as np
import pandas as pd

from .drive_file import Drive, read_drive
from .errors import BadInput, Failed, LawFailed, told
from .png import read_png
from .programs import program, raise_for
from .rig import Rig, shipped_file

if TYPE_CHECKING:
    from .control.controller import Controller
    from .control.sensors import Sensors

PathLike = str | os.PathLike[str]
_PORTS = 30  # of a rig
_GIVEN: list[int] = []  # the last that were given to drives of this process, which may not hold them yet
_GIVEN_LOCK = threading.Lock()


class Report:
    """What came out of a drive: its folder, its figures, its pictures, its course.

    As long as this object lives, so does the folder, where the drive was given none of its own.
    """

    def __init__(self, folder: PathLike, command: Sequence[str] = (), kept_by: Any = None):
        self.folder = Path(folder)
        self.command = list(command)  # that repeats the drive
        self._kept_by = kept_by
        file = self.folder / "report.json"
        try:
            self.raw: dict[str, Any] = json.loads(file.read_text())
        except OSError as wrong:
            raise BadInput(f"{file}: {wrong.strerror}") from wrong
        except json.JSONDecodeError as wrong:
            raise BadInput(f"{file}: {wrong}") from wrong
        self._drive: Drive | None = None

    def __repr__(self) -> str:
        return f"Report({str(self.folder)!r}, {self.figures.get('frames', 0)} frames)"

    @property
    def figures(self) -> dict[str, Any]:
        """The figures that matter (`summary` of report.json): frames, frame_ms, self_audit, law, messages, …"""
        return dict(self.raw.get("summary", {}))

    @property
    def exit_code(self) -> int:
        """0: done; 1: it did not come to its end, and `raw["why"]` says why."""
        return int(self.raw.get("exit_code", 0))

    @property
    def picture_hash(self) -> str:
        """Over all pictures kept: equal when two drives look the same, byte for byte."""
        return str(self.raw["processes"]["visual-0"]["kept_frames"]["hash"])

    @property
    def frame_files(self) -> list[Path]:
        """The pictures of the drive, in their order."""
        return sorted((self.folder / "frames").glob("*.png"))

    def frame(self, number: int) -> np.ndarray:
        """One picture: uint8 of shape (height, width, 3), sRGB, the top row first. Negative numbers count from the end."""
        files = self.frame_files
        try:
            return read_png(files[number])[..., :3]
        except IndexError:
            raise BadInput(f"{self.folder}: {len(files)} pictures, no number {number}") from None

    def frames(self) -> np.ndarray:
        """All pictures: uint8 of shape (pictures, height, width, 3)."""
        files = self.frame_files
        return np.stack([read_png(file)[..., :3] for file in files]) if files else np.zeros((0, 0, 0, 3), np.uint8)

    @property
    def drive(self) -> Drive:
        """Every message of the drive, where it was recorded."""
        if self._drive is None:
            file = self.folder / "drive.pcap"
            if not self._asked_for("--record") or not file.exists():
                raise BadInput(f"{self.folder}: the drive was not recorded (record=True)")
            self._drive = read_drive(file)
        return self._drive

    @property
    def car(self) -> pd.DataFrame:
        """Time series of the car: sim_time_s as index; x_m, y_m, z_m, yaw_rad, pitch_rad (nose down), speed_mps, … as
        VehicleState of net/phare.proto."""
        return self._drawn(self.drive.table("vehicle_state"))

    @property
    def controls(self) -> pd.DataFrame:
        """Time series of the driver's controls: light_switch (0 off, 1 position, 2 low, 3 high), steering_wheel_rad, …"""
        return self._drawn(self.drive.table("cockpit_state"))

    @property
    def pictures(self) -> pd.DataFrame:
        """Time series of the pictures: frame_ms, gpu_ms, light_drawn, … as FrameReport."""
        return self.drive.table("frame_report")

    @property
    def law(self) -> pd.DataFrame:
        """Time series of the control law's answers: light_switch, levelling_rad, and for each lamp NAME/yaw_rad,
        NAME/pitch_rad and NAME/SOURCE (its light, 0 to 1; sources count from 1)."""
        table = self.drive.table("law_answer")
        rows, seen = [], set()
        for datagram, answer in self.drive.payloads("law_answer"):
            if (datagram.start_id, datagram.sequence) in seen:
                continue
            seen.add((datagram.start_id, datagram.sequence))
            row: dict[str, float] = {}
            for light in answer.lamps:
                row[f"{light.lamp}/yaw_rad"], row[f"{light.lamp}/pitch_rad"] = light.yaw_rad, light.pitch_rad
                for i, dimming in enumerate(light.dimming_01):
                    row[f"{light.lamp}/{i + 1}"] = dimming
            rows.append(row)
        return self._drawn(pd.concat([table, pd.DataFrame(rows, index=table.index)], axis=1))

    @property
    def led_by_law(self) -> bool:
        """Whether a control law led it: then there are `law` and `law_steps`."""
        return self._asked_for("--law") and (self.folder / "law.csv").exists()

    def _asked_for(self, flag: str) -> bool:
        """What another drive left in the folder is not of this one."""
        return any(word == flag or word.startswith(f"{flag}=") for word in self.raw.get("command", [flag]))

    def _drawn(self, table: pd.DataFrame) -> pd.DataFrame:
        """Lockstep: up to the last frame that was drawn. Whether the processes had begun the next when it ended is chance."""
        if not self.raw.get("lockstep") or table.empty:
            return table
        return table[table.frame_index <= self.pictures.frame_index.max()]

    @property
    def law_steps(self) -> pd.DataFrame:
        """One row a step of the control law: frame_index as index, time_s, law_ms (of its step on this machine), objects (that
        it was given), nearest_m, seen_time_s, light, levelling_rad."""
        file = self.folder / "law.csv"
        if not self.led_by_law:
            raise BadInput(f"{self.folder}: no control law led this drive to its end")
        steps = pd.read_csv(file, index_col="frame_index", keep_default_na=False, na_values={"nearest_m": ["nan"]})
        lockstep = self.raw.get("lockstep") and self._asked_for("--record") and (self.folder / "drive.pcap").exists()
        return steps[steps.index <= self.pictures.frame_index.max()] if lockstep else steps


def free_ports() -> int:
    """The first of 30 UDP ports of this machine that nobody holds now: drives side by side need ports of their own."""
    for _ in range(200):
        base = random.randrange(20000, 32000 - _PORTS, _PORTS)  # below those that the kernel gives out by itself
        with _GIVEN_LOCK:
            if base in _GIVEN:
                continue
            _GIVEN.append(base)
            del _GIVEN[:-100]
        if all(_free(base + offset) for offset in range(_PORTS)):
            return base
    raise Failed("no 30 free UDP ports between 20000 and 32000")


def _free(port: int) -> bool:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.bind(("127.0.0.1", port))
        except OSError:
            return False
    return True


def drive(
    rig: Rig | PathLike | None = None,
    *,
    lamp: str | Sequence[str] | PathLike | None = None,
    lamp_high: str | PathLike | None = None,
    lamp_fog: str | PathLike | None = None,
    aim: str | float | None = None,
    drive: PathLike | None = None,
    script: PathLike | None = None,
    log: PathLike | None = None,
    traffic: PathLike | None = None,
    out: PathLike | None = None,
    frames: int | None = None,
    size: str | tuple[int, int] | None = None,
    level: str | None = None,
    lockstep: bool = True,
    record: bool = True,
    overwrite: bool = False,
    controller: Controller | None = None,
    sensors: Sensors | None = None,
    settings: Mapping[str, Any] | None = None,
    port_base: int | None = None,
    timeout_s: float | None = None,
    more: Sequence[str] = (),
) -> Report:
    """Drives without a window and returns what came out.

    rig: a Rig, or a rig file; None: the demo. lamp, lamp_high, lamp_fog, aim: a lamp of one's own in the words of
    `phare drive --lamp`. drive: a drive file to replay; script: of the driver model; log: a candump log; none: the demo drive.
    traffic: other road users in the picture, a TOML file; None: the rig's (docs/traffic.md).
    out: folder for pictures and report; None: a folder that goes with the Report. frames: keep each of the first so many
    and end then; None: to the end of the drive. size: pixels, "320x180" or (320, 180). level: of the car's model. lockstep:
    reproducible bit for bit; else in real time. record: keep every message (the time series of the Report). overwrite: put this
    drive in the place of another in `out`, which stays as it is where this one cannot begin. controller: a control law, which leads the lamps; sensors: what it is given.
    settings: of the picture, as `phare control set` has them. port_base: first of 30 UDP ports; None: free ones. timeout_s: of
    the clock on the wall. more: further words for `phare drive`.

    Raises BadInput with the program's words, Failed when the drive did not come to its end, LawFailed when the law did not.
    """
    if sensors is not None and controller is None:
        raise BadInput("sensors: are of a control law, and there is no controller")
    kept_by = None
    if out is None:
        kept_by = tempfile.TemporaryDirectory(prefix="phare-drive-")
        out = kept_by.name
    folder = Path(out).absolute()
    if (folder / "report.json").exists() and not overwrite:
        raise BadInput(f"{folder}: holds a drive; overwrite=True puts this one in its place")
    with told(folder):
        folder.mkdir(parents=True, exist_ok=True)
    rig_file = folder / "driven.toml" if isinstance(rig, Rig) else None if rig is None else Path(rig).absolute()
    more, chosen = _port_in(more)
    if chosen is not None and port_base is not None:
        raise BadInput(f"port_base is {port_base}, and --port-base of more {chosen}: one of both")
    base = next((port for port in (port_base, chosen) if port is not None), None)
    base = free_ports() if base is None else base
    words = ["drive", "--headless", "--overwrite", "--out", str(folder), "--port-base", str(base)]
    given: dict[str, Any] = {
        "--rig": rig_file, "--lamp-high": lamp_high, "--lamp-fog": lamp_fog, "--aim": aim, "--drive": drive,
        "--script": script, "--log": log, "--traffic": traffic, "--frames": frames, "--level": level,
        "--size": "x".join(map(str, size)) if isinstance(size, tuple) else size,
        "--record": folder / "drive.pcap" if record else None,
    }
    for flag, value in given.items():
        words += [flag, os.fspath(value) if isinstance(value, os.PathLike) else str(value)] if value is not None else []
    for each in [lamp] if isinstance(lamp, (str, os.PathLike)) else lamp or []:
        words += ["--lamp", os.fspath(each)]
    for name, value in (settings or {}).items():
        words += ["--set", f"{name}={value}"]
    words += (["--lockstep"] if lockstep else []) + (["--law"] if controller is not None else []) + list(more)
    command = [str(program()), *words]
    inputs = [rig_file, *(Path(file) for file in (drive, log, script) if file is not None)]
    with _in_place_of(folder, [file for file in inputs if file is not None]):
        if isinstance(rig, Rig):
            rig.write(folder / "driven.toml")
        if controller is None:
            _watch(command, timeout_s, lambda: None)
            return Report(folder, command, kept_by)

        from .control.link import Link, design_shown

        own = folder / "rig.toml" if lamp is not None or lamp_high is not None or lamp_fog is not None else None
        of_link = (controller, rig_file or shipped_file("rigs/country_road.toml"), base, lockstep, sensors, own)
        with Link(*of_link, design_shown(settings or {}, more)) as link:
            _watch(command, timeout_s, link.fault)
    link.write_csv(folder / "law.csv")
    return Report(folder, command, kept_by)


def _port_in(more: Sequence[str]) -> tuple[list[str], int | None]:
    """Words without --port-base, which the law needs to know, too; and that port."""
    words, left, port = [part for word in more for part in (word.split("=", 1) if word.startswith("--port-base=") else [word])], [], None
    while words:
        word = words.pop(0)
        if word != "--port-base":
            left.append(word)
        elif not words or not words[0].isdecimal():
            raise BadInput(f"--port-base: expected a number, got {words[0] if words else 'nothing'}")
        else:
            port = int(words.pop(0))
    return left, port


@contextlib.contextmanager
def _in_place_of(folder: Path, inputs: Sequence[Path]) -> Iterator[None]:
    """What this package puts beside a report goes with the drive that it belongs to. Where the new drive did not begin, so that
    report.json is the one of before, it stays; else what the new one has not written and is not driven from is removed."""
    beside = [folder / name for name in ("driven.toml", "drive.pcap", "law.csv")]
    of_rig, report = beside[0], folder / "report.json"
    rig_before = of_rig.read_bytes() if of_rig.exists() else None
    before = {file: _stamp(file) for file in (*beside, report)}
    try:
        yield
    finally:
        begun = _stamp(report) != before[report]
        for file in beside if begun else ():
            if before[file] is not None and _stamp(file) == before[file] and not any(_same(file, one) for one in inputs):
                file.unlink()
        if not begun and _stamp(of_rig) != before[of_rig]:
            if rig_before is None:
                of_rig.unlink()
            else:
                part = of_rig.with_name(of_rig.name + ".part")
                part.write_bytes(rig_before)
                part.replace(of_rig)


def _stamp(file: Path) -> tuple[int, int, int] | None:
    """Of a file's contents; None: there is none."""
    try:
        of = file.stat()
    except OSError:
        return None
    return of.st_ino, of.st_size, of.st_mtime_ns


def _same(one: Path, other: Path) -> bool:
    return other.exists() and one.samefile(other)


def _watch(command: Sequence[str], timeout_s: float | None, fault: Callable[[], LawFailed | None]) -> None:
    """Runs a drive to its end; ends it when the law fails or time is up."""
    with tempfile.TemporaryFile("w+") as said, subprocess.Popen(
        command, stdout=subprocess.DEVNULL, stderr=said, stdin=subprocess.DEVNULL
    ) as running:
        until = None if timeout_s is None else time.monotonic() + timeout_s
        why: Failed | LawFailed | None = None
        try:
            while running.poll() is None:
                why = fault()
                if why is None and until is not None and time.monotonic() > until:
                    why = Failed(f"phare drive: not done after {timeout_s:g} s")
                if why is not None:
                    break
                try:
                    running.wait(0.05)
                except subprocess.TimeoutExpired:
                    continue
        finally:
            if running.poll() is None:
                running.send_signal(signal.SIGINT)
                try:
                    running.wait(20)
                except subprocess.TimeoutExpired:
                    running.kill()
        why = why or fault()
        if why is not None:
            raise why
        said.seek(0)
        raise_for(running.returncode, said.read(), "phare drive")
