"""unit: sensors and the shipped laws on scenes made by hand. process: laws in the loop of drives."""

import copy
import math
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import phare
from phare.control import messages
from phare.control.link import design_shown
from phare.control.sensors import Eyes, Pose, set_angles
from phare.laws import AutomaticHighBeam, BendingLight, DynamicLevelling, GlareFree

from conftest import SMALL, straight_lane

DEG = math.pi / 180


def lamp(name="left", y=0.6, columns=8):
    """A low beam and `columns` segments of 4 degrees side by side, centred, from -1 to 3 degrees up."""
    sources = [phare.SourceOfLaw("low", 1e4, -20 * DEG, 20 * DEG, -10 * DEG, 0.0)]
    for i in range(columns):
        left = (4 * i - 2 * columns) * DEG
        sources.append(phare.SourceOfLaw("high", 1e4, left, left + 4 * DEG, -1 * DEG, 3 * DEG))
    return phare.LampOfLaw(name, 3.45, y, 0.66, sources)


def other(x, y=3.5, lights="white", kind="car", closing=0.0, id=1):
    seen = phare.RoadUserSeen(id, kind, lights, x, y, 0.0, 1.8, 1.5, closing, 0, 0, 0, 0)
    set_angles(seen, np.array([3.45, 0.0, 0.66]))
    return seen


def seen_at(eyes: Eyes, time_s: float, x_m=0.0, frame=None) -> list:
    given = phare.Given(frame_index=frame if frame is not None else round(time_s * 60), time_s=time_s, speed_mps=20.0)
    eyes.fill(given, Pose(x_m, 0, 0, 0, 0, 0), np.array([20.0, 0, 0]))
    return given.objects


# ---- sensors


def test_a_car_that_slows_down_is_seen_by_its_brake_lamps_and_its_speed(tmp_path):
    lane = straight_lane(tmp_path)
    user = phare.RoadUser(direction="same", start_s_m=40, lights=False, speeds=((0.0, 20.0), (1.0, 20.0), (3.0, 10.0)))
    eyes = Eyes(phare.Sensors([user]), lane)
    assert seen_at(eyes, 0.1)[0].lights == "none"
    (seen,) = seen_at(eyes, 2.0)
    assert seen.lights == "red" and seen.x_m == pytest.approx(40 + 20 + 17.5 - 2.15)
    assert seen.closing_mps == pytest.approx(20.0 - 15.0)


def test_the_camera_sees_place_size_and_angles(tmp_path):
    user = phare.RoadUser(start_s_m=203.45 + 2.15, speed_mps=10.0, offset_m=3.5)  # its front 203.45 m ahead at first
    (seen,) = seen_at(Eyes(phare.Sensors([user]), straight_lane(tmp_path)), 0.0)
    assert (seen.kind, seen.lights) == ("car", "white")
    assert seen.x_m == pytest.approx(203.45) and seen.y_m == pytest.approx(3.5)
    assert seen.closing_mps == pytest.approx(30.0, abs=0.05)  # along the line of sight, 1 degree aside
    middle, half = math.atan2(-3.5, 200.0), math.atan2(0.9, math.hypot(200, 3.5))
    assert seen.h_left_rad == pytest.approx(middle - half) and seen.h_right_rad == pytest.approx(middle + half)
    assert seen.v_bottom_rad == pytest.approx(math.atan2(-0.66, 200), rel=1e-3)
    (later,) = seen_at(Eyes(phare.Sensors([user]), straight_lane(tmp_path)), 2.0)
    assert later.x_m == pytest.approx(183.45)


def test_range_field_of_view_and_lights_count(tmp_path):
    lane = straight_lane(tmp_path)

    def count(user, **sensors):
        return len(seen_at(Eyes(phare.Sensors([user], **sensors), lane), 0.0))

    assert count(phare.RoadUser(start_s_m=390)) == 1 and count(phare.RoadUser(start_s_m=430)) == 0
    before = phare.RoadUser(direction="same", start_s_m=90)
    assert count(before) == 1 and seen_at(Eyes(phare.Sensors([before]), lane), 0.0)[0].lights == "red"
    assert count(phare.RoadUser(direction="same", start_s_m=130)) == 0
    aside = phare.RoadUser("pedestrian", "standing", start_s_m=30, offset_m=14.0, lights=False)
    assert count(aside, fov_deg=60) == 1 and count(aside, fov_deg=40) == 0
    assert count(phare.RoadUser(start_s_m=50, from_s=1.0)) == 0
    deer = phare.RoadUser("deer", "oncoming", start_s_m=50, lights=False)
    assert [seen.kind for seen in seen_at(Eyes(phare.Sensors([deer]), lane), 0.0)] == ["unknown"], "no class of a sensor's"


