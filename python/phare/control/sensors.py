"""What a car's camera and sensors would tell a control law: with their field of view, range, delay, noise and misses.

All that is random is drawn from the seed and the number of the frame, so a lockstep drive is given the same twice.

Left out: what stands between (but for the road's own crests, along the lane), rain and dirt, wrong classes, ids that change.
"""

from __future__ import annotations

import math
import os
from collections import deque
from dataclasses import dataclass, field
from numbers import Integral, Real
from typing import Sequence

import numpy as np

from ..errors import BadInput
from .messages import CLASSES, CurveAhead, Given, LampOfLaw, RoadUserSeen
from .road_users import Lane, RoadUser, read_road_users


@dataclass
class Sensors:
    """How good they are; as it stands without noise, delay and misses.

    road_users: a TOML file or RoadUsers. range_m: how far road users are seen that come towards us with their lamps on (white),
    that drive before us (red), and that have no light (none). The first two are the distances UN R48 is said to ask of a sensor
    for adaptive driving beams (unconfirmed), the third is chosen by eye. fov_deg: of the camera, to both sides together.
    delay_s: of the camera, from the light to its answer. noise_angle_deg: standard deviation of the angles of edges; noise_distance_share: of the
    distance; noise_yaw_rate_radps and noise_speed_share: of the car's own. miss_01: chance that a road user that could be seen is missed in a
    frame. map_ahead_m: how far the lane ahead is known; 0: no map.
    """

    road_users: Sequence[RoadUser] | str | os.PathLike[str] = ()
    range_m: dict[str, float] = field(default_factory=lambda: {"white": 400.0, "red": 100.0, "none": 60.0})
    fov_deg: float = 60.0
    camera_m: tuple[float, float, float] = (1.7, 0.0, 1.3)  # behind the windscreen
    delay_s: float = 0.0
    noise_angle_deg: float = 0.0
    noise_distance_share: float = 0.0
    noise_yaw_rate_radps: float = 0.0
    noise_speed_share: float = 0.0
    miss_01: float = 0.0
    map_ahead_m: float = 150.0
    seed: int = 1

    def __post_init__(self) -> None:
        most = {"miss_01": 1.0, "fov_deg": 360.0}
        others = ("road_users", "range_m", "camera_m", "seed")
        numbers = {name: value for name, value in vars(self).items() if name not in others}
        numbers |= {f"range_m of {lights}": value for lights, value in self.range_m.items()}
        numbers |= {f"camera_m[{i}]": value for i, value in enumerate(self.camera_m)}
        for name, value in numbers.items():
            if not isinstance(value, Real):
                raise BadInput(f"Sensors: {name} is {value!r}, expected a number")
            if not name.startswith("camera_m") and not 0.0 <= value <= most.get(name, math.inf):
                raise BadInput(f"Sensors: {name} is {value}, expected 0 to {most.get(name, math.inf):g}")
        if not all(math.isfinite(value) for value in self.camera_m):
            raise BadInput(f"Sensors: camera_m is {self.camera_m}")
        if not isinstance(self.seed, Integral) or self.seed < 0:
            raise BadInput(f"Sensors: seed is {self.seed!r}, expected a whole number from 0")
        if set(self.range_m) != {"white", "red", "none"}:
            raise BadInput(f"Sensors: range_m has {sorted(self.range_m)}, expected white, red and none")
        self.users()  # a file that cannot be read is told here, whoever is given the sensors

    def users(self) -> list[RoadUser]:
        """The road users, read where a file was named."""
        if isinstance(self.road_users, (str, os.PathLike)):
            return read_road_users(self.road_users)
        return list(self.road_users)


@dataclass
class Pose:
    """The car's body in the world: origin and rotation Rz(yaw)·Ry(pitch)·Rx(roll), pitch nose down."""

    x_m: float
    y_m: float
    z_m: float
    roll_rad: float
    pitch_rad: float
    yaw_rad: float

    def car_from_world(self) -> np.ndarray:
        """3 x 3."""
        cr, sr = math.cos(self.roll_rad), math.sin(self.roll_rad)
        cp, sp = math.cos(self.pitch_rad), math.sin(self.pitch_rad)
        cy, sy = math.cos(self.yaw_rad), math.sin(self.yaw_rad)
        world_from_car = np.array([
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ])
        return world_from_car.T


