"""What a law is given for a frame, and what it answers: LawInput and LawAnswer of net/phare.proto as Python objects.

Car frame: x forward, y left, z up, origin on the ground below the middle of the rear axle. Angles h are to the right and v up, as
lighting engineers count them; yaw is to the left.
"""

from __future__ import annotations

import math
import os
from dataclasses import dataclass, field
from numbers import Real
from typing import Any

from .. import phare_pb2 as pb
from ..errors import LawFailed

LIGHT = ("off", "position", "low", "high")
CLASSES = ("unknown", "car", "lorry", "motorcycle", "bicycle", "pedestrian")
LIGHTS = ("none", "white", "red")


@dataclass(slots=True)
class RoadUserSeen:
    """A road user as the camera sees it: its edges from the middle of the headlamps, body fixed."""

    id: int
    kind: str  # of CLASSES
    lights: str  # white: its headlamps are seen, it comes towards us; red: it drives as we do; none
    x_m: float  # of the nearer side, its middle on the ground
    y_m: float
    z_m: float
    width_m: float
    height_m: float
    closing_mps: float  # positive: the distance shrinks
    h_left_rad: float
    h_right_rad: float
    v_bottom_rad: float
    v_top_rad: float


@dataclass(slots=True)
class CurveAhead:
    """The lane at a distance along it."""

    distance_m: float
    curvature_1pm: float  # left positive


def lane_aside_m(ahead: list[CurveAhead], distance_m: float) -> float:
    """How far to the left of the car's axis the lane's middle is, that far along it: its curvature ahead, summed twice."""
    heading = aside_m = 0.0
    for one, other in zip(ahead, ahead[1:]):
        length_m = min(other.distance_m, distance_m) - one.distance_m
        if length_m <= 0:
            break
        turn = one.curvature_1pm * length_m
        aside_m += (heading + turn / 2) * length_m
        heading += turn
    return aside_m


@dataclass(slots=True)
class SourceOfLaw:
    """Where a source shines with more than a tenth of its peak, in the car: mounted and aimed."""

    function: str  # low, high, fog …
    peak_cd: float
    h_from_rad: float
    h_to_rad: float
    v_from_rad: float
    v_to_rad: float


@dataclass(slots=True)
class LampOfLaw:
    """A lamp of the design that shines, and its sources in the rig's order."""

    lamp: str
    x_m: float
    y_m: float
    z_m: float
    sources: list[SourceOfLaw]


@dataclass(slots=True)
class Given:
    """What a law is given for one frame."""

    frame_index: int = 0
    time_s: float = 0.0
    step_s: float = 0.0  # since the one before; 0 in the first
    speed_mps: float = 0.0
    yaw_rate_radps: float = 0.0  # left positive
    steering_wheel_rad: float = 0.0
    steer_rad: float = 0.0  # of the road wheels
    ax_mps2: float = 0.0
    ay_mps2: float = 0.0
    suspension_pitch_rad: float = 0.0  # against the road, nose down positive
    light: str = "low"  # of the stalk: off, position, low, high
    flash: bool = False
    high_beam_automatic: bool = False
    design_index: int = 0
    objects: list[RoadUserSeen] = field(default_factory=list)
    ahead: list[CurveAhead] = field(default_factory=list)
    lamps: list[LampOfLaw] = field(default_factory=list)  # of the design; in every Given of Python
    seen_time_s: float = 0.0  # when the camera saw `objects`

    def to_proto(self, with_lamps: bool) -> pb.LawInput:
        """The message; lamps only where asked for, as they seldom change."""
        plain = {
            name: getattr(self, name)
            for name in self.__slots__
            if name not in ("light", "objects", "ahead", "lamps")
        }
        message = pb.LawInput(light_switch=LIGHT.index(self.light), **plain)
        for seen in self.objects:
            words = {name: getattr(seen, name) for name in seen.__slots__ if name not in ("kind", "lights")}
            message.objects.add(kind=CLASSES.index(seen.kind), lights=LIGHTS.index(seen.lights), **words)
        for point in self.ahead:
            message.ahead.add(distance_m=point.distance_m, curvature_1pm=point.curvature_1pm)
        for lamp in self.lamps if with_lamps else []:
            added = message.lamps.add(lamp=lamp.lamp, x_m=lamp.x_m, y_m=lamp.y_m, z_m=lamp.z_m)
            for source in lamp.sources:
                added.sources.add(**{name: getattr(source, name) for name in source.__slots__})
        return message

    @classmethod
    def of_proto(cls, message: pb.LawInput, lamps: list[LampOfLaw] | None = None) -> Given:
        """What to_proto was made of. lamps: those of before, for a message that has none."""
        def words(kind: type, part: Any, *without: str) -> dict[str, Any]:
            return {name: getattr(part, name) for name in kind.__slots__ if name not in without}

        given = cls(**words(cls, message, "light", "objects", "ahead", "lamps"), light=LIGHT[message.light_switch])
        given.objects = [
            RoadUserSeen(kind=CLASSES[seen.kind], lights=LIGHTS[seen.lights], **words(RoadUserSeen, seen, "kind", "lights"))
            for seen in message.objects
        ]
        given.ahead = [CurveAhead(point.distance_m, point.curvature_1pm) for point in message.ahead]
        given.lamps = lamps or []
        if message.lamps:
            given.lamps = [
                LampOfLaw(sources=[SourceOfLaw(**words(SourceOfLaw, source)) for source in lamp.sources], **words(LampOfLaw, lamp, "sources"))
                for lamp in message.lamps
            ]
        return given


