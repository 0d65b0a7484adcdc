"""Puts a law on the bus of a drive: hears car and controls, asks the law, sends LawAnswer (docs/control-law.md)."""

from __future__ import annotations

import csv
import os
import random
import select
import socket
import threading
import time
from pathlib import Path
from types import TracebackType
from typing import Any, Mapping, Sequence

import numpy as np

from .. import phare_pb2 as pb
from .. import wire
from ..errors import BadInput, LawFailed, PhareError
from ..rig import Rig, resolved
from .controller import Controller, ended, failed
from .lamps import lamps_of
from .messages import LIGHT, Answer, Given, LampOfLaw
from .road_users import Lane
from .sensors import Eyes, Pose, Sensors

_LAW_PORT, _RECORDER_PORT, _VISUAL_PORT = 4, 2, 10
_LEAVES_WITHIN_S = 5.0  # a law is waited for when its drive has ended; chosen


def design_shown(settings: Mapping[str, Any], more: Sequence[str]) -> str | None:
    """What the words of a drive say of the design that its picture shows: a setting before --design; None: nothing."""
    words = [word.partition("=") for word in more]
    given = [(flag, value or (more[i + 1] if i + 1 < len(more) else "")) for i, (flag, _, value) in enumerate(words)]
    chosen = [value for flag, value in given if flag == "--design"]
    chosen += [str(settings["design"])] if "design" in settings else []
    chosen += [value.removeprefix("design=") for flag, value in given if flag == "--set" and value.startswith("design=")]
    return chosen[-1] if chosen else None


