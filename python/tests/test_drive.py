"""process: drives through the programs, and what is read of them."""

import random
import shutil
import subprocess
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

import phare
from phare import drive_file, wire
from phare import phare_pb2 as pb

from conftest import SMALL


def test_the_report_has_figures_pictures_and_the_course_of_the_car(report):
    assert report.exit_code == 0
    assert report.figures["frames"] == 4
    frames = report.frames()
    assert frames.shape == (4, 90, 160, 3) and frames.dtype == np.uint8 and 0 < frames.mean() < 255
    np.testing.assert_array_equal(frames[-1], report.frame(-1))
    # The car at frame k of 60 a second, and the pictures of them.
    np.testing.assert_allclose(report.car.index, np.arange(4) / 60, atol=1e-9)
    assert len(report.controls) == 4  # though the processes may have begun the next
    assert (report.car.speed_mps.diff().dropna() >= 0).all()  # it starts to drive
    assert report.controls.light_switch.iloc[0] == 2
    assert report.pictures.frame_index.max() == 3
    with pytest.raises(phare.BadInput, match="4 pictures, no number 7"):
        report.frame(7)


def test_the_same_drive_has_the_same_pictures(report, tmp_path):
    again = phare.drive(phare.Rig.shipped(), frames=4, out=tmp_path / "out", record=False, **SMALL)
    assert again.picture_hash == report.picture_hash
    with pytest.raises(phare.BadInput, match="not recorded"):
        again.car
    assert phare.Report(tmp_path / "out").picture_hash == report.picture_hash


def test_other_road_users_are_drawn_and_their_glare_is_told(report, tmp_path):
    file = tmp_path / "traffic.toml"
    file.write_text("[[road_user]]\nstart_s_m = 70\noffset_m = 3.4\n")
    met = phare.drive(phare.Rig.shipped(), traffic=file, frames=4, out=tmp_path / "out", record=False, **SMALL)
    assert met.picture_hash != report.picture_hash
    rows = pd.read_csv(met.folder / "drive.csv")
    assert (rows.veil_cdm2 > 0).all() and (rows.others_eye_lx > 0).all() and rows.de_boer.between(1, 9).all()
    assert (rows.others_veil_cdm2 > 0).all() and rows.others_de_boer.between(1, 9).all()
    np.testing.assert_allclose(rows.others_threshold_increment_percent, 65 * rows.others_veil_cdm2, rtol=5e-4)  # four digits, adapted to 1 cd/m²
    assert "glare_lx" not in pd.read_csv(report.folder / "drive.csv").columns
    with pytest.raises(phare.BadInput, match="road_user"):
        file.write_text("[[car]]\n")
        phare.drive(traffic=file, frames=1, out=tmp_path / "bad")


def test_a_folder_that_holds_a_drive_is_not_written_over(report):
    with pytest.raises(phare.BadInput, match="holds a drive; overwrite=True"):
        phare.drive(frames=1, out=report.folder)


def contents(folder: Path) -> dict[str, bytes]:
    return {file.name: file.read_bytes() for file in folder.iterdir() if file.is_file()}


def test_a_drive_in_the_place_of_another_has_nothing_of_it(tmp_path):
    class Straight(phare.Controller):
        def step(self, given):
            return phare.Answer()

    words = dict(out=tmp_path / "out", frames=2, overwrite=True, **SMALL)
    first = phare.drive(phare.Rig.shipped(), controller=Straight(), **words)
    assert len(first.law_steps) == len(first.car) == 2
    second = phare.drive(record=False, **words)
    for table in ("car", "law_steps"):
        with pytest.raises(phare.BadInput, match="was not recorded|no control law led"):
            getattr(second, table)
    assert not {"drive.pcap", "law.csv", "driven.toml"} & {file.name for file in second.folder.iterdir()}
    assert not second.led_by_law
    # By the command line it is this package that does not know what goes.
    third = phare.drive(controller=Straight(), **words)
    phare.programs.run(["drive", "--headless", "--lockstep", "--overwrite", "--frames", "1", "--size", "64x36", "--out", third.folder])
    for table in ("car", "law_steps"):
        with pytest.raises(phare.BadInput, match="was not recorded|no control law led"):
            getattr(phare.Report(third.folder), table)


