"""phare rate iihs: the tables of phare.rate_iihs in words."""

from __future__ import annotations

import argparse
import sys

from .command_line import leave
from .errors import BadInput, PhareError
from .rating import GOOD_M, POOR_M, UNOFFICIAL, Iihs, rate_iihs


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


def main() -> int:
    """phare rate iihs. Exit codes: 0 done, 1 failed, 2 bad input."""
    parser = argparse.ArgumentParser(
        prog="phare rate", description=f"The drive test of the IIHS as far as it is public; {UNOFFICIAL}.",
        epilog="Example:\n  phare rate iihs --rig config/rigs/country_road.toml", formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("test", choices=["iihs"])
    parser.add_argument("--rig", required=True, help="rig file")
    parser.add_argument("--design", help="design of it [its first]")
    parser.add_argument("--limits", help="TOML with targets and a glare curve of your own (docs/python.md)")
    parser.add_argument("--high-beam-assist", action="store_true", help="the car has it: credited by [assist] of the limits")
    options = parser.parse_args()
    try:
        done = rate_iihs(options.rig, design=options.design, limits=options.limits, assist=options.high_beam_assist)
    except PhareError as wrong:
        print(f"phare rate: {wrong}", file=sys.stderr)
        return 2 if isinstance(wrong, BadInput) else 1
    print(_words(done, options.limits))
    print(UNOFFICIAL)
    return 0


if __name__ == "__main__":
    leave(main)
