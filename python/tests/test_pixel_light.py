"""unit: a module's limits, pictures on the road, names of pictures. process: a drive whose pixel light a law gives pictures."""

import math
import time
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

import phare
from phare.control import messages
from phare.light_in_drive import design_of_frames, lux_in_drive

from conftest import SMALL
from test_control import lamp

LOOP = dict(frames=12, **SMALL)


# ---- in the loop


def test_a_pixel_light_that_begins_dark_is_no_problem(tmp_path):
    (tmp_path / "full.csv").write_text("h_deg,v_deg,intensity_cd\n" + "".join(f"{h},{v},60000\n" for v in (-4, 4) for h in (-8, 8)))
    (tmp_path / "dark.pgm").write_bytes(b"P5 64 32 255\n" + bytes(64 * 32))
    rig = phare.Rig.shipped("country_road")
    problems = rig.problems()
    for lamp in rig.designs[0].lamps:
        if lamp.name == "headlamp":
            lamp.sources.append(phare.Source("high", str(tmp_path / "full.csv"), more={"pixels": str(tmp_path / "dark.pgm")}))
    assert rig.problems() == problems
    (tmp_path / "full.csv").write_text("h_deg,v_deg,intensity_cd\n" + "".join(f"{h},{v},0\n" for v in (-4, 4) for h in (-8, 8)))
    rig.designs[0].lamps[0].sources[-1].more = {}
    assert rig.problems() != problems  # without a picture it is a lamp that sends no light


def test_a_law_gives_a_pixel_light_its_pictures(moving, tmp_path):
    """In lockstep each frame shows the picture of its own answer: twice the same drive, and another one with other pictures."""
    (tmp_path / "full.csv").write_text("h_deg,v_deg,intensity_cd\n" + "".join(f"{h},{v},60000\n" for v in (-4, 4) for h in (-8, 8)))
    picture, columns, rows = tmp_path / "left.pgm", 64, 32

    def write(shares):
        new = tmp_path / "left.new"
        new.write_bytes(b"P5 %d %d 255\n" % (columns, rows) + shares.astype(np.uint8).tobytes())
        new.replace(picture)

    class Sweep(phare.Controller):
        step_px = 4

        def step(self, given):
            shares = np.zeros((rows, columns))
            at = self.step_px * given.frame_index % columns
            shares[:, at : at + 8] = 255
            write(shares)
            return phare.Answer(light="high", lamps={"headlamp left": phare.LampLight(frame=str(picture))})

    class Still(Sweep):
        step_px = 0

    write(np.zeros((rows, columns)))
    rig = phare.Rig.shipped("country_road")
    for lamp in rig.designs[0].lamps:
        if lamp.name == "headlamp":
            lamp.sources.append(phare.Source("high", str(tmp_path / "full.csv"), more={"pixels": str(picture)}))
    drives = []
    for name, law in [("one", Sweep()), ("two", Sweep()), ("still", Still())]:
        write(np.zeros((rows, columns)))
        drives.append(phare.drive(rig, drive=moving, controller=law, out=tmp_path / name, **LOOP))
    assert drives[0].picture_hash == drives[1].picture_hash != drives[2].picture_hash
    assert drives[0].frame(6).tobytes() != drives[2].frame(6).tobytes()
    assert drives[0].figures["law"]["refused"] == 0


def with_pixels(folder, shares, function="low"):
    """The demo's rig and its halogen headlamps with a pixel light besides, turned, whose picture is 64 x 32."""
    (folder / "full.csv").write_text("h_deg,v_deg,intensity_cd\n" + "".join(f"{h},{v},60000\n" for v in (-8, 2) for h in (-10, 10)))
    picture = folder / "picture.pgm"
    picture.write_bytes(b"P5 64 32 255\n" + shares.astype(np.uint8).tobytes())
    rig = phare.Rig.shipped("country_road")
    more = {"pixels": str(picture)}
    rig.designs[0].lamps[0].sources.append(phare.Source(function, str(folder / "full.csv"), yaw_deg=2.0, pitch_deg=-0.5, more=more))
    return rig