def test_a_drive_that_cannot_begin_leaves_the_other_as_it_is(tmp_path):
    words = dict(out=tmp_path / "out", frames=1, overwrite=True, **SMALL)
    kept = phare.drive(phare.Rig.shipped(), **words)
    before = contents(kept.folder)
    for wrong in ({"settings": {"nope": 1}}, {"drive": tmp_path / "none.pcap"}, {"level": "none"}, {"controller": phare.laws.GlareFree},
                  {"controller": phare.laws.GlareFree(), "traffic": tmp_path / "none.toml"}):
        with pytest.raises(phare.BadInput):
            phare.drive(phare.Rig.shipped("matrix"), **{**words, **wrong})
        assert contents(kept.folder) == before, wrong
    with pytest.raises(phare.BadInput):
        phare.drive(phare.Rig.shipped("matrix"), settings={"nope": 1}, out=tmp_path / "new")
    assert contents(tmp_path / "new") == {}
    again = phare.drive(kept.folder / "driven.toml", drive=kept.folder / "drive.pcap", record=False, **words)  # by files of its own
    assert {"driven.toml", "drive.pcap"} <= contents(again.folder).keys()


def test_the_port_may_stand_among_further_words(tmp_path):
    base = phare.free_ports()
    for more in (["--port-base", str(base)], [f"--port-base={base}"]):
        driven = phare.drive(frames=1, size=(64, 36), more=["--audit-every", "0", *more])
        assert driven.command.count("--port-base") == 1 and driven.command[driven.command.index("--port-base") + 1] == str(base)
    for wrong in (dict(more=["--port-base"]), dict(more=["--port-base", "x"]), dict(more=["--port-base", "47000"], port_base=48000)):
        with pytest.raises(phare.BadInput, match="port-base"):
            phare.drive(frames=1, **wrong)


def test_errors_are_the_programs_own_words(tmp_path):
    with pytest.raises(phare.BadInput, match="^/nowhere.toml: no such file$"):
        phare.drive("/nowhere.toml", frames=1, out=tmp_path)
    with pytest.raises(phare.BadInput, match="/nowhere.ies"):
        phare.drive(lamp="/nowhere.ies", frames=1, out=tmp_path)
    with pytest.raises(phare.NotFound, match="no program phare in it"):
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("PHARE_BIN", str(tmp_path))
            phare.drive(frames=1)
    with pytest.raises(phare.BadInput, match="nothing.*report.json"):
        phare.Report(tmp_path / "nothing")
    (tmp_path / "file").write_text("")
    drive = phare.poses([0, 1], x_m=0, y_m=0)
    for wrong in (lambda: phare.drive(out=tmp_path / "file"), lambda: phare.read_drive(tmp_path / "none.pcap"), lambda: phare.read_drive(tmp_path),
                  lambda: phare.write_drive(tmp_path / "none" / "x", drive), lambda: phare.Rig.shipped().write(tmp_path / "none" / "x")):
        with pytest.raises(phare.BadInput, match=f"^{tmp_path}.*: (File exists|No such file|Is a directory)"):
            wrong()


def test_a_drive_that_takes_too_long_is_ended(tmp_path):
    with pytest.raises(phare.Failed, match="not done after 0.5 s"):
        phare.drive(lockstep=False, out=tmp_path / "out", timeout_s=0.5, **SMALL)


def test_a_drive_file_is_written_as_it_was_read(report, tmp_path):
    file = tmp_path / "copy.pcap"
    phare.write_drive(file, report.drive.datagrams)
    again = phare.read_drive(file)
    assert again.datagrams == report.drive.datagrams and not again.cut and again.refused == 0
    assert again.duration_s == report.drive.duration_s


def test_a_drive_file_cut_anywhere_is_read_to_its_last_whole_record(report, tmp_path):
    file = tmp_path / "cut.pcap"
    phare.write_drive(file, report.drive.datagrams)
    data, whole = file.read_bytes(), len(report.drive.datagrams)
    generator = random.Random(5)
    for end in [24, len(data) - 1, *(generator.randrange(25, len(data)) for _ in range(20))]:
        file.write_bytes(data[:end])
        cut = phare.read_drive(file)
        assert len(cut.datagrams) < whole and cut.datagrams == report.drive.datagrams[: len(cut.datagrams)]
    file.write_bytes(data[:23])
    with pytest.raises(phare.BadInput, match="no pcap file"):
        phare.read_drive(file)
    flipped = bytearray(data)
    flipped[24 + 16 + 28 + 5] ^= 1  # within the first datagram: its check does not fit
    file.write_bytes(flipped)
    assert phare.read_drive(file).refused == 1


