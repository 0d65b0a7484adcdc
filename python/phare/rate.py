"""phare rate: the tables of phare.rate_iihs and of phare.track_tests in words."""

from __future__ import annotations

import argparse
import math
import os
import sys

from .command_line import Parser, leave
from .control.sensors import Sensors
from .errors import BadInput, PhareError
from .rating import GOOD_M, POOR_M, UNOFFICIAL, Iihs, rate_iihs
from .rig import Rig
from .sweep.job import law_named
from .tracks import track_tests


def _words(done: Iihs, limits: str | None) -> str:
    """The tables, each with how sure its rule is."""
    straight = done.visibility[(done.visibility.beam == "low") & (done.visibility.approach == "straight")]
    reach_m = float(straight[straight.edge == "right edge"].distance_m.iloc[0])
    words = [
        f"5 lx at 0.25 m, distance_m from the rear axle (right edge: one source; left edges: unconfirmed)\n{done.visibility.to_string(index=False)}",
        f"low beam, straight, right edge: {reach_m:.1f} m; a good one reaches {GOOD_M:.1f} m, a poor one {POOR_M:.1f} m or less "
        "(two sources; where the car's zero is they do not say)",
        f"low beam, most lux over the oncoming lane, 10 to 120 m (unconfirmed)\n{done.glare.max().round(3).to_string()}",
    ]
    if done.above is not None and done.demerits is not None:
        words += [f"above the glare curves of {limits} (speeds: one source)\n{done.above.to_string(index=False)}"] if len(done.above) else []
        words += [f"{done.demerits.to_string(index=False)}\n{done.total:g} demerits by {limits}: {done.rating} (bands unconfirmed; with excess "
                  "glare Marginal at best: one source, of 2016)"]
    return "\n\n".join(words) + "\n"


def _stays(file: str, page: str | None) -> None:
    """A page is not written over what it is made from."""
    if page and os.path.exists(page) and os.path.exists(file) and os.path.samefile(page, file):
        raise BadInput(f"{page}: is the input {file}; it would be overwritten")


def _adb(options: argparse.Namespace) -> tuple[str, int]:
    """The eight tracks, and the page where it is asked for; the exit code: 1 where something is above its limit."""
    options.law, options.delay = options.law or "GlareFree", options.delay or 0.0
    for flag, value in (("--delay", options.delay), ("--red-range", options.red_range)):
        if value is not None and not (math.isfinite(value) and value >= 0.0):
            raise BadInput(f"{flag} {value:g}: 0 or more")
    _stays(options.rig, options.page)
    read = Rig.read(options.rig)
    for file in (*read.files(), options.law):
        _stays(file, options.page)
    seen_m = Sensors().range_m | ({"red": options.red_range} if options.red_range is not None else {})
    law_named(options.law)  # told before anything is computed
    done = track_tests(
        read, lambda: law_named(options.law), sensors=Sensors(delay_s=options.delay, range_m=seen_m), design=options.design
    )
    if options.page:
        done.write_page(options.page, f"{options.law}, camera {options.delay:g} s late")
    text = (
        f"FMVSS 108 S9.4.1.6, lux by range (limits: one source; receptors and the fixture's place: by eye)\n{done.rows.round(1).to_string(index=False)}\n\n"
        f"{done.failed} of {len(done.rows)} above the limit, for {done.above_s:.2f} s of {done.measured_s:.2f} s\n\n"
        "compares laws and lamps; approves none"
    )
    return text, int(done.failed > 0)


def main() -> int:
    """phare rate. Exit codes: 0 done, 1 failed, or the law is above a limit, 2 bad input."""
    parser = Parser(
        prog="phare rate", description=f"iihs: the drive test of the IIHS as far as it is public; {UNOFFICIAL}. adb: a control law on the track "
        "tests of FMVSS 108 for adaptive beams.",
        epilog="Examples:\n  phare rate iihs --rig config/rigs/country_road.toml\n"
        "  phare rate adb --rig config/rigs/matrix.toml --law GlareFree --page out/tracks.html",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("test", choices=["iihs", "adb"])
    parser.add_argument("--rig", required=True, help="rig file")
    parser.add_argument("--design", help="design of it [its first]")
    iihs, adb = parser.add_argument_group("iihs"), parser.add_argument_group("adb")
    of_one_test = {
        "iihs": [
            iihs.add_argument("--limits", help="TOML with targets and a glare curve of your own (docs/python.md)"),
            iihs.add_argument("--high-beam-assist", action="store_true", help="the car has it: credited by [assist] of the limits"),
        ],
        "adb": [
            adb.add_argument("--law", help="class of phare.laws, module:Class, or an FMU [GlareFree]"),
            adb.add_argument("--delay", type=float, metavar="S", help="how late the camera is, s [0]"),
            adb.add_argument("--red-range", type=float, metavar="M", help="from where the camera sees rear lamps, m [100]"),
            adb.add_argument("--page", help="HTML file with lux over range on each track"),
        ],
    }
    options = parser.parse_args()
    for other, actions in of_one_test.items():
        for action in actions:
            given = getattr(options, action.dest)
            if other != options.test and given is not None and given is not False:
                parser.error(f"{action.option_strings[0]}: is of {other}, and {options.test} is asked for")
    try:
        if options.test == "adb":
            text, code = _adb(options)
            print(text)
            return code
        done = rate_iihs(options.rig, design=options.design, limits=options.limits, assist=options.high_beam_assist)
    except PhareError as wrong:
        print(f"phare rate: {wrong}", file=sys.stderr)
        return 2 if isinstance(wrong, BadInput) else 1
    except OSError as wrong:
        print(f"phare rate: {wrong.filename}: {wrong.strerror}", file=sys.stderr)
        return 2
    print(_words(done, options.limits))
    print(UNOFFICIAL)
    return 0


if __name__ == "__main__":
    leave(main)
