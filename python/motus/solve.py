"""Equations given as functions: `solve_ivp` with SciPy's signature, and `solve` for second order."""
from __future__ import annotations

import re
from typing import Any, Callable, Optional, Sequence

import numpy as np

from ._motus import ffi, lib
from .callback import System
from .calls import Watch, new, new_error
from .errors import DivergedError, MethodError, StepsError, text
from .model import system_of

#: SciPy's names of methods, and those of the library.
METHODS = {"RK23": "bs32", "RK45": "dopri5", "DOP853": "dop853"}
STIFF = ("Radau", "BDF", "LSODA")


class Result(dict):
    """What a solver found, as attributes and as a dictionary, with SciPy's names: t, y, sol, t_events, y_events, nfev,
    njev, nlu, status, message, success; and besides

    Attributes:
        error: how far each number at the end may be from the exact motion, like y[:, -1]; the motion is computed again,
            with a companion, when this is first read.
        note: what a function of Python took, or "".
    """

    def __getattr__(self, name: str) -> Any:
        if name == "error" and "_bars" in self:
            self["error"] = self.pop("_bars")()
        try:
            return self[name]
        except KeyError:
            raise AttributeError(f"a result has no {name!r}; it has {', '.join(k for k in self if k[0] != '_')}") from None

    def __dir__(self) -> Any:
        return [k for k in self if k[0] != "_"] + ["error"]

    def __repr__(self) -> str:
        return "\n".join(f"{name:>10}: {value!r}" for name, value in self.items() if name[0] != "_")


def method_of(method: Optional[str]) -> str:
    if method is None:
        return "auto"
    if method in STIFF:
        raise MethodError(f"motus has no {method}", hint="for stiff equations take method=\"gauss6\" or \"radau15\"")
    return METHODS.get(method, method)


def started(source: str) -> str:
    """Adds the initial values that a text lacks, since a solver gets them besides."""
    plain = re.sub(r"#.*", "", source)
    lines = []
    for name, primes in dict(re.findall(r"([^\W\d]\w*)(''?)\s*=", plain)).items():
        for at in [f"{name}(0)", f"{name}'(0)"][: len(primes)]:
            if not re.search(rf"(?<!\w){re.escape(at)}", plain):
                lines.append(f"{at} = 0")
    return "\n".join([source.rstrip("\n"), *lines, ""])


