from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from paintlink.config import default_settings, find_config, load_settings
from paintlink.errors import ConfigError

FULL = """
[site]
name = "Shop 3"
folder = "site"
[state]
folder = "/var/lib/elsewhere"
[inbox]
folder = "/mnt/share/in"
max_size_mib = 2
[[instrument]]
name = "bench"
driver = "xrite_ma"
port = "/dev/ttyUSB0"
baud = 19200
options = { plate = "A1", angles = [15, 45, 110] }
[[route]]
name = "colornet"
folder = "../colornet"
format = "colornet"
accept = ["real", "simulated"]
mode = "0640"
pattern = "{date}_{name}"
"""


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A machine of its own: no system file, user folders below ``tmp_path``."""
    for name in ("CONFIG", "DATA", "STATE"):
        monkeypatch.setenv(f"XDG_{name}_HOME", str(tmp_path / name.lower()))
    system = tmp_path / "etc" / "paintlink.toml"
    monkeypatch.setattr("paintlink.config._places.SYSTEM_FILE", system)
    return tmp_path


def place(path: Path, name: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f'[site]\nname = "{name}"\n', encoding="utf-8")
    return path


def test_file_becomes_settings(load, tmp_path: Path) -> None:
    settings = load(FULL)

    assert settings.source == tmp_path / "paintlink.toml"
    assert settings.site.name == "Shop 3"
    assert settings.inbox.max_bytes == 2 * 1024 * 1024
    (instrument,) = settings.instruments
    assert (instrument.driver, instrument.baud) == ("xrite_ma", 19200)
    assert instrument.options == {"plate": "A1", "angles": [15, 45, 110]}
    (route,) = settings.routes
    assert route.accept == ("real", "simulated")
    assert (route.mode_bits, route.pattern) == (0o640, "{date}_{name}")


@pytest.mark.parametrize(
    ("section", "line", "value"),
    [
        ("snap", 'formula = "cmc"', "cmc"),
        ("snap", "top = 7", 7),
        ("preview", "caption = false", False),
        ("log", 'level = "error"', "error"),
    ],
)
def test_each_section_reaches_the_settings(
    load, section: str, line: str, value: object
) -> None:
    settings = load(f"[{section}]\n{line}")

    assert getattr(getattr(settings, section), line.partition(" ")[0]) == value


def test_relative_folders_start_at_the_file(load, tmp_path: Path) -> None:
    settings = load(FULL)

    assert settings.site_folder == tmp_path / "site"
    assert settings.routes[0].folder == tmp_path.parent / "colornet"
    assert settings.inbox.folder == Path("/mnt/share/in")


def test_file_may_be_named_from_where_you_are(
    write, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write('[site]\nfolder = "site"')
    monkeypatch.chdir(tmp_path)

    settings = load_settings(Path("paintlink.toml"), environ={})

    assert settings.source == tmp_path / "paintlink.toml"
    assert settings.site_folder == tmp_path / "site"


def test_inbox_follows_the_site_folder(load) -> None:
    settings = load('[site]\nfolder = "/srv/shop"')

    assert settings.inbox.folder == Path("/srv/shop/inbox")


def test_state_holds_journal_and_pictures(load) -> None:
    settings = load('[state]\nfolder = "/srv/state"')

    assert settings.state_folder == Path("/srv/state")
    assert settings.journal_path == Path("/srv/state/journal.db")
    assert settings.previews_folder == Path("/srv/state/previews")


def test_formats_lie_beside_the_file(load, tmp_path: Path) -> None:
    without = load("").formats_folder

    (tmp_path / "formats").mkdir()

    assert without is None
    assert load("").formats_folder == tmp_path / "formats"


def test_empty_file_says_what_no_file_says(load, home: Path) -> None:
    empty, default = load(""), default_settings(environ={})

    for section in default.__slots__:
        if section != "source":
            assert getattr(empty, section) == getattr(default, section)


def test_byte_order_mark_and_carriage_returns_are_fine(tmp_path: Path) -> None:
    path = tmp_path / "from_windows.toml"
    path.write_bytes(b'\xef\xbb\xbf[log]\r\nlevel = "debug"\r\n')

    assert load_settings(path, environ={}).log_level == "debug"


def test_named_file_wins_over_every_other(home: Path) -> None:
    named = place(home / "named.toml", "named")
    place(home / "etc" / "paintlink.toml", "system")
    variable = place(home / "variable.toml", "variable")

    settings = load_settings(named, environ={"PAINTLINK_CONFIG": str(variable)})

    assert settings.site.name == "named"


def test_search_goes_variable_system_user(home: Path) -> None:
    user = place(home / "config" / "paintlink" / "paintlink.toml", "user")
    only_user = find_config({})
    system = place(home / "etc" / "paintlink.toml", "system")
    both = find_config({})

    assert (only_user, both) == (user, system)
    assert find_config({"PAINTLINK_CONFIG": "x.toml"}) == Path("x.toml")
    assert load_settings(environ={}).site.name == "system"


def test_no_file_gives_built_in_settings(home: Path) -> None:
    settings = load_settings(environ={})

    assert settings == default_settings(environ={})
    assert settings.source is None
    assert settings.formats_folder is None
    assert settings.instruments == settings.routes == ()
    assert settings.site_folder == home / "data" / "paintlink" / "site"
    assert settings.state_folder == home / "state" / "paintlink"


def test_service_lives_in_the_folder_of_systemd() -> None:
    environ = {"STATE_DIRECTORY": "/var/lib/paintlink:/var/lib/other"}

    settings = default_settings(environ=environ)

    assert settings.state_folder == Path("/var/lib/paintlink")
    assert settings.inbox.folder == Path("/var/lib/paintlink/site/inbox")


def test_built_in_settings_need_no_pydantic(tmp_path: Path) -> None:
    code = (
        "import sys, paintlink.config as config\n"
        "config.default_settings(environ={})\n"
        "print({'pydantic', 'numpy', 'lxml'} & set(sys.modules))"
    )

    run = subprocess.run([sys.executable, "-c", code], capture_output=True, check=True)

    assert run.stdout == b"set()\n"


def test_missing_named_file_is_told(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match=r"none\.toml: there is no such file; corr"):
        load_settings(tmp_path / "none.toml", environ={})


def test_file_that_cannot_be_read_is_told(home: Path) -> None:
    (home / "etc" / "paintlink.toml").mkdir(parents=True)

    with pytest.raises(ConfigError, match=r"cannot be read \(Is a directory\)"):
        load_settings(environ={})


def test_file_that_cannot_be_found_out_about_is_told(home: Path) -> None:
    system = home / "etc" / "paintlink.toml"
    system.parent.mkdir()
    system.symlink_to(system)

    with pytest.raises(ConfigError, match=r"cannot be read \(Too many levels of sym"):
        load_settings(environ={})


def test_file_in_another_encoding_is_told(tmp_path: Path) -> None:
    path = tmp_path / "latin.toml"
    path.write_bytes(b'[site]\nname = "Caf\xe9"\n')

    with pytest.raises(ConfigError, match=r"latin.toml: line 2: byte E9 is not UTF-8"):
        load_settings(path, environ={})


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        (
            "[log]\na b",
            "line 2, column 3: Expected '=' after a key in a key/value pair: a b",
        ),
        ("[log]\n[log]", "line 2, column 5: Cannot declare ('log',) twice: [log]"),
        ("top = [1,", "Invalid value (at end of document); correct the file"),
        ("top = " + 5000 * "[", "lists or tables nested too deeply; correct the file"),
    ],
    ids=["no equals sign", "section twice", "ends too early", "too deep"],
)
def test_broken_toml_is_told_with_its_line(refuse, text: str, fault: str) -> None:
    assert refuse(text) == [f"FILE: {fault}"]
