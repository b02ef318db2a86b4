"""Commands that work with instruments, the journal and the service."""

from __future__ import annotations

import json
import sqlite3
import subprocess
import time
from contextlib import closing
from dataclasses import replace
from pathlib import Path

import pytest

from paintlink.config import TemplateSettings
from paintlink.daemon.journal import Journal
from paintlink.export import load_formats
from paintlink.intake import read_order
from paintlink.spec import read_spec_file
from paintlink_simulators import PtyPort
from tests.cli.conftest import Run
from tests.conformance.bench import SEED, panel, simulator_module
from tests.daemon.conftest import make_reading

XMLLINT = "/usr/bin/xmllint"


def config(tmp_path: Path, *, accept: str = '"simulated"', port: str = "") -> Path:
    (tmp_path / "colornet").mkdir(exist_ok=True)
    instrument = (
        f'[[instrument]]\nname = "bench"\ndriver = "xrite_ma"\nport = "{port}"\n'
        'serial = "4711"\nreadings = 2\n'
    )
    path = tmp_path / "paintlink.toml"
    path.write_text(
        '[site]\nfolder = "."\n[state]\nfolder = "state"\n'
        "[preview]\nsize = 128\n"
        f'[[route]]\nname = "colornet"\nfolder = "colornet"\nformat = "colornet"\n'
        f"accept = [{accept}]\n" + (instrument if port else "")
    )
    return path


@pytest.fixture
def port() -> PtyPort:
    simulator = simulator_module("xrite_ma").create(
        panel(), clock=time.monotonic, seed=SEED
    )
    with PtyPort(simulator, auto_press_after_s=0.05) as opened:
        yield opened


def test_demo_delivers_valid_files_and_never_again(run: Run, tmp_path: Path) -> None:
    first = run("demo", "--once", "--no-web", "--dir", "d")
    taken = {path.name for path in (tmp_path / "d/colornet").glob("*.xml")}
    second = run("demo", "--once", "--no-web", "--dir", "d")
    files = set((tmp_path / "d/colornet").glob("*.xml"))

    assert (first.returncode, second.returncode) == (0, 0), first.stderr
    assert len(taken) == 2
    assert len(files) == 4
    for label in ("serial", "Lab at 110", "Flop Index", "nearest paint", "total"):
        assert label in first.stdout
    schema = load_formats()["colornet"].source.with_suffix(".xsd")
    if not Path(XMLLINT).exists():
        pytest.skip("needs xmllint (libxml2-utils)")
    subprocess.run(
        [XMLLINT, "--noout", "--schema", schema, *files],
        check=True,
        capture_output=True,
    )


def test_demo_can_be_looked_at_with_jobs(run: Run, tmp_path: Path) -> None:
    run("demo", "--once", "--dir", "d", "--seed", "7")

    listed = json.loads(
        run("jobs", "list", "--json", "--config", "d/paintlink.toml").stdout
    )
    shown = run("jobs", "show", listed[0]["job"], "--config", "d/paintlink.toml")

    assert {job["state"] for job in listed} == {"done"}
    assert {job["origin"] for job in listed} == {"simulated"}
    assert all(Path(job["preview"]).exists() for job in listed)
    assert "every route served" in shown.stdout


def test_measure_goes_all_the_way(run: Run, tmp_path: Path, port: PtyPort) -> None:
    done = run(
        "measure", "bench", "--sample", "door", "--json", "--config",
        config(tmp_path, port=port.path),
    )  # fmt: skip

    assert done.returncode == 0, done.stderr
    job = json.loads(done.stdout)
    assert job["origin"] == "simulated"
    assert job["specification"]["name"] == "door"
    assert [one["state"] for one in job["deliveries"]] == ["written"]
    assert "reading 2 of 2" in done.stderr
    (delivered,) = (tmp_path / "colornet").glob("*.xml")
    assert delivered.name.startswith("SIM-")


def test_capture_of_a_reading_replays_to_the_same_bits(
    run: Run, tmp_path: Path, port: PtyPort
) -> None:
    path = config(tmp_path, port=port.path)
    run("measure", "bench", "--readings", "1", "--config", path)
    with Journal(tmp_path / "state" / "journal.db") as journal:
        stored = journal.reading(1).measurement
    (capture,) = (tmp_path / "state" / "captures").iterdir()

    done = run("replay", capture, "--json")

    outcomes = {one["call"]: one["value"] for one in json.loads(done.stdout)}
    assert stored.spectra is not None
    assert outcomes["measure"]["factors"] == stored.spectra.factors.tolist()
    assert outcomes["identify"]["model"] == "MA68II"


def test_file_that_is_no_capture_is_refused(run: Run, spec_file: Path) -> None:
    done = run("replay", spec_file)

    assert done.returncode == 3
    assert "is no capture of paintlink" in done.stderr


def test_reading_over_a_pty_never_reaches_a_real_route(
    run: Run, tmp_path: Path, port: PtyPort
) -> None:
    done = run(
        "measure", port.path, "--driver", "xrite_ma", "--config",
        config(tmp_path, accept='"real"'),
    )  # fmt: skip

    assert done.returncode == 0, done.stderr
    assert not list((tmp_path / "colornet").glob("*.xml"))


def test_dry_run_stores_nothing(run: Run, tmp_path: Path, port: PtyPort) -> None:
    path = config(tmp_path)

    done = run(
        "measure", port.path, "--driver", "xrite_ma", "--dry-run", "--config", path
    )
    listed = run("jobs", "list", "--json", "--config", path)

    assert "Starting points" in done.stdout
    assert json.loads(listed.stdout) == []


