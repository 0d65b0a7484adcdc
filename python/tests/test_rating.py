"""reference: reach and demerits of a lamp that shines evenly, by hand."""

import math
import os
import subprocess
import sys
from pathlib import Path

import pytest

import phare
from phare.rating import rating_of, read_limits

LIMITS = """[[visibility]]
approach = "straight"
beam = "low"
edge = "right"
target_m = 100
demerits_per_m = 0.5
[[visibility]]
approach = "straight"
beam = "high"
edge = "right"
target_m = 50
demerits_per_m = 9
[[glare]]
approach = "straight"
curve = [[40, 9], [60, 9]]
demerits = 4
allowed_s = 0
[[glare]]
approach = "sharp left"
curve = [[40, 30], [60, 30]]
demerits = 8
allowed_s = 0
[assist]
credit_share_01 = 0.5
"""


@pytest.fixture(scope="module")
def rig(tmp_path_factory):
    """One lamp in the middle, 0.66 m high, 3.45 m ahead of the origin: low 20,000 cd everywhere, high 60,000 cd besides."""
    folder = tmp_path_factory.mktemp("rated")
    for name, cd in (("low", 20000), ("high", 60000)):
        lines = ["# quantity: luminous intensity", "# unit: cd", "# angles: type A", "V\\H,-60,60", f"-30,{cd},{cd}", f"30,{cd},{cd}"]
        (folder / f"{name}.csv").write_text("\n".join(lines) + "\n")
    made = phare.Rig.shipped()
    sources = [phare.Source(name, str(folder / f"{name}.csv")) for name in ("low", "high")]
    made.designs = [phare.Design("even", [phare.LampPlace("headlamp", [3.45, 0.0, 0.66], sources=sources)])]
    return made.write(folder / "rig.toml")


def test_reach_of_both_beams_and_no_rating_of_our_own(rig):
    done = phare.rate_iihs(rig)
    assert len(done.visibility) == 20 and done.rating is done.total is done.demerits is None
    for beam, cd in (("low", 20000), ("high", 80000)):
        at = done.visibility[(done.visibility.beam == beam) & (done.visibility.approach == "straight")].distance_m.iloc[0]
        # sqrt(I / 5); the step is 0.5 m, and the edge 1.8 m aside shortens it by less than 0.1 m.
        assert 0 <= 3.45 + math.sqrt(cd / 5) - at < 0.6


def test_demerits_by_hand(rig, tmp_path):
    (tmp_path / "limits.toml").write_text(LIMITS)
    done = phare.rate_iihs(rig, limits=tmp_path / "limits.toml")
    # Low: 66.5 m of 100 m. High: beyond 50 m. Glare at 40 m: 14.8 lx, above 9 and below 30.
    assert list(done.demerits.demerits) == [pytest.approx(0.5 * 33.5), 0.0, 4.0, 0.0]
    assert done.total == pytest.approx(20.75) and done.rating == "Marginal"
    # 20000 x / (x^2 + 3.6^2 + 0.44^2)^1.5 = 9 lx; the trace is linear between half metres: some mm of 10 m.
    low, high = 40.0, 60.0
    for _ in range(60):
        x = (low + high) / 2
        low, high = (x, high) if 20000 * x / (x * x + 3.6**2 + 0.44**2) ** 1.5 > 9 else (low, x)
    assert list(done.above.above_m) == [pytest.approx(low + 3.45 - 40, abs=0.01), 0.0] and list(done.above.excess) == [True, False]
    assert done.above.above_s[0] == pytest.approx((low + 3.45 - 40) / (40 * 1609.344 / 3600), abs=0.001)
    assert [rating_of(n) for n in (0, 10, 10.1, 20, 30, 30.1)] == ["Good", "Good", "Acceptable", "Acceptable", "Marginal", "Poor"]


def test_glare_that_is_allowed_so_long_is_no_excess(rig, tmp_path):
    (tmp_path / "limits.toml").write_text(LIMITS.replace("demerits = 4\nallowed_s = 0", "demerits = 4\nallowed_s = 0.6"))  # 0.580 s are above
    done = phare.rate_iihs(rig, limits=tmp_path / "limits.toml")
    assert done.total == pytest.approx(16.75) and done.rating == "Acceptable" and not done.above.excess.any()


def test_assist_gives_back_what_the_high_beam_regains_where_glare_is_not_in_excess(rig, tmp_path):
    limits = tmp_path / "limits.toml"
    limits.write_text(LIMITS)
    assert phare.rate_iihs(rig, limits=limits, assist=True).total == pytest.approx(20.75)  # the straight has excess glare
    limits.write_text(LIMITS.replace("demerits = 4\nallowed_s = 0", "demerits = 4\nallowed_s = 0.6"))
    done = phare.rate_iihs(rig, limits=limits, assist=True)
    assert done.total == pytest.approx(16.75 / 2) and done.rating == "Good"  # the high beam reaches the 100 m: half of 16.75 comes back
    # Of a target of 140 m, 73.5 m are short; the high beam (129.5 m) is 10.5 m short itself: half of 63 m at 0.5 a metre.
    limits.write_text(limits.read_text().replace("target_m = 100", "target_m = 140"))
    assert phare.rate_iihs(rig, limits=limits, assist=True).total == pytest.approx(73.5 * 0.5 - 0.5 * 63 * 0.5)
    limits.write_text(limits.read_text().replace('approach = "straight"\ncurve', 'approach = "gradual left"\ncurve'))
    assert phare.rate_iihs(rig, limits=limits, assist=True).total == pytest.approx(73.5 * 0.5)  # no curve there, so no credit
    for words in ({}, {"limits": limits}):
        limits.write_text(LIMITS.partition("[assist]")[0])
        with pytest.raises(phare.BadInput, match="not public: give limits with"):
            phare.rate_iihs(rig, assist=True, **words)


