"""Dynamic levelling: the beam stays on the road while the body pitches."""

from __future__ import annotations

import math

from ..control.controller import Controller
from ..control.messages import Answer, Given, LampOfLaw
from .checks import not_negative


class DynamicLevelling(Controller):
    """Turns all lamps against the body's pitch, as the height sensors of both axles tell it.

    follow_s: time constant of the filter, s; rate_degps and most_deg: of the adjuster. Chosen by eye. For cars whose own
    levelling is the driver's wheel ([levelling] system = "wheel" of the vehicle file): one that levels by itself would do it twice.
    What it does well and not: docs/laws.md.
    """

    def __init__(self, *, follow_s: float = 0.05, rate_degps: float = 20.0, most_deg: float = 2.0):
        not_negative("DynamicLevelling", follow_s=follow_s, rate_degps=rate_degps, most_deg=most_deg)
        self.follow_s, self.rate_radps, self.most_rad = follow_s, math.radians(rate_degps), math.radians(most_deg)
        self._filtered_rad = self._up_rad = 0.0
        self._first = True

    def begin(self, lamps: list[LampOfLaw]) -> None:
        self._first = True

    def step(self, given: Given) -> Answer:
        pitch = given.suspension_pitch_rad
        if self._first:
            self._filtered_rad = self._up_rad = max(-self.most_rad, min(self.most_rad, pitch))
            self._first = False
        share = 1.0 if self.follow_s <= 0 else 1.0 - math.exp(-given.step_s / self.follow_s)
        self._filtered_rad += share * (pitch - self._filtered_rad)
        wanted = max(-self.most_rad, min(self.most_rad, self._filtered_rad))
        step = self.rate_radps * given.step_s
        self._up_rad += max(-step, min(step, wanted - self._up_rad))
        return Answer(levelling_rad=self._up_rad)
