"""What the variables of an FMI unit mean, by their names: inputs of a Given, outputs of an Answer (docs/fmu-law.md has the tables).

A variable `objects.x_m` is an array of one dimension; `objects[1].x_m`, `objects[2].x_m` … are its elements as scalars, counted from 1.
What there is less of than elements is 0; what there is more of is left out, the farthest first.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Any, Callable

from .messages import CLASSES, LIGHT, LIGHTS, Answer, Given, LampLight, LampOfLaw, RoadUserSeen, SourceOfLaw

FUNCTIONS = ("position", "low", "high", "fog", "daytime", "cornering")
"""Of a source, as `sources.function` counts them, from 0."""

REAL, WHOLE, YES_NO = "real", "whole", "yes or no"

SCALARS: dict[str, tuple[str, Callable[[Given], float]]] = {
    "frame_index": (WHOLE, lambda given: given.frame_index),
    "light_switch": (WHOLE, lambda given: LIGHT.index(given.light)),
    "flash": (YES_NO, lambda given: given.flash),
    "high_beam_automatic": (YES_NO, lambda given: given.high_beam_automatic),
    "design_index": (WHOLE, lambda given: given.design_index),
    **{
        name: (REAL, lambda given, name=name: getattr(given, name))
        for name in (
            "time_s", "step_s", "speed_mps", "yaw_rate_radps", "steering_wheel_rad", "steer_rad", "ax_mps2", "ay_mps2",
            "suspension_pitch_rad", "seen_time_s",
        )
    },
}
"""Inputs that stand once."""

_OBJECT_CODES: dict[str, tuple[str, Callable[[RoadUserSeen], float]]] = {
    "id": (WHOLE, lambda seen: seen.id),
    "kind": (WHOLE, lambda seen: CLASSES.index(seen.kind)),
    "lights": (WHOLE, lambda seen: LIGHTS.index(seen.lights)),
}


def _reals(*names: str) -> dict[str, tuple[str, Callable[[Any], float]]]:
    return {name: (REAL, lambda item, name=name: getattr(item, name)) for name in names}


@dataclass(frozen=True)
class SourceInLamp:
    """A source, and the number of its lamp from 1."""

    lamp: int
    source: SourceOfLaw


def _of_source(name: str) -> Callable[[SourceInLamp], float]:
    return lambda item: getattr(item.source, name)


GROUPS: dict[str, dict[str, tuple[str, Callable[[Any], float]]]] = {
    "objects": {**_OBJECT_CODES, **_reals(*(n for n in RoadUserSeen.__slots__ if n not in _OBJECT_CODES))},
    "ahead": _reals("distance_m", "curvature_1pm"),
    "lamps": _reals("x_m", "y_m", "z_m"),
    "sources": {
        "lamp": (WHOLE, lambda item: item.lamp),
        "function": (WHOLE, lambda item: FUNCTIONS.index(item.source.function)),
        **{n: (REAL, _of_source(n)) for n in ("peak_cd", "h_from_rad", "h_to_rad", "v_from_rad", "v_to_rad")},
    },
}
"""Inputs that stand once for each object, point of the lane, lamp or source. Each group has its `count` too."""

OUTPUT_SCALARS = {"light": WHOLE, "levelling_rad": REAL}
OUTPUT_GROUPS = {"lamps": ("yaw_rad", "pitch_rad", "dimming_01"), "sources": ("dimming_01",)}

_ELEMENT = re.compile(r"(objects|ahead|lamps|sources)(?:\[([1-9][0-9]{0,7})\])?\.(\w+)")


@dataclass(frozen=True)
class Meaning:
    """What a variable stands for."""

    group: str  # "" for what stands once
    name: str
    element: int  # from 1; 0: a whole array, or what stands once
    kind: str  # REAL, WHOLE, YES_NO


def input_named(name: str) -> Meaning | None:
    """None: no input of ours."""
    if name in SCALARS:
        return Meaning("", name, 0, SCALARS[name][0])
    found = _ELEMENT.fullmatch(name)
    if found is None:
        return None
    group, element, what = found[1], int(found[2] or 0), found[3]
    if what == "count" and not element:
        return Meaning(group, what, 0, WHOLE)
    return Meaning(group, what, element, GROUPS[group][what][0]) if what in GROUPS[group] else None


def output_named(name: str) -> Meaning | None:
    """None: no output of ours."""
    if name in OUTPUT_SCALARS:
        return Meaning("", name, 0, OUTPUT_SCALARS[name])
    found = _ELEMENT.fullmatch(name)
    if found is None or found[3] not in OUTPUT_GROUPS.get(found[1], ()):
        return None
    return Meaning(found[1], found[3], int(found[2] or 0), REAL)


def items_of(given: Given) -> dict[str, list[Any]]:
    """The groups in the order in which a unit has them: objects nearest first, lamps and their sources as in the rig."""
    return {
        "objects": sorted(given.objects, key=lambda seen: (math.hypot(seen.x_m, seen.y_m), seen.id)),
        "ahead": given.ahead,
        "lamps": given.lamps,
        "sources": [SourceInLamp(n, source) for n, lamp in enumerate(given.lamps, 1) for source in lamp.sources],
    }


def answer_of(light: int, levelling_rad: float, groups: dict[tuple[str, str], list[float]], lamps: list[LampOfLaw]) -> Answer:
    """groups: by group and name the values of what the unit has, from the first on; what lies beyond the design is left out."""
    answer = Answer(light=LIGHT[light] if light else None, levelling_rad=levelling_rad)
    if not groups:
        return answer

    def value(group: str, name: str, index: int, otherwise: float) -> float:
        values = groups.get((group, name), ())
        return values[index] if index < len(values) else otherwise

    first = 0
    for number, lamp in enumerate(lamps):
        whole = value("lamps", "dimming_01", number, 1.0)
        dims = [whole * value("sources", "dimming_01", first + n, 1.0) for n in range(len(lamp.sources))]
        first += len(lamp.sources)
        answer.lamps[lamp.lamp] = LampLight(value("lamps", "yaw_rad", number, 0.0), value("lamps", "pitch_rad", number, 0.0), dims)
    return answer
