"""An FMU as a law from the command line: as a law program on standard input and output, or with a drive of its own.

    python3 -m phare.laws.fmu unit.fmu --list
    python3 -m phare.laws.fmu unit.fmu --out out/mine --traffic traffic.toml -- --frames 60
    phare.Program(["python3", "-m", "phare.laws.fmu", "unit.fmu"])
"""

from __future__ import annotations

import math
import sys

from ..command_line import Parser, leave
from ..control.fmu import Fmu
from ..control.sensors import Sensors
from ..control.serve import serve
from ..drive import drive
from ..errors import BadInput, LawFailed, PhareError


def main() -> int:
    """Exit codes: 0 done, 1 the drive failed, 2 bad input, or a unit that cannot be followed."""
    parser = Parser(
        prog="python3 -m phare.laws.fmu", description="An FMI 3.0 co-simulation unit is the control law (docs/fmu-law.md). Without --out "
        "it reads LawInput and writes LawAnswer, as phare.Program wants it.",
    )
    parser.add_argument("unit", help="the .fmu file")
    parser.add_argument("--list", action="store_true", help="print which of its variables are known, and end")
    parser.add_argument("--out", help="drive with it in lockstep, into this folder")
    parser.add_argument("--rig", help="rig file of that drive [the demo]")
    parser.add_argument("--traffic", help="road users that the camera sees, and the picture shows (TOML)")
    parser.add_argument("--delay-s", type=float, help="of the camera [0]")
    parser.usage = "%(prog)s [options] unit.fmu [-- further words for phare drive, --port-base among them]"
    words, more = _parted(sys.argv[1:])
    options = parser.parse_args(words)
    of_a_drive = {"--rig": options.rig, "--traffic": options.traffic, "--delay-s": options.delay_s, "--": more or None}
    for flag, value in of_a_drive.items():
        if value is not None and (options.out is None or options.list):
            parser.error(f"{flag}: is of a drive, which --out asks for")
    if options.delay_s is not None and not (math.isfinite(options.delay_s) and options.delay_s >= 0.0):
        parser.error(f"--delay-s: {options.delay_s:g} is not 0 or more")
    try:
        law = Fmu(options.unit)
        if options.list:
            return _list(law)
        if options.out is None:
            serve(law)
            return 0
        sensors = Sensors(options.traffic or (), delay_s=options.delay_s or 0.0)
        driven = drive(options.rig, traffic=options.traffic, out=options.out, controller=law, sensors=sensors, more=more)
        print(f"{driven.folder}: {int(driven.figures['frames'])} frames, pictures {driven.picture_hash}")
        return 0
    except (BadInput, LawFailed) as wrong:
        print(f"phare.laws.fmu: {wrong}", file=sys.stderr)
        return 2
    except PhareError as wrong:
        print(f"phare.laws.fmu: {wrong}", file=sys.stderr)
        return 1


def _parted(words: list[str]) -> tuple[list[str], list[str]]:
    """Before and behind the first --."""
    at = words.index("--") if "--" in words else len(words)
    return words[:at], words[at + 1 :]


def _list(law: Fmu) -> int:
    for kind, variables in (("input", law.inputs), ("output", law.outputs)):
        for variable in variables:
            print(f"{kind:<7} {variable.name}" + (f" ({variable.size})" if variable.is_array else ""))
    for name in law.unknown:
        print(f"not known here: {name}")
    return 0


if __name__ == "__main__":
    leave(main)
