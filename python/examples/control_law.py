"""A control law of one's own in the loop, against the one that is shipped: who leaves more of the road lit, and for whom.

    python3 python/examples/control_law.py
"""

import numpy as np

import phare
from phare.laws import GlareFree


class HighUnlessSeen(phare.Controller):
    """The plainest law: high beam, and low beam while anybody's lamps are seen."""

    def step(self, given: phare.Given) -> phare.Answer:
        seen = any(other.lights != "none" for other in given.objects)
        return phare.Answer(light="low" if seen else "high")


# A straight half second of the demo's road at 72 km/h, and a car that comes towards us.
t = np.arange(0.0, 0.6, 0.02)
lane = phare.control.road_users.Lane(phare.generated_file("scenes/country_road_lane.csv"))
place = np.array([lane.at(20 + 20 * time, 0.0)[0] for time in t])
phare.write_drive(
    "straight.pcap",
    phare.poses(t, x_m=place[:, 0], y_m=place[:, 1], z_m=place[:, 2], yaw_rad=lane.at(20, 0)[1], speed_mps=20.0),
)
oncoming = phare.Sensors([phare.RoadUser(start_s_m=110, speed_mps=20.0, offset_m=3.5)], delay_s=0.05)

for law in (HighUnlessSeen(), GlareFree()):
    report = phare.drive(
        phare.Rig.shipped("matrix"), drive="straight.pcap", frames=12, size=(160, 90), controller=law, sensors=oncoming
    )
    lit = report.law.filter(regex=r"left/\d+$").iloc[-1] if "headlamp left/1" in report.law else None
    segments = f", {int((lit == 0).sum())} of its {len(lit)} sources dark" if lit is not None else ""
    print(f"{type(law).__name__}: {report.law_steps.light.iloc[-1]} beam{segments}, picture {report.frame(-1).mean():.1f} of 255")
