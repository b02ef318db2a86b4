from __future__ import annotations

from pathlib import Path

import pytest

from paintlink.config import default_settings, load_settings, load_snap_settings
from paintlink.errors import ConfigError


def test_environment_wins_over_the_file(load) -> None:
    settings = load(
        "[inbox]\npoll_s = 30\nquiet_s = 3",
        PAINTLINK__INBOX__POLL_S="0.5",
        PAINTLINK__INBOX__ENABLED="false",
        PAINTLINK__SNAP__TOP="5",
        PAINTLINK__LOG__LEVEL="debug",
    )

    assert (settings.inbox.poll_s, settings.inbox.quiet_s) == (0.5, 3.0)
    assert settings.inbox.enabled is False
    assert settings.snap.top == 5
    assert settings.log_level == "debug"


def test_text_that_looks_like_a_number_stays_text(load) -> None:
    assert load("", PAINTLINK__SITE__NAME="12").site.name == "12"


def test_folder_from_the_environment_moves_the_inbox(load) -> None:
    settings = load("", PAINTLINK__SITE__FOLDER="/srv/shop")

    assert settings.inbox.folder == Path("/srv/shop/inbox")


def test_environment_works_without_a_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("paintlink.config._load.find_config", lambda _: None)
    monkeypatch.chdir(tmp_path)
    environ = {"STATE_DIRECTORY": "/s", "PAINTLINK__SITE__FOLDER": "here"}

    settings = load_settings(environ=environ)

    assert settings.source is None
    assert settings.site_folder == tmp_path / "here"
    assert settings.snap == default_settings(environ=environ).snap


@pytest.mark.parametrize("environ", [{}, {"PAINTLINK__SNAP__FORMULA": "ciede2000"}])
def test_snap_section_alone_is_that_of_the_whole(
    environ: dict[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("paintlink.config._load.find_config", lambda _: None)

    alone = load_snap_settings(environ=environ)

    assert alone == load_settings(environ=environ).snap
    assert alone.formula == environ.get("PAINTLINK__SNAP__FORMULA", "cie76")


def test_other_variables_are_left_alone(load) -> None:
    settings = load("", PAINTLINK_SITE_NAME="x", PAINTLINKS__SITE__NAME="y")

    assert settings.site.name == "paintlink"


@pytest.mark.parametrize(
    ("name", "value", "fault"),
    [
        ("INBOX__POL_S", "1", 'unknown key "pol_s": did you mean "poll_s"?'),
        ("INBX__POLL_S", "1", 'unknown section "inbx": did you mean "inbox"?'),
        ("ROUTE__NAME", "x", "[[route]] can only be written in a file"),
        ("SNAP__TOP", "many", 'top = "many": must be a whole number from 1 to 1000'),
        ("SNAP__TOP", "5\n6", 'top = "5\\n6": must be a whole number from 1 to 1000'),
        ("SNAP__GREEN", "9", "green = 9: must not be above amber = 3.0"),
        ("SITE__FOLDER", "", 'folder = "": must be a folder in quotes, without "~", '),
    ],
)
def test_fault_names_the_variable(refuse, name: str, value: str, fault: str) -> None:
    (found,) = refuse("", **{f"PAINTLINK__{name}": value})

    assert found.startswith(f"environment: PAINTLINK__{name}: {fault}")


def test_faults_of_file_and_environment_come_together(refuse) -> None:
    faults = refuse("[log]\nlevel = 3", PAINTLINK__SNAP__TOP="0")

    assert [fault.partition(":")[0] for fault in faults] == ["environment", "FILE"]


def test_faults_without_a_file_need_no_file_name(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("paintlink.config._load.find_config", lambda _: None)

    with pytest.raises(ConfigError, match=r"^environment: PAINTLINK__LOG__LEVEL: lev"):
        load_settings(environ={"PAINTLINK__LOG__LEVEL": "loud"})
