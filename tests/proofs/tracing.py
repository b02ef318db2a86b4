"""A forked child stopped at each of its system calls, to kill it there or to fail it.

strace counts calls per system call and per thread, and starts an interpreter for each
point. Here one number counts every call of the child's one thread, in the order they
are made, and a point costs a fork.
"""

from __future__ import annotations

import ctypes
import errno
import os
import platform
import signal
import struct
import traceback
from collections.abc import Callable
from typing import NamedTuple

import pytest

SYSCALLS = {
    1: "write", 2: "open", 18: "pwrite64", 20: "writev", 40: "sendfile", 74: "fsync",
    75: "fdatasync", 77: "ftruncate", 82: "rename", 83: "mkdir", 84: "rmdir",
    86: "link", 87: "unlink", 88: "symlink", 91: "fchmod", 257: "openat",
    258: "mkdirat", 263: "unlinkat", 264: "renameat", 265: "linkat", 268: "fchmodat",
    280: "utimensat", 316: "renameat2", 326: "copy_file_range", 437: "openat2",
}  # fmt: skip
"""Those of x86-64 that change a disk, or open what will."""

REACHING = {
    2: ("open", 0), 257: ("openat", 1), 437: ("openat2", 1), 41: ("socket", -1),
    42: ("connect", -1), 59: ("execve", 0), 322: ("execveat", 1), 56: ("clone", -1),
    57: ("fork", -1), 58: ("vfork", -1), 435: ("clone3", -1), 44: ("sendto", -1),
}  # fmt: skip
"""Calls that reach out, and the place of the path among their arguments."""

TRACEME, CONT, SYSCALL, KILL = 0, 7, 24, 8
SETOPTIONS, SYSCALL_INFO, GETREGS, SETREGS = 0x4200, 0x420E, 12, 13
TRACESYSGOOD, EXITKILL = 1, 1 << 20
ENTRY = 1
STOPPED_AT_CALL = signal.SIGTRAP | 0x80
REGISTERS = 27 * 8
RAX, ORIG_RAX = 10, 15

_libc = ctypes.CDLL(None, use_errno=True)
_ptrace = _libc.ptrace
_ptrace.argtypes = [ctypes.c_long, ctypes.c_long, ctypes.c_void_p, ctypes.c_void_p]
_ptrace.restype = ctypes.c_long

needs_tracing = pytest.mark.skipif(
    platform.machine() != "x86_64" or platform.system() != "Linux",
    reason="stopping at system calls is written for Linux on x86-64",
)


class Run(NamedTuple):
    """What became of a child: its calls, and how it ended (None: it was killed)."""

    calls: tuple[str, ...]
    status: int | None


def traced(
    work: Callable[[], None],
    *,
    kill_at: int | None = None,
    fail: tuple[str, int, int] | None = None,
    each: Callable[[], None] = lambda: None,
    reach: Callable[[str, str], None] | None = None,
    before_kill: Callable[[], None] = lambda: None,
) -> Run:
    """Run work in a child, whose calls that matter are counted from 1.

    Parameters
    ----------
    kill_at
        Number of the call on whose entry the child is killed.
    fail
        Name of a call, which use of it (from 1), and the errno it gives instead.
    each
        Called at each of those calls, the child standing still.
    reach
        Told of every call that opens, connects or executes something, with the path.
    before_kill
        Called at the call of the kill, before the child is gone.
    """
    child = os.fork()
    if child == 0:
        _child(work)
    return _follow(child, kill_at, fail, each, reach, before_kill)


def _child(work: Callable[[], None]) -> None:
    code = 70
    try:
        _ptrace(TRACEME, 0, None, None)
        os.kill(os.getpid(), signal.SIGSTOP)
        work()
        code = 0
    except SystemExit as end:
        code = int(end.code or 0)
    except BaseException:  # noqa: BLE001 - the child must end here
        if os.environ.get("PAINTLINK_TEST_SHOW_CHILD"):
            traceback.print_exc()
    finally:
        os._exit(code)


def _follow(
    child: int,
    kill_at: int | None,
    fail: tuple[str, int, int] | None,
    each: Callable[[], None],
    reach: Callable[[str, str], None] | None,
    before_kill: Callable[[], None],
) -> Run:
    calls: list[str] = []
    os.waitpid(child, 0)
    _check(_ptrace(SETOPTIONS, child, None, TRACESYSGOOD | EXITKILL))
    passed_on, failing = 0, False
    while True:
        _check(_ptrace(SYSCALL, child, None, passed_on))
        _, status = os.waitpid(child, 0)
        if os.WIFEXITED(status):
            return Run(tuple(calls), os.WEXITSTATUS(status))
        if os.WIFSIGNALED(status):
            return Run(tuple(calls), None)
        passed_on = 0
        if os.WSTOPSIG(status) != STOPPED_AT_CALL:
            passed_on = os.WSTOPSIG(status)
            continue
        kind, number, arguments = _info(child)
        if kind != ENTRY:
            if failing and fail is not None:
                _set(child, RAX, -fail[2])
                failing = False
            continue
        if reach is not None and number in REACHING:
            call, argument = REACHING[number]
            reach(call, _text(child, arguments[argument]) if argument >= 0 else "")
        name = SYSCALLS.get(number)
        if name is None:
            continue
        calls.append(name)
        each()
        if len(calls) == kill_at:
            before_kill()
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)
            return Run(tuple(calls), None)
        if fail and name == fail[0] and calls.count(name) == fail[1]:
            _set(child, ORIG_RAX, -1)
            failing = True


def _info(child: int) -> tuple[int, int, tuple[int, ...]]:
    """Whether a call begins, its number and its arguments."""
    buffer = ctypes.create_string_buffer(88)
    _check(_ptrace(SYSCALL_INFO, child, len(buffer), ctypes.addressof(buffer)))
    kind = buffer.raw[0]
    if kind != ENTRY:
        return kind, -1, ()
    number, *arguments = struct.unpack_from("=7Q", buffer.raw, 24)
    return kind, number, tuple(arguments)


def _text(child: int, address: int) -> str:
    """A path in the memory of the child."""
    with open(f"/proc/{child}/mem", "rb", buffering=0) as memory:  # noqa: PTH123
        memory.seek(address)
        return memory.read(4096).split(b"\0", 1)[0].decode(errors="replace")


def _set(child: int, register: int, value: int) -> None:
    buffer = (ctypes.c_longlong * 27)()
    _check(_ptrace(GETREGS, child, None, ctypes.addressof(buffer)))
    buffer[register] = value
    _check(_ptrace(SETREGS, child, None, ctypes.addressof(buffer)))


def _check(result: int) -> None:
    if result < 0:
        code = ctypes.get_errno()
        if code == errno.EPERM:
            pytest.skip("this machine lets nobody trace")
        raise OSError(code, os.strerror(code))
