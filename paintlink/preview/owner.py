"""One thread that owns something no other thread may touch."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from concurrent.futures import Future
from queue import SimpleQueue
from typing import Generic, TypeVar

from paintlink.errors import PreviewError

Owned = TypeVar("Owned")
Answer = TypeVar("Answer")


class Owner(Generic[Owned]):
    """Makes a thing in a thread of its own and lends it there, one job at a time.

    The thread is a daemon: a driver that hangs must not keep the program from ending.

    Parameters
    ----------
    make
        Called once, in the thread; its error answers every later job.
    """

    def __init__(self, make: Callable[[], Owned]) -> None:
        self._process = os.getpid()
        self._hangs = False
        self._jobs: SimpleQueue[Callable[[], None]] = SimpleQueue()
        self._made: Future[Owned] = Future()
        thread = threading.Thread(target=self._serve, name="paintlink-gl", daemon=True)
        thread.start()
        self._jobs.put(lambda: _answer(self._made, make))

    def lend(self, job: Callable[[Owned], Answer], *, timeout_s: float) -> Answer:
        """Answer of ``job``, run with the owned thing in its thread.

        Raises
        ------
        PreviewError
            When the thing or the answer could not be had, for whatever reason.
        """
        if os.getpid() != self._process:
            msg = "this process was forked from one that used OpenGL: start it afresh"
            raise PreviewError(msg)
        if self._hangs:
            msg = "OpenGL hangs since an earlier picture: restart the program"
            raise PreviewError(msg)
        answer: Future[Answer] = Future()
        self._jobs.put(lambda: _answer(answer, lambda: job(self._made.result())))
        return self._settled(answer, timeout_s)

    def _serve(self) -> None:
        while True:
            self._jobs.get()()

    def _settled(self, future: Future[Answer], timeout_s: float) -> Answer:
        try:
            error = future.exception(timeout_s)
        except TimeoutError as late:
            self._hangs = True
            msg = f"OpenGL gave no answer within {timeout_s:g} s"
            raise PreviewError(msg) from late
        if error is None:
            return future.result()
        msg = str(error) or type(error).__name__
        raise PreviewError(msg) from error


def _answer(future: Future[Answer], job: Callable[[], Answer]) -> None:
    """Run the job; the future carries its answer, or whatever went wrong."""
    try:
        future.set_result(job())
    except Exception as error:  # noqa: BLE001 (drivers raise plain exceptions)
        future.set_exception(error)
