from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from paintlink.export import outcome, probe, stage


def problem(folder: Path) -> str:
    return probe(folder) or "no problem"


def test_good_folder_has_no_problem(tmp_path: Path) -> None:
    assert probe(tmp_path) is None


def test_probe_leaves_the_folder_as_it_was(tmp_path: Path) -> None:
    (tmp_path / "job.xml").write_bytes(b"theirs")
    stage(tmp_path, "token", b"ours")

    probe(tmp_path)

    names = sorted(str(path.relative_to(tmp_path)) for path in tmp_path.rglob("*"))
    assert names == [".paintlink", ".paintlink/token", "job.xml"]


def test_probe_never_makes_a_lost_staging_folder_good(tmp_path: Path) -> None:
    probe(tmp_path)

    assert outcome(tmp_path, "token") == "unknown"


def test_missing_folder_is_a_problem(tmp_path: Path) -> None:
    assert "does not exist; create it" in problem(tmp_path / "hot")


def test_file_in_place_of_the_folder_is_a_problem(tmp_path: Path) -> None:
    (tmp_path / "hot").write_bytes(b"")

    assert "this is not a folder" in problem(tmp_path / "hot")


def test_file_in_place_of_the_staging_folder_is_a_problem(tmp_path: Path) -> None:
    (tmp_path / ".paintlink").write_bytes(b"")

    assert ".paintlink: this is not a folder" in problem(tmp_path)


def test_missing_permission_is_a_problem(locked_folder: Path) -> None:
    assert "may not write here" in problem(locked_folder)


def test_read_only_disk_is_a_problem(read_only_disk: Path) -> None:
    assert "mounted read-only" in problem(read_only_disk)


def test_nearly_full_disk_is_a_problem(small_disk: Path) -> None:
    (small_disk / "filler").write_bytes(bytes(512 << 10))

    assert "KiB are free; free at least 1 MiB" in problem(small_disk)
    assert sorted(path.name for path in small_disk.iterdir()) == ["filler"]


def test_full_disk_is_a_problem(small_disk: Path) -> None:
    with pytest.raises(OSError, match="No space left"):
        (small_disk / "filler").write_bytes(bytes(2 << 20))

    assert "the disk is full" in problem(small_disk)


def test_staging_on_another_disk_is_a_problem(tmp_path: Path, big_disk: Path) -> None:
    folder = tmp_path / "hot"
    staging = folder / ".paintlink"
    staging.mkdir(parents=True)
    subprocess.run(["mount", "--bind", big_disk, staging], check=True)
    try:
        found = problem(folder)
    finally:
        subprocess.run(["umount", staging], check=True)

    assert "lies on another file system" in found
    assert list(big_disk.iterdir()) == []
