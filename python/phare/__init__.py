"""Phare from Python: drive a headlamp through the night, measure it, judge it, and put a control law in the loop.

    import phare

    report = phare.drive(lamp="low_beam.ies", frames=60)
    report.figures["self_audit"], report.frame(-1), report.car.speed_mps
    phare.Lamp.read("low_beam.ies").intensity([0, 1], [-0.57, -1])
    phare.measure(phare.Mounted("low_beam.ies", 3.45, 0.62, 0.66, pitch_deg=-0.573), [[50, -1.5, 0]])

A control law leads the lamps: `phare.drive(controller=phare.laws.GlareFree(), sensors=phare.Sensors("traffic.toml"))`.

Everything is done by Phare's programs, which this package starts and listens to. Units stand at the end of names: m, s, rad,
deg, cd, lm, lx. Car and world: x forward, y left, z up (ISO 8855).
"""

from . import laws, sweep
from .control import (
    Answer, Controller, Given, LampLight, LampOfLaw, Program, RoadUser, RoadUserSeen, Sensors, SourceOfLaw, Together,
    read_road_users,
)
from .detection import Detection, detect_pedestrians, threshold_cdm2, visibility_level
from .drive import Report, drive, free_ports
from .drive_file import Drive, poses, read_drive, write_drive
from .edges import oncoming_glare, visibility
from .errors import BadInput, Failed, LawFailed, NotFound, PhareError
from .judge import Glare, judge_glare
from .lamp import Comparison, Hspr, Lamp, Table, Verdict
from .measuring import Mounted, measure
from .programs import program, version
from .rating import Iihs, rate_iihs
from .rig import Channel, Design, LampPlace, Rig, Source, generated_file, shipped_file
from .tracks import TrackTests, track_tests

__all__ = [
    "Answer", "BadInput", "Channel", "Comparison", "Controller", "Design", "Detection", "Drive", "Failed", "Given", "Glare", "Hspr", "Iihs",
    "Lamp", "LampLight", "LampOfLaw", "LampPlace", "LawFailed", "Mounted", "NotFound", "PhareError", "Program",
    "Report", "Rig", "RoadUser", "RoadUserSeen", "Sensors", "Source", "SourceOfLaw", "Table", "Together", "TrackTests", "Verdict",
    "detect_pedestrians", "drive", "free_ports", "generated_file", "judge_glare", "laws", "measure", "oncoming_glare", "poses", "program", "rate_iihs",
    "read_drive", "read_road_users", "shipped_file", "sweep", "threshold_cdm2", "track_tests", "version", "visibility",
    "visibility_level", "write_drive",
]