class Eyes:
    """The sensors at work in one drive."""

    def __init__(self, sensors: Sensors, lane: Lane | None):
        self.sensors = sensors
        self.lane = lane
        self.users = sensors.users()
        self._seen: deque[tuple[float, list[RoadUserSeen]]] = deque()

    def fill(self, given: Given, pose: Pose, velocity_mps: np.ndarray) -> None:
        """Puts objects and curve into `given`, which has the car's own already, and noise on what is measured."""
        random = np.random.default_rng([self.sensors.seed, given.frame_index])
        s = self.sensors
        if s.noise_speed_share:
            given.speed_mps *= 1 + s.noise_speed_share * random.standard_normal()
        if s.noise_yaw_rate_radps:
            given.yaw_rate_radps += s.noise_yaw_rate_radps * random.standard_normal()
        if self.lane is None:
            return
        ego_s_m = self.lane.nearest_s_m(pose.x_m, pose.y_m)
        given.ahead = self._curve(ego_s_m)
        middle = middle_of(given.lamps)
        now = [
            seen
            for number, user in enumerate(self.users, 1)
            if (seen := self._see(number, user, given.time_s, pose, velocity_mps, middle, ego_s_m)) is not None
        ]
        self._seen.append((given.time_s, [seen for seen in now if self._noticed(seen, random)]))
        while len(self._seen) > 1 and self._seen[1][0] <= given.time_s - s.delay_s + 1e-9:
            self._seen.popleft()
        given.seen_time_s, given.objects = self._seen[0]
        if given.seen_time_s > given.time_s - s.delay_s + 1e-9:  # the camera has not answered yet
            given.objects = []

    def _curve(self, ego_s_m: float | None) -> list[CurveAhead]:
        if ego_s_m is None or self.sensors.map_ahead_m <= 0 or self.lane is None:
            return []
        steps = np.arange(0.0, self.sensors.map_ahead_m + 1e-9, 10.0)
        steps = steps[ego_s_m + steps <= self.lane.s_m[-1]]
        values = np.interp(ego_s_m + steps, self.lane.s_m, self.lane.curvature_1pm)
        return [CurveAhead(float(d), float(c)) for d, c in zip(steps, values)]

    def _see(
        self, number: int, user: RoadUser, time_s: float, pose: Pose, velocity_mps: np.ndarray, middle: np.ndarray,
        ego_s_m: float | None,
    ) -> RoadUserSeen | None:
        """As it is, without noise; None where it cannot be seen."""
        there = user.pose(self.lane, time_s) if self.lane is not None else None
        if there is None:
            return None
        place, along = there.place_m, there.along
        origin = np.array([pose.x_m, pose.y_m, pose.z_m])
        towards_us = float(np.dot(along, origin - place)) > 0
        near = place + (0.5 if towards_us else -0.5) * user.length_m * along
        turn = pose.car_from_world()
        at = turn @ (near - origin)
        shows = user.lights or (there.brakes and not towards_us)  # brake lamps burn without the others, too
        lights = "none" if not shows else "white" if towards_us else "red"
        to_camera = at - np.array(self.sensors.camera_m)
        distance_m = math.hypot(to_camera[0], to_camera[1])
        if to_camera[0] <= 0 or distance_m > self.sensors.range_m[lights]:
            return None
        if abs(math.atan2(to_camera[1], to_camera[0])) > math.radians(self.sensors.fov_deg) / 2:
            return None
        if ego_s_m is not None and self._behind_a_crest(ego_s_m, there.s_m, pose, place[2] + 0.8 * user.height_m):
            return None
        line = (near - origin) / max(float(np.linalg.norm(near - origin)), 1e-9)
        closing = float(np.dot(velocity_mps - there.speed_mps * along, line))
        seen = RoadUserSeen(
            number, user.kind if user.kind in CLASSES else "unknown", lights, float(at[0]), float(at[1]), float(at[2]), user.width_m, user.height_m, closing, 0, 0, 0, 0
        )
        set_angles(seen, middle)
        return seen

    def _behind_a_crest(self, ego_s_m: float, other_s_m: float, pose: Pose, top_m: float) -> bool:
        """The road itself lies above the line from the camera to four fifths of its height: along the lane, whose sideways
        way the line of sight does not have in a bend."""
        assert self.lane is not None
        between = np.linspace(ego_s_m, other_s_m, 32)[1:-1]
        eye_m = pose.z_m + self.sensors.camera_m[2]
        sight_m = np.linspace(eye_m, top_m, 32)[1:-1]
        return bool((np.interp(between, self.lane.s_m, self.lane.z_m) > sight_m).any())

    def _noticed(self, seen: RoadUserSeen, random: np.random.Generator) -> bool:
        """Draws the same count of numbers for each, whatever comes of it; adds the noise."""
        s, draws = self.sensors, random.standard_normal(3)
        missed = random.random() < s.miss_01
        if s.noise_distance_share:
            share = 1 + s.noise_distance_share * draws[0]
            seen.x_m, seen.y_m = seen.x_m * share, seen.y_m * share
        if s.noise_angle_deg:
            h, v = (math.radians(s.noise_angle_deg) * draw for draw in draws[1:])
            seen.h_left_rad, seen.h_right_rad = seen.h_left_rad + h, seen.h_right_rad + h
            seen.v_bottom_rad, seen.v_top_rad = seen.v_bottom_rad + v, seen.v_top_rad + v
            distance = math.hypot(seen.x_m, seen.y_m)
            seen.y_m -= h * distance
            seen.z_m += v * distance
        return not missed


def middle_of(lamps: Sequence[LampOfLaw]) -> np.ndarray:
    """Middle of the headlamps in the car's frame; without lamps where a small car has it."""
    heads = [lamp for lamp in lamps if any(source.function in ("low", "high") for source in lamp.sources)]
    if not heads:
        return np.array([3.45, 0.0, 0.66])
    return np.array([[lamp.x_m, lamp.y_m, lamp.z_m] for lamp in heads]).mean(axis=0)


def set_angles(seen: RoadUserSeen, middle: np.ndarray) -> None:
    """The angles of its edges from a point of the car: of a box of its width and height that faces that point."""
    dx, dy, dz = seen.x_m - middle[0], seen.y_m - middle[1], seen.z_m - middle[2]
    distance = max(math.hypot(dx, dy), 0.1)
    h, half = math.atan2(-dy, dx), math.atan2(seen.width_m / 2, distance)
    seen.h_left_rad, seen.h_right_rad = h - half, h + half
    seen.v_bottom_rad, seen.v_top_rad = math.atan2(dz, distance), math.atan2(dz + seen.height_m, distance)
