"""Automatic high beam: on when nobody is there whom it could dazzle."""

from __future__ import annotations

from ..control.controller import Controller
from ..control.messages import Answer, Given, LampOfLaw
from .checks import not_negative, off_not_above_on


class AutomaticHighBeam(Controller):
    """High beam above a speed while no lamp of another is seen; low beam at once when one is.

    on_above_kmh, off_below_kmh: speeds, km/h. on_after_s: nobody has been seen for so long. Chosen by eye. Acts while the
    stalk is at low or high. What it does well and not: docs/laws.md.
    """

    def __init__(self, *, on_above_kmh: float = 40.0, off_below_kmh: float = 25.0, on_after_s: float = 1.5):
        off_not_above_on("AutomaticHighBeam", on_above_kmh, off_below_kmh)
        not_negative("AutomaticHighBeam", on_after_s=on_after_s)
        self.on_above_kmh, self.off_below_kmh, self.on_after_s = on_above_kmh, off_below_kmh, on_after_s
        self._on, self._alone_s = False, on_after_s

    def begin(self, lamps: list[LampOfLaw]) -> None:
        self._on, self._alone_s = False, self.on_after_s

    def step(self, given: Given) -> Answer:
        seen = any(other.lights != "none" for other in given.objects)
        self._alone_s = 0.0 if seen else self._alone_s + given.step_s
        speed_kmh = given.speed_mps * 3.6
        fast = speed_kmh > (self.off_below_kmh if self._on else self.on_above_kmh)
        self._on = fast and self._alone_s >= self.on_after_s
        return Answer(light="high" if self._on else "low")
