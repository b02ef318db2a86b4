"""What kind of file system a folder lies on, asked of the kernel."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

MOUNTS = Path("/proc/self/mountinfo")

# Files appear here without events, and locks and syncs mean less than on a disk.
NETWORK_TYPES = frozenset({
    "9p", "afs", "ceph", "cifs", "coda", "fuse.sshfs", "fuse.glusterfs", "fuse.s3fs",
    "fuse.rclone", "fuse.smbnetfs", "fuse.gvfsd-fuse", "glusterfs", "lustre", "ncpfs",
    "nfs", "nfs4", "ocfs2", "gfs2", "smb2", "smb3", "smbfs", "vboxsf", "vmhgfs",
    "fuse.vmhgfs-fuse", "virtiofs",
})  # fmt: skip


class Mount(NamedTuple):
    """Where a file system is mounted, and its type as the kernel names it."""

    point: Path
    type: str

    @property
    def is_network(self) -> bool:
        """Whether its files lie on another machine."""
        return self.type in NETWORK_TYPES


def mount_of(folder: Path, table: Path = MOUNTS) -> Mount:
    """The mount that holds a folder; the parents of one that is missing count.

    Where the system has no such table, the type is empty and nothing is known.
    """
    try:
        lines = table.read_text("utf-8", "surrogateescape").splitlines()
    except OSError:
        return Mount(Path("/"), "")
    place = folder.resolve()
    mounts = [_mount(line) for line in lines if line]
    holding = [one for one in mounts if place.is_relative_to(one.point)]
    # The last of several mounts on one point is the one that can be seen.
    longest = max((len(one.point.parts) for one in holding), default=0)
    found = [one for one in holding if len(one.point.parts) == longest]
    return found[-1] if found else Mount(Path("/"), "")


def _mount(line: str) -> Mount:
    fields, _, rest = line.partition(" - ")
    return Mount(Path(_plain(fields.split(" ")[4])), rest.split(" ")[0])


def _plain(text: str) -> str:
    """A path as it is: the kernel writes blanks and backslashes as octal numbers."""
    for code in ("040", "011", "012", "134"):
        text = text.replace(f"\\{code}", chr(int(code, 8)))
    return text