@dataclass(slots=True)
class LampLight:
    """One lamp: turned in its place (rad; yaw left, pitch up) and the light of each source, 0 to 1: a list in the rig's order, or
    one number for all; empty: full. `frame`: file of the picture (PNG, PGM) that its pixel light shines, best in /dev/shm and
    written beside and renamed; empty: as it is."""

    yaw_rad: float = 0.0
    pitch_rad: float = 0.0
    dimming_01: list[float] | float = field(default_factory=list)
    frame: str | os.PathLike[str] = ""


@dataclass(slots=True)
class Answer:
    """All that a law wants of the lamps. What it does not name shines in full and straight."""

    light: str | None = None  # beam in place of the stalk's: position, low, high; None: as the stalk says
    levelling_rad: float = 0.0  # all lamps, up positive
    lamps: dict[str, LampLight] = field(default_factory=dict)

    def to_proto(self, lamps: list[LampOfLaw]) -> pb.LawAnswer:
        """The message. Raises LawFailed when a lamp is not there, or a number is out of its range."""
        if self.light is not None and self.light not in LIGHT[1:]:
            raise LawFailed(f"the law answered light {self.light!r}: position, low, high or None")
        message = pb.LawAnswer(
            light_switch=LIGHT.index(self.light) if self.light else 0, levelling_rad=_within("levelling_rad", self.levelling_rad)
        )
        sources = {lamp.lamp: len(lamp.sources) for lamp in lamps}
        for name, light in self.lamps.items():
            if name not in sources:
                raise LawFailed(f"the law answered for lamp {name!r}: the design has {', '.join(sources)}")
            dims = [light.dimming_01] if isinstance(light.dimming_01, Real) else list(light.dimming_01)
            if len(dims) > 1 and len(dims) != sources[name]:
                raise LawFailed(f"the law answered {len(dims)} dimmings for lamp {name!r}, which has {sources[name]} sources")
            for dim in dims:
                if not 0.0 <= dim <= 1.0:  # NaN too
                    raise LawFailed(f"the law answered a dimming of {dim} for lamp {name!r}: 0 to 1")
            message.lamps.add(
                lamp=name, yaw_rad=_within("yaw_rad", light.yaw_rad), pitch_rad=_within("pitch_rad", light.pitch_rad),
                dimming_01=[float(dim) + 0.0 for dim in dims], frame=_file(name, light.frame),
            )
        return message

    @classmethod
    def of_proto(cls, message: pb.LawAnswer) -> Answer:
        """The answer of a law that is another program."""
        lamps = {light.lamp: LampLight(light.yaw_rad, light.pitch_rad, list(light.dimming_01), light.frame) for light in message.lamps}
        return cls(LIGHT[message.light_switch] if message.light_switch else None, message.levelling_rad, lamps)


def _file(lamp: str, frame: str | os.PathLike[str]) -> str:
    """As the visual processes, whose folder is another, can open it."""
    file = os.path.abspath(frame) if frame else ""
    if len(os.fsencode(file)) > 4096:
        raise LawFailed(f"the law answered a frame for lamp {lamp!r} whose name is longer than 4096 bytes")
    return file


def _within(name: str, value: float) -> float:
    if not (math.isfinite(value) and abs(value) <= 1.6):
        raise LawFailed(f"the law answered {name} = {value}: -1.6 to 1.6")
    return float(value) + 0.0  # no -0: one encoding
