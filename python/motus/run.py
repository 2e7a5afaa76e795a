"""Runs: a model integrated, with the error of the answer."""
from __future__ import annotations

import difflib
import inspect
import math
from typing import Any, Callable, Iterator, NamedTuple, Optional, Sequence, Union

import numpy as np

from ._motus import ffi, lib
from .calls import Using, Watch, check, new, new_error
from .errors import ArgumentError, UnknownNameError, text
from .model import Model
from .places import Place, column_name, find, shaped

BARS = {"none": lib.MOTUS_BARS_NONE, "cheap": lib.MOTUS_BARS_CHEAP, "full": lib.MOTUS_BARS_FULL}
SWITCHES = {"step": lib.MOTUS_SWITCHES_STEP, "locate": lib.MOTUS_SWITCHES_LOCATE,
            "resolve": lib.MOTUS_SWITCHES_RESOLVE, "usual": lib.MOTUS_SWITCHES_USUAL}
ROWS, STEPS, NUMBERS = 1000, 100_000, 500_000_000


def chosen(value: str, words: dict[str, int], what: str) -> int:
    if value not in words:
        raise ValueError(f"{what}={value!r}: it is one of {', '.join(map(repr, words))}")
    return words[value]


def with_error(value: float, error: float) -> str:
    """Writes a number with its error, to the digit that the error leaves."""
    if error == 0:
        return f"{value:.12g} (exact)"
    if not math.isfinite(error) or not math.isfinite(value):
        return f"{value:.6g} (no error is known)" if math.isnan(error) else f"{value:.6g} (no digit is known)"
    places = max(0, 1 - math.floor(math.log10(error)))
    return f"{value:.{min(places, 17)}f} ± {error:.1e}" if places <= 17 else f"{value:.16g} ± {error:.1e}"


class Event(NamedTuple):
    """An event of a run, as :attr:`Run.events` has it."""

    name: str
    count: int
    time: float
    error: float
    touched: bool
    values: dict[str, float]


class Live:
    """A handle of the library that can step, with a system of its own, so that runs of one model may be computed in
    several threads."""

    def __init__(self, model: Model, until: Optional[float] = None, **how: Any) -> None:
        unknown = next((name for name in how if name not in KEYWORDS), None)
        if unknown is not None:
            near = difflib.get_close_matches(unknown, KEYWORDS, 1)
            raise TypeError(f"a run has no argument {unknown!r}" + (f": did you mean {near[0]!r}?" if near else ""))
        self.begin(model, until, **how)

    def begin(self, model: Model, until: Optional[float] = None, *, method: Optional[str] = None,
              step: Optional[float] = None, tolerance: Optional[float] = None, accuracy: Optional[float] = None,
              start: Optional[float] = None, error: str = "cheap", absolute: bool = False,
              shortest_step: float = 0, longest_step: float = 0, machine: str = "auto", threads: int = 0,
              switches: str = "usual", most_steps: int = 0,
              progress: Optional[Callable[[float], Any]] = None) -> None:
        made, err = ffi.new("motus_system **"), new_error()
        with model._using:
            check(lib.motus_system_clone(model._system, made, err), err)
        self.system = ffi.gc(made[0], lib.motus_system_destroy)
        self.watch, self.using = Watch(progress), Using("run")
        d = self.definition = new("run_def")
        self.kept = [ffi.new("char[]", word.encode()) for word in (method or "", machine)]
        d.method, d.machine = self.kept[0] if method else ffi.NULL, self.kept[1]
        for name, value in (("step", step), ("until", until), ("tolerance", tolerance), ("accuracy", accuracy),
                            ("start", start)):
            if value is not None:
                setattr(d, name, float(value))
        d.shortest_step, d.longest_step, d.threads, d.most_steps = shortest_step, longest_step, threads, most_steps
        d.error, d.switches = chosen(error, BARS, "error"), chosen(switches, SWITCHES, "switches")
        d.absolute = bool(absolute)
        self.watch.put(d)
        run = ffi.new("motus_run **")
        with self.using:
            self.watch.check(lib.motus_run_create(self.system, d, run, err), err)
        self.run = ffi.gc(run[0], lib.motus_run_destroy)

    def call(self, function: Any, *arguments: Any) -> None:
        err = new_error()
        with self.using:
            self.watch.check(function(self.run, *arguments, err), err)

    def save(self) -> str:
        """Returns the exact restart state, a text."""
        out, length = ffi.new("char **"), ffi.new("size_t *")
        self.call(lib.motus_run_save, out, length)
        return ffi.buffer(out[0], length[0])[:].decode()

    def statistics(self) -> dict[str, Any]:
        s = new("run_statistics")
        lib.motus_run_statistics_of(self.run, s)
        names = [name for name, _ in ffi.typeof("motus_run_statistics").fields if name != "size"]
        values = {name: getattr(s, name) for name in names}
        return {name: text(v) if isinstance(v, ffi.CData) else v for name, v in values.items()}