class Solver:
    """A problem in the form in which the library takes it: made anew for every run of it."""

    def __init__(self, force: Any, span: Sequence[float], x: np.ndarray, v: np.ndarray, how: dict[str, Any],
                 events: Sequence[Any], arguments: tuple[Any, ...], reads_velocity: bool, progress: Any) -> None:
        self.force, self.x, self.v, self.how, self.events = force, x, v, how, events
        self.start, self.end = float(span[0]), float(span[1])
        self.arguments, self.reads_velocity, self.progress = arguments, reads_velocity, progress

    def begin(self, bars: bool = False) -> tuple[Any, Any, Any]:
        """Returns a run, what it comes back to, and what keeps it alive."""
        run, err, d = ffi.new("motus_run **"), new_error(), new("run_def")
        if isinstance(self.force, str):
            system, watch = system_of(started(self.force), "", []), Watch(self.progress)
            kept: Any = system
            nx = lib.motus_positions(system)
            if len(self.x) == 0 and len(self.v) == nx + lib.motus_velocities(system):
                self.x, self.v = self.v[:nx].copy(), self.v[nx:].copy()
            if lib.motus_positions(system) != len(self.x) or lib.motus_velocities(system) != len(self.v):
                raise ValueError(f"the text has {lib.motus_positions(system)} positions and "
                                 f"{lib.motus_velocities(system)} velocities and first-order variables; the initial "
                                 f"values are {len(self.x)} and {len(self.v)}")
            d.x = ffi.from_buffer("double[]", self.x) if len(self.x) else ffi.NULL
            d.v = ffi.from_buffer("double[]", self.v)
        else:
            kept = System(self.force, self.start, self.x, self.v, events=self.events, arguments=self.arguments,
                          reads_velocity=self.reads_velocity, progress=self.progress)
            system, watch = kept.system, kept.force
        method = ffi.new("char[]", self.how["method"].encode())
        machine = ffi.new("char[]", b"auto")
        d.method, d.machine, d.start, d.until = method, machine, self.start, self.end
        for name in ("step", "tolerance", "accuracy", "longest_step", "absolute"):
            if self.how.get(name) is not None:
                setattr(d, name, self.how[name])
        d.error = lib.MOTUS_BARS_CHEAP if bars else lib.MOTUS_BARS_NONE
        watch.put(d)
        watch.check(lib.motus_run_create(system, d, run, err), err)
        return ffi.gc(run[0], lib.motus_run_destroy), watch, (kept, method, machine)

    def width(self) -> int:
        return len(self.x) + len(self.v)

    def sample(self, times: np.ndarray) -> np.ndarray:
        """Returns the state at times in the direction of the motion, a row for each."""
        run, watch, _kept = self.begin()
        err, columns = new_error(), np.arange(1, 1 + self.width(), dtype=np.uintp)
        out = np.full((len(times), self.width()), np.nan)
        status = lib.motus_run_sample(run, ffi.from_buffer("double[]", times), len(times),
                                      ffi.from_buffer("size_t[]", columns), len(columns),
                                      ffi.from_buffer("double[]", out, require_writable=True), err)
        watch.check(status, err)
        return out

    def at(self, times: Any) -> np.ndarray:
        wanted = np.atleast_1d(np.asarray(times, dtype=np.float64))
        order = np.argsort(wanted if self.end >= self.start else -wanted, kind="stable")
        rows = np.empty((len(wanted), self.width()))
        rows[order] = self.sample(np.ascontiguousarray(wanted[order]))
        return rows[0] if np.ndim(times) == 0 else rows.T

    def bars(self) -> np.ndarray:
        run, watch, _kept = self.begin(bars=True)
        err, columns = new_error(), np.arange(1, 1 + self.width(), dtype=np.uintp)
        values, errors = np.empty(self.width()), np.empty(self.width())
        watch.check(lib.motus_run_finish(run, err), err)
        watch.check(lib.motus_run_errors(run, ffi.from_buffer("size_t[]", columns), len(columns),
                                         ffi.from_buffer("double[]", values, require_writable=True),
                                         ffi.from_buffer("double[]", errors, require_writable=True), err), err)
        return errors

    def solve(self, times: Optional[np.ndarray], dense: bool) -> Result:
        run, watch, kept = self.begin()
        err, width = new_error(), self.width()
        status, message, rows = 0, "The solver successfully reached the end of the integration interval.", []
        row = np.empty(width)
        x, v = ffi.from_buffer("double[]", row[: len(self.x)]), ffi.from_buffer("double[]", row[len(self.x) :])
        taken: list[float] = []
        try:
            if times is None:
                while True:
                    watch.check(lib.motus_run_state(run, x if len(self.x) else ffi.NULL, v, err), err)
                    taken.append(lib.motus_run_time(run))
                    rows.append(row.copy())
                    if lib.motus_run_done(run):
                        break
                    watch.check(lib.motus_run_step(run, 1, err), err)
            else:
                out = np.empty((len(times), width))
                columns = np.arange(1, 1 + width, dtype=np.uintp)
                for k, t in enumerate(times):
                    if lib.motus_run_done(run) and (t - lib.motus_run_time(run)) * (self.end - self.start) > 0:
                        break
                    one = np.array([t])
                    code = lib.motus_run_sample(run, ffi.from_buffer("double[]", one), 1,
                                                ffi.from_buffer("size_t[]", columns), width,
                                                ffi.from_buffer("double[]", out[k], require_writable=True), err)
                    if code == lib.MOTUS_ARGUMENT and lib.motus_run_done(run) and lib.motus_run_time(run) != self.end:
                        break
                    watch.check(code, err)
                    taken.append(float(t))
                    rows.append(out[k])
                watch.check(lib.motus_run_finish(run, err), err)
        except (DivergedError, StepsError) as failure:
            status, message = -1, str(failure)
        if status == 0 and lib.motus_run_time(run) != self.end:
            status, message = 1, "A termination event occurred."
        s = new("run_statistics")
        lib.motus_run_statistics_of(run, s)
        found = Result(t=np.array(taken), y=np.array(rows).reshape(len(rows), width).T, sol=self.at if dense else None,
                       t_events=None, y_events=None, nfev=s.evaluations, njev=0, nlu=0, status=status, message=message,
                       success=status >= 0, method=text(s.method), _bars=self.bars,
                       note=getattr(watch, "note", lambda: "")())
        if self.events:
            self._events(run, watch, found)
        return found

    def _events(self, run: Any, watch: Any, found: Result) -> None:
        columns, row, err = np.arange(1, 1 + self.width(), dtype=np.uintp), new("event_row"), new_error()
        times: list[list[float]] = [[] for _ in self.events]
        states: list[list[np.ndarray]] = [[] for _ in self.events]
        for k in range(lib.motus_run_events(run)):
            lib.motus_run_event(run, k, row)
            at = int(text(row.name)[len("event"):]) - 1
            state = np.empty(self.width())
            watch.check(lib.motus_run_event_values(run, k, 0, ffi.from_buffer("size_t[]", columns), len(columns),
                                                   ffi.from_buffer("double[]", state, require_writable=True), err), err)
            times[at].append(row.time)
            states[at].append(state)
        found["t_events"] = [np.array(t) for t in times]
        found["y_events"] = [np.array(s) for s in states]


