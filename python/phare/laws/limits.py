"""What a lamp's module can take: electric power and heat, as a limit on top of any law."""

from __future__ import annotations

import math
from dataclasses import replace
from numbers import Real

from ..control.controller import Controller
from ..control.messages import Answer, Given, LampLight, LampOfLaw
from ..errors import BadInput


class ModuleLimits(Controller):
    """A law whose answers are held to what a lamp's module can take.

    power_w: most electric power of a lamp's high beam sources together, W. source_w: of one such source at full light, W; power
    is proportional to dimming. What is asked beyond is dimmed alike for all sources of the lamp. Heat, where k_per_w is given: the
    module as one thermal resistance and time constant, dT/dt = (k_per_w P - (T - ambient_c)) / tau_s, exact over a step;
    full light below from_c, linearly down to none at most_c. Low beam is left alone: it is what the law demands. Numbers of no
    product, chosen by eye; what it does well and not: docs/laws.md.
    """

    def __init__(
        self, law: Controller, *, power_w: float = 20.0, source_w: float = 1.0, k_per_w: float | None = None, tau_s: float = 60.0,
        ambient_c: float = 40.0, from_c: float = 110.0, most_c: float = 130.0,
    ):
        for name, value in [("power_w", power_w), ("source_w", source_w), ("tau_s", tau_s)]:
            if not (math.isfinite(value) and value > 0.0):
                raise BadInput(f"{name} = {value}: more than 0")
        if k_per_w is not None and not (k_per_w >= 0.0 and ambient_c < from_c < most_c):
            raise BadInput("k_per_w >= 0 and ambient_c < from_c < most_c")
        self.law, self.power_w, self.source_w = law, power_w, source_w
        self.k_per_w, self.tau_s, self.ambient_c, self.from_c, self.most_c = k_per_w, tau_s, ambient_c, from_c, most_c
        self.power_of: dict[str, float] = {}  # W of each lamp in the newest frame
        self.temperature_of: dict[str, float] = {}  # °C

    def begin(self, lamps: list[LampOfLaw]) -> None:
        self.power_of = {lamp.lamp: 0.0 for lamp in lamps}
        self.temperature_of = {lamp.lamp: self.ambient_c for lamp in lamps}
        self.law.begin(lamps)

    def step(self, given: Given) -> Answer:
        answer = self.law.step(given)
        stalk_lets = given.light in ("low", "high")  # a law lights nothing that the driver has switched off
        high = ((answer.light if stalk_lets else None) or given.light) == "high" or given.flash
        lights = dict(answer.lamps)
        for lamp in given.lamps:
            limited = [i for i, source in enumerate(lamp.sources) if source.function == "high"]
            if not limited:
                continue
            self._warm(lamp.lamp, given.step_s)
            light = lights.get(lamp.lamp, LampLight())
            dims = [light.dimming_01] if isinstance(light.dimming_01, Real) else list(light.dimming_01)
            dims = dims * len(lamp.sources) if len(dims) == 1 else dims or [1.0] * len(lamp.sources)
            asked_w = self.source_w * sum(dims[i] for i in limited) if high else 0.0
            share = min(1.0, self.power_w / asked_w) if asked_w > 0.0 else 1.0
            share *= self._share_of_heat(self.temperature_of.get(lamp.lamp, self.ambient_c))
            self.power_of[lamp.lamp] = asked_w * share
            if share < 1.0:
                for i in limited:
                    dims[i] *= share
                lights[lamp.lamp] = replace(light, dimming_01=dims)
        return replace(answer, lamps=lights)

    def end(self) -> None:
        self.law.end()

    def _warm(self, lamp: str, step_s: float) -> None:
        if self.k_per_w is None:
            return
        settled_c = self.ambient_c + self.k_per_w * self.power_of.get(lamp, 0.0)
        was_c = self.temperature_of.get(lamp, self.ambient_c)
        self.temperature_of[lamp] = settled_c + (was_c - settled_c) * math.exp(-step_s / self.tau_s)

    def _share_of_heat(self, temperature_c: float) -> float:
        if self.k_per_w is None:
            return 1.0
        return min(1.0, max(0.0, (self.most_c - temperature_c) / (self.most_c - self.from_c)))
