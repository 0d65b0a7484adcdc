"""Control laws that are shipped: plain ones, to begin with and to measure others against (docs/laws.md)."""

from ..control.fmu import Fmu
from .bending import BendingLight
from .glare_free import GlareFree
from .high_beam import AutomaticHighBeam
from .levelling import DynamicLevelling
from .limits import ModuleLimits
from .road_picture import LaneProjection, SymbolProjection, arrow

__all__ = [
    "AutomaticHighBeam", "BendingLight", "DynamicLevelling", "Fmu", "GlareFree", "LaneProjection", "ModuleLimits", "SymbolProjection",
    "arrow",
]
