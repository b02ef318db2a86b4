"""The files that go to systemd and udev."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest

from paintlink.errors import ConfigError

ROOT = Path(__file__).parents[2]
UNIT = ROOT / "systemd" / "paintlink.service"
RULES = ROOT / "config" / "60-paintlink.rules"
SYSUSERS = ROOT / "config" / "paintlink.sysusers"

EXPOSURE_TENTHS = "15"
TOKEN = re.compile(r'([A-Z_]+(?:\{\w+\})?)(==|!=|\+=|=)"([^"]*)"')
MATCHES = {"==", "!="}
ADAPTER_CHIPS = {"0403", "067b", "10c4", "1a86"}


def unit() -> dict[str, list[str]]:
    """Every value of every directive, in the order of the file."""
    found: dict[str, list[str]] = {}
    for line in UNIT.read_text(encoding="utf-8").splitlines():
        if line and line[0] not in "#[":
            key, _, value = line.partition("=")
            found.setdefault(key, []).append(value)
    return found


def rules(text: str) -> list[list[tuple[str, str, str]]]:
    """Key, operator and value of each part of each rule.

    Raises
    ------
    ValueError
        When something stands between the parts that is no part.
    """
    found = []
    for line in text.splitlines():
        if not line or line.startswith("#"):
            continue
        rest = TOKEN.sub("", line).replace(",", "").strip()
        if rest:
            msg = f"not a part of a rule: {rest}"
            raise ValueError(msg)
        found.append([match.groups() for match in TOKEN.finditer(line)])
    return found


def run(*command: str, given: str = "") -> subprocess.CompletedProcess[str]:
    """Outcome of a program of systemd; skipped where there is none."""
    if shutil.which(command[0]) is None:
        pytest.skip(f"{command[0]} is not installed")
    return subprocess.run(
        command, input=given, capture_output=True, text=True, check=False
    )


@pytest.fixture
def startable(tmp_path: Path) -> Path:
    """The unit with a program that exists on every machine."""
    path = tmp_path / UNIT.name
    text = UNIT.read_text(encoding="utf-8").replace("/usr/bin/paintlink", "/bin/true")
    path.write_text(text, encoding="utf-8")
    return path


def test_systemd_knows_every_directive(startable: Path) -> None:
    done = run("systemd-analyze", "verify", "--recursive-errors=one", str(startable))

    assert (done.returncode, done.stderr) == (0, "")


def test_misspelled_directive_is_found(startable: Path) -> None:
    text = startable.read_text(encoding="utf-8")
    startable.write_text(text.replace("ProtectSystem", "ProtectSystm"), "utf-8")

    done = run("systemd-analyze", "verify", "--recursive-errors=one", str(startable))

    assert done.returncode == 1
    assert "ProtectSystm" in done.stderr


def test_service_is_exposed_little(startable: Path) -> None:
    threshold = f"--threshold={EXPOSURE_TENTHS}"

    done = run("systemd-analyze", "security", "--offline=1", threshold, str(startable))

    assert done.returncode == 0, done.stdout


def test_no_protection_is_switched_off() -> None:
    off = [key for key, values in unit().items() if "no" in values]

    assert off == []


def test_service_starts_what_it_was_told() -> None:
    directives = unit()

    assert directives["Type"] == ["notify"]
    assert directives["WatchdogSec"] == ["30s"]
    (start,) = directives["ExecStart"]
    assert start.endswith(" run --config /etc/paintlink/paintlink.toml")


def test_wrong_configuration_is_not_tried_again() -> None:
    assert unit()["RestartPreventExitStatus"] == [str(ConfigError.exit_code)]


def test_service_keeps_its_memory_where_settings_expect_it() -> None:
    directives = unit()

    assert directives["StateDirectory"] == ["paintlink"]
    assert directives["RequiresMountsFor"] == ["/var/lib/paintlink"]
    assert directives["IPAddressDeny"] == ["any"]


def test_every_rule_matches_and_acts() -> None:
    for rule in rules(RULES.read_text(encoding="utf-8")):
        operators = {operator for _, operator, _ in rule}
        label = rule[0][0] == "LABEL"

        assert label or operators & MATCHES, rule
        assert operators - MATCHES, rule


def test_every_jump_has_its_label() -> None:
    parts = [part for rule in rules(RULES.read_text("utf-8")) for part in rule]

    jumps = {value for key, _, value in parts if key == "GOTO"}

    assert jumps == {value for key, _, value in parts if key == "LABEL"}


def test_no_adapter_chip_is_claimed_as_a_whole() -> None:
    for rule in rules(RULES.read_text(encoding="utf-8")):
        values = {value.lower() for key, _, value in rule if "idVendor" in key}
        keys = {key for key, _, _ in rule}

        assert not values & ADAPTER_CHIPS or "ATTRS{serial}" in keys


def test_instrument_is_opened_to_the_service_alone() -> None:
    (claim,) = [
        {key: value for key, _, value in rule}
        for rule in rules(RULES.read_text(encoding="utf-8"))
        if any(key == "GROUP" for key, _, _ in rule)
    ]

    assert (claim["ATTR{idVendor}"], claim["ATTR{idProduct}"]) == ("0765", "d020")
    assert (claim["GROUP"], claim["MODE"]) == ("paintlink", "0660")
    assert claim["ENV{ID_MM_DEVICE_IGNORE}"] == "1"


def test_rules_that_are_switched_off_are_right_too() -> None:
    text = RULES.read_text(encoding="utf-8").replace("#SUBSYSTEM", "SUBSYSTEM")

    assert len(rules(text)) == len(rules(RULES.read_text(encoding="utf-8"))) + 1


@pytest.mark.parametrize(
    "line", ['ACTION=="add, MODE="0660"', "ACTION==add", 'MODE="0660";', "GOTO"]
)
def test_lint_finds_a_broken_rule(line: str) -> None:
    with pytest.raises(ValueError, match="not a part of a rule"):
        rules(line)


def test_user_of_the_service_is_made(tmp_path: Path) -> None:
    text = SYSUSERS.read_text(encoding="utf-8")

    done = run("systemd-sysusers", f"--root={tmp_path}", "--dry-run", "-", given=text)

    assert done.returncode == 0, done.stderr
    user = unit()["User"][0]
    assert f"Creating user '{user}'" in done.stderr
    assert all(f"m {user} {group}\n" in text for group in ("dialout", "render"))
