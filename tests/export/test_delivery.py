from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

from paintlink.errors import ExportError
from paintlink.export import discard, outcome, publish, stage

DATA = b"<job/>\n"


def refusal(match: str):
    return pytest.raises(ExportError, match=match)


def delivered(folder: Path) -> list[str]:
    return sorted(entry.name for entry in folder.iterdir() if entry.is_file())


def staged(folder: Path) -> list[str]:
    return sorted(entry.name for entry in (folder / ".paintlink").iterdir())


def test_published_file_holds_the_staged_bytes(tmp_path: Path) -> None:
    stage(tmp_path, "token", DATA)

    path = publish(tmp_path, "token", "job.xml")

    assert path == tmp_path / "job.xml"
    assert path.read_bytes() == DATA
    assert staged(tmp_path) == []


def test_staged_file_is_not_yet_visible(tmp_path: Path) -> None:
    stage(tmp_path, "token", DATA)

    assert delivered(tmp_path) == []
    assert staged(tmp_path) == ["token"]


def test_staging_again_replaces_what_was_interrupted(tmp_path: Path) -> None:
    stage(tmp_path, "token", b"half a fi")

    stage(tmp_path, "token", DATA)

    assert publish(tmp_path, "token", "job.xml").read_bytes() == DATA


def test_mode_is_set_whatever_the_umask(tmp_path: Path) -> None:
    before = os.umask(0o077)
    try:
        stage(tmp_path, "token", DATA, mode=0o664)
        stage(tmp_path, "other", DATA)
    finally:
        os.umask(before)

    modes = {
        entry.name: entry.stat().st_mode & 0o777
        for entry in (tmp_path / ".paintlink").iterdir()
    }
    assert modes == {"token": 0o664, "other": 0o600}


def test_outcome_follows_the_token(tmp_path: Path) -> None:
    before = outcome(tmp_path, "token")
    stage(tmp_path, "token", DATA)
    between = outcome(tmp_path, "token")
    publish(tmp_path, "token", "job.xml").unlink()
    after = outcome(tmp_path, "token")

    assert (before, between, after) == ("unknown", "staged", "published")


def test_lost_staging_folder_leaves_the_outcome_unknown(tmp_path: Path) -> None:
    stage(tmp_path, "token", DATA)
    discard(tmp_path, "token")
    (tmp_path / ".paintlink").rmdir()

    assert outcome(tmp_path, "token") == "unknown"
    assert delivered(tmp_path) == []
    assert not (tmp_path / ".paintlink").exists()


def test_unreachable_folder_gives_no_outcome(tmp_path: Path) -> None:
    with refusal("does not exist; create it") as caught:
        outcome(tmp_path / "share", "token")

    assert caught.value.kind == "missing"


def test_discarded_file_leaves_no_trace(tmp_path: Path) -> None:
    stage(tmp_path, "token", DATA)

    discard(tmp_path, "token")
    discard(tmp_path, "token")

    assert staged(tmp_path) == []


def test_discard_without_staging_folder_does_nothing(tmp_path: Path) -> None:
    discard(tmp_path, "token")

    assert list(tmp_path.iterdir()) == []


def test_existing_file_is_never_replaced(tmp_path: Path) -> None:
    (tmp_path / "job.xml").write_bytes(b"theirs")
    stage(tmp_path, "token", DATA)

    with refusal(r"job\.xml: a file of this name lies there already") as caught:
        publish(tmp_path, "token", "job.xml")

    assert caught.value.kind == "exists"
    assert (tmp_path / "job.xml").read_bytes() == b"theirs"
    assert outcome(tmp_path, "token") == "staged"


def test_dangling_link_under_the_name_is_kept(tmp_path: Path) -> None:
    (tmp_path / "job.xml").symlink_to(tmp_path / "elsewhere")
    stage(tmp_path, "token", DATA)

    with refusal("lies there already"):
        publish(tmp_path, "token", "job.xml")

    assert not (tmp_path / "elsewhere").exists()


def test_publishing_twice_says_the_token_is_gone(tmp_path: Path) -> None:
    stage(tmp_path, "token", DATA)
    publish(tmp_path, "token", "job.xml")

    with refusal("the staged file is gone; it was published before") as caught:
        publish(tmp_path, "token", "again.xml")

    assert caught.value.kind == "gone"
    assert delivered(tmp_path) == ["job.xml"]


def test_publishing_without_staging_folder_asks_to_look(tmp_path: Path) -> None:
    with refusal(r"\.paintlink: the staging folder is gone.*look") as caught:
        publish(tmp_path, "token", "job.xml")

    assert caught.value.kind == "gone"


