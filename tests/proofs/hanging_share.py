"""A share that hangs when it is told to: a folder seen through FUSE.

Usage: python -m tests.proofs.hanging_share BEHIND MOUNT HANG

While the file HANG exists, every operation waits, as on a share whose server is gone.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

LIMIT_S = 30.0
MARK = "this is the share"


def main(behind: str, mount: str, hang: str) -> None:
    """Serve the folder until it is unmounted."""
    from mfusepy import FUSE, Operations

    def there(path: str) -> str:
        """Where a path of the share lies, once the share answers."""
        while os.path.exists(hang):  # noqa: PTH110
            time.sleep(0.01)
        return behind + path

    class Share(Operations):  # type: ignore[misc]
        use_ns = True

        def getattr(self, path: str, fh: int | None = None) -> dict[str, Any]:
            found = os.lstat(there(path))
            names = ("st_mode", "st_nlink", "st_uid", "st_gid", "st_size", "st_ino")
            times = ("st_atime", "st_mtime", "st_ctime")
            return {name: getattr(found, name) for name in names} | {
                name: getattr(found, f"{name}_ns") for name in times
            }

        def readdir(self, path: str, fh: int) -> list[str]:
            return [".", "..", *os.listdir(there(path))]  # noqa: PTH208

        def create(self, path: str, mode: int, fi: Any = None) -> int:
            return os.open(there(path), os.O_RDWR | os.O_CREAT | os.O_EXCL, mode)

        def open(self, path: str, flags: int) -> int:
            return os.open(there(path), flags)

        def read(self, path: str, size: int, offset: int, fh: int) -> bytes:
            there(path)
            return os.pread(fh, size, offset)

        def write(self, path: str, data: bytes, offset: int, fh: int) -> int:
            there(path)
            return os.pwrite(fh, data, offset)

        def fsync(self, path: str, datasync: int, fh: int) -> None:
            there(path)
            os.fsync(fh)

        def fsyncdir(self, path: str, datasync: int, fh: int) -> None:
            descriptor = os.open(there(path), os.O_RDONLY)
            os.fsync(descriptor)
            os.close(descriptor)

        def release(self, path: str, fh: int) -> None:
            os.close(fh)

        def rename(self, old: str, new: str) -> None:
            os.rename(there(old), there(new))  # noqa: PTH104

        def unlink(self, path: str) -> None:
            os.unlink(there(path))  # noqa: PTH108

        def mkdir(self, path: str, mode: int) -> None:
            os.mkdir(there(path), mode)  # noqa: PTH102

        def chmod(self, path: str, mode: int) -> None:
            os.chmod(there(path), mode)  # noqa: PTH101

    FUSE(Share(), mount, foreground=True)


@contextmanager
def mounted(root: Path) -> Iterator[tuple[Path, Path]]:
    """The folder of the share, and the file that makes it hang."""
    if not os.access("/dev/fuse", os.W_OK) or not shutil.which("fusermount3"):
        pytest.skip("no FUSE for this user here")
    behind, mount, hang = root / "behind", root / "mount", root / "hang"
    for folder in (behind, mount):
        folder.mkdir(parents=True)
    (behind / MARK).touch()
    command = [sys.executable, "-m", __name__, *map(str, (behind, mount, hang))]
    share = subprocess.Popen(command, cwd=Path(__file__).parents[2])
    try:
        deadline = time.monotonic() + LIMIT_S
        while not mount.is_mount():
            if share.poll() is not None or time.monotonic() > deadline:
                pytest.skip("no FUSE file system can be mounted here")
            time.sleep(0.02)
        # Whatever is written there must not land anywhere else.
        assert [one.name for one in mount.iterdir()] == [MARK]
        (behind / MARK).unlink()
        yield mount, hang
    finally:
        hang.unlink(missing_ok=True)
        subprocess.run(["umount", "-l", mount], check=False)
        share.wait(LIMIT_S)


if __name__ == "__main__":
    main(*sys.argv[1:])