def test_a_drive_of_ones_own_is_replayed(tmp_path):
    t = np.arange(0, 0.2, 0.01)
    phare.write_drive(
        tmp_path / "own.pcap",
        phare.poses(t, x_m=30 + 20 * t, y_m=-1.75, speed_mps=20.0, light=["low"] * 5 + ["high"] * 15),
    )
    driven = phare.drive(drive=tmp_path / "own.pcap", out=tmp_path / "out", frames=8, **SMALL)
    car = driven.car
    np.testing.assert_allclose(car.x_m, 30 + 20 * car.index, atol=1e-6)  # poses are linear in time, so is what lies between
    assert set(driven.controls.light_switch) == {2, 3}


def test_poses_refuse_what_is_no_drive():
    for times in ([0.0], [0.0, 0.0], [-1.0, 1.0], [0.0, float("nan")]):
        with pytest.raises(phare.BadInput, match="time_s"):
            phare.poses(times, x_m=0, y_m=0)
    for times, why in (([[0, 1]], "one list"), ("abc", "time_s: "), ([0, 5e9], "a drive file ends")):
        with pytest.raises(phare.BadInput, match=why):
            phare.poses(times, x_m=0, y_m=0)
    for light in ("bright", None, [["low"], "low"]):
        with pytest.raises(phare.BadInput, match="light"):
            phare.poses([0, 1], x_m=0, y_m=0, light=light)
    with pytest.raises(phare.BadInput, match="start_id = -1"):
        phare.poses([0, 1], x_m=0, y_m=0, start_id=-1)
    for wrong in (float("nan"), [0.0, float("inf")], [0, 1, 2], "ahead"):
        with pytest.raises(phare.BadInput, match="poses: yaw_rad"):
            phare.poses([0, 1], x_m=0, y_m=0, yaw_rad=wrong)


def test_a_drive_file_refuses_what_it_cannot_hold(tmp_path):
    late = pb.Datagram(protocol_version=1, sender=pb.SENDER_DYNAMICS, sim_time_ns=5_000_000_000_000_000_000)
    for datagrams, more, why in (([late], {}, "behind 4294967295 s"), ([7], {}, "7 is no datagram"), ([], {"port_base": 70000}, "port_base = 70000")):
        with pytest.raises(phare.BadInput, match=why):
            phare.write_drive(tmp_path / "x.pcap", datagrams, **more)
    assert not list(tmp_path.iterdir())


def test_a_list_of_a_message_is_known_by_every_protobuf():
    """Releases up to 6 have `label`, 7 has is_repeated alone."""
    for is_list in (False, True):
        new, old = SimpleNamespace(is_repeated=is_list), SimpleNamespace(label=3 if is_list else 1, LABEL_REPEATED=3)
        assert drive_file._is_list(new) is drive_file._is_list(old) is is_list
    assert [of.name for of in pb.LawAnswer.DESCRIPTOR.fields if drive_file._is_list(of)] == ["lamps"]


def test_the_seal_is_that_of_the_programs():
    datagram = pb.Datagram(protocol_version=1, sender=pb.SENDER_LAW, start_id=7, sequence=1, law_answer=pb.LawAnswer())
    key = bytes(range(32))
    sealed = wire.seal(wire.encode(datagram), key)
    assert wire.decode(wire.unseal(sealed, key)) == datagram
    assert wire.unseal(sealed, bytes(32)) is None
    with pytest.raises(phare.BadInput, match="checksum"):
        wire.decode(wire.unseal(sealed, key)[:-1])


def test_the_messages_of_the_package_are_those_of_the_programs(tmp_path):
    proto = Path(__file__).resolve().parents[2] / "net" / "phare.proto"
    if not proto.exists() or not shutil.which("protoc"):
        pytest.skip("no net/phare.proto or no protoc here")
    subprocess.run(["protoc", f"-I{proto.parent}", f"--python_out={tmp_path}", str(proto)], check=True)
    assert Path(pb.__file__).read_text() == (tmp_path / "phare_pb2.py").read_text(), (
        "run: protoc -I net --python_out=python/phare net/phare.proto"
    )
