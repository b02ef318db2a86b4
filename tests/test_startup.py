"""What starting the program costs: the modules it loads."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from paintlink.spec import write_spec
from tests.daemon.conftest import make_spec

HEAVY = (
    "colour",
    "scipy",
    "moderngl",
    "fastapi",
    "matplotlib",
    "PIL",
    "serial",
    "pydantic",
)
PROBE = """
import sys
sys.argv = ["paintlink", *sys.argv[1:]]
from paintlink.cli import main
try:
    main()
except SystemExit as end:
    code = end.code
print("LOADED", code, *sorted(name for name in sys.modules if "." not in name))
"""


def loaded(*arguments: str) -> tuple[str, set[str]]:
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", PROBE, *arguments],
        capture_output=True,
        text=True,
        check=True,
    )
    code, *names = done.stdout.rsplit("LOADED", 1)[1].split()
    return code, set(names)


def test_help_loads_nothing_heavy() -> None:
    code, names = loaded("--help")

    assert code == "0"
    assert not names & {*HEAVY, "numpy", "lxml", "rich"}


def test_snap_loads_nothing_it_does_not_need(tmp_path: Path) -> None:
    spec = tmp_path / "spec.xml"
    spec.write_bytes(write_spec(make_spec()))

    code, names = loaded("snap", str(spec), "--json")

    assert code == "0"
    assert "numpy" in names
    assert not names & {*HEAVY, "sqlite3", "logging", "rich"}


@pytest.mark.parametrize("package", ["paintlink_drivers", "paintlink_simulators"])
def test_drivers_and_simulators_start_light(package: str) -> None:
    probe = (
        "import sys, importlib, pkgutil\n"
        f"import {package} as p\n"
        "for m in pkgutil.iter_modules(p.__path__):\n"
        "    if m.name != '__main__':\n"
        "        importlib.import_module(p.__name__ + '.' + m.name)\n"
        "print(*sys.modules)"
    )
    done = subprocess.run(
        [sys.executable, "-c", probe], capture_output=True, text=True, check=True
    )

    assert not set(done.stdout.split()) & {"serial", "usb", "colour", "scipy", "PIL"}
