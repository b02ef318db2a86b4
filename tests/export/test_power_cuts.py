"""The exporter killed and, at the same instant, the disk of the folder cut off.

The shutdown call of ext4 loses everything that was not synced, directory entries too.
The journal lies on another disk, as in a shop: on the same one its syncs would hide a
missing sync of the folder.
"""

from __future__ import annotations

import fcntl
import os
import shutil
import struct
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from paintlink.export.folders import opened
from tests.export.exporting import Place, calls_of_the_work, traced

EXT4_IOC_SHUTDOWN = 0x8004587D
WITHOUT_FLUSHING_THE_LOG = 2

pytestmark = [
    pytest.mark.proof,
    pytest.mark.timeout(900),
    pytest.mark.skipif(
        os.geteuid() != 0
        or not shutil.which("mkfs.ext4")
        or not shutil.which("strace"),
        reason="cutting off a disk needs root, mkfs.ext4 and strace",
    ),
]


class Disk:
    """An ext4 file system that loses its power when told to."""

    def __init__(self, image: Path, place: Path) -> None:
        self.image = image
        self.place = place

    def mount(self) -> None:
        subprocess.run(["mount", "-o", "loop", self.image, self.place], check=True)

    def unmount(self) -> None:
        subprocess.run(["umount", self.place], check=True)

    def folder(self, name: str) -> Path:
        """A folder that was there long before the power went."""
        (self.place / name).mkdir()
        with opened(self.place) as fd:
            os.fsync(fd)
        return self.place / name

    def cut(self) -> None:
        with opened(self.place) as fd:
            how = struct.pack("I", WITHOUT_FLUSHING_THE_LOG)
            fcntl.ioctl(fd, EXT4_IOC_SHUTDOWN, how)
        self.unmount()
        self.mount()


@contextmanager
def mounted_disk(root: Path) -> Iterator[Disk]:
    root.mkdir()
    disk = Disk(root / "image", root / "disk")
    disk.place.mkdir()
    with disk.image.open("wb") as image:
        image.truncate(48 << 20)
    subprocess.run(["mkfs.ext4", "-q", "-F", disk.image], check=True)
    try:
        disk.mount()
    except subprocess.CalledProcessError:
        pytest.skip("no loop device can be mounted here")
    try:
        yield disk
    finally:
        disk.unmount()


@pytest.fixture
def disk(tmp_path: Path) -> Iterator[Disk]:
    with mounted_disk(tmp_path / "power") as disk:
        yield disk


@pytest.mark.parametrize("call", ["fdatasync", "fsync", "renameat2", "write"])
def test_no_power_cut_loses_or_tears(tmp_path: Path, disk: Disk, call: str) -> None:
    points = calls_of_the_work(call, tmp_path)
    for at in points:
        place = Place(tmp_path / str(at), folder=disk.folder(str(at)))

        place.export_unwatched(*traced(call, f"{call}:signal=KILL:when={at}"))
        disk.cut()
        recovered = place.export_unwatched()
        disk.cut()
        place.consumer.take()

        assert recovered == 0
        assert (place.consumer.lost(), place.consumer.torn) == ([], [])
        assert place.consumer.doubled() == []
    assert len(points) >= 6


def test_power_cut_after_recovery_loses_nothing(tmp_path: Path, disk: Disk) -> None:
    place = Place(tmp_path / "place", folder=disk.folder("hot"))
    after_the_last_rename = calls_of_the_work("fsync", tmp_path)[-2]
    kill = f"fsync:signal=KILL:when={after_the_last_rename}"

    killed = place.export_unwatched(*traced("fsync", kill))
    place.export_unwatched()
    disk.cut()
    place.consumer.take()

    assert killed != 0
    assert (place.consumer.lost(), place.consumer.doubled()) == ([], [])
