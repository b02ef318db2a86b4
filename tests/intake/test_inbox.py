"""The inbox against real files."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest

from paintlink.errors import InputError
from paintlink.intake import Inbox, InboxFolders
from paintlink.intake import inbox as inbox_module
from paintlink.intake.safe import open_beneath, opened_folder


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


def test_rewrite_between_look_and_claim_is_noticed(inbox: Inbox, clock: Clock) -> None:
    drop(inbox, "a.xml")
    path = drop(inbox, "b.xml")
    inbox.claim()
    clock.now += 1.0
    first = inbox.claim()
    assert first is not None
    inbox.finish(first.path, "done")

    path.write_text("<longer/>")

    assert inbox.claim() is None


def test_any_number_of_files_costs_the_memory_of_a_few(
    inbox: Inbox, clock: Clock, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(inbox_module, "WATCHED_AT_ONCE", 5)
    for number in range(23):
        drop(inbox, f"{number}.xml")
    taken = set()
    for _ in range(60):
        claimed = inbox.claim()
        assert len(inbox._seen) <= 5
        if claimed is None:
            clock.now += 1.0
        else:
            taken.add(inbox.finish(claimed.path, "done").name)

    assert len(taken) == 23


def test_share_that_is_not_connected_is_no_empty_folder(
    tmp_path: Path, clock: Clock
) -> None:
    folders = InboxFolders.below(tmp_path)
    folders.create()
    inbox = Inbox(folders, quiet_s=1.0, max_bytes=1000, clock=clock, share=True)
    drop(inbox, "a.xml")

    with pytest.raises(InputError, match="the share is not connected; mount it"):
        inbox.claim()
    (folders.inbox / ".paintlink-share").touch()
    inbox.claim()
    clock.now += 1.0

    assert inbox.claim() is not None


def test_hard_link_is_refused(inbox: Inbox, tmp_path: Path) -> None:
    secret = tmp_path / "secret"
    secret.write_text("secret")
    link = inbox.folders.working / "a.xml"
    link.hardlink_to(secret)

    with pytest.raises(InputError, match="a hard link to a file elsewhere"):
        inbox.read(link)


def test_growing_file_is_read_up_to_the_limit_only(inbox: Inbox) -> None:
    path = inbox.folders.working / "a.xml"
    path.write_text("x" * 1000)

    assert len(inbox.read(path)) == 1000


@pytest.mark.parametrize("name", ["../secret", "dir/secret", "", ".", ".."])
def test_only_entries_of_the_folder_can_be_opened(tmp_path: Path, name: str) -> None:
    with opened_folder(tmp_path) as folder_fd, pytest.raises(OSError, match="entry"):
        open_beneath(name, folder_fd)


def test_without_openat2_links_are_refused_too(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("platform.system", lambda: "elsewhere")
    (tmp_path / "link").symlink_to("/etc/hostname")

    with opened_folder(tmp_path) as folder_fd, pytest.raises(OSError, match="link"):
        open_beneath("link", folder_fd)


SWAPPER = """
import ctypes, os, sys
os.chdir(sys.argv[1])
EXCHANGE, HERE = 2, -100
swap = ctypes.CDLL(None).renameat2
for _ in range(10000):
    swap(HERE, b"a.xml", HERE, b"link", EXCHANGE)
"""


def test_swapping_file_and_link_never_shows_the_canary(
    inbox: Inbox, tmp_path: Path
) -> None:
    canary = tmp_path / "canary"
    canary.write_text("canary")
    working = inbox.folders.working
    (working / "a.xml").write_text("plain")
    (working / "link").symlink_to(canary)
    command = [sys.executable, "-c", SWAPPER, str(working)]
    read = []
    with subprocess.Popen(command) as swapper:
        while swapper.poll() is None:
            with suppress(InputError):
                read.append(inbox.read(working / "a.xml"))

    assert swapper.returncode == 0
    assert b"plain" in read
    assert b"canary" not in read


def test_busy_file_is_tried_again_before_it_fails(inbox: Inbox, clock: Clock) -> None:
    drop(inbox, "a.xml")
    inbox.claim()
    clock.now += 1.0
    claimed = inbox.claim()
    assert claimed is not None

    first = inbox.postpone(claimed.path, patience_s=10.0)
    at_once = inbox.claim()
    clock.now += 2.0
    later = inbox.claim()
    clock.now += 10.0
    at_last = inbox.postpone(claimed.path, patience_s=10.0)

    assert (first, at_once, at_last) == (True, None, False)
    assert later == claimed


@pytest.fixture
def far_inbox(tmp_path: Path, clock: Clock) -> Iterator[Inbox]:
    """An inbox on another file system than the folders behind it."""
    if os.geteuid() != 0:
        pytest.skip("needs root, to mount a second file system")
    share = tmp_path / "share"
    share.mkdir()
    subprocess.run(["mount", "-t", "tmpfs", "tmpfs", share], check=True)
    folders = InboxFolders.below(tmp_path / "site", share)
    folders.create()
    yield Inbox(folders, quiet_s=1.0, max_bytes=1000, clock=clock)
    subprocess.run(["umount", share], check=True)


def test_file_is_carried_over_from_another_file_system(
    far_inbox: Inbox, clock: Clock
) -> None:
    drop(far_inbox, "a.xml", "<far/>")
    far_inbox.claim()
    clock.now += 1.0

    claimed = far_inbox.claim()

    assert claimed is not None
    assert far_inbox.read(claimed.path) == b"<far/>"
    assert far_inbox.finish(claimed.path, "done").name == "a.xml"
    assert [one.name for one in far_inbox.folders.inbox.iterdir()] == [".paintlink"]


def test_interrupted_carrying_goes_on(far_inbox: Inbox) -> None:
    aside = far_inbox.folders.inbox / ".paintlink"
    aside.mkdir()
    (aside / "a.xml").write_text("<far/>")
    (far_inbox.folders.working / ".a.xml.part").write_text("<fa")

    claimed = far_inbox.claim()

    assert claimed is not None
    assert claimed.left_over
    assert far_inbox.read(claimed.path) == b"<far/>"
    assert list(aside.iterdir()) == []