def test_a_crest_hides_what_is_behind_it(tmp_path):
    hill = np.maximum(0.0, 4.0 - np.abs(np.arange(101) - 15) * 0.8)  # 4 m high at 150 m
    user = [phare.RoadUser(start_s_m=300)]
    assert seen_at(Eyes(phare.Sensors(user), straight_lane(tmp_path, hill)), 0.0) == []
    assert len(seen_at(Eyes(phare.Sensors(user), straight_lane(tmp_path)), 0.0)) == 1


def test_delay_shows_the_past(tmp_path):
    eyes = Eyes(phare.Sensors([phare.RoadUser(start_s_m=302.15, speed_mps=20.0)], delay_s=0.1), straight_lane(tmp_path))
    past = []
    for frame in range(12):
        given = phare.Given(frame_index=frame, time_s=frame / 60)
        eyes.fill(given, Pose(0, 0, 0, 0, 0, 0), np.zeros(3))
        past.append((given.seen_time_s, [seen.x_m for seen in given.objects]))
    assert past[5][1] == []  # 0.1 s are 6 frames
    for frame in range(6, 12):
        assert past[frame][0] == pytest.approx((frame - 6) / 60)
        assert past[frame][1] == [pytest.approx(300 - 20 * (frame - 6) / 60)]


def test_noise_and_misses_come_from_the_seed(tmp_path):
    users = [phare.RoadUser(start_s_m=300), phare.RoadUser(start_s_m=200)]
    lane = straight_lane(tmp_path)

    def course(seed):
        eyes = Eyes(phare.Sensors(users, noise_angle_deg=0.1, miss_01=0.3, seed=seed), lane)
        return [[(seen.id, seen.h_left_rad) for seen in seen_at(eyes, frame / 60)] for frame in range(200)]

    assert course(3) == course(3) != course(4)
    missed = 1 - np.mean([len(seen) / 2 for seen in course(3)])
    assert missed == pytest.approx(0.3, abs=0.07)  # 400 draws: standard deviation 0.023, three of them
    spread = np.std([angle for seen in course(3) for id, angle in seen if id == 1])
    assert spread == pytest.approx(0.1 * DEG, rel=0.2)  # of some 140 values: 6 % standard deviation


def test_a_shared_object_is_not_the_laws_to_change(tmp_path):
    eyes = Eyes(phare.Sensors([phare.RoadUser(start_s_m=300)], noise_angle_deg=0.1), straight_lane(tmp_path))
    assert seen_at(eyes, 0.0)[0].h_left_rad != seen_at(eyes, 1 / 60)[0].h_left_rad


# ---- laws


def test_high_beam_goes_off_at_once_and_comes_back_after_a_while():
    law = AutomaticHighBeam()
    law.begin([lamp()])
    light = []
    for frame in range(240):
        seen = [other(200)] if 60 <= frame < 90 else []
        given = phare.Given(frame_index=frame, step_s=1 / 60, speed_mps=20.0, objects=seen)
        light.append(law.step(given).light)
    assert light[59] == "high" and light[60] == "low" and light[90 + 88] == "low" and light[90 + 92] == "high"
    assert law.step(phare.Given(step_s=1 / 60, speed_mps=6.0)).light == "low"
    assert law.step(phare.Given(step_s=1 / 60, speed_mps=9.0)).light == "low"  # between the two speeds it stays
    walker = phare.Given(step_s=1 / 60, speed_mps=20.0, objects=[other(50, lights="none", kind="pedestrian")])
    assert law.step(walker).light == "high"


def dark(answer: phare.Answer, name="left") -> list[int]:
    return [i for i, share in enumerate(answer.lamps[name].dimming_01) if share == 0.0]


def glare_free(given: phare.Given, **settings) -> phare.Answer:
    law = GlareFree(**settings)
    law.begin(given.lamps)
    return law.step(given)


