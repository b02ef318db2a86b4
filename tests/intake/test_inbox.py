"""The inbox against real files."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from paintlink.errors import InputError
from paintlink.intake import Inbox, InboxFolders


class Clock:
    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def inbox(tmp_path: Path, clock: Clock) -> Inbox:
    folders = InboxFolders.below(tmp_path)
    folders.create()
    return Inbox(folders, quiet_s=1.0, max_bytes=1000, clock=clock)


def drop(inbox: Inbox, name: str, text: str = "<a/>") -> Path:
    path = inbox.folders.inbox / name
    path.write_text(text)
    return path


def test_file_is_taken_after_quiet_time(inbox: Inbox, clock: Clock) -> None:
    drop(inbox, "a.xml")

    first = inbox.claim()
    clock.now += 1.0
    second = inbox.claim()

    assert first is None
    assert second is not None
    assert second.path == inbox.folders.working / "a.xml"
    assert not second.left_over
    assert not list(inbox.folders.inbox.iterdir())


def test_growing_file_starts_its_quiet_time_again(inbox: Inbox, clock: Clock) -> None:
    path = drop(inbox, "a.xml")
    inbox.claim()
    clock.now += 0.9
    path.write_text("<a>more</a>")

    inbox.claim()
    clock.now += 0.9

    assert inbox.claim() is None
    clock.now += 0.2
    assert inbox.claim() is not None


def test_same_size_rewrite_is_noticed(inbox: Inbox, clock: Clock) -> None:
    path = drop(inbox, "a.xml")
    inbox.claim()
    path.write_text("<b/>")
    os.utime(path, ns=(1, 2))

    clock.now += 1.0

    assert inbox.claim() is None


def test_oldest_file_comes_first(inbox: Inbox, clock: Clock) -> None:
    for name, seconds in (("b.xml", 10), ("a.xml", 20)):
        os.utime(drop(inbox, name), (seconds, seconds))
    inbox.claim()
    clock.now += 1.0

    claimed = inbox.claim()

    assert claimed is not None
    assert claimed.path.name == "b.xml"


def test_claim_of_interrupted_run_comes_first(inbox: Inbox) -> None:
    (inbox.folders.working / "old.xml").write_text("<a/>")

    claimed = inbox.claim()

    assert claimed is not None
    assert claimed.left_over
    assert claimed.path.name == "old.xml"


def test_hidden_files_and_folders_stay(inbox: Inbox, clock: Clock) -> None:
    drop(inbox, ".part")
    (inbox.folders.inbox / "folder").mkdir()
    inbox.claim()
    clock.now += 5.0

    assert inbox.claim() is None


def test_name_in_use_is_never_overwritten(inbox: Inbox) -> None:
    (inbox.folders.done / "a.xml").write_text("old")
    claimed = inbox.folders.working / "a.xml"
    claimed.write_text("new")

    target = inbox.finish(claimed, "done")

    assert target.name == "a-2.xml"
    assert (inbox.folders.done / "a.xml").read_text() == "old"
    assert target.read_text() == "new"


def test_failed_file_has_its_reason_beside_it(inbox: Inbox) -> None:
    claimed = inbox.folders.working / "a.xml"
    claimed.write_text("nonsense")

    target = inbox.finish(claimed, "failed", "line 1: not XML")

    reason = target.with_name("a.xml.reason.txt")
    assert reason.read_text() == "line 1: not XML\n"
    assert target.read_text() == "nonsense"


@pytest.mark.parametrize(
    ("text", "message"),
    [("", "the file is empty; export it again"), ("x" * 1001, "1001 bytes, more than")],
)
def test_unusable_content_is_refused_by_name(
    inbox: Inbox, text: str, message: str
) -> None:
    path = inbox.folders.working / "a.xml"
    path.write_text(text)

    with pytest.raises(InputError, match=f"a.xml: .*{message}"):
        inbox.read(path)


def test_symbolic_link_is_never_followed(inbox: Inbox, tmp_path: Path) -> None:
    secret = tmp_path / "secret"
    secret.write_text("secret")
    link = inbox.folders.working / "a.xml"
    link.symlink_to(secret)

    with pytest.raises(InputError, match="cannot be opened"):
        inbox.read(link)


def test_fifo_does_not_block_the_inbox(inbox: Inbox) -> None:
    fifo = inbox.folders.working / "a.xml"
    os.mkfifo(fifo)

    with pytest.raises(InputError, match="not a regular file"):
        inbox.read(fifo)


def test_missing_inbox_folder_says_what_to_do(inbox: Inbox) -> None:
    inbox.folders.inbox.rmdir()

    with pytest.raises(InputError, match="create the folder or correct"):
        inbox.claim()
