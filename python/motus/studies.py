"""Methods side by side: `compare`, `converge`, `rank`."""
from __future__ import annotations

from typing import Any, Callable, Optional, Sequence

from ._motus import ffi, lib
from .calls import Watch, new, new_error, strings
from .errors import text
from .model import Model
from .tables import Table, row_of

COMPARED = ("method", "order", "step", "steps", "evaluations", "seconds", "error_max_x", "error_max_v", "error_final_x",
            "error_final_v", "reversal", "note")
CONVERGED = ("method", "declared", "observed", "standard_error", "passed", "uncertain", "exact_here", "certificate")


class Study:
    """The definition of a study, and what its call comes back to."""

    def __init__(self, model: Model, methods: Optional[Sequence[str]], progress: Optional[Callable[[float], Any]],
                 **numbers: Any) -> None:
        self.model, self.watch, self.definition = model, Watch(progress), new("study_def")
        d = self.definition
        if methods is not None:
            array, kept = strings([methods] if isinstance(methods, str) else methods)
            d.methods, d.method_count = array, len(kept)
            self.kept = (array, kept)
        for name, value in numbers.items():
            if value is not None:
                setattr(d, name, value)
        self.watch.put(d)

    def call(self, function: Any, destroy: Any, kind: str) -> Any:
        made, err = ffi.new(f"{kind} **"), new_error()
        with self.model._using:
            self.watch.check(function(self.model._system, self.definition, made, err), err)
        return ffi.gc(made[0], destroy)


def compare(model: Model, methods: Optional[Sequence[str]] = None, *, step: Optional[float] = None,
            until: Optional[float] = None, evaluations: Optional[int] = None,
            progress: Optional[Callable[[float], Any]] = None) -> Table:
    """Integrates a model by each method and compares the results.

    >>> t = compare(Model("x'' = -x", x=1, v=0), ["verlet", "rk4"], step=0.1, until=10)
    >>> bool(t["rk4"]["error_max_x"] < t["verlet"]["error_max_x"])
    True
    """
    study = Study(model, methods, progress, step=step, until=until, evaluations=evaluations)
    c = study.call(lib.motus_compare, lib.motus_comparison_destroy, "motus_comparison")
    rows = []
    for k in range(c.row_count):
        row = row_of(c.rows[k], COMPARED)
        for i in range(c.rows[k].invariant_count):
            drift = c.rows[k].invariants[i]
            row["drift of " + text(drift.name)] = drift.max_drift
        rows.append(row)
    names = [*COMPARED[:-1], *dict.fromkeys(n for row in rows for n in row if n.startswith("drift of ")), "note"]
    rows = [{n: row.get(n) for n in names} for row in rows]
    return Table(names, rows, text(c.remarks), reference=text(c.reference), reference_error=c.reference_error)


def converge(model: Model, methods: Optional[Sequence[str]] = None, *, step: Optional[float] = None,
             until: Optional[float] = None, progress: Optional[Callable[[float], Any]] = None) -> Table:
    """Fits the observed order of each method to its errors at several steps; `points` of a row has them."""
    study = Study(model, methods, progress, step=step, until=until)
    c = study.call(lib.motus_converge, lib.motus_convergence_destroy, "motus_convergence")
    rows = []
    for k in range(c.row_count):
        r = c.rows[k]
        points = [row_of(r.points[i], ("step", "error", "used", "evaluations", "tolerance")) for i in range(r.point_count)]
        rows.append({**row_of(r, CONVERGED), "points": points})
    return Table(CONVERGED, rows, "", reference=text(c.reference), reference_error=c.reference_error, passed=bool(c.passed))


def rank(model: Model, methods: Optional[Sequence[str]] = None, *, coarsest: float = 1e-3, finest: float = 1e-9,
         until: Optional[float] = None, absolute: bool = False,
         progress: Optional[Callable[[float], Any]] = None) -> Table:
    """Ranks methods by the evaluations that each needs for accuracies from `coarsest` to `finest`."""
    study = Study(model, methods, progress, coarsest=coarsest, finest=finest, until=until, absolute=absolute)
    r = study.call(lib.motus_rank, lib.motus_ranking_destroy, "motus_ranking")
    accuracies = [r.accuracies[k] for k in range(r.accuracy_count)]
    names = ["method", "order", *(f"{a:.0e}" for a in accuracies), "note"]
    rows = []
    for k in range(r.row_count):
        one = r.rows[k]
        reached = [one.points[i] for i in range(r.accuracy_count)] if one.points != ffi.NULL else []
        work = [p.evaluations if p.error == p.error else None for p in reached] or [None] * len(accuracies)
        rows.append(dict(zip(names, [text(one.method), one.order, *work, text(one.note)])))
    return Table(names, rows, text(r.remarks), reference=text(r.reference), reference_error=r.reference_error,
                 accuracies=accuracies)