def test_the_segments_that_reach_a_road_user_are_dark_and_no_others():
    # 100 m ahead of the lamp, 3.5 m to the left: -1.66 deg, half a degree to each side and the margin: from -2.87 to -0.45.
    given = phare.Given(speed_mps=20.0, lamps=[lamp()], objects=[other(103.45)])
    assert dark(glare_free(given)) == [4]  # of -4 to 0 degrees
    assert dark(glare_free(given, margin_deg=1.5)) == [4, 5]  # to -3.68 and 0.36
    assert glare_free(given).light == "high"
    given.objects = [other(103.45, lights="none", kind="pedestrian")]
    assert dark(glare_free(given)) == []
    given.speed_mps = 3.0
    assert glare_free(given).light == "low"


def test_what_lies_below_the_road_user_stays_lit():
    low_segment = phare.SourceOfLaw("high", 1e4, -4 * DEG, 0.0, -4 * DEG, -1 * DEG)
    given = phare.Given(speed_mps=20.0, lamps=[phare.LampOfLaw("left", 3.45, 0, 0.66, [low_segment])], objects=[other(103.45)])
    assert dark(glare_free(given)) == []


def test_each_lamp_has_its_own_angles():
    # 10 m before the lamps on their middle line: the left lamp sees it to the right, the right lamp to the left.
    given = phare.Given(speed_mps=20.0, lamps=[lamp("left", 2.0), lamp("right", -2.0)], objects=[other(13.45, y=0.0)])
    answer = glare_free(given)
    assert min(dark(answer, "left")) > max(dark(answer, "right")) - 1
    assert dark(answer, "left") != dark(answer, "right")


def test_a_segment_goes_dark_at_once_and_comes_back_slowly_after_the_hold():
    law, lamps = GlareFree(hold_s=0.1, rise_s=0.5), [lamp()]
    law.begin(lamps)
    course = []
    for frame in range(90):
        seen = [other(103.45)] if frame < 10 else []
        time_s = frame / 60
        given = phare.Given(frame, time_s, 1 / 60, 20.0, lamps=lamps, objects=seen, seen_time_s=time_s)
        course.append(law.step(given).lamps["left"].dimming_01[4])
    first = next(i for i, share in enumerate(course) if share > 0)
    assert first == 9 + 7  # told of last in frame 9, held for 0.1 s: up to frame 15
    assert course[first + 15] == pytest.approx(16 / 30) and course[-1] == 1.0


def test_the_delay_is_made_up_for_by_prediction():
    # Seen 0.2 s ago 60 m ahead of the lamp, closing with 40 m/s: 8 m nearer by now, and 0.5 deg further to the left.
    given = phare.Given(60, 1.0, 1 / 60, 20.0, lamps=[lamp(columns=80)], seen_time_s=0.8, objects=[other(63.45, closing=40.0)])
    fine = phare.LampOfLaw("left", 3.45, 0.0, 0.66, [
        phare.SourceOfLaw("high", 1e4, (-10 + 0.1 * i) * DEG, (-9.9 + 0.1 * i) * DEG, -1 * DEG, 3 * DEG) for i in range(200)
    ])
    given.lamps = [fine]
    with_it, without = dark(glare_free(given)), dark(glare_free(given, predict=False))
    assert min(with_it) < min(without)
    turning = copy.copy(given)
    turning.yaw_rate_radps = 0.2  # to the left: 2.3 deg in 0.2 s, so it is further to the right
    assert min(dark(glare_free(turning))) > min(with_it) + 15


def test_a_camera_however_late_is_not_forgotten():
    """What it has just told counts, of whatever moment; the hold begins where it tells no more."""
    law, lamps = GlareFree(hold_s=0.5), [lamp()]
    law.begin(lamps)
    course = []
    for frame in range(200):
        time_s, late_s = frame / 60, 1.5
        seen = [other(103.45)] if 90 <= frame <= 120 else []
        given = phare.Given(frame, time_s, 1 / 60, 20.0, lamps=lamps, objects=seen, seen_time_s=time_s - late_s)
        course.append(law.step(given).lamps["left"].dimming_01[4])
    assert set(course[90:151]) == {0.0} and course[89] == 1.0 and course[151] > 0.0


