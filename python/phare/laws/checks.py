"""Numbers of a law that cannot be are refused where it is made."""

from __future__ import annotations

import math

from ..errors import BadInput


def not_negative(law: str, **numbers: float) -> None:
    """Raises BadInput that names the first which is no finite number of 0 or more."""
    for name, value in numbers.items():
        if not (math.isfinite(value) and value >= 0.0):
            raise BadInput(f"{law}: {name} is {value}, expected a number of 0 or more")


def share_01(law: str, **numbers: float) -> None:
    """Raises BadInput that names the first which is not within 0 to 1."""
    for name, value in numbers.items():
        if not 0.0 <= value <= 1.0:
            raise BadInput(f"{law}: {name} is {value}, expected 0 to 1")


def off_not_above_on(law: str, on_above_kmh: float, off_below_kmh: float) -> None:
    """Speeds of a beam that comes on above one and stays until another."""
    not_negative(law, on_above_kmh=on_above_kmh, off_below_kmh=off_below_kmh)
    if off_below_kmh > on_above_kmh:
        raise BadInput(f"{law}: off_below_kmh is {off_below_kmh:g}, expected on_above_kmh ({on_above_kmh:g}) at most")
