"""Bending light: the lamps look where the road goes."""

from __future__ import annotations

import math

from ..control.controller import Controller
from ..control.messages import Answer, Given, LampLight, LampOfLaw, lane_aside_m
from .checks import not_negative


class BendingLight(Controller):
    """Turns the headlamps towards the place of the lane that the car reaches in ahead_s.

    With a map by the lane's curvature ahead; without one by the circle that yaw rate and speed tell. most_deg: to each side.
    rate_degps: how fast lamps turn. outer_share: of the angle for the lamp on the outer side of the bend. Chosen by eye. What it
    does well and not: docs/laws.md.
    """

    def __init__(
        self, *, ahead_s: float = 2.0, most_deg: float = 12.0, rate_degps: float = 30.0, outer_share: float = 1.0,
        from_kmh: float = 5.0,
    ):
        not_negative(
            "BendingLight", ahead_s=ahead_s, most_deg=most_deg, rate_degps=rate_degps, outer_share=outer_share, from_kmh=from_kmh
        )
        self.ahead_s, self.most_rad, self.rate_radps = ahead_s, math.radians(most_deg), math.radians(rate_degps)
        self.outer_share, self.from_mps = outer_share, from_kmh / 3.6
        self._yaw_rad = 0.0

    def begin(self, lamps: list[LampOfLaw]) -> None:
        self._yaw_rad = 0.0

    def step(self, given: Given) -> Answer:
        wanted = self._wanted_rad(given) if given.speed_mps > self.from_mps else 0.0
        wanted = max(-self.most_rad, min(self.most_rad, wanted))
        step = self.rate_radps * given.step_s
        self._yaw_rad += max(-step, min(step, wanted - self._yaw_rad))
        lights = {}
        for lamp in given.lamps:
            if not any(source.function in ("low", "high") for source in lamp.sources):
                continue
            outer = lamp.y_m * self._yaw_rad < 0
            lights[lamp.lamp] = LampLight(yaw_rad=self._yaw_rad * (self.outer_share if outer else 1.0))
        return Answer(lamps=lights)

    def _wanted_rad(self, given: Given) -> float:
        reach_m = given.speed_mps * self.ahead_s
        if len(given.ahead) < 2:
            return given.yaw_rate_radps / given.speed_mps * reach_m / 2  # chord of a circle: half its angle
        end_m = min(reach_m, given.ahead[-1].distance_m)
        return math.atan2(lane_aside_m(given.ahead, reach_m), end_m) if end_m > 0 else 0.0