def test_bending_light_looks_along_the_map():
    law, lamps = BendingLight(rate_degps=1e9), [lamp()]
    bend = [messages.CurveAhead(10.0 * i, 1 / 200) for i in range(16)]
    given = phare.Given(0, 0.0, 1 / 60, 20.0, lamps=lamps, ahead=bend)
    # 40 m along a circle of 200 m: aside 4.0 m by s^2 / 2R; atan(4 / 40).
    assert law.step(given).lamps["left"].yaw_rad == pytest.approx(math.atan2(4.0, 40.0), rel=1e-6)
    given.ahead = []
    given.yaw_rate_radps = -0.1  # no map: the same circle by yaw rate, to the right
    assert law.step(given).lamps["left"].yaw_rad == pytest.approx(-0.1)
    given.speed_mps = 0.5
    assert law.step(given).lamps["left"].yaw_rad == 0.0


def test_bending_light_keeps_its_limits():
    law = BendingLight(rate_degps=30.0, most_deg=5.0, outer_share=0.5)
    bend = [messages.CurveAhead(10.0 * i, 1 / 40) for i in range(16)]
    lamps = [lamp("left", 0.6), lamp("right", -0.6)]
    answers = [law.step(phare.Given(i, i / 60, 1 / 60, 20.0, lamps=lamps, ahead=bend)) for i in range(60)]
    assert answers[0].lamps["left"].yaw_rad == pytest.approx(0.5 * DEG)
    assert answers[-1].lamps["left"].yaw_rad == pytest.approx(5 * DEG)
    assert answers[-1].lamps["right"].yaw_rad == pytest.approx(2.5 * DEG)


def test_levelling_holds_against_the_body():
    law = DynamicLevelling(follow_s=0.05)
    law.begin([lamp()])
    assert law.step(phare.Given(suspension_pitch_rad=0.005)).levelling_rad == 0.005
    for frame in range(1, 60):
        answer = law.step(phare.Given(frame, step_s=1 / 60, suspension_pitch_rad=0.02))
    assert answer.levelling_rad == pytest.approx(0.02, rel=1e-4)
    for frame in range(60, 180):
        answer = law.step(phare.Given(frame, step_s=1 / 60, suspension_pitch_rad=0.2))
    assert answer.levelling_rad == pytest.approx(2 * DEG)  # its stop


def test_laws_together_see_the_lamps_as_those_before_have_turned_them():
    class Turn(phare.Controller):
        def step(self, given):
            return phare.Answer(lamps={"left": phare.LampLight(yaw_rad=8 * DEG, dimming_01=0.5)})

    given = phare.Given(speed_mps=20.0, lamps=[lamp()], objects=[other(103.45)])
    law = phare.Together(Turn(), GlareFree())
    law.begin(given.lamps)
    answer = law.step(given)
    assert dark(answer) == [6]  # two segments further, for the lamp is turned to the left by two
    assert answer.lamps["left"].dimming_01[5] == 0.5 and answer.lamps["left"].yaw_rad == 8 * DEG and answer.light == "high"


@pytest.mark.parametrize("wrong", [
    {"fov_deg": float("nan")}, {"fov_deg": 361.0}, {"delay_s": -0.1}, {"miss_01": 1.5}, {"noise_angle_deg": float("nan")},
    {"range_m": {"white": 400.0}}, {"range_m": {"white": float("nan"), "red": 1.0, "none": 1.0}},
    {"camera_m": (1.7, float("inf"), 1.3)}, {"delay_s": "a"}, {"camera_m": ("a", 0.0, 1.0)}, {"seed": -1}, {"seed": 0.5},
])
def test_sensors_that_cannot_be_are_refused(wrong):
    with pytest.raises(phare.BadInput, match=f"Sensors: {next(iter(wrong))}"):
        phare.Sensors(**wrong)


@pytest.mark.parametrize("law, words, named", [
    (law, {name: value}, name)
    for law, names in (
        (GlareFree, ("margin_deg", "hold_s", "rise_s", "on_above_kmh")), (BendingLight, ("ahead_s", "most_deg", "rate_degps", "outer_share", "from_kmh")),
        (AutomaticHighBeam, ("on_above_kmh", "off_below_kmh", "on_after_s")), (DynamicLevelling, ("follow_s", "rate_degps", "most_deg")),
    )
    for name in names
    for value in (math.nan, math.inf, -1.0)
] + [(law, {"on_above_kmh": 10.0, "off_below_kmh": 50.0}, "off_below_kmh") for law in (GlareFree, AutomaticHighBeam)])
def test_a_law_refuses_what_cannot_be(law, words, named):
    with pytest.raises(phare.BadInput, match=f"{law.__name__}: {named} is"):
        law(**words)


