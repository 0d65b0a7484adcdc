"""What ctest runs: pytest over the package, or one line and exit code 77 where a package for it is missing."""

import importlib.util
import os
import sys
from pathlib import Path

PACKAGES = {
    "numpy": "python3-numpy", "pandas": "python3-pandas", "google.protobuf": "python3-protobuf", "pytest": "python3-pytest",
    "scipy": "python3-scipy",
}


def there(module: str) -> bool:
    try:
        return importlib.util.find_spec(module) is not None
    except ModuleNotFoundError:
        return False


def main() -> int:
    missing = [package for module, package in PACKAGES.items() if not there(module)]
    if missing:
        print(f"skipped: the tests of the Python package need: apt-get install {' '.join(missing)}")
        return 77
    import pytest

    if len(sys.argv) > 1:
        os.environ["PHARE_BIN"] = sys.argv[1]
    sys.dont_write_bytecode = True
    here = Path(__file__).resolve().parent
    return int(pytest.main(["-q", "-rs", "-p", "no:cacheprovider", "--durations=5", "--rootdir", str(here.parent), str(here)]))


if __name__ == "__main__":
    sys.exit(main())
