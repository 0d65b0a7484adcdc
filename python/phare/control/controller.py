"""The base class of control laws, laws that are other programs, and several laws together."""

from __future__ import annotations

import os
import select
import struct
import subprocess
import time
from dataclasses import replace
from numbers import Real
from typing import Sequence

from google.protobuf.message import DecodeError

from .. import phare_pb2 as pb
from ..errors import LawFailed
from .messages import Answer, Given, LampLight, LampOfLaw, SourceOfLaw


class Controller:
    """A control law: `step` is asked once a frame. A law keeps its own state, and begins anew with `begin`."""

    def begin(self, lamps: list[LampOfLaw]) -> None:
        """Before the first frame, and when the driver chooses another design: the lamps there are."""

    def step(self, given: Given) -> Answer:
        """What the lamps should do in this frame."""
        raise NotImplementedError

    def end(self) -> None:
        """After the last frame."""


def failed(wrong: BaseException, when: str) -> LawFailed:
    """What a law raised, as the error of a law."""
    if isinstance(wrong, LawFailed):
        return wrong
    fault = LawFailed(f"the law failed {when}: {type(wrong).__name__}: {wrong}")
    fault.__cause__ = wrong
    return fault


def ended(law: Controller) -> LawFailed | None:
    """Ends a law, and says why it could not."""
    try:
        law.end()
    except (Exception, SystemExit) as wrong:
        return failed(wrong, "at its end")
    return None


class Together(Controller):
    """Several laws at once: dimmings multiply, angles add, and the first that names a beam has it. Each law is given the lamps as
    those before it have turned them: a law that turns lamps stands before one that dims segments."""

    def __init__(self, *laws: Controller):
        self.laws = laws

    def begin(self, lamps: list[LampOfLaw]) -> None:
        for law in self.laws:
            law.begin(lamps)

    def step(self, given: Given) -> Answer:
        sources = {lamp.lamp: len(lamp.sources) for lamp in given.lamps}
        whole = Answer()
        for law in self.laws:
            answer = law.step(replace(given, lamps=_turned(given.lamps, whole)))
            whole.light = whole.light or answer.light
            whole.levelling_rad += answer.levelling_rad
            for name, light in answer.lamps.items():
                whole.lamps[name] = _joined(whole.lamps.get(name, LampLight()), light, sources.get(name, 0))
        return whole

    def end(self) -> None:
        for law in self.laws:
            law.end()


def _turned(lamps: list[LampOfLaw], answer: Answer) -> list[LampOfLaw]:
    """Where the sources shine when the lamps do as this answer says."""
    turned = []
    for lamp in lamps:
        light = answer.lamps.get(lamp.lamp)
        right = -light.yaw_rad if light else 0.0
        up = answer.levelling_rad + (light.pitch_rad if light else 0.0)
        if right == 0.0 and up == 0.0:
            turned.append(lamp)
            continue
        sources = [
            SourceOfLaw(s.function, s.peak_cd, s.h_from_rad + right, s.h_to_rad + right, s.v_from_rad + up, s.v_to_rad + up)
            for s in lamp.sources
        ]
        turned.append(replace(lamp, sources=sources))
    return turned


def _joined(one: LampLight, other: LampLight, sources: int) -> LampLight:
    def full(light: LampLight) -> list[float]:
        dims = [light.dimming_01] if isinstance(light.dimming_01, Real) else light.dimming_01
        return list(dims) * (sources if len(dims) == 1 else 1) or [1.0] * sources

    dims = [a * b for a, b in zip(full(one), full(other))]
    return LampLight(one.yaw_rad + other.yaw_rad, one.pitch_rad + other.pitch_rad, dims, other.frame or one.frame)


class Program(Controller):
    """A law that is a program of its own, in any language: LawInput on its standard input and LawAnswer on its standard output,
    each after four bytes of its length, little-endian. What it writes to standard error is left alone. It ends when its input
    does."""

    def __init__(self, command: Sequence[str | os.PathLike[str]], *, answers_within_s: float = 30.0):
        self.command = [os.fspath(word) for word in command]
        self.answers_within_s = answers_within_s
        self._running: subprocess.Popen[bytes] | None = None
        self._tell_lamps = True

    def begin(self, lamps: list[LampOfLaw]) -> None:
        self._tell_lamps = True
        if self._running is None:
            try:
                self._running = subprocess.Popen(self.command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0)
            except OSError as wrong:
                raise LawFailed(f"{self.command[0]}: {wrong.strerror}") from wrong

    def step(self, given: Given) -> Answer:
        assert self._running is not None and self._running.stdin is not None
        body = given.to_proto(self._tell_lamps).SerializeToString()
        self._tell_lamps = False
        try:
            self._running.stdin.write(struct.pack("<I", len(body)) + body)
        except BrokenPipeError:
            raise self._gone() from None
        (length,) = struct.unpack("<I", self._read(4))
        if length > 1 << 20:
            raise LawFailed(f"{self.command[0]}: an answer of {length} bytes; before each stand four bytes of its length")
        message = pb.LawAnswer()
        try:
            message.ParseFromString(self._read(length))
        except DecodeError as wrong:
            raise LawFailed(f"{self.command[0]}: its answer is no LawAnswer: {wrong}") from wrong
        return Answer.of_proto(message)

    def _read(self, count: int) -> bytes:
        assert self._running is not None and self._running.stdout is not None
        pipe, data, until = self._running.stdout, b"", time.monotonic() + self.answers_within_s
        while len(data) < count:
            if not select.select([pipe], [], [], max(0.0, until - time.monotonic()))[0]:
                raise LawFailed(f"{self.command[0]}: no answer within {self.answers_within_s:g} s")
            more = pipe.read(count - len(data))
            if not more:
                raise self._gone()
            data += more
        return data

    def _gone(self) -> LawFailed:
        assert self._running is not None
        try:
            code = self._running.wait(2)
        except subprocess.TimeoutExpired:
            return LawFailed(f"{self.command[0]}: closed its pipes and did not end")
        how = f"by signal {-code}" if code < 0 else f"with exit code {code}"
        return LawFailed(f"{self.command[0]}: ended {how} within the drive")

    def end(self) -> None:
        if self._running is None:
            return
        for pipe in (self._running.stdin, self._running.stdout):
            if pipe is not None:
                pipe.close()
        try:
            self._running.wait(5)
        except subprocess.TimeoutExpired:
            self._running.kill()
            self._running.wait()
        self._running = None
