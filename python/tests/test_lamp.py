"""process: photometry through the bench, against what the files say."""

import numpy as np
import pytest

import phare


@pytest.fixture(scope="module")
def lamp(examples):
    return phare.Lamp.read(examples / "low_beam.ies")


def test_the_peak_is_where_the_table_has_it(lamp):
    table = lamp.table()
    row, column = np.unravel_index(table.intensity_cd.argmax(), table.intensity_cd.shape)
    assert (table.h_deg[column], table.v_deg[row]) == lamp.peak_deg
    assert table.intensity_cd.max() == lamp.peak_cd


def test_intensity_keeps_the_shape_and_is_the_table_at_its_nodes(lamp):
    table = lamp.table()
    h, v = np.meshgrid(table.h_deg[10:14], table.v_deg[20:25])
    cd = lamp.intensity(h, v)
    assert cd.shape == (5, 4)
    # The CSV of the table is written with digits enough for 1e-12 of the peak (phare lamp convert tells 7e-15).
    np.testing.assert_allclose(cd, table.intensity_cd[20:25, 10:14], rtol=0, atol=1e-9 * lamp.peak_cd)
    assert lamp.intensity(89.0, 89.0).shape == ()
    assert lamp.intensity([], []).shape == (0,)


def test_intensity_refuses_what_is_no_direction(lamp):
    with pytest.raises(phare.BadInput, match="not finite"):
        lamp.intensity([0.0, float("nan")], 0.0)


def test_an_eulumdat_file_gives_the_same_beam(lamp, tmp_path):
    phare.programs.run(["lamp", "convert", lamp.file, "--out", tmp_path / "low.ldt", "--out-axis", "gamma90"])
    other = phare.Lamp.read(tmp_path / "low.ldt", axis="gamma90")
    assert other.info["format"] == "EULUMDAT"
    # EULUMDAT holds candela per 1000 lm with few digits: 1e-3 of the peak is what phare lamp convert promises of it.
    assert np.abs(other.table().intensity_cd.max() - lamp.peak_cd) < 1e-3 * lamp.peak_cd


def test_mirror_turns_left_and_right_round(lamp):
    mirrored = phare.Lamp.read(lamp.file, mirror=True)
    assert mirrored.intensity(-3.0, -0.6) == lamp.intensity(3.0, -0.6)


def test_a_rulebook_judges(lamp):
    verdict = lamp.check("r112-passing-b")
    assert verdict.passed and verdict.failed == 0 and len(verdict.rows) > 10
    assert not lamp.check("r112-driving-b").passed


def test_compare_and_hspr(lamp, examples):
    led = phare.Lamp.read(examples / "led_low_beam.ies")
    both = lamp.compare(led)
    assert both.flux_a_lm == lamp.flux_lm and both.flux_b_lm == led.flux_lm
    assert {"name", "a_cd", "b_cd"} <= set(both.points.columns)
    assert lamp.compare(lamp).mean_absolute_difference_cd == 0
    rated = lamp.hspr()
    assert rated.rating == rated.raw["class"] and rated.points > 0 and len(rated.rows) > 5


def test_each_lamp_is_asked_for_as_it_was_read(lamp, tmp_path):
    mirrored = phare.Lamp.read(lamp.file, mirror=True)
    by_command = phare.programs.run_json(["lamp", "compare", lamp.file, lamp.file, "--mirror-b", "--no-align"])
    for one, other in ((lamp, mirrored), (mirrored, lamp)):
        both = one.compare(other, align=False)
        assert both.raw["a"] == both.raw["b"] == str(lamp.file)
        # LM-63 keeps the candela to 1e-14 of the peak.
        assert both.correlation == pytest.approx(by_command["correlation"], abs=1e-9) and both.correlation < 0.95
        assert both.mean_absolute_difference_cd == pytest.approx(by_command["mean_absolute_difference_cd"], rel=1e-9)
    assert mirrored.compare(mirrored).mean_absolute_difference_cd == 0
    with pytest.raises(phare.BadInput, match="^low_beam.ies: is for left-hand traffic"):
        lamp.hspr(mirrored)
    turned, plain = tmp_path / "turned.ldt", tmp_path / "plain.ldt"
    phare.programs.run(["lamp", "convert", lamp.file, "--out", turned, "--out-axis", "gamma90"])
    phare.programs.run(["lamp", "convert", lamp.file, "--out", plain])
    turned = phare.Lamp.read(turned, axis="gamma90")
    assert lamp.compare(turned).correlation > 0.9999 < turned.compare(lamp).correlation
    with pytest.raises(phare.BadInput, match="no pair"):
        lamp.check("r123-passing-c", right=mirrored)
    alike = [one.check("r123-passing-c", right=other) for one, other in ((lamp, lamp.file), (lamp, turned), (turned, lamp))]
    assert len({verdict.failed for verdict in alike}) == 1
    with pytest.raises(phare.BadInput, match="plain.ldt with gamma0: .* different axes"):
        turned.compare(plain)


def test_lamps_may_be_files_and_nonsense_is_refused(lamp, examples):
    assert lamp.compare(lamp.file).correlation == 1.0
    assert lamp.hspr(high=[examples / "high_beam.ies"] * 2).raw["score"] == lamp.hspr(lamp.file, high=(str(examples / "high_beam.ies"),) * 2).raw["score"]
    with pytest.raises(phare.BadInput, match="high is two lamps"):
        lamp.hspr(high=(lamp,))
    for h, v in (([1, 2], [1, 2, 3]), ("a", 0)):
        with pytest.raises(phare.BadInput, match="intensity: "):
            lamp.intensity(h, v)


def test_a_bad_file_says_place_and_reason(tmp_path):
    bad = tmp_path / "bad.ies"
    bad.write_text("IESNA:LM-63-2002\nTILT=NONE\n1 -1\n")
    with pytest.raises(phare.BadInput, match=r"bad\.ies:\d+: "):
        phare.Lamp.read(bad)
    with pytest.raises(phare.BadInput, match="No such file"):
        phare.Lamp.read(tmp_path / "none.ies")
