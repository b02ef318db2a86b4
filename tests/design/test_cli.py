"""The commands as a person calls them."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner, Result

from paintlink.cli import main
from paintlink.color import flop_index
from paintlink.design import read_design
from paintlink.library import bundled
from paintlink.spec import read_spec_file, write_spec
from tests.design.conftest import RED, make_spec

Call = Callable[..., Result]


@pytest.fixture
def call(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Call:
    """Call `paintlink design` in an empty folder."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))

    def go(*arguments: str) -> Result:
        return CliRunner().invoke(main, ["design", *arguments])

    return go


@pytest.fixture
def red(call: Call) -> Path:
    """A design on a red metallic, three angles."""
    Path("red.xml").write_bytes(write_spec(make_spec(RED, "red")))
    assert call("new", "red.json", "--spec", "red.xml").exit_code == 0
    return Path("red.json")


def test_design_is_made_step_by_step(call: Call, red: Path) -> None:
    call("apply", "red.json", "travel", "factor=0.5")
    done = call("apply", "red.json", "tint-flop", "color=10,5,-30", "amount=.5")

    assert done.exit_code == 0
    assert "2. tint-flop color=10,5,-30 amount=0.5 channels=Lab" in done.stdout
    assert [step.name for step in read_design(red).steps] == ["travel", "tint-flop"]


def test_undo_and_redo_change_the_file(call: Call, red: Path) -> None:
    call("apply", "red.json", "travel", "factor=0.5")
    call("apply", "red.json", "mirror")
    before = red.read_bytes()

    assert "undone: 2" in call("undo", "red.json", "2").stdout
    assert np.array_equal(read_design(red).spec.lab(), RED)
    call("redo", "red.json", "2")
    assert red.read_bytes() == before


def test_limited_step_says_how_far_it_went(call: Call, red: Path) -> None:
    done = call("apply", "red.json", "darken", "amount=40")

    assert "1. darken amount=40; limited to 21 %" in done.stdout


def test_show_prints_everything_as_json(call: Call, red: Path) -> None:
    call("apply", "red.json", "darken", "amount=40")

    document = json.loads(call("show", "red.json", "--json").stdout)

    assert document["steps"][0]["share"] == pytest.approx(0.21, abs=1e-4)
    assert document["spec"]["travel"]["flop_index"] == pytest.approx(
        flop_index(read_design(red).spec.lab())
    )
    assert document["nearest"]["code"] in bundled().codes


def test_what_no_paint_can_follow_is_told(call: Call, red: Path) -> None:
    done = call("apply", "red.json", "set-face", "L=110", "a=60", "b=-80")

    findings = json.loads(call("show", "red.json", "--json").stdout)["findings"]

    told = [one for one in findings if one["told"]]
    assert {one["kind"] for one in told} >= {"sparse", "off-radial"}
    assert all(one["value"] > one["limit"] for one in told)
    assert all(f"note: {one['sentence']}" in done.stdout for one in told)


def test_paint_of_the_library_is_a_start_and_a_goal(call: Call) -> None:
    first, second = bundled().codes[100], bundled().codes[900]

    done = call("new", "a.json", "--paint", first, "--angles", "5")
    assert first in done.stdout
    done = call("apply", "a.json", "towards", f"paint={second}", "amount=1")

    assert f"towards paint={second} amount=1" in done.stdout
    assert f"nearest: {second}" in done.stdout


def test_specification_file_is_a_goal(call: Call, red: Path) -> None:
    call("new", "grey.json", "--blank")

    call("apply", "grey.json", "towards", "paint=red.xml", "amount=1")

    assert np.array_equal(read_design(Path("grey.json")).spec.lab(), RED)


def test_export_is_a_specification_with_a_starting_paint(call: Call, red: Path) -> None:
    call("apply", "red.json", "exposure", "stops=0.3")

    assert call("export", "red.json", "-o", "out.xml").exit_code == 0

    spec = read_spec_file("out.xml")
    assert np.array_equal(spec.lab(), read_design(red).spec.lab())
    assert spec.starting_paint is not None
    assert spec.provenance is None
    assert call("export", "red.json", "-o", "out.xml").exit_code == 5