def test_sensors_of_a_file_that_is_not_there_are_refused(tmp_path):
    with pytest.raises(phare.BadInput, match="nope.toml: No such file"):
        phare.Sensors(tmp_path / "nope.toml")


@pytest.mark.parametrize("answer, why", [
    (phare.Answer(lamps={"middle": phare.LampLight()}), "lamp 'middle': the design has left"),
    (phare.Answer(lamps={"left": phare.LampLight(dimming_01=[1.0, 0.5])}), "2 dimmings .* has 9 sources"),
    (phare.Answer(lamps={"left": phare.LampLight(dimming_01=float("nan"))}), "dimming of nan"),
    (phare.Answer(lamps={"left": phare.LampLight(yaw_rad=2.0)}), "yaw_rad = 2.0"),
    (phare.Answer(light="bright"), "light 'bright'"), (phare.Answer(levelling_rad=float("inf")), "levelling_rad = inf"),
])
def test_an_answer_that_cannot_be_followed_is_refused(answer, why):
    with pytest.raises(phare.LawFailed, match=why):
        answer.to_proto([lamp()])


def test_numbers_of_numpy_are_numbers_of_an_answer():
    lights = {"left": phare.LampLight(dimming_01=np.float32(0.5))}
    assert list(phare.Answer(lamps=lights).to_proto([lamp()]).lamps[0].dimming_01) == [0.5]
    assert phare.Sensors(delay_s=np.float32(0.5)).delay_s == 0.5

    class Half(phare.Controller):
        def step(self, given):
            return phare.Answer(lamps=lights)

    both = phare.Together(Half(), Half()).step(phare.Given(lamps=[lamp()]))
    assert both.lamps["left"].dimming_01 == [0.25] * 9


# ---- in the loop

TRAFFIC = [phare.RoadUser(start_s_m=120, speed_mps=20.0, offset_m=3.5), phare.RoadUser(direction="same", start_s_m=60, speed_mps=15.0)]
LOOP = dict(frames=12, **SMALL)


def test_a_law_leads_the_lamps_and_the_drive_repeats(moving, tmp_path):
    rig, hashes = phare.Rig.shipped("matrix"), []
    noisy = phare.Sensors(TRAFFIC, delay_s=0.05, noise_angle_deg=0.1, miss_01=0.2, seed=7)
    for run in range(2):
        driven = phare.drive(rig, drive=moving, controller=GlareFree(), sensors=noisy, out=tmp_path / str(run), **LOOP)
        hashes.append(driven.picture_hash)
    assert hashes[0] == hashes[1]
    law = driven.figures["law"]
    assert law["answers"] == 12 and law["silent_frames"] == 0 and law["refused"] == 0
    steps = driven.law_steps
    assert list(steps.index) == list(range(12)) and (steps.light == "high").all() and steps.objects.max() == 2
    segments = driven.law.filter(regex=r"^headlamp left/\d+$")
    assert segments.shape[1] == 37 and (segments.iloc[-1] == 0).sum() >= 2 and (segments.iloc[-1] == 1).sum() > 20

    class Bright(phare.Controller):
        def step(self, given):
            return phare.Answer(light="high")

    bright = phare.drive(rig, drive=moving, controller=Bright(), out=tmp_path / "bright", **LOOP)
    assert bright.picture_hash != hashes[0]
    assert bright.frame(-1).mean() > driven.frame(-1).mean()  # segments were dark there


def test_a_frame_waits_for_its_answer_from_the_first_on(moving, tmp_path):
    class Late(phare.Controller):
        def __init__(self, wait_s):
            self.wait_s = wait_s

        def step(self, given):
            time.sleep(self.wait_s)
            return phare.Answer(light="low" if given.frame_index % 2 else "high")

    # Longer than the 100 ms after which a picture that makes no progress says again what it has drawn.
    prompt, late = (
        phare.drive(drive=moving, controller=Late(wait_s), out=tmp_path / str(wait_s), frames=3, **SMALL) for wait_s in (0.0, 0.3)
    )
    assert len(late.frame_files) == 3 and late.picture_hash == prompt.picture_hash


def test_in_real_time_the_delay_of_the_answers_is_told(moving):
    led = phare.drive(drive=moving, controller=AutomaticHighBeam(), lockstep=False, **SMALL)
    law = led.figures["law"]
    assert law["answers"] >= 1 and law["refused"] == 0
    assert 0 < law["delay_ms"]["median"] <= law["delay_ms"]["max"] and law["in_frame"] <= law["answers"]
    assert len(led.law_steps) >= law["answers"] and led.law.light_switch.isin([2, 3]).all()


