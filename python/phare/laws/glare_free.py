"""Glare-free high beam (ADB): the high beam stays on, and its segments leave other road users out."""

from __future__ import annotations

import math
from dataclasses import replace

from ..control.controller import Controller
from ..control.messages import Answer, Given, LampLight, LampOfLaw, RoadUserSeen, SourceOfLaw
from .checks import not_negative, off_not_above_on


class GlareFree(Controller):
    """Every segment of the high beam whose light would reach a lit road user is dark; the others shine.

    margin_deg: to both sides of a road user, and shade_from_m: height above the road from which it is spared. hold_s: one that
    the camera has lost is spared for so long from when it told of it last, where it must be by now. rise_s: a segment comes back so
    slowly, and goes dark at once. predict: the camera's delay is made up for by closing speed and yaw rate. on_above_kmh, off_below_kmh: below, low
    beam. Chosen by eye. Acts while the stalk is at low or high. What it does well and not: docs/laws.md.
    """

    def __init__(
        self, *, margin_deg: float = 0.7, shade_from_m: float = 0.5, hold_s: float = 0.5, rise_s: float = 0.5,
        predict: bool = True, on_above_kmh: float = 30.0, off_below_kmh: float = 20.0,
    ):
        not_negative("GlareFree", margin_deg=margin_deg, shade_from_m=shade_from_m, hold_s=hold_s, rise_s=rise_s)
        off_not_above_on("GlareFree", on_above_kmh, off_below_kmh)
        self.margin_rad, self.shade_from_m = math.radians(margin_deg), shade_from_m
        self.hold_s, self.rise_s, self.predict = hold_s, rise_s, predict
        self.on_above_kmh, self.off_below_kmh = on_above_kmh, off_below_kmh
        self._on = False
        self._others: dict[int, tuple[float, float, RoadUserSeen]] = {}  # when told of last, of which moment, and how they were
        self._light: dict[str, list[float]] = {}

    def begin(self, lamps: list[LampOfLaw]) -> None:
        self._on, self._others = False, {}
        self._light = {lamp.lamp: [1.0] * len(lamp.sources) for lamp in lamps}

    def step(self, given: Given) -> Answer:
        speed_kmh = given.speed_mps * 3.6
        self._on = speed_kmh > (self.off_below_kmh if self._on else self.on_above_kmh)
        for other in given.objects:
            if other.lights != "none":
                self._others[other.id] = (given.time_s, given.seen_time_s, other)
        self._others = {key: seen for key, seen in self._others.items() if given.time_s - seen[0] <= self.hold_s + 1e-9}
        spared = [self._now(given, seen_s, other) for _, seen_s, other in self._others.values()]
        rise = given.step_s / self.rise_s if self.rise_s > 0 else 1.0
        for lamp in given.lamps:
            light = self._light[lamp.lamp]
            for i, source in enumerate(lamp.sources):
                dark = source.function == "high" and any(self._reaches(lamp, source, other) for other in spared)
                light[i] = 0.0 if dark else min(1.0, light[i] + rise)
        lights = {name: LampLight(dimming_01=list(light)) for name, light in self._light.items()}
        return Answer(light="high" if self._on else "low", lamps=lights)

    def _now(self, given: Given, seen_s: float, other: RoadUserSeen) -> RoadUserSeen:
        """Where it is by now, seen from the car that has driven and turned on since."""
        late_s = given.time_s - seen_s if self.predict else 0.0
        distance = max(math.hypot(other.x_m, other.y_m), 1.0)
        nearer = max(1.0 - other.closing_mps * late_s / distance, 0.05)
        turned = given.yaw_rate_radps * late_s  # to the left: what stood ahead goes to the right
        x, y = other.x_m * nearer, other.y_m
        return replace(other, x_m=x + turned * y, y_m=y - turned * x)

    def _reaches(self, lamp: LampOfLaw, source: SourceOfLaw, other: RoadUserSeen) -> bool:
        dx, dy = other.x_m - lamp.x_m, other.y_m - lamp.y_m
        if dx < 1.0:
            return False
        distance = math.hypot(dx, dy)
        h, half = math.atan2(-dy, dx), math.atan2(other.width_m / 2, distance) + self.margin_rad
        v = math.atan2(other.z_m + self.shade_from_m - lamp.z_m, distance)
        return h - half < source.h_to_rad and source.h_from_rad < h + half and source.v_to_rad > v
