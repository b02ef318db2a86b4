"""File systems that lose their power, run full, or hang when they are told to."""

from __future__ import annotations

import fcntl
import os
import shutil
import struct
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

SHUTDOWN = 0x8004587D  # _IOR('X', 125, u32), the same for ext4 and xfs
WITHOUT_FLUSHING_THE_LOG = 2
SIZES_MIB = {"ext4": 48, "xfs": 320}
OPTIONS = {"ext4": ["-q", "-F"], "xfs": ["-q", "-f"]}


class Disk:
    """A file system in a file, whose power can be cut."""

    def __init__(self, root: Path, kind: str) -> None:
        if os.geteuid() != 0 or shutil.which(f"mkfs.{kind}") is None:
            pytest.skip(f"cutting off a disk needs root and mkfs.{kind}")
        root.mkdir(parents=True)
        self.kind, self.image, self.place = kind, root / "image", root / "disk"
        self.place.mkdir()
        with self.image.open("wb") as image:
            image.truncate(SIZES_MIB[kind] << 20)
        subprocess.run([f"mkfs.{kind}", *OPTIONS[kind], self.image], check=True)
        self.mount()

    def mount(self) -> None:
        command = ["mount", "-o", "loop", self.image, self.place]
        if subprocess.run(command, check=False).returncode:
            pytest.skip("no loop device can be mounted here")

    def unmount(self) -> None:
        """Unmount; just after a shutdown the disk is busy for some milliseconds."""
        for _ in range(100):
            done = subprocess.run(
                ["umount", self.place], capture_output=True, check=False
            )
            if done.returncode == 0:
                return
            time.sleep(0.02)
        raise OSError(f"{self.place} stays busy: {done.stderr.decode()}")

    def cut(self) -> None:
        """Lose everything that was not synced, directory entries too."""
        descriptor = os.open(self.place, os.O_RDONLY)
        try:
            fcntl.ioctl(
                descriptor, SHUTDOWN, struct.pack("I", WITHOUT_FLUSHING_THE_LOG)
            )
        finally:
            os.close(descriptor)

    def power_on(self) -> None:
        self.unmount()
        self.mount()


@contextmanager
def disks(root: Path, kind: str, *names: str) -> Iterator[list[Disk]]:
    made: list[Disk] = []
    try:
        for name in names:
            made.append(Disk(root / name, kind))
        yield made
    finally:
        for disk in made:
            disk.unmount()
