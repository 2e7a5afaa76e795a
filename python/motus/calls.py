"""Calls of the library: their errors as exceptions, their interrupts, and who uses a handle.

Invariant: a call that computes gives up the GIL, and comes back about every 10 ms to see whether the user has pressed
Ctrl-C; an exception there, or in a callback, ends the call and is raised again by it.
"""
from __future__ import annotations

import threading
from typing import Any, Callable, Optional

from ._motus import ffi, lib
from .errors import error_of

OK = lib.MOTUS_OK


def new_error() -> Any:
    err = ffi.new("motus_error *")
    err[0] = lib.motus_default_error()
    return err


def new(kind: str) -> Any:
    """Makes a definition or a struct to fill, ``new("run_def")``, with its defaults."""
    short = kind[:-4] if kind.endswith("_def") else kind
    made = ffi.new(f"motus_{kind} *")
    made[0] = getattr(lib, f"motus_default_{short}")()
    return made


def check(status: int, err: Any) -> None:
    if status != OK:
        raise error_of(err)


def strings(values: Any) -> tuple[Any, list[Any]]:
    """Returns an array of C strings, and what keeps them alive."""
    kept = [ffi.new("char[]", v.encode("utf-8")) for v in values]
    return ffi.new("char *[]", kept), kept


class Watch:
    """What a computing call comes back to.

    Args:
        progress: called with the part that is done, 0 to 1; a true value cancels the call.
    """

    def __init__(self, progress: Optional[Callable[[float], Any]] = None) -> None:
        self.progress = progress
        self.failure: Optional[BaseException] = None
        self.handle = ffi.new_handle(self)

    def put(self, definition: Any) -> None:
        """Puts itself into a definition with `progress` and `context`."""
        definition.progress = lib.motus_python_progress
        definition.context = self.handle

    def check(self, status: int, err: Any) -> None:
        """Raises what failed in a call: the exception of a callback before the library's own."""
        failure, self.failure = self.failure, None
        if failure is not None:
            raise failure
        check(status, err)


def keep_failure(_type: Any, failure: BaseException, trace: Any) -> None:
    """Keeps an exception of a callback for the call that it ends."""
    frame = trace
    while frame is not None and "context" not in frame.tb_frame.f_locals:
        frame = frame.tb_next
    if frame is not None:
        ffi.from_handle(frame.tb_frame.f_locals["context"]).failure = failure.with_traceback(trace)


@ffi.def_extern(error=-1, onerror=keep_failure)
def motus_python_progress(context: Any, fraction: float) -> int:
    watch = ffi.from_handle(context)
    return 1 if watch.progress is not None and watch.progress(fraction) else 0


class Using:
    """Lets one thread at a time use a handle; a second one gets a RuntimeError."""

    def __init__(self, what: str) -> None:
        self.what, self.lock = what, threading.Lock()

    def __enter__(self) -> None:
        if not self.lock.acquire(blocking=False):
            raise RuntimeError(f"another thread uses this {self.what}: give each thread its own, by copy.copy")

    def __exit__(self, *_: Any) -> None:
        self.lock.release()
