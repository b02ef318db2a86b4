"""The mistakes that the tests of safe delivery must notice, made one after another.

Usage: python tools/mutants.py [NUMBER ...]

Each is made in a copy of the repository, and the tests named beside it are run there.
A mistake that no test notices is reported, and the exit code is 1.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[1]
COPIED = ("paintlink", "drivers", "simulators", "tests", "pyproject.toml", "systemd",
          "config", "docs", "README.md", "LICENSE")  # fmt: skip


class Mutant(NamedTuple):
    """One mistake: where it is made, what becomes what, and who should notice.

    What stands there more than once is changed everywhere.
    """

    name: str
    file: str
    old: str
    new: str
    tests: tuple[str, ...]


def _moved_up(line: str, before: str) -> tuple[str, str]:
    """What stands there, and the same with its last line first."""
    return before + line, line + before


MUTANTS = (
    Mutant(
        "drop the file fsync",
        "paintlink/export/delivery.py",
        "            os.fchmod(fd, mode)\n        os.fsync(fd)\n",
        "            os.fchmod(fd, mode)\n",
        ("tests/export/test_kills.py::test_everything_is_synced_before_the_next_step",),
    ),
    Mutant(
        "drop the directory fsync",
        "paintlink/export/delivery.py",
        "        os.fsync(folder_fd)\n        os.fsync(staging_fd)\n    return",
        "        os.fsync(staging_fd)\n    return",
        ("tests/export/test_kills.py::test_everything_is_synced_before_the_next_step",),
    ),
    Mutant(
        "synchronous=NORMAL",
        "paintlink/daemon/opening.py",
        '"synchronous=FULL"',
        '"synchronous=NORMAL"',
        ("tests/daemon/test_journal.py::test_journal_syncs_each_commit_to_disk",),
    ),
    Mutant(
        "mark before rename",
        "paintlink/daemon/deliverer.py",
        "        refused = publish_many(",
        "        with self._journal.transaction():\n"
        "            for delivery in staged.values():\n"
        "                self._written(delivery)\n"
        "        refused = publish_many(",
        (
            "tests/proofs/test_kills.py::test_some_kills_lose_and_double_nothing",
            "tests/proofs/test_errors.py::test_some_errors_of_the_folder_lose_nothing",
        ),
    ),
    Mutant(
        "acknowledge before commit",
        "paintlink/daemon/instruments.py",
        *_moved_up(
            "        self._wake_line()\n",
            "        order = self._journal.orders.next_for(self._settings.name)\n"
            "        if order is not None:\n"
            "            reading = replace(reading, sample=order.order.sample)\n"
            "        token = self._journal.accept_reading("
            "reading, source=self._settings.name)\n"
            '        log.info("%s %s stored", token, reading.sample)\n'
            "        self._refusals = 0\n"
            "        self._left = None if self._left is None else self._left - 1\n",
        ),
        ("tests/daemon/test_acknowledge.py",),
    ),
    Mutant(
        "write in place",
        "paintlink/export/delivery.py",
        "rename_noreplace(token, staging_fd, name, folder_fd)",
        "(_write_new(name, folder_fd, "
        "Path(f'/proc/self/fd/{staging_fd}/{token}').read_bytes(), None), "
        "_remove(token, staging_fd))",
        ("tests/export/test_kills.py", "tests/proofs/test_kills.py"),
    ),
    Mutant(
        "ignore the overflow of events",
        "paintlink/daemon/service.py",
        "            return min(poll_s, SETTLING_S) if inbox.unsettled else poll_s\n",
        "            return 1e6\n",
        ("tests/system/test_service.py::test_files_arrive_without_trustworthy_events",),
    ),
    Mutant(
        "catch-all except",
        "paintlink/daemon/worker.py",
        "        except JournalError:\n            raise\n",
        "",
        ("tests/daemon/test_worker.py",),
    ),
    Mutant(
        "blame a job for the journal",
        "paintlink/daemon/faults.py",
        "OF_NO_JOB = (JournalError, OSError, MemoryError)",
        "OF_NO_JOB = (OSError, MemoryError)",
        ("tests/daemon/test_faults.py",),
    ),
)


def main(wanted: set[int]) -> int:
    """Make each mistake and print who noticed; the exit code."""
    chosen = [
        (number, mutant)
        for number, mutant in enumerate(MUTANTS, 1)
        if not wanted or number in wanted
    ]
    unnoticed = 0
    with tempfile.TemporaryDirectory(prefix="paintlink-mutants-") as name:
        _require_passing(Path(name) / "as it is", [one for _, one in chosen])
        for number, mutant in chosen:
            caught = _is_noticed(mutant, Path(name) / str(number))
            unnoticed += not caught
            verdict = f"caught by {caught}" if caught else "NOT NOTICED"
            print(f"{number}  {mutant.name:32} {verdict}", flush=True)
    return 1 if unnoticed else 0


def _require_passing(copy: Path, mutants: Sequence[Mutant]) -> None:
    """Refuse to go on when a test fails without any mistake: it would prove nothing."""
    _copy_to(copy)
    tests = dict.fromkeys(test for one in mutants for test in one.tests)
    failed = _first_failure(copy, tuple(tests))
    if failed:
        raise SystemExit(f"{failed} fails without any mistake: repair that first")


def _is_noticed(mutant: Mutant, copy: Path) -> str:
    """Name of the first test that fails; empty when none does."""
    _copy_to(copy)
    target = copy / mutant.file
    text = target.read_text("utf-8")
    if mutant.old not in text:
        msg = f"{mutant.file} no longer holds the place of {mutant.name!r}"
        raise SystemExit(msg)
    target.write_text(text.replace(mutant.old, mutant.new), "utf-8")
    return _first_failure(copy, mutant.tests)


def _copy_to(copy: Path) -> None:
    copy.mkdir()
    for name in COPIED:
        source = ROOT / name
        if source.is_dir():
            ignored = shutil.ignore_patterns("__pycache__")
            shutil.copytree(source, copy / name, ignore=ignored)
        elif source.exists():
            shutil.copy(source, copy / name)


def _first_failure(copy: Path, tests: tuple[str, ...]) -> str:
    # A skip that is turned into a failure would look like a mistake that was noticed.
    kept = {k: v for k, v in os.environ.items() if k != "PAINTLINK_TEST_NO_SKIP"}
    paths = [str(copy), str(copy / "drivers"), str(copy / "simulators")]
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-x", "-m", "not proof", "-rfE",
         "-p", "no:cacheprovider", *tests],
        cwd=copy,
        env={**kept, "PYTHONPATH": os.pathsep.join(paths)},
        capture_output=True,
        text=True,
        check=False,
    )  # fmt: skip
    failed = [
        line.split(" - ")[0].split("::", 1)[-1]
        for line in done.stdout.splitlines()
        if line.startswith("FAILED tests/")
    ]
    if done.returncode != 0 and not failed:
        raise SystemExit(f"the tests did not run:\n{done.stdout}\n{done.stderr}")
    return failed[0] if failed else ""


if __name__ == "__main__":
    sys.exit(main({int(one) for one in sys.argv[1:]}))