def test_missing_folder_is_not_created(tmp_path: Path) -> None:
    folder = tmp_path / "hot"

    with refusal("hot: the folder does not exist; create it") as caught:
        stage(folder, "token", DATA)

    assert caught.value.kind == "missing"
    assert not folder.exists()


def test_vanished_folder_is_reported_as_missing(tmp_path: Path) -> None:
    folder = tmp_path / "hot"
    folder.mkdir()
    stage(folder, "token", DATA)
    folder.rename(tmp_path / "moved")

    with refusal("hot: the folder does not exist"):
        publish(folder, "token", "job.xml")

    assert outcome(tmp_path / "moved", "token") == "staged"


def test_file_in_place_of_the_folder_is_named(tmp_path: Path) -> None:
    (tmp_path / "hot").write_bytes(b"")

    with refusal("hot: this is not a folder; remove it") as caught:
        stage(tmp_path / "hot", "token", DATA)

    assert caught.value.kind == "not-a-folder"


@pytest.mark.parametrize("kind", ["link", "file"])
def test_staging_folder_must_be_a_real_one(tmp_path: Path, kind: str) -> None:
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    folder = tmp_path / "hot"
    folder.mkdir()
    if kind == "link":
        (folder / ".paintlink").symlink_to(elsewhere)
    else:
        (folder / ".paintlink").write_bytes(b"")

    with refusal(r"\.paintlink: this is not a folder"):
        stage(folder, "token", DATA)

    assert list(elsewhere.iterdir()) == []


def test_staged_link_is_replaced_not_followed(tmp_path: Path) -> None:
    victim = tmp_path / "victim"
    victim.write_bytes(b"theirs")
    stage(tmp_path, "other", DATA)
    (tmp_path / ".paintlink" / "token").symlink_to(victim)

    stage(tmp_path, "token", DATA)

    assert victim.read_bytes() == b"theirs"
    assert publish(tmp_path, "token", "job.xml").read_bytes() == DATA


@pytest.mark.parametrize("name", ["", ".", "..", "../job.xml", "a/b.xml", "a\0b"])
def test_only_plain_names_are_published(tmp_path: Path, name: str) -> None:
    stage(tmp_path, "token", DATA)

    with refusal("is not the name of a file") as caught:
        publish(tmp_path, "token", name)

    assert caught.value.kind == "name"
    assert outcome(tmp_path, "token") == "staged"


@pytest.mark.parametrize("use", [outcome, discard])
def test_only_plain_tokens_are_looked_up(tmp_path: Path, use) -> None:
    stage(tmp_path, "token", DATA)

    with refusal("is not the name of a file"):
        use(tmp_path, "../.paintlink/token")


def test_too_long_name_leaves_the_file_staged(tmp_path: Path) -> None:
    stage(tmp_path, "token", DATA)

    with refusal("takes no name this long; shorten") as caught:
        publish(tmp_path, "token", "n" * 300)

    assert caught.value.kind == "name"
    assert outcome(tmp_path, "token") == "staged"


def test_read_only_disk_is_named_as_such(read_only_disk: Path) -> None:
    with refusal("disk: the file system is mounted read-only") as caught:
        stage(read_only_disk, "token", DATA)

    assert caught.value.kind == "read-only"


def test_full_disk_leaves_nothing_behind(small_disk: Path) -> None:
    with refusal("disk: the disk is full; free some space") as caught:
        stage(small_disk, "token", bytes(2 << 20))

    assert caught.value.kind == "full"
    assert staged(small_disk) == []
    assert delivered(small_disk) == []


def test_delivery_works_again_after_space_is_freed(small_disk: Path) -> None:
    (small_disk / "filler").write_bytes(bytes(900 << 10))
    with refusal("the disk is full"):
        stage(small_disk, "token", bytes(200 << 10))

    (small_disk / "filler").unlink()
    stage(small_disk, "token", bytes(200 << 10))

    assert publish(small_disk, "token", "job.xml").stat().st_size == 200 << 10


def test_staging_on_another_disk_is_refused(tmp_path: Path, small_disk: Path) -> None:
    folder = small_disk.parent / "hot"
    folder.mkdir()
    (folder / ".paintlink").mkdir()
    subprocess.run(["mount", "--bind", small_disk, folder / ".paintlink"], check=True)
    try:
        stage(folder, "token", DATA)

        with refusal("lies on another file system; make it a plain folder"):
            publish(folder, "token", "job.xml")
    finally:
        subprocess.run(["umount", folder / ".paintlink"], check=True)


def test_missing_permission_is_named(locked_folder: Path) -> None:
    with refusal("paintlink may not write here; give its user") as caught:
        stage(locked_folder, "token", DATA)

    assert caught.value.kind == "denied"
    assert list(locked_folder.iterdir()) == []