def begin(force: Any, span: Sequence[float], x0: Any, v0: Any, *, method: Optional[str], times: Any, dense: bool,
          events: Any, args: Any, rtol: Optional[float], atol: Optional[float], max_step: Optional[float],
          step: Optional[float], accuracy: Optional[float], progress: Any, reads_velocity: bool = True) -> Result:
    for name, numbers in (("x0", x0), ("the initial values", v0)):
        if np.asarray(numbers).dtype.kind not in "fiub":
            raise TypeError(f"{name}: {np.asarray(numbers).dtype}; real numbers are wanted (write a complex one as two)")
    x, v = (np.ascontiguousarray(np.atleast_1d(a), dtype=np.float64) for a in (x0, v0))
    if x.ndim != 1 or v.ndim != 1:
        raise TypeError(f"initial values are one row of numbers each, not {x.ndim if x.ndim != 1 else v.ndim}-dimensional")
    absolute = bool(rtol == 0 and atol)
    how = {"method": method_of(method if step is None else method or "verlet"), "step": step, "accuracy": accuracy,
           "tolerance": (atol if absolute else rtol) if step is None and accuracy is None else None,
           "absolute": absolute, "longest_step": max_step}
    several = [] if events is None else list(events) if isinstance(events, (list, tuple)) else [events]
    if times is not None:
        times = np.array(times, dtype=np.float64)
        if (np.diff(times) * (float(span[1]) - float(span[0])) < 0).any():
            raise ValueError("t_eval: the times follow the direction of the motion, from span[0] to span[1]")
    solver = Solver(force, span, x, v, how, several, tuple(args or ()), reads_velocity, progress)
    return solver.solve(times, dense)


def solve_ivp(fun: Any, t_span: Sequence[float], y0: Any, method: Optional[str] = None, t_eval: Any = None,
              dense_output: bool = False, events: Any = None, args: Any = None, *, rtol: float = 1e-9,
              atol: Optional[float] = None, max_step: Optional[float] = None, step: Optional[float] = None,
              accuracy: Optional[float] = None, progress: Optional[Callable[[float], Any]] = None) -> Result:
    """Integrates y' = fun(t, y), called as SciPy's function of this name.

    What differs: without a method one is chosen; rtol is 1e-9; the keywords are those below, and any other, such as jac
    or first_step, is a TypeError; there are no BDF and LSODA; every zero of every event is found.

    >>> s = solve_ivp(lambda t, y: [y[1], -y[0]], (0, 10), [1, 0])
    >>> s.success, bool(abs(s.y[0, -1] - np.cos(10)) < s.error[0])
    (True, True)

    Args:
        fun: a function of t and y; the text of a model, in which y0 are all positions, then their velocities, then the
            first-order variables; or a compiled
            function (numba's cfunc, SciPy's LowLevelCallable, cffi, ctypes, an address) of `motus.signature`, in which
            y is `v` and y' is `a`.
        t_span: start and end; the end may be before the start.
        y0: the initial values.
        method: a method of the library, or SciPy's "RK23", "RK45", "DOP853"; None: chosen for the force.
        t_eval: the times of the rows; None: the ends of the steps.
        dense_output: the result has `sol`, which gives the numbers at any times and computes the motion again for it.
        events: functions of t and y, whose zeros are found, all of them; with the attributes `terminal` and `direction`.
        args: handed to fun and events behind t and y.
        rtol: the tolerance of a step, relative to the size of each number.
        atol: the tolerance of a step in the units of the numbers, where rtol is 0; else every number keeps to rtol
            alone, which is the stricter.
        max_step: the longest step.
        step: instead of a tolerance, the size of all steps.
        accuracy: instead of a tolerance, how far the answer may be from the exact one.

    Raises:
        motus.Error, and what `fun` raises.
    """
    return begin(fun, t_span, [], y0, method=method, times=t_eval, dense=dense_output, events=events, args=args,
                 rtol=rtol, atol=atol, max_step=max_step, step=step, accuracy=accuracy, progress=progress)


def solve(force: Any, t_span: Sequence[float], x0: Any, v0: Any, method: Optional[str] = None, t_eval: Any = None,
          dense_output: bool = False, events: Any = None, args: Any = None, *, rtol: float = 1e-9,
          atol: Optional[float] = None, max_step: Optional[float] = None, step: Optional[float] = None,
          accuracy: Optional[float] = None, reads_velocity: bool = True,
          progress: Optional[Callable[[float], Any]] = None) -> Result:
    """Integrates x'' = force(t, x, v).

    The arguments are those of :func:`solve_ivp`; v0 has the velocities of all x0, and behind them what only has a rate.
    The rows of `y` are x, then v. ``reads_velocity=False`` says that the force does not depend on v, which is then full
    of NaN; methods that need that become admitted.

    >>> s = solve(lambda t, x, v: -x, (0, 10), 1, 0, method="verlet", step=0.01, reads_velocity=False)
    >>> s.y.shape
    (2, 1001)
    """
    return begin(force, t_span, x0, v0, method=method, times=t_eval, dense=dense_output, events=events, args=args,
                 rtol=rtol, atol=atol, max_step=max_step, step=step, accuracy=accuracy, progress=progress,
                 reads_velocity=reads_velocity)