def test_a_law_knows_lamps_of_ones_own(moving, tmp_path, examples):
    class Known(phare.Controller):
        def begin(self, lamps):
            self.lamps = lamps

        def step(self, given):
            return phare.Answer(lamps={lamp.lamp: phare.LampLight(yaw_rad=0.05) for lamp in self.lamps})

    law = Known()
    own = phare.drive(lamp=examples / "led_low_beam.ies", drive=moving, controller=law, frames=2, out=tmp_path / "out", **SMALL)
    low = [source for lamp in law.lamps for source in lamp.sources if source.function == "low"]
    assert len(low) == 2 and low[0].peak_cd == phare.Lamp.read(examples / "led_low_beam.ies").peak_cd
    assert own.figures["law"]["refused"] == 0 and own.figures["law"]["answers"] == 2


class Knows(phare.Controller):
    """The low beam's peak of the lamps it is given."""

    def begin(self, lamps):
        self.peak_cd = lamps[0].sources[0].peak_cd

    def step(self, given):
        self.design_index = given.design_index
        return phare.Answer()


def led_peak_cd():
    return phare.Lamp.read(phare.generated_file("lamps/led_low_rht.ies")).peak_cd


@pytest.mark.parametrize("settings, more, shown", [
    ({}, [], None), ({"design": 1}, [], "1"), ({"view": "photo"}, ["--design", "led"], "led"), ({}, ["--design=led"], "led"),
    ({}, ["--set", "design=1"], "1"), ({}, ["--set=design=cockpit", "--design", "led"], "cockpit"), ({}, ["--set", "view=photo"], None),
])
def test_the_design_that_a_picture_shows_is_read_from_the_words_of_a_drive(settings, more, shown):
    assert design_shown(settings, more) == shown


def test_a_law_is_given_the_design_of_the_rigs_desk(moving):
    rig, law = phare.Rig.shipped(), Knows()
    rig.more["desk"] = {**rig.more.get("desk", {}), "design": 1}
    driven = phare.drive(rig, drive=moving, controller=law, frames=2, **SMALL)
    assert law.peak_cd == led_peak_cd() and law.design_index == 1
    assert driven.figures["law"]["refused"] == 0


@pytest.mark.parametrize("words", [{"settings": {"design": 1}}, {"more": ["--design", "led"]}])
def test_a_law_is_given_the_design_that_a_drive_names(moving, words):
    law = Knows()
    more = ["--audit-every", "0", *words.get("more", [])]
    driven = phare.drive(drive=moving, controller=law, frames=2, size=(160, 90), more=more, settings=words.get("settings"))
    assert law.peak_cd == led_peak_cd() and law.design_index == 1
    assert driven.figures["law"]["refused"] == 0


def test_sensors_without_a_law_are_refused(moving):
    with pytest.raises(phare.BadInput, match="sensors: are of a control law"):
        phare.drive(drive=moving, sensors=phare.Sensors(), frames=2)


def test_a_law_that_raises_ends_the_drive_with_its_words(moving):
    class Broken(phare.Controller):
        def step(self, given):
            if given.frame_index == 2:
                raise ZeroDivisionError("by nothing")
            return phare.Answer()

    with pytest.raises(phare.LawFailed, match="after frame 1: ZeroDivisionError: by nothing") as told:
        phare.drive(drive=moving, controller=Broken(), **LOOP)
    assert isinstance(told.value.__cause__, ZeroDivisionError)


@pytest.mark.parametrize("raised", [SystemExit(3), KeyboardInterrupt("by the law")])
def test_a_law_that_leaves_ends_the_drive_with_its_words(moving, raised):
    class Leaves(phare.Controller):
        def step(self, given):
            raise raised

    with pytest.raises(phare.LawFailed, match=f"{type(raised).__name__}: {raised}"):
        phare.drive(drive=moving, controller=Leaves(), timeout_s=60, **LOOP)


def test_a_law_that_never_answers_is_left_when_time_is_up(moving):
    class Silent(phare.Controller):
        ended = False
        leave = threading.Event()

        def step(self, given):
            self.leave.wait(120)
            return phare.Answer()

        def end(self):
            self.ended = True

    law = Silent()
    with pytest.raises(phare.Failed, match="not done after 3 s"):
        phare.drive(drive=moving, controller=law, timeout_s=3, **LOOP)
    assert not law.ended  # it is at its step still
    law.leave.set()


