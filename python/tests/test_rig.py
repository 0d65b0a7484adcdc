"""unit: rigs as objects, held against the programs' reader."""

import copy
import math
import tomllib

import numpy as np
import pytest

import phare
from phare import toml_out


@pytest.mark.parametrize("name", ["country_road", "matrix"])
def test_a_shipped_rig_is_written_as_it_was_read(name, tmp_path):
    rig = phare.Rig.shipped(name)
    again = phare.Rig.read(rig.write(tmp_path / "again.toml"))
    assert again == rig
    assert again.problems() == []


def test_keys_the_class_does_not_name_stay(tmp_path):
    rig = phare.Rig.shipped()
    rig.more["keep_design"] = True
    rig.designs[0].lamps[0].sources[0].more["mirror"] = True
    again = phare.Rig.read(rig.write(tmp_path / "again.toml"))
    assert again.more["keep_design"] is True
    assert again.designs[0].lamps[0].sources[0].more == {"mirror": True}
    assert again.more["bus"]["port_base"] == 47000


def test_a_pair_is_two_lamps_by_name():
    assert phare.Rig.shipped("matrix").design("matrix").lamp_names() == ["headlamp left", "headlamp right"]
    with pytest.raises(phare.BadInput, match="the rig has matrix"):
        phare.Rig.shipped("matrix").design("laser")


def test_what_is_wrong_with_a_rig_is_said_by_the_program():
    rig = copy.deepcopy(phare.Rig.shipped())
    rig.designs[0].lamps[0].sources[0].file = "/nowhere/lamp.ies"
    problems = rig.problems()
    assert len(problems) == 1 and "/nowhere/lamp.ies" in problems[0]


def test_a_file_that_is_no_rig_is_refused_with_its_name(tmp_path):
    for text, why in (("scene = ", "Invalid value"), ("scene = 'a'\n", "missing"), ("scene = 3\n", "another kind")):
        (tmp_path / "bad.toml").write_text(text)
        with pytest.raises(phare.BadInput, match=f"bad.toml: .*{why}"):
            phare.Rig.read(tmp_path / "bad.toml")
    with pytest.raises(phare.BadInput, match="No such file"):
        phare.Rig.read(tmp_path / "none.toml")


def test_toml_keeps_every_kind_of_value():
    document = {
        "word": 'quote " back \\ line\n é \x7f', "whole": -3, "share": 1e-30, "flag": False, "list": [1.5, [2]], "empty": [],
        "a key": {"inner": {"deep": 1}}, "rows": [{"x": 1, "more": [{"y": 2}]}, {"x": 2}], "mixed": [[{"z": 1}]],
    }
    assert tomllib.loads(toml_out.dumps(document)) == document
    assert toml_out.dumps({"none": None}) == ""
    with pytest.raises(phare.BadInput):
        toml_out.dumps({"bad": float("nan")})


def test_the_road_users_of_a_rig_are_found_from_elsewhere(tmp_path):
    (tmp_path / "far").mkdir()
    (tmp_path / "far" / "others.toml").write_text('[[road_user]]\nclass = "car"\ndirection = "oncoming"\nstart_s_m = 300\nspeed_kmh = 50\n')
    rig = phare.Rig.shipped()
    rig.more["traffic"] = "others.toml"
    rig.write(tmp_path / "far" / "rig.toml")
    again = phare.Rig.read(tmp_path / "far" / "rig.toml")
    assert again.more["traffic"] == str(tmp_path / "far" / "others.toml")
    assert phare.Rig.read(again.write(tmp_path / "rig.toml")).problems() == []


def test_street_lamps_of_a_rig_are_found_from_elsewhere(tmp_path):
    (tmp_path / "far").mkdir()
    lamps = tmp_path / "far" / "lamps.toml"
    lamps.write_bytes(phare.generated_file("scenes/town_lamps.toml").read_bytes())
    rig = phare.Rig.shipped("town")
    rig.more["street_lamps"] = "lamps.toml"
    rig.write(tmp_path / "far" / "rig.toml")
    again = phare.Rig.read(tmp_path / "far" / "rig.toml")
    assert again.more["street_lamps"] == str(lamps) and str(lamps) in again.files()
    assert not [problem for problem in again.problems() if "no such file" in problem]


def test_a_byte_order_mark_is_read_over_as_by_the_programs(tmp_path):
    (tmp_path / "bom.toml").write_bytes(b"\xef\xbb\xbf" + phare.shipped_file("rigs/matrix.toml").read_bytes())
    assert phare.Rig.read(tmp_path / "bom.toml").name == phare.Rig.shipped("matrix").name


def test_numbers_of_numpy_are_numbers(tmp_path):
    rig, plain = phare.Rig.shipped(), phare.Rig.shipped()
    rig.designs[0].lamps[0].position_m = np.array([3.5, 0.625, 0.75])
    rig.designs[0].lamps[0].sources[0].scale = np.float32(0.5)
    plain.designs[0].lamps[0].position_m, plain.designs[0].lamps[0].sources[0].scale = [3.5, 0.625, 0.75], 0.5
    assert phare.Rig.read(rig.write(tmp_path / "rig.toml")) == plain
    assert toml_out.dumps({"a": np.int64(3), "b": np.bool_(True), "c": np.array([[1, 2]])}) == "a = 3\nb = true\nc = [[1, 2]]\n"


def test_a_matrix_in_one_file_is_a_source_for_each_segment(tmp_path):
    """TM-33 with three emitters of 4 degrees side by side: seen by a law one by one, and the light of all."""
    def emitter(left):
        data = "".join(f'<IntensityData horz="{h}" vert="{v}">{1000 * (left + 7)}</IntensityData>' for h in (left, left + 4) for v in (-5, 5))
        return f"<Emitter><LuminousData><PhotometryType>CIE-A</PhotometryType><SymmType>Symm_None</SymmType>{data}</LuminousData></Emitter>"

    matrix = tmp_path / "matrix.xml"
    matrix.write_text('<?xml version="1.0"?>\n<t:IESTM33-22 xmlns:t="http://www.ies.org/tm-33"><Version>1.1</Version>'
                      + "".join(map(emitter, (-6, -2, 2))) + "</t:IESTM33-22>\n")
    rig = phare.Rig.shipped("matrix")
    head = rig.designs[0].lamps[0]
    head.sources = [head.sources[0], phare.Source("high", str(matrix), pitch_deg=-0.5, more={"emitters": 3})]
    file = rig.write(tmp_path / "rig.toml")
    read = phare.Rig.read(file)
    assert read.problems() == []
    assert [source.more.get("emitter") for source in read.designs[0].lamps[0].sources] == [None, 1, 2, 3]
    (left, right) = phare.control.lamps.lamps_of(read.designs[0])
    degrees = [(round(math.degrees(s.h_from_rad), 9), round(math.degrees(s.h_to_rad), 9), s.peak_cd) for s in left.sources[1:]]
    assert degrees == [(-6, -2, 1000), (-2, 2, 5000), (2, 6, 9000)] and len(right.sources) == 4
    at = [[50.0, y, 0.66, -1.0, 0.0, 0.0] for y in (4.0, 0.0, -4.0)]
    each = [f"{matrix},x=3.45,y={y},z=0.66,pitch_deg=-0.5,emitter={number}" for y in (0.62, -0.62) for number in (1, 2, 3)]
    one_file = phare.measure(file, at, beams="high", reference=True)
    assert one_file == pytest.approx(phare.measure(each, at, reference=True), rel=1e-12)
    read.designs[0].lamps[0].sources[1].more["emitter"] = 4
    assert "emitter 4 was asked for, the file has 3" in read.problems()[0]
