"""Systems whose force is a function: of Python, or compiled and known by its address.

A compiled function never takes the GIL. A Python function gets arrays that look into the library's own memory; they
are made once, and hold what they show only during the call.
"""
from __future__ import annotations

import ctypes
import time
from typing import Any, Callable, Optional, Sequence

import numpy as np

from ._motus import ffi, lib
from .calls import Watch, check, keep_failure, new, new_error

TIMED = 64

#: What a compiled force is, for ``numba.cfunc``: (context, t, x, v, a) -> status.
signature = "int32(voidptr, float64, CPointer(float64), CPointer(float64), CPointer(float64))"


def address_of(function: Any) -> Optional[int]:
    """Returns the address of a compiled function: of numba's cfunc, SciPy's LowLevelCallable, cffi, ctypes, or a plain
    number. None: it is a function of Python."""
    if isinstance(function, (int, np.integer)) and not isinstance(function, bool):
        return int(function)
    if isinstance(function, ffi.CData):
        return int(ffi.cast("uintptr_t", function))
    if isinstance(function, ctypes._CFuncPtr):
        return ctypes.cast(function, ctypes.c_void_p).value
    if type(function).__name__ == "LowLevelCallable":
        return address_of(function.function) if not isinstance(function.function, str) else None
    address = getattr(function, "address", None)
    return address if isinstance(address, int) else None


class Views(dict):
    """Arrays over the library's memory, by pointer, each made once."""

    def __init__(self, count: int) -> None:
        super().__init__()
        self.count = count

    def __missing__(self, at: Any) -> np.ndarray:
        made = np.frombuffer(ffi.buffer(ffi.cast("double *", at), 8 * self.count), dtype=np.float64)
        if len(self) > 4096:
            self.clear()
        self[at] = made
        return made


class Force(Watch):
    """The callbacks of a system in Python, with the exception that one of them has raised."""

    def __init__(self, positions: int, first_order: int, function: Callable[..., Any], events: Sequence[Any],
                 arguments: tuple[Any, ...], progress: Any) -> None:
        super().__init__(progress)
        self.function, self.events, self.arguments = function, events, arguments
        self.x, self.v = Views(positions), Views(positions + first_order)
        self.values = Views(len(events))
        self.moves = positions > 0
        self.rates = positions + first_order
        self.seconds, self.calls = 0.0, 0  # seconds: of every TIMED-th call, which a clock would slow down

    def note(self) -> str:
        seconds = self.seconds * self.calls / -(-self.calls // TIMED) if self.calls else 0
        return f"{self.calls} calls of the function took {seconds:.2g} s" if self.calls else ""


@ffi.def_extern(error=-1, onerror=keep_failure)
def motus_python_acceleration(context: Any, t: float, x: Any, v: Any, a: Any) -> int:
    force = ffi.from_handle(context)
    timed = force.calls % TIMED == 0
    force.calls += 1
    begun = time.perf_counter() if timed else 0.0
    if force.moves:
        rate = force.function(t, force.x[x], force.v[v], *force.arguments)
    else:
        rate = force.function(t, force.v[v], *force.arguments)
    if type(rate) is tuple or type(rate) is list:
        a[0 : force.rates] = rate
    else:
        force.v[a][:] = rate
    if timed:
        force.seconds += time.perf_counter() - begun
    return 0


@ffi.def_extern(error=-1, onerror=keep_failure)
def motus_python_functions(context: Any, t: float, x: Any, v: Any, values: Any) -> int:
    force = ffi.from_handle(context)
    out, state = force.values[values], force.v[v]
    for k, event in enumerate(force.events):
        if force.moves:
            out[k] = event(t, force.x[x], state, *force.arguments)
        else:
            out[k] = event(t, state, *force.arguments)
    return 0


class System:
    """A system of the library, with what must live as long as it."""

    def __init__(self, function: Any, start: float, x: np.ndarray, v: np.ndarray, *, events: Sequence[Any] = (),
                 arguments: tuple[Any, ...] = (), reads_velocity: bool = True, progress: Any = None) -> None:
        self.positions, self.first_order = len(x), len(v) - len(x)
        address = address_of(function)
        if address is None and not callable(function):
            raise TypeError(f"the force is {type(function).__name__}: a text, a function, or the address of one is wanted")
        if address is not None and arguments:
            raise TypeError("args are handed to functions of Python; a compiled one has its numbers in its own memory")
        self.force = Force(self.positions, self.first_order, function, events, arguments, progress)
        definition, err, made = new("callback_def"), new_error(), ffi.new("motus_system **")
        names = [f"x{k + 1}" for k in range(self.positions)] + [f"y{k + 1}" for k in range(self.first_order)]
        self.kept: list[Any] = [ffi.new("char[]", name.encode()) for name in names]
        self.kept += [ffi.new("char *[]", self.kept[:]), x, v]
        definition.names = self.kept[len(names)]
        definition.positions, definition.first_order, definition.start = self.positions, self.first_order, start
        definition.x = ffi.from_buffer("double[]", x) if len(x) else ffi.NULL
        definition.v = ffi.from_buffer("double[]", v)
        kind = ffi.typeof("int (*)(void *, double, const double *, const double *, double *)")
        definition.acceleration = ffi.cast(kind, address) if address is not None else lib.motus_python_acceleration
        definition.depends_on_velocity = reads_velocity
        definition.context = self.force.handle
        if events:
            rows = ffi.new("motus_event_def[]", len(events))
            for row, event in zip(rows, events):
                direction = getattr(event, "direction", 0)
                row.direction = (direction > 0) - (direction < 0)
                row.stop = int(getattr(event, "terminal", False))
            self.kept.append(rows)
            definition.events, definition.event_count = rows, len(events)
            definition.event_functions = lib.motus_python_functions
        check(lib.motus_system_from_callback(definition, made, err), err)
        self.system = ffi.gc(made[0], lib.motus_system_destroy)