KEYWORDS = [name for name in inspect.signature(Live.begin).parameters if name not in ("self", "model", "until")]


def doubles(array: np.ndarray) -> Any:
    return ffi.from_buffer("double[]", array, require_writable=True)


class Run:
    """A run of a model from its start to its end.

    >>> m = Model("x'' = -x", x=1, v=0)
    >>> r = m.run(until=10, method="verlet", step=0.01)
    >>> r.x.shape, r["x'"].shape
    ((1001,), (1001,))
    >>> abs(r.final["x"] - np.cos(10)) < r.error["x"]
    True

    Args:
        until: the end; without it the model's, or one that suits the motion.
        method, step, tolerance, accuracy: without any of them the run chooses a method, and its answer is accurate to
            1e-9.
        every: the time between two rows. Without `every` and `times` there is a row at every step of a method whose
            steps have one size, at every second, third … where these are more than 100 000; else there are 1000
            intervals.
        times: the times of the rows, in the direction of the run.
        columns: names of what to observe; without them everything that the model has.
        error: "cheap", "full" or "none": how the errors of the numbers are found.
        progress: called with the part that is done; a true value cancels the run.
        start, absolute, shortest_step, longest_step, machine, threads, switches, most_steps: as in `motus_run_def`.

    Attributes:
        t: the times of the rows.
        table: all numbers, rows by columns, as the library wrote them; `names` are those of the columns. ``r.x`` and
            ``r["x'"]`` are views of it, with the shape of their vector or family behind the rows.
        final: the numbers at the end, by name.
        error: how far each of them may be from the exact motion.
        events: the table of events.
        statistics: what the run is, and what it has done.
    """

    def __init__(self, model: Model, until: Optional[float] = None, *, every: Optional[float] = None,
                 times: Optional[Sequence[float]] = None, columns: Optional[Sequence[str]] = None,
                 **how: Any) -> None:
        if every is not None and times is not None:
            raise TypeError("every and times both say when rows are taken: give one of them")
        self.model, self._how = model, dict(how, until=until)
        self._system = model._system
        self._live = live = Live(model, until, **how)
        self._places: dict[str, Place] = {}
        self._table_of_events: Optional[list[Event]] = None
        self._saved: Optional[str] = None
        self._choose(columns)
        self._take(live, self._times(live, every, times))
        self.statistics = live.statistics()

    def _choose(self, columns: Optional[Sequence[str]]) -> None:
        """Chooses the columns of the table."""
        system = self._system
        if columns is None:
            self._columns = np.arange(lib.motus_column_count(system), dtype=np.uintp)
            self._whole = True
            return
        chosen_columns: list[int] = []
        for name in columns:
            place = find(system, name)
            self._places[name] = Place(len(chosen_columns), place.count, place.shape)
            chosen_columns += range(place.first, place.first + place.count)
        self._columns, self._whole = np.array(chosen_columns, dtype=np.uintp), False

    @staticmethod
    def _times(live: Live, every: Optional[float], times: Optional[Sequence[float]]) -> np.ndarray:
        run, start = live.run, lib.motus_run_time(live.run)
        if times is not None:
            return np.array(times, dtype=np.float64, ndmin=1)
        steps = live.statistics()["steps_total"]
        end = live.definition.until
        if math.isnan(end):
            settings, err = new("settings"), new_error()
            check(lib.motus_run_settings(live.system, live.definition, settings, err), err)
            end = settings.until
        if every is not None:
            if not every > 0:
                raise ValueError(f"every={every!r}: it is a time between two rows, above 0")
            count = int((abs(end - start) / every) * (1 + 1e-12))
            return np.append(start + math.copysign(every, end - start) * np.arange(count + 1),
                             [end] * (count * every < abs(end - start) * (1 - 1e-12)))
        if steps > 0:
            stride = -(-steps // STEPS)
            marks = [*range(0, steps, stride), steps]
            return np.array([lib.motus_run_time_of(run, k) for k in marks])
        made = np.linspace(start, end, ROWS + 1)
        made[-1] = end
        return made

    def _take(self, live: Live, times: np.ndarray) -> None:
        """Integrates, and fills in the table; the errors are told at the end. Where an event ends the run, the last row
        is there."""
        columns, width = ffi.from_buffer("size_t[]", self._columns), len(self._columns)
        room = len(times) + 1
        if room * width > NUMBERS:
            raise ValueError(f"{room} rows of {width} numbers are more than {NUMBERS:.0e}: name some columns, or take "
                             f"fewer rows by every")
        table = np.empty((room, width))
        try:
            if len(times):
                live.call(lib.motus_run_sample, doubles(times), len(times), columns, width, doubles(table))
            rows = len(times)
            live.call(lib.motus_run_finish)
        except ArgumentError:
            end = lib.motus_run_time(live.run)
            if not lib.motus_run_done(live.run) or end == live.definition.until:
                raise
            backward = len(times) > 1 and times[-1] < times[0]
            rows = int(np.count_nonzero(times >= end if backward else times <= end))
            if rows == 0 or times[rows - 1] != end:
                times[rows] = end
                live.call(lib.motus_run_values, columns, width, doubles(table[rows]))
                rows += 1
        self.t, self.table = times[:rows], table[:rows]
        values = np.empty(width)
        self._final_values, self._final_errors = values, np.full(width, np.nan)
        if live.definition.error == lib.MOTUS_BARS_NONE:
            live.call(lib.motus_run_values, columns, width, doubles(values))
        else:
            live.call(lib.motus_run_errors, columns, width, doubles(values), doubles(self._final_errors))

    # --- numbers by name

    def _place(self, name: str) -> Place:
        place = self._places.get(name)
        if place is None:
            if not self._whole:
                raise KeyError(f"{name!r} is not among the columns of this run: {', '.join(self._places)}")
            place = self._places[name] = find(self._system, name)
        return place

    def __getitem__(self, name: str) -> np.ndarray:
        return shaped(self.table, self._place(name))

    def __getattr__(self, name: str) -> np.ndarray:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except (UnknownNameError, KeyError) as error:
            raise AttributeError(f"a run has no attribute and no number {name!r}: {error}") from None

    @property
    def names(self) -> list[str]:
        """The names of the columns of the table."""
        return [column_name(self._system, int(k)) for k in self._columns]

    @property
    def final(self) -> dict[str, float]:
        return dict(zip(self.names, self._final_values.tolist()))

    @property
    def error(self) -> dict[str, float]:
        return dict(zip(self.names, self._final_errors.tolist()))

    @property
    def events(self) -> list[Event]:
        if self._table_of_events is None:
            self._table_of_events = list(self._events())
        return self._table_of_events

    def _events(self) -> Iterator[Event]:
        live, row = self._live, new("event_row")
        values, names = np.empty(len(self._columns)), self.names
        for k in range(lib.motus_run_events(live.run)):
            lib.motus_run_event(live.run, k, row)
            live.call(lib.motus_run_event_values, k, 0, ffi.from_buffer("size_t[]", self._columns), len(names),
                      doubles(values))
            yield Event(text(row.instance) or text(row.name), row.count, row.time, row.error, bool(row.touched),
                        dict(zip(names, values.tolist())))

    def at(self, times: Union[float, Sequence[float]]) -> dict[str, np.ndarray]:
        """Returns the numbers of all columns at given times, by dense output; the run is computed again for it."""
        wanted = np.atleast_1d(np.asarray(times, dtype=np.float64))
        order = np.argsort(wanted if self.t[-1] >= self.t[0] else -wanted, kind="stable")
        again = Run(self.model, times=wanted[order], columns=None if self._whole else list(self._places),
                    **dict(self._how, error="none"))
        back = np.empty_like(order)
        back[order] = np.arange(len(order))
        shape = np.shape(times)
        return {name: again.table[back, k].reshape(shape) for k, name in enumerate(self.names)}

    def save(self) -> str:
        """Returns the exact restart state, a text, which the program reads too."""
        if self._saved is None:
            self._saved = self._live.save()
        return self._saved

    def __getstate__(self) -> dict[str, Any]:
        self.save(), self.events
        state = {k: v for k, v in vars(self).items() if k not in ("_live", "_system")}
        return {**state, "_how": {k: v for k, v in self._how.items() if k != "progress"}}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._system = self.model._system

    def __str__(self) -> str:
        s = self.statistics
        lines = [f"{self.model.file or 'model'}: {s['method']}, t = {self.t[0]:.12g} to {self.t[-1]:.12g} "
                 f"in {s['steps']} steps, {s['evaluations']} evaluations"]
        wide = max((len(n) for n in self.names), default=0)
        lines += [f"  {n:{wide}}  {with_error(v, e)}" for (n, v), e in zip(self.final.items(), self.error.values())]
        return "\n".join(lines)