class Link:
    """A law in the loop of one drive, in a thread of its own, from `with` to its end."""

    def __init__(
        self, controller: Controller, rig_file: str | os.PathLike[str], port_base: int, lockstep: bool,
        sensors: Sensors | None = None, driven_rig: Path | None = None, design: str | None = None,
    ):
        """driven_rig: a rig file that the drive makes of it, where it has lamps of one's own. design: name or number of the one that the
        picture shows, whatever the cockpit has chosen; None: as the rig's [desk] says."""
        if isinstance(controller, type):
            raise BadInput(f"controller is the class {controller.__name__}: give an object of it, {controller.__name__}()")
        if not isinstance(controller, Controller):
            raise BadInput(f"controller is {type(controller).__name__}, and no phare.Controller")
        self._law, self._rig_file, self._base, self._lockstep = controller, Path(rig_file), port_base, lockstep
        self._driven_rig = driven_rig
        self._rig = Rig.read(rig_file)
        self._shown = design if design is not None else self._rig.more.get("desk", {}).get("design", "cockpit")
        bus = self._rig.more.get("bus", {})
        self._address = bus.get("address", "127.0.0.1")
        if not self._address.startswith("127."):
            raise BadInput(f"{rig_file}: its bus leaves this machine; a law of this package speaks on loopback")
        self._key: bytes | None = wire.read_key(bus["key_file"]) if bus.get("key_file") else None
        run_key = bus.get("run_key", True) and not bus.get("key_file")
        self._key_file = wire.run_folder() / f"{self._address}-{port_base}.key" if run_key else None
        lane_file = resolved(self._rig.scene)
        lane_file = lane_file.with_name(lane_file.stem + "_lane.csv")
        self._eyes = Eyes(sensors or Sensors(), Lane(lane_file) if lane_file.exists() else None)
        self._lamps: dict[int, list[LampOfLaw]] = {}
        self._cockpit: pb.CockpitState | None = None
        self._car: pb.Datagram | None = None
        self._design: int | None = None
        self._answered: pb.Datagram | None = None  # the last
        self._last_s: float | None = None
        self._start_id, self._sequence = random.getrandbits(63) | 1, 0
        self._fault: LawFailed | None = None
        self._leave = threading.Event()
        self._rows: list[list[Any]] = []
        self._socket: socket.socket | None = None
        self._thread: threading.Thread | None = None

    def __enter__(self) -> Link:
        if self._driven_rig is None:
            self._lamps_of(self._shown_index(0))
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4 << 20)
        try:
            self._socket.bind((self._address, self._base + _LAW_PORT))
        except OSError as wrong:
            self._socket.close()
            raise BadInput(f"UDP port {self._base + _LAW_PORT} of the control law: {wrong.strerror}") from wrong
        self._socket.setblocking(False)
        self._thread = threading.Thread(target=self._run, name="control law", daemon=True)
        self._thread.start()
        return self

    def __exit__(self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None) -> None:
        """Raises what the law failed by, where nothing else is wrong. One that does not come back from its step is left alone."""
        self._leave.set()
        if self._thread is not None:
            self._thread.join(_LEAVES_WITHIN_S)
        if self._socket is not None:
            self._socket.close()
        if kind is None and self._fault is not None:
            raise self._fault

    def fault(self) -> LawFailed | None:
        """Why the law does not go on; None as long as it does."""
        return self._fault

    def write_csv(self, file: Path) -> None:
        """One row a frame: what the law was given in short, how long it took, what it said."""
        with file.open("w", newline="") as out:
            writer = csv.writer(out)
            writer.writerow(
                ["frame_index", "time_s", "law_ms", "objects", "nearest_m", "seen_time_s", "light", "levelling_rad"]
            )
            writer.writerows(list(self._rows))

    def _shown_index(self, of_cockpit: int) -> int:
        """The design that shines, as visual/process has it: that of the desk before that of the cockpit; past the last: the last."""
        names = [design.name for design in self._rig.designs]
        shown = str(self._shown)
        index = names.index(shown) if shown in names else int(shown) if shown.isdecimal() else of_cockpit
        return min(index, len(names) - 1)

    def _lamps_of(self, design_index: int) -> list[LampOfLaw]:
        if design_index not in self._lamps:
            designs = self._rig.designs
            self._lamps[design_index] = lamps_of(designs[min(design_index, len(designs) - 1)])
        return self._lamps[design_index]

    def _run(self) -> None:
        assert self._socket is not None
        try:
            while not self._leave.is_set():
                if not select.select([self._socket], [], [], 0.05)[0]:
                    continue
                self._hear()
                if self._lockstep:
                    self._in_lockstep()
                else:
                    self._in_real_time()
        except BaseException as wrong:  # whatever a law raises, sys.exit() too, ends the drive with its own words
            frame = 0 if self._last_s is None else round(self._last_s * self._rig.frame_rate_hz)
            self._fault = failed(wrong, f"after frame {frame}")
        why = ended(self._law)
        self._fault = self._fault or why

    def _hear(self) -> None:
        """Takes all that waits; of each message the newest counts."""
        assert self._socket is not None
        while True:
            try:
                data = self._socket.recv(65536)
            except BlockingIOError:
                return
            opened = self._open(data)
            if opened is None:
                continue
            try:
                datagram = wire.decode(opened)
            except BadInput:
                continue
            if datagram.HasField("vehicle_state") and datagram.sender == pb.SENDER_DYNAMICS:
                self._car = datagram
            elif datagram.HasField("cockpit_state") and datagram.sender == pb.SENDER_COCKPIT:
                self._cockpit = datagram.cockpit_state

    def _open(self, data: bytes) -> bytes | None:
        """Without its tag. The key of the run is made when the drive starts: one that does not fit is read anew."""
        if self._key_file is None:
            return wire.unseal(data, self._key)
        opened = wire.unseal(data, self._key) if self._key else None
        if opened is None:
            try:
                self._key = wire.read_key(self._key_file)
            except (OSError, PhareError):
                return None
            opened = wire.unseal(data, self._key)
        return opened

    def _in_lockstep(self) -> None:
        if self._car is None or self._cockpit is None:
            return
        frame = self._car.vehicle_state.frame_index
        if frame < 0 or self._cockpit.frame_index != frame:
            return
        if self._answered is not None and self._answered.law_answer.frame_index == frame:
            self._transmit()  # somebody asks again: the answer was lost
        else:
            self._answer(frame)

    def _in_real_time(self) -> None:
        """Once a frame's time, of the newest pose."""
        if self._car is None or self._cockpit is None:
            return
        rate = self._rig.frame_rate_hz
        due_ns = -1 if self._answered is None else self._answered.sim_time_ns + 1_000_000_000 // rate - 2_000_000
        if self._car.sim_time_ns < due_ns and self._car.sim_time_ns >= (self._answered.sim_time_ns if self._answered else 0):
            return  # not due, and nobody has gone back in time
        self._answer(-1)

    def _given(self, number: int) -> Given:
        assert self._car is not None and self._cockpit is not None
        car, controls, time_s = self._car.vehicle_state, self._cockpit, self._car.sim_time_ns * 1e-9
        if self._driven_rig is not None and not self._lamps and self._driven_rig.exists():
            self._rig = Rig.read(self._driven_rig)
        design_index = self._shown_index(controls.design_index)
        given = Given(
            frame_index=number, time_s=time_s, step_s=0.0 if self._last_s is None else max(0.0, time_s - self._last_s),
            speed_mps=car.speed_mps, yaw_rate_radps=car.yaw_rate_radps, steering_wheel_rad=controls.steering_wheel_rad,
            steer_rad=car.steer_rad, ax_mps2=car.ax_mps2, ay_mps2=car.ay_mps2, suspension_pitch_rad=car.suspension_pitch_rad,
            light=LIGHT[controls.light_switch], flash=controls.flash, high_beam_automatic=controls.high_beam_automatic,
            design_index=design_index, seen_time_s=time_s, lamps=self._lamps_of(design_index),
        )
        pose = Pose(car.x_m, car.y_m, car.z_m, car.roll_rad, car.pitch_rad, car.yaw_rad)
        self._eyes.fill(given, pose, np.array([car.vx_mps, car.vy_mps, car.vz_mps]))
        return given

    def _answer(self, frame: int) -> None:
        assert self._car is not None
        begin = time.perf_counter()
        number = frame if frame >= 0 else round(self._car.sim_time_ns * 1e-9 * self._rig.frame_rate_hz)
        given = self._given(number)
        if given.design_index != self._design:
            self._law.begin(given.lamps)
            self._design = given.design_index
        answer = self._law.step(given)
        if not isinstance(answer, Answer):
            raise LawFailed(f"the law answered {type(answer).__name__} instead of an Answer")
        message = answer.to_proto(given.lamps)
        message.frame_index, message.input_wall_ns = frame, self._car.sent_wall_ns
        self._sequence += 1
        self._answered = pb.Datagram(
            protocol_version=wire.PROTOCOL_VERSION, sender=pb.SENDER_LAW, start_id=self._start_id, sequence=self._sequence,
            sim_time_ns=self._car.sim_time_ns, law_answer=message,
        )
        self._transmit()
        self._last_s = given.time_s
        nearest = min((seen.x_m for seen in given.objects), default=float("nan"))
        took_ms = (time.perf_counter() - begin) * 1e3
        self._rows.append(
            [number, f"{given.time_s:.9f}", f"{took_ms:.4f}", len(given.objects), f"{nearest:.3f}", f"{given.seen_time_s:.9f}",
             answer.light or "", answer.levelling_rad]
        )

    def _transmit(self) -> None:
        """To the pictures and the recorder; the same again under its number, with the time of now."""
        assert self._socket is not None and self._answered is not None
        self._answered.sent_wall_ns = time.time_ns()
        data = wire.seal(wire.encode(self._answered), self._key)
        pictures = max(1, len(self._rig.channels))
        for offset in [*range(_VISUAL_PORT, _VISUAL_PORT + pictures), _RECORDER_PORT]:
            try:
                self._socket.sendto(data, (self._address, self._base + offset))
            except OSError:
                pass  # nobody listens there, as a recorder that there is not
