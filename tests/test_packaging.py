"""What a user gets from the wheel."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
NEEDED = (
    "paintlink/intake/profiles/paintlink_csv.toml",
    "paintlink/py.typed",
    "paintlink/spec/color-specification-1.xsd",
    "paintlink/export/formats/colornet.xslt",
    "paintlink/export/formats/colornet.xsd",
    "paintlink/color/data/weights.csv",
)
USE = """
import sys
sys.path.insert(0, sys.argv[1])
import paintlink
assert paintlink.__file__.startswith(sys.argv[1]), paintlink.__file__
from paintlink.color import weights
from paintlink.export import load_formats
from paintlink.library import bundled
from paintlink.preview import light_names, object_names
from paintlink.spec import schema_path
assert schema_path().exists()
print(len(bundled()), sorted(load_formats()), len(weights("D65", "10", 10)))
assert "panel" in object_names() and "studio" in light_names()
"""


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    command = [sys.executable, "-m", "build", "--wheel", "--no-isolation"]
    subprocess.run(
        [*command, "--outdir", str(folder), str(ROOT)], check=True, capture_output=True
    )
    return next(folder.glob("*.whl"))


def test_wheel_has_exactly_three_import_packages(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        top = {name.split("/")[0] for name in archive.namelist()}

    packages = {name for name in top if not name.startswith("paintlink-")}
    assert packages == {"paintlink", "paintlink_drivers", "paintlink_simulators"}


def test_wheel_carries_data_and_service_files(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()

    assert set(NEEDED) <= set(names)
    assert any(name.endswith("share/paintlink/config/paintlink.toml") for name in names)
    assert any(name.endswith("paintlink/systemd/paintlink.service") for name in names)
    assert not [name for name in names if "__pycache__" in name or "/tests/" in name]


def test_unpacked_wheel_works_away_from_checkout(wheel: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(tmp_path)

    done = subprocess.run(
        [sys.executable, "-I", "-c", USE, str(tmp_path)],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
    )

    assert done.returncode == 0, done.stderr
    assert done.stdout.startswith("6000 ['colornet', 'csv', 'cxf3', 'json'] 31")
