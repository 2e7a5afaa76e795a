"""Sweeps: many trajectories of a model, and the numbers that are recorded of each."""
from __future__ import annotations

import re
from typing import Any, Callable, Mapping, Optional, Sequence, Union

import numpy as np

from ._motus import ffi, lib
from .calls import Watch, check, new, new_error, strings
from .errors import AccuracyError, text
from .model import Model
from .places import column_name, find
from .run import doubles

REDUCTIONS = {word: getattr(lib, "MOTUS_REDUCE_" + word.upper())
              for word in ("final", "min", "max", "mean", "time_of_min", "time_of_max", "steps", "refused",
                           "shortest_step", "longest_step", "evaluations", "accuracy", "tolerance")}
OF_TRAJECTORIES = ("steps", "refused", "shortest_step", "longest_step", "evaluations", "accuracy", "tolerance")


def records_of(system: Any, record: Union[str, Sequence[str]]) -> list[tuple[str, int, int]]:
    """Returns the name, the reduction and the column of each record: "final", "x", "max(x)", "steps"."""
    items = re.split(r",\s*(?![^(]*\))", record) if isinstance(record, str) else list(record)
    found: list[tuple[str, int, int]] = []
    for item in (i.strip() for i in items):
        call = re.fullmatch(r"(\w+)\s*\(\s*(.*?)\s*\)", item)
        if item == "final":
            count = lib.motus_positions(system) + lib.motus_velocities(system)
            found += [(column_name(system, k), REDUCTIONS["final"], k) for k in range(1, 1 + count)]
        elif item in OF_TRAJECTORIES:
            found.append((item, REDUCTIONS[item], 0))
        elif call and call[1] in REDUCTIONS and call[1] not in OF_TRAJECTORIES:
            place = find(system, call[2])
            found += [(f"{call[1]}({column_name(system, k)})", REDUCTIONS[call[1]], k)
                      for k in range(place.first, place.first + place.count)]
        else:
            place = find(system, item)
            found += [(column_name(system, k), REDUCTIONS["final"], k)
                      for k in range(place.first, place.first + place.count)]
    return found


class Sweep(Mapping[str, np.ndarray]):
    """What a sweep has recorded: columns by name, each a view of one array that the library wrote.

    Attributes:
        table: records by trajectories.
        records: the names of its rows; ``s["max(x)"]``.
        errors: how far each number may be off, like `table`; None: not asked for.
        stopped: when a trajectory stopped before its end; NaN: it did not.
        shape: of a product, the lengths of what varies; else (number of trajectories,).
    """

    def __init__(self, varied: dict[str, np.ndarray], axes: Optional[dict[str, np.ndarray]], records: list[str],
                 table: np.ndarray, errors: Optional[np.ndarray], stopped: np.ndarray, statistics: dict[str, Any]) -> None:
        self.varied, self.axes, self.records, self.statistics = varied, axes, records, statistics
        self.shape = tuple(len(a) for a in axes.values()) if axes else (table.shape[1],)
        self.table, self.errors, self.stopped = table, errors, stopped.reshape(self.shape)

    def __getitem__(self, name: str) -> np.ndarray:
        if name in self.records:
            return self.table[self.records.index(name)].reshape(self.shape)
        if name in self.varied:
            return self.varied[name].reshape(self.shape)
        raise KeyError(f"{name!r} is neither recorded nor varied; there are {', '.join(self)}")

    def __iter__(self) -> Any:
        return iter([*self.varied, *self.records])

    def __len__(self) -> int:
        return len(self.varied) + len(self.records)

    def to_pandas(self) -> Any:
        """Returns a DataFrame, a row for each trajectory."""
        import pandas

        return pandas.DataFrame({name: self[name].reshape(-1) for name in self}, copy=False)

    def to_xarray(self) -> Any:
        """Returns a Dataset; of a product with what varies as its dimensions."""
        import xarray

        if self.axes:
            return xarray.Dataset({r: (tuple(self.axes), self[r]) for r in self.records}, coords=self.axes)
        return xarray.Dataset({name: ("trajectory", self[name]) for name in self})

    def __repr__(self) -> str:
        return f"Sweep of {self.table.shape[1]} trajectories: {', '.join(self)}"