@pytest.mark.parametrize("wrong, why", [(GlareFree, r"the class GlareFree: give an object of it, GlareFree\(\)"), (object(), "is object, and no phare.Controller")])
def test_what_is_no_law_is_refused(wrong, why):
    with pytest.raises(phare.BadInput, match=why):
        phare.drive(controller=wrong, **LOOP)


def test_a_law_that_cannot_end_is_told_and_hides_nothing(moving):
    class Ends(phare.Controller):
        def __init__(self, raises):
            self.raises = raises

        def step(self, given):
            if self.raises:
                raise ZeroDivisionError("first")
            return phare.Answer()

        def end(self):
            raise ValueError("at last")

    with pytest.raises(phare.LawFailed, match="at its end: ValueError: at last") as told:
        phare.drive(drive=moving, controller=Ends(False), **LOOP)
    assert isinstance(told.value.__cause__, ValueError)
    with pytest.raises(phare.LawFailed, match="ZeroDivisionError: first"):
        phare.drive(drive=moving, controller=Ends(True), **LOOP)
    with pytest.raises(phare.BadInput, match="nope"):
        phare.drive(drive=moving, controller=Ends(False), settings={"nope": 1}, **LOOP)


def test_a_law_may_be_a_program_of_its_own(moving, tmp_path):
    law = tmp_path / "law.py"
    law.write_text(
        "import struct, sys\nfrom phare import phare_pb2 as pb\n"
        "while head := sys.stdin.buffer.read(4):\n"
        "    given = pb.LawInput.FromString(sys.stdin.buffer.read(struct.unpack('<I', head)[0]))\n"
        "    if given.lamps: names = [lamp.lamp for lamp in given.lamps if lamp.lamp.startswith('head')]\n"
        "    answer = pb.LawAnswer(light_switch=pb.LIGHT_SWITCH_LOW)\n"
        "    for name in names: answer.lamps.add(lamp=name, yaw_rad=0.1, dimming_01=[0.5])\n"
        "    body = answer.SerializeToString()\n"
        "    sys.stdout.buffer.write(struct.pack('<I', len(body)) + body); sys.stdout.buffer.flush()\n"
    )
    environment = ["env", f"PYTHONPATH={Path(phare.__file__).parents[1]}"]
    driven = phare.drive(drive=moving, controller=phare.Program([*environment, sys.executable, law]), **LOOP)
    assert (driven.law["headlamp left/yaw_rad"] == 0.1).all() and (driven.law["headlamp right/1"] == 0.5).all()


@pytest.mark.parametrize("code, why", [
    ("import sys; sys.exit(3)", "ended with exit code 3"),
    ("import sys; sys.stdin.buffer.read(4); sys.stdout.buffer.write(b'hello you'); sys.stdout.flush(); sys.stdin.read()", "answer of"),
    ("import time; time.sleep(60)", "no answer within 0.5 s"),
])
def test_a_program_that_is_no_law_is_told(code, why):
    law = phare.Program([sys.executable, "-c", code], answers_within_s=0.5 if "sleep" in code else 20)
    law.begin([])
    with pytest.raises(phare.LawFailed, match=why):
        for _ in range(200):
            law.step(phare.Given())
    law._running.kill() if law._running else None
    law.end()


def test_a_program_that_is_not_there_is_told():
    with pytest.raises(phare.LawFailed, match="/no/law: No such file"):
        phare.Program(["/no/law"]).begin([])


def test_the_message_of_a_program_is_what_a_law_of_python_is_given():
    given = phare.Given(5, 0.25, 1 / 60, 20.0, light="high", lamps=[lamp()], objects=[other(50, kind="lorry", lights="red")],
                        ahead=[messages.CurveAhead(10.0, 0.01)], seen_time_s=0.2)
    message = given.to_proto(with_lamps=True)
    assert (message.frame_index, message.light_switch, message.objects[0].kind, message.objects[0].lights) == (5, 3, 2, 2)
    assert message.objects[0].h_left_rad == given.objects[0].h_left_rad and message.ahead[0].curvature_1pm == 0.01
    assert len(message.lamps[0].sources) == 9 and not given.to_proto(with_lamps=False).lamps