def test_preview_shows_start_design_and_nearest(call: Call, red: Path) -> None:
    from PIL import Image

    done = call(
        "preview", "red.json", "-o", "red.png", "--size", "128",
        "--beside", "start", "--beside", "nearest",
    )  # fmt: skip

    assert done.exit_code == 0, done.stderr
    with Image.open("red.png") as picture:
        assert picture.width == 128
    assert Path("red.png").read_bytes().count(b"iTXtPaint") == 3


def test_plot_follows_the_ending_of_its_name(call: Call, red: Path) -> None:
    pytest.importorskip("matplotlib", reason="curves are an optional extra")

    assert call("plot", "red.json", "-o", "red.svg").exit_code == 0
    assert call("plot", "red.json", "-o", "red.png").exit_code == 0

    assert Path("red.svg").read_bytes().startswith(b"<?xml")
    assert Path("red.png").read_bytes().startswith(b"\x89PNG")


def test_steps_list_parameters_and_limits(call: Call) -> None:
    text = call("steps").stdout
    documents = json.loads(call("steps", "--json").stdout)

    assert "vertex_deg: a number above 45 to 110 degrees" in text
    assert "channels: one of L, a, b, ab, Lab (default L)" in text
    assert "L: a number from 0 to 170 (optional)" in text
    turn = next(one for one in documents if one["step"] == "rotate-hue")
    assert turn["parameters"]["angle_deg"]["required"]


@pytest.mark.parametrize(
    ("arguments", "code", "says"),
    [
        (["apply", "red.json", "rotate-heu", "angle_deg=3"], 3, "mean rotate-hue"),
        (["apply", "red.json", "rotate-hue", "angle=3"], 3, "mean angle_deg"),
        (["apply", "red.json", "rotate-hue", "30"], 2, "write NAME=VALUE"),
        (["apply", "red.json", "rotate-hue"], 3, "angle_deg is missing"),
        (["apply", "red.json", "exposure", "stops=nan"], 3, "from -10 to 10"),
        (["apply", "red.json", "exposure", "stops=inf"], 3, "not inf"),
        (["apply", "red.json", "exposure", "stops=1e400"], 3, "not inf"),
        (["apply", "red.json", "exposure", "stops=one"], 3, "not 'one'"),
        (["apply", "red.json", "tint-flop", "color=1,2", "amount=1"], 3, "L,a,b of"),
        (["apply", "red.json", "towards", "paint=QX", "amount=1"], 3, "no paint with"),
        (["apply", "red.json", "towards", "paint=no.xml", "amount=1"], 3, "no.xml"),
        (["apply", "none.json", "mirror"], 3, "none.json: cannot be read"),
        (["redo", "red.json"], 3, "nothing to redo"),
        (["new", "red.json", "--blank"], 5, "exists: choose another name"),
        (["new", "b.json"], 2, "say what to start from"),
        (["new", "b.json", "--blank", "--paint", "X"], 2, "say what to start from"),
        (["new", "b.json", "--spec", "red.xml", "--angles", "5"], 3, "15/45/110: ask"),
        (["new", "b.json", "--paint", "BM4055"], 3, "did you mean"),
        (["new", "b.json", "--paint", ""], 3, "no paint with the code"),
        (["new", "no/such/b.json", "--blank"], 5, "choose a folder"),
        (["plot", "red.json", "-o", "red.jpg"], 2, "end the name in .png or .svg"),
        (["preview", "red.json", "-o", "a.png", "--object", "bal"], 5, "bal"),
    ],
)
def test_wrong_call_says_what_to_do(
    call: Call, red: Path, arguments: list[str], code: int, says: str
) -> None:
    before = red.read_bytes()

    done = call(*arguments)

    assert done.exit_code == code
    assert says in " ".join(done.stderr.split())
    assert red.read_bytes() == before