def sweep(model: Model, vary: Optional[Mapping[str, Any]] = None, *, record: Union[str, Sequence[str]] = "final",
          product: bool = False, until: Optional[float] = None, method: Optional[str] = None,
          step: Optional[float] = None, tolerance: Optional[float] = None, accuracy: Optional[float] = None,
          every: int = 1, error: bool = False, absolute: bool = False, threads: int = 0, lanes: int = 0,
          machine: str = "auto", fast: bool = False, progress: Optional[Callable[[float], Any]] = None,
          **numbers: Any) -> Sweep:
    """Computes many trajectories of a model.

    >>> m = Model("x'' = -x + x^3 + F cos(t)", F=0.1, x=0, v=0)
    >>> s = sweep(m, F=np.linspace(0, 0.1, 5), record="final, max(x)", until=10, step=0.01)
    >>> s["max(x)"].shape, s["x'"].shape
    ((5,), (5,))

    What varies has one length, and trajectory k has the k-th of each; `product=True` combines all, as `motus sweep` does.

    Args:
        vary: what differs, by name: ``{"x(0)": …, "r.x(0)": …, "until": …}``; arrays of one length.
        numbers: the same as keywords: a parameter, ``F=…``, or a variable, whose initial value differs, ``x=…``.
        record: "final" is every number of the state at the end, "x" one of them; "max(x)", "min(…)", "mean(…)",
            "time_of_max(…)", "steps", "evaluations".
        product: every combination of what varies is computed; the results have these dimensions.
        every: the steps between two observations, of which maxima and means are taken.
        error: the results have errors.
        until, method, step, tolerance, accuracy, absolute, threads, lanes, machine, fast, progress: as of a run; 0
            threads are all processors.
    """
    variables = {text(v) for v in _variables(model)}
    given: dict[str, np.ndarray] = {}
    for name, values in {**(vary or {}), **numbers}.items():
        if name == "v" and name not in variables and name not in model.parameters and len(variables) == 1:
            name = next(iter(variables)) + "'(0)"
        given[name + "(0)" * (name in variables)] = np.ascontiguousarray(np.atleast_1d(values), dtype=np.float64)
    if not given:
        raise TypeError("nothing varies: name a parameter or a variable, F=np.linspace(0, 1, 100)")
    axes = dict(given) if product else None
    if axes:
        mesh = np.meshgrid(*axes.values(), indexing="ij")
        given = {name: np.ascontiguousarray(m).reshape(-1) for name, m in zip(axes, mesh)}
    lengths = {name: len(values) for name, values in given.items()}
    if len(set(lengths.values())) > 1:
        raise TypeError("what varies has different lengths, "
                        + ", ".join(f"{n}: {k}" for n, k in lengths.items()) + "; product=True takes every combination")
    count = next(iter(lengths.values()))

    made, err, clone = ffi.new("motus_ensemble **"), new_error(), ffi.new("motus_system **")
    with model._using:
        check(lib.motus_system_clone(model._system, clone, err), err)
    system = ffi.gc(clone[0], lib.motus_system_destroy)
    chosen = records_of(system, record)
    records = ffi.new("motus_record[]", len(chosen))
    for one, (_, how, column) in zip(records, chosen):
        one.how, one.column = how, column
    names, kept = strings(given)
    watch, d = Watch(progress), new("ensemble_def")
    words = [ffi.new("char[]", word.encode()) for word in (method or "", machine)]
    d.vary, d.vary_count, d.records, d.record_count = names, len(given), records, len(chosen)
    d.method, d.machine = words[0] if method else ffi.NULL, words[1]
    d.every, d.threads, d.lanes, d.fast, d.absolute, d.expected = every, threads, lanes, fast, absolute, count
    for name, value in (("step", step), ("until", until), ("tolerance", tolerance), ("accuracy", accuracy)):
        if value is not None:
            setattr(d, name, float(value))
    d.error = lib.MOTUS_BARS_CHEAP if error else lib.MOTUS_BARS_NONE
    watch.put(d)
    watch.check(lib.motus_ensemble_create(system, d, made, err), err)
    ensemble = ffi.gc(made[0], lib.motus_ensemble_destroy)
    values = ffi.new("double *[]", [ffi.from_buffer("double[]", v) for v in given.values()])
    table, stopped = np.empty((len(chosen), count)), np.empty(count)
    rows = ffi.new("double *[]", [doubles(row) for row in table])
    errors = np.empty_like(table) if error else None
    try:
        if errors is None:
            status = lib.motus_ensemble_run(ensemble, count, values, rows, doubles(stopped), err)
        else:
            bars = ffi.new("double *[]", [doubles(row) for row in errors])
            status = lib.motus_ensemble_run_errors(ensemble, count, values, rows, bars, doubles(stopped), err)
        watch.check(status, err)
    except AccuracyError as missed:
        import warnings

        warnings.warn(str(missed), RuntimeWarning, stacklevel=3)
    s = new("ensemble_statistics")
    lib.motus_ensemble_statistics_of(ensemble, s)
    statistics = {"method": text(s.method), "machine": text(s.machine), "note": text(s.note), "steps": s.steps,
                  "seconds": s.seconds, "lanes": s.lanes, "threads": s.threads}
    return Sweep(given, axes, [name for name, _, _ in chosen], table, errors, stopped, statistics)


def _variables(model: Model) -> list[Any]:
    variable, found = new("variable"), []
    for k in range(lib.motus_variable_count(model._system)):
        lib.motus_variable_at(model._system, k, variable)
        found.append(variable.name)
    return found
