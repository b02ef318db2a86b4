"""One system call: a rename that never replaces."""

from __future__ import annotations

import ctypes
import errno
import os

from paintlink.export.folders import exists

RENAME_NOREPLACE = 1
NOT_OFFERED = {errno.EINVAL, errno.ENOSYS, errno.EOPNOTSUPP}

_libc = ctypes.CDLL(None, use_errno=True)


def rename_noreplace(source: str, source_fd: int, target: str, target_fd: int) -> None:
    """Move an entry to another folder of the same file system in one step.

    Where the file system offers no such rename (NFS, some FUSE and guest shares), the
    target is looked for first and the plain rename follows. That leaves an instant in
    which a foreign file of the same name could be replaced. Link and unlink would not,
    but a kill between the two leaves a second entry that the next start would publish
    again.

    Raises
    ------
    FileExistsError
        When the target is there already.
    """
    result = _libc.renameat2(
        source_fd,
        os.fsencode(source),
        target_fd,
        os.fsencode(target),
        RENAME_NOREPLACE,
    )
    if result == 0:
        return
    code = ctypes.get_errno()
    if code not in NOT_OFFERED:
        raise OSError(code, os.strerror(code), target)
    if exists(target, target_fd):
        raise FileExistsError(errno.EEXIST, os.strerror(errno.EEXIST), target)
    os.rename(source, target, src_dir_fd=source_fd, dst_dir_fd=target_fd)