def test_excess_glare_is_marginal_at_best():
    assert [rating_of(n, excess_glare=True) for n in (0, 30, 30.1)] == ["Marginal", "Marginal", "Poor"]


@pytest.mark.parametrize("old, new, said", [
    ('"low"', '"fog"', "beam is low or high"), ('"straight"', '"bent"', "approach 'bent'"), ("= 100", "= nan", "not finite"),
    ("= 100", "= 251", "beyond the 250 m"), ("[60, 9]", "[121, 9]", "10 to 120 m"),
    ("[60, 9]", "[40, 9]", "do not grow"), ("= 0.5\n[[", "= -1\n[[", "below 0"), ("allowed_s = 0\n", "", "expected the keys"),
    ("01 = 0.5", "01 = 1.5", "0 to 1"), ("credit_share", "credit", "0 to 1"), ("sharp left", "straight", "straight stands there twice"),
    ("target_m = 50", "target_m = inf", "not finite"), ("target_m", "goal_m", "expected the keys"), ("[[glare]]", "[[glow]]", "nothing else"),
    ('"straight"', '["straight"]', "expected words"), ('"low"', "{ a = 1 }", "expected words"), ('"right"', "3", "expected words"),
])
def test_limits_that_cannot_be_used_are_refused(tmp_path, old, new, said):
    (tmp_path / "limits.toml").write_text(LIMITS.replace(old, new))
    with pytest.raises(phare.BadInput, match=said):
        read_limits(tmp_path / "limits.toml")


def test_a_rig_as_an_object_is_rated_as_its_file(rig):
    one, other = phare.rate_iihs(rig), phare.rate_iihs(phare.Rig.read(rig))
    assert one.visibility.equals(other.visibility) and one.glare.equals(other.glare)


def test_the_command_says_what_it_is_not(rig, tmp_path):
    environment = {**os.environ, "PYTHONPATH": str(Path(phare.__file__).parents[1])}

    def say(*words):
        return subprocess.run([sys.executable, "-m", "phare.rate", *words], env=environment, capture_output=True, text=True)

    said = say("iihs", "--rig", str(rig))
    assert said.returncode == 0 and said.stdout.rstrip().endswith("are not public") and "sharp left" in said.stdout
    assert "a good one reaches 99.1 m" in said.stdout and "unconfirmed" in said.stdout
    (tmp_path / "limits.toml").write_text(LIMITS)
    said = say("iihs", "--rig", str(rig), "--limits", str(tmp_path / "limits.toml"), "--high-beam-assist")
    assert said.returncode == 0 and "20.75 demerits" in said.stdout and "Marginal (bands unconfirmed" in said.stdout
    assert say("iihs", "--rig", str(tmp_path / "none.toml")).returncode == 2
    assert say("iihs", "--rig", str(rig), "--high-beam-assist").returncode == 2
    only_low = phare.Rig.read(rig)
    only_low.designs[0].lamps[0].sources.pop()
    missing = say("iihs", "--rig", str(only_low.write(tmp_path / "low.toml")))
    assert missing.returncode == 2 and "design even has no high beam" in missing.stderr


def test_a_full_disk_is_told_in_one_line(rig):
    environment = {**os.environ, "PYTHONPATH": str(Path(phare.__file__).parents[1])}
    for words in (["iihs", "--rig", str(rig)], ["--help"]):
        with open("/dev/full", "w") as full:
            ran = subprocess.run([sys.executable, "-m", "phare.rate", *words], env=environment, stdout=full, stderr=subprocess.PIPE, text=True)
        assert ran.returncode == 2 and ran.stderr == "phare: standard output: cannot be written: No space left on device\n"


@pytest.mark.parametrize("words, said", [
    (["iihs", "--page", "x.html"], "--page: is of adb, and iihs is asked for"), (["iihs", "--delay", "0"], "--delay: is of adb"),
    (["adb", "--high-beam-assist"], "--high-beam-assist: is of iihs"), (["adb", "--speed", "9"], "unrecognized arguments: --speed"),
    (["adb", "--page", "LAMP"], "it would be overwritten"),
])
def test_words_that_mean_nothing_are_refused_in_one_line(rig, words, said):
    lamp = phare.Rig.read(rig).designs[0].lamps[0].sources[0].file
    words = [lamp if word == "LAMP" else word for word in words]
    before = Path(lamp).read_bytes()
    ran = subprocess.run(
        [sys.executable, "-m", "phare.rate", *words, "--rig", str(rig)], capture_output=True, text=True,
        env={**os.environ, "PYTHONPATH": str(Path(phare.__file__).parents[1])},
    )
    assert ran.returncode == 2 and said in ran.stderr and ran.stderr.startswith("phare rate: ") and ran.stderr.count("\n") == 1
    assert Path(lamp).read_bytes() == before