def left_half(rows=32, columns=64):
    shares = np.zeros((rows, columns))
    shares[:, : columns // 2] = 255
    return shares


def test_judges_see_the_picture_of_a_pixel_light(moving, tmp_path):
    """Lux of the rig by the judge, by `phare measure --rig` and by the picture's own probe (float32)."""
    rig = with_pixels(tmp_path, left_half())
    points = [[40.0, y, 0.5, -1.0, 0.0, 0.0] for y in (4.0, 0.5, -2.6)]
    probes = {"probes": "; ".join(f"car {x:g} {y:g} {z:g} -1 0 0" for x, y, z, *_ in points)}
    report = phare.drive(rig, drive=moving, settings=probes, frames=2, size=(64, 36), more=["--audit-every", "0"])
    rows = pd.DataFrame([[1, *point] for point in points], columns=["frame", "x", "y", "z", "nx", "ny", "nz"])
    lux = lux_in_drive(rows, report, rig, design_of_frames(report, rig))
    assert lux == pytest.approx(phare.measure(rig.write(tmp_path / "rig.toml"), points, reference=True), rel=1e-9)
    probed = pd.read_csv(report.folder / "probes.csv").iloc[-1]
    assert [probed[f"probe{i}_lx"] for i in (1, 2, 3)] == pytest.approx(list(lux), rel=1e-4)
    plain = phare.measure(phare.shipped_file("rigs/country_road.toml"), points, reference=True)
    assert lux[0] > plain[0] + 10.0 and lux[2] == pytest.approx(plain[2], rel=1e-9)  # lit to the left, dark to the right


def test_a_dark_pixel_light_changes_no_track_test(tmp_path):
    with_it, without = with_pixels(tmp_path, np.zeros((32, 64))), phare.Rig.shipped("country_road")
    one, other = (phare.track_tests(rig, phare.laws.AutomaticHighBeam) for rig in (with_it, without))
    assert list(one.rows.most_lx) == list(other.rows.most_lx)


def test_pictures_of_a_law_are_refused_by_the_judges(moving, tmp_path):
    """What they were is gone when the drive is judged. Where that source is dark nothing is asked of them."""
    frame = tmp_path / "frame.pgm"
    frame.write_bytes(b"P5 64 32 255\n" + left_half().astype(np.uint8).tobytes())

    class Gives(phare.Controller):
        def step(self, given):
            return phare.Answer(lamps={"headlamp left": phare.LampLight(frame=str(frame) if given.frame_index == 0 else "")})

    users = [phare.RoadUser(start_s_m=90.0, speed_mps=0.0, offset_m=3.5)]
    rig = with_pixels(tmp_path, left_half())
    report = phare.drive(rig, drive=moving, controller=Gives(), frames=3, **SMALL)
    for judge in (phare.judge_glare, phare.detect_pedestrians):
        of_it = users if judge is phare.judge_glare else [phare.RoadUser(kind="pedestrian", direction="standing", start_s_m=60.0)]
        with pytest.raises(phare.BadInput, match="lamp 'headlamp left': the control law gave its pixel light pictures"):
            judge(report, rig, of_it)
    with pytest.raises(phare.BadInput, match="gave its pixel light pictures"):
        phare.track_tests(rig, Gives)
    of_high = with_pixels(tmp_path, left_half(), "high")
    assert phare.track_tests(of_high, Gives).measured_s > 0.0


# ---- names of pictures


def test_a_picture_may_be_named_from_where_the_law_runs(tmp_path, monkeypatch):
    """The visual opens it, from another folder: it is told the whole name. A Path is one too, and none stays none."""
    monkeypatch.chdir(tmp_path)

    def told(frame):
        return phare.Answer(lamps={"left": phare.LampLight(frame=frame)}).to_proto([lamp()]).lamps[0].frame

    assert told("left.pgm") == told(Path("left.pgm")) == str(tmp_path / "left.pgm")
    assert told("../left.pgm") == str(tmp_path.parent / "left.pgm")
    assert told("/dev/shm/left.pgm") == "/dev/shm/left.pgm" and told("") == ""


def test_a_name_that_no_datagram_takes_is_refused(tmp_path, monkeypatch):
    """4096 bytes are the most that net/wire.cpp takes; a letter may be two of them, and the folder counts."""
    monkeypatch.chdir(tmp_path)

    def answer(frame):
        return phare.Answer(lamps={"left": phare.LampLight(frame=frame)}).to_proto([lamp()])

    assert len(answer("/" + 4095 * "a").lamps[0].frame) == 4096
    for name in ("/" + 4096 * "a", "/" + 2048 * "é", 4096 * "a"):
        with pytest.raises(phare.LawFailed, match="frame for lamp 'left' whose name is longer than 4096 bytes"):
            answer(name)


# ---- limits of a module, pictures on the road


def test_a_module_gives_no_more_power_than_it_has():
    class Full(phare.Controller):
        def step(self, given):
            return phare.Answer(light="high")

    lamps = [lamp("left", columns=8), lamp("right", -0.6, columns=8)]
    limits = phare.laws.ModuleLimits(Full(), power_w=4.0, source_w=1.0)
    limits.begin(lamps)
    answer = limits.step(phare.Given(lamps=lamps))
    dims = answer.lamps["left"].dimming_01
    assert dims[0] == 1.0 and dims[1:] == pytest.approx([0.5] * 8)  # low beam as it was, 8 W asked
    assert limits.power_of == pytest.approx({"left": 4.0, "right": 4.0})

    class Some(phare.Controller):
        def step(self, given):
            return phare.Answer(light="high", lamps={"left": phare.LampLight(dimming_01=[1.0, 1.0, 0.0, 0.5, 0, 0, 0, 0, 0])})

    limits = phare.laws.ModuleLimits(Some(), power_w=4.0, source_w=1.0)
    limits.begin(lamps)
    answer = limits.step(phare.Given(lamps=lamps))
    assert answer.lamps["left"].dimming_01 == [1.0, 1.0, 0.0, 0.5, 0, 0, 0, 0, 0]  # 1.5 W: nothing to limit
    assert limits.power_of["left"] == pytest.approx(1.5)


def test_a_module_that_is_switched_off_stays_cold():
    """A law's beam counts while the stalk is at low or high; the flash has high beam whatever the stalk."""

    class Full(phare.Controller):
        def step(self, given):
            return phare.Answer(light="high")

    lamps = [lamp("left", columns=8)]
    asked = {("off", False): 0.0, ("position", False): 0.0, ("low", False): 8.0, ("high", False): 8.0, ("off", True): 8.0}
    for (stalk, flash), watts in asked.items():
        limits = phare.laws.ModuleLimits(Full(), k_per_w=4.0)
        limits.begin(lamps)
        for frame in range(60):
            limits.step(phare.Given(frame_index=frame, step_s=1.0, lamps=lamps, light=stalk, flash=flash))
        assert limits.power_of["left"] == watts, stalk
        assert (limits.temperature_of["left"] > 41.0) == (watts > 0.0)


def test_a_module_settles_where_heat_and_light_balance():
    """P = full (130 - T) / 20 above 110 °C and T = 40 + r P: T = (40 * 20 + 130 r P0) / (20 + r P0)."""

    class Full(phare.Controller):
        def step(self, given):
            return phare.Answer(light="high")

    lamps = [lamp("left", columns=8)]
    limits = phare.laws.ModuleLimits(Full(), power_w=100.0, source_w=2.0, k_per_w=6.0, tau_s=60.0)
    limits.begin(lamps)
    temperatures = []
    for frame in range(6000):  # ten time constants
        answer = limits.step(phare.Given(frame_index=frame, step_s=0.1 if frame else 0.0, lamps=lamps))
        temperatures.append(limits.temperature_of["left"])
    full_k = 6.0 * 16.0
    settled = (40 * 20 + 130 * full_k) / (20 + full_k)
    assert 110 < settled < 130 and temperatures[-1] == pytest.approx(settled, abs=1e-6)
    assert answer.lamps["left"].dimming_01[1] == pytest.approx((130 - settled) / 20, abs=1e-6)
    assert answer.lamps["left"].dimming_01[0] == 1.0
    # Until it dims, the closed form of one time constant.
    warm = [(0.1 * k, t) for k, t in enumerate(temperatures) if t < 110]
    assert len(warm) > 100
    for time_s, t in warm[1:]:
        assert t == pytest.approx(40 + full_k * (1 - math.exp(-time_s / 60)), abs=1e-6)
    with pytest.raises(ValueError, match="ambient_c < from_c"):
        phare.laws.ModuleLimits(Full(), k_per_w=1.0, ambient_c=120.0)


def test_lane_lines_lie_on_the_road_where_the_lane_is():
    place = lamp("headlamp left", 0.6)
    law = phare.laws.LaneProjection(columns=800, rows=400, h_deg=(-10, 10), v_deg=(-8, 2), half_width_m=1.1, line_m=0.2)
    curve = 0.005  # to the left
    ahead = [messages.CurveAhead(float(d), curve) for d in range(0, 60, 2)]
    picture = law.draw(phare.Given(ahead=ahead), place)
    rows, columns = np.nonzero(picture == 255)
    v = np.radians(2 - 10 * (rows + 0.5) / 400)
    h = np.radians(-10 + 20 * (columns + 0.5) / 800)
    ahead_m = 0.66 / np.tan(-v)
    x, y = 3.45 + ahead_m, 0.6 - ahead_m * np.tan(h)
    assert ahead_m.min() >= 8 and ahead_m.max() <= 35 and len(rows) > 1000
    off = np.abs(y - curve * x**2 / 2)  # a circle, to (x/R)² of it: 2 % of 3.7 m
    assert off.min() > 1.0 - 0.08 and off.max() < 1.2 + 0.08
    assert (y < curve * x**2 / 2).any() and (y > curve * x**2 / 2).any()
    assert (picture[:79] == 153).all() and (picture[-1] == 76).all()  # above the horizon, at the lamp's foot

    big = phare.laws.LaneProjection(columns=1664, rows=800, h_deg=(-8, 8), v_deg=(-4, 4))
    big.begin([place])
    taken = []
    for _ in range(5):
        start = time.perf_counter()
        answer = big.step(phare.Given(ahead=ahead))
        taken.append(time.perf_counter() - start)
    print(f"a lane picture of 1.3 million pixels: {1000 * sorted(taken)[2]:.1f} ms")
    written = Path(answer.lamps["headlamp left"].frame).read_bytes()
    assert written.startswith(b"P5 1664 800 255\n") and len(written) == 16 + 1664 * 800
    big.end()
    assert not Path(answer.lamps["headlamp left"].frame).exists()


RASTER = dict(columns=8, rows=4, h_deg=(-10, 10), v_deg=(-8, 2))


@pytest.mark.parametrize("words", [
    {"line_01": 2.0}, {"line_01": math.nan}, {"road_01": -0.1}, {"above_01": 1.5}, {"from_m": math.nan}, {"to_m": -1.0}, {"half_width_m": math.inf},
    {"line_m": -0.2}, {"up_deg": math.nan},
])
def test_a_projection_that_cannot_be_is_refused(words):
    for law in (phare.laws.LaneProjection, phare.laws.SymbolProjection):
        with pytest.raises(phare.BadInput, match=f"{law.__name__}: {next(iter(words))} is"):
            law(**RASTER, **words)


def test_a_projection_by_a_lamp_that_is_not_there_is_refused():
    law = phare.laws.LaneProjection("haedlamp left", **RASTER)
    with pytest.raises(phare.BadInput, match="no lamp 'haedlamp left': the design has headlamp left"):
        law.begin([lamp("headlamp left")])


def test_a_symbol_lies_on_the_road_in_its_lane():
    """Each pixel's place on the road, by its own way back: the symbol's share there, and nothing of it elsewhere."""
    place, raster = lamp("headlamp left", 0.6), dict(columns=1200, rows=800, h_deg=(-10.0, 10.0), v_deg=(-8.0, 2.0))
    ramp = np.outer(np.ones(2), np.linspace(0.0, 1.0, 8))  # to the right brighter
    law = phare.laws.SymbolProjection(**raster, symbol=ramp, at_m=12.0, length_m=8.0, width_m=2.0, road_01=0.0, above_01=0.0)
    curve = -0.004  # to the right
    picture = law.draw(phare.Given(ahead=[messages.CurveAhead(0.5 * d, curve) for d in range(80)]), place)
    v, h = np.meshgrid(np.radians(2 - 10 * (np.arange(800) + 0.5) / 800), np.radians(-10 + 20 * (np.arange(1200) + 0.5) / 1200), indexing="ij")
    with np.errstate(divide="ignore", invalid="ignore"):
        ahead_m = np.where(v < 0, 0.66 / np.tan(-v), np.inf)
        aside_m = 0.6 - ahead_m * np.tan(h) - curve * (3.45 + ahead_m) ** 2 / 2
    on_it = (ahead_m > 12.0) & (ahead_m < 20.0) & (np.abs(aside_m) < 1.0)
    assert picture[~on_it].max() <= 1 and on_it.sum() > 5000  # at the very edge the steps of the lane's curve count
    # Between the middles of its outer columns the symbol is linear in its width: eight columns of 0.25 m, 0 to 1. The lane as summed in
    # steps of 0.5 m is off by under curve * 0.5 * 24 / 2 = 2.4 cm, 0.014 of it; then half of 1/255.
    inner = on_it & (np.abs(aside_m) < 0.875)
    expected = (0.875 - aside_m[inner]) / 1.75
    assert np.abs(picture[inner] / 255 - expected).max() < 0.014 + 0.5 / 255

    straight = phare.laws.SymbolProjection(**raster, road_01=0.0, above_01=0.0, line_m=0.2)
    rows, columns = np.nonzero(straight.draw(phare.Given(), place) == 255)
    y = 0.6 - 0.66 / np.tan(-v[rows, 0]) * np.tan(h[0, columns])
    assert ((np.abs(y) < 0.7) | (np.abs(np.abs(y) - 1.1) < 0.11)).all()  # the arrow and both lines
    turned = phare.laws.arrow(90.0)
    assert phare.laws.arrow()[:20].sum() > phare.laws.arrow()[-20:].sum() and turned[:, :20].sum() > turned[:, -20:].sum()


@pytest.mark.parametrize("words", [dict(symbol=np.full((3, 3), 1.5)), dict(symbol=np.zeros(4)), dict(symbol=np.full((2, 2), np.nan)), dict(at_m=0.0)])
def test_a_symbol_that_is_none_is_refused(words):
    with pytest.raises(ValueError, match="symbol|at_m"):
        phare.laws.SymbolProjection(columns=8, rows=8, h_deg=(-1, 1), v_deg=(-1, 1), **words)