def test_calibrate_leads_to_a_valid_calibration(
    run: Run, tmp_path: Path, port: PtyPort
) -> None:
    done = run(
        "calibrate", port.path, "--driver", "xrite_ma", "--config", config(tmp_path)
    )

    assert done.returncode == 0, done.stderr
    assert "white plaque" in done.stderr
    assert "calibration valid" in done.stdout


@pytest.mark.parametrize(
    ("arguments", "code", "says"),
    [
        (["bench"], 2, "no instrument 'bench' is configured"),
        (["/dev/ttyUSB9"], 2, "say what is plugged in, such as --driver xrite_ma"),
        (["/dev/ttyUSB9", "--driver", "xrite_ma"], 4, "/dev/ttyUSB9"),
        (["/dev/ttyUSB9", "--driver", "xrite_mb"], 2, "xrite_ma"),
    ],
)
def test_instrument_that_cannot_be_used_is_explained(
    run: Run, tmp_path: Path, arguments: list[str], code: int, says: str
) -> None:
    done = run("measure", *arguments, "--config", config(tmp_path))

    assert done.returncode == code
    assert says in done.stderr
    assert "Traceback" not in done.stderr


def test_devices_lists_kinds_and_how_far_they_were_tested(
    run: Run, tmp_path: Path
) -> None:
    done = run("devices", "--json", "--config", config(tmp_path, port="/dev/ttyUSB9"))

    document = json.loads(done.stdout)
    (kind,) = [one for one in document["kinds"] if one["driver"] == "xrite_ma"]
    assert kind["hardware_tested"] is False
    assert document["instruments"][0]["last_state"] == "never run"


def test_config_check_names_every_fault(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "paintlink.toml"
    path.write_text(
        '[[route]]\nname = "a"\nfolder = "x"\nformt = "csv"\n[snap]\ntop = 0\n'
    )

    done = run("config", "check", "--config", path)

    assert done.returncode == 2
    assert 'did you mean "format"' in done.stderr
    assert "top" in done.stderr


def test_config_check_looks_at_the_folders(run: Run, tmp_path: Path) -> None:
    path = config(tmp_path)
    (tmp_path / "colornet").rmdir()

    done = run("config", "check", "--config", path)

    assert done.returncode == 2
    assert "create it" in done.stderr


def test_config_explain_tells_every_section(run: Run) -> None:
    done = run("config", "explain")

    assert all(word in done.stdout for word in ("[[route]]", "stale_min", "quiet_s"))


def test_unknown_job_points_to_the_list(run: Run, tmp_path: Path) -> None:
    done = run("jobs", "show", "nosuchjob", "--config", config(tmp_path))

    assert done.returncode == 2
    assert "see `paintlink jobs list`" in done.stderr


def test_trace_verify_backup_and_restore_work_together(
    run: Run, tmp_path: Path, spec_file: Path
) -> None:
    path = config(tmp_path, accept='"real", "simulated"')
    with Journal(tmp_path / "state" / "journal.db") as journal:
        token = journal.accept_file("a.xml", "hash", read_spec_file(spec_file))

    traced = run("trace", token, "--config", path)
    backed_up = run("backup", tmp_path / "copy.db", "--config", path)
    clean = run("jobs", "verify", "--config", path)
    with closing(sqlite3.connect(tmp_path / "state" / "journal.db")) as connection:
        connection.execute("UPDATE events SET text = 'never happened'")
        connection.commit()
    edited = run("jobs", "verify", "--config", path)
    restored = run("restore", tmp_path / "copy.db", "--config", path)
    again = run("jobs", "verify", "--config", path)

    assert (traced.returncode, clean.returncode) == (0, 0), traced.stderr
    assert "specification" in traced.stdout
    assert "holds" in traced.stdout
    assert backed_up.returncode == 0, backed_up.stderr
    assert edited.returncode == 6
    assert "entry 1 of the history" in edited.stdout
    assert "compare with a backup" in edited.stderr
    assert (restored.returncode, again.returncode) == (0, 0), restored.stderr
    assert "is kept in" in restored.stdout


def test_orders_verdicts_labels_and_health_work_together(
    run: Run, tmp_path: Path
) -> None:
    path = config(tmp_path, accept='"real"')
    with Journal(tmp_path / "state" / "journal.db") as journal:
        order = read_order(b'{"sample": "door", "vin": ""}', source="a.json")
        journal.orders.accept(order, TemplateSettings(name="refinish"), "hash")
    ordered = run("jobs", "orders", "--config", path)
    with Journal(tmp_path / "state" / "journal.db") as journal:
        reading = replace(make_reading(), sample="door")
        token = journal.accept_reading(reading, source="bench")

    verdict = run("jobs", "verdict", token, "pass", "--config", path)
    label = run("jobs", "label", token, "--format", "zpl", "--config", path)
    page = run("jobs", "label", token, "--config", path)
    green = run("health", "--config", path)
    nothing = run("jobs", "close", token, "colornet", "--config", path)

    assert "refinish" in ordered.stdout
    assert "human: pass" in verdict.stdout
    assert f"^FDMA,{token}^FS" in label.stdout
    assert "<svg" in page.stdout
    assert (green.returncode, nothing.returncode) == (0, 2), green.stderr
    assert "nothing waiting or unknown" in nothing.stderr
