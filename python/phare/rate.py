"""phare rate iihs: the tables of phare.rate_iihs in words."""

from __future__ import annotations

import argparse
import sys

from .errors import BadInput, PhareError
from .rating import UNOFFICIAL, rate_iihs


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
    options = parser.parse_args()
    try:
        done = rate_iihs(options.rig, design=options.design, limits=options.limits)
    except PhareError as wrong:
        print(f"phare rate: {wrong}", file=sys.stderr)
        return 2 if isinstance(wrong, BadInput) else 1
    print(done.visibility.to_string(index=False))
    print(f"\nlow beam, most lux over the oncoming lane, 10 to 120 m (unconfirmed):\n{done.glare.max().round(3).to_string()}\n")
    if done.demerits is not None:
        print(f"{done.demerits.to_string(index=False)}\n{done.total:g} demerits by {options.limits}: {done.rating} (bands unconfirmed)")
    print(UNOFFICIAL)
    return 0


if __name__ == "__main__":
    sys.exit(main())
