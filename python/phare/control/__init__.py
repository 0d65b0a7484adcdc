"""A control law of the lamps in the loop: what it is given, what it answers, and the laws' base class.

docs/control-law.md tells how; `phare.laws` has those that are shipped.
"""

from .controller import Controller, Program, Together
from .messages import Answer, CurveAhead, Given, LampLight, LampOfLaw, RoadUserSeen, SourceOfLaw
from .road_users import RoadUser, read_road_users
from .sensors import Sensors

__all__ = [
    "Answer", "Controller", "CurveAhead", "Given", "LampLight", "LampOfLaw", "Program", "RoadUser", "RoadUserSeen", "Sensors",
    "SourceOfLaw", "Together", "read_road_users",
]
