"""A run in the hand: step by step."""
from __future__ import annotations

from typing import Any, Iterator, Optional

import numpy as np

from ._motus import ffi, lib
from .calls import new_error
from .errors import text
from .model import Model
from .places import Place, column_name, find, shaped
from .run import Live, doubles

KINDS = {getattr(lib, "MOTUS_TRACE_" + k.upper()): k
         for k in ("start", "kick", "drift", "stage", "solve", "taylor", "step", "end", "refused")}


class Stepper:
    """A run that goes on when it is told to.

    >>> s = Model("x'' = -x", x=1, v=0).start(method="verlet", step=0.1, until=10)
    >>> s.step(10).t, s.done
    (1.0, False)
    >>> s["x"] == s.state["x"]
    True
    >>> sum(1 for _ in s)
    90

    The arguments are those of :class:`motus.Run` but for rows; `state` is a restart state, from `save` or from the
    program, from which the run goes on to the same bits.
    """

    def __init__(self, model: Model, until: Optional[float] = None, *, state: Optional[str] = None, **how: Any) -> None:
        self.model, self._how = model, dict(how, until=until)
        self._live = Live(model, until, **how)
        if state is not None:
            body = state.encode()
            self._live.call(lib.motus_run_restore, ffi.from_buffer("char[]", body), len(body))

    @property
    def t(self) -> float:
        return float(lib.motus_run_time(self._live.run))

    @property
    def done(self) -> bool:
        return bool(lib.motus_run_done(self._live.run))

    @property
    def steps(self) -> int:
        return int(lib.motus_run_steps(self._live.run))

    def step(self, count: int = 1) -> Stepper:
        """Takes steps, fewer if the end comes first."""
        self._live.call(lib.motus_run_step, int(count))
        return self

    def finish(self) -> Stepper:
        self._live.call(lib.motus_run_finish)
        return self

    def __iter__(self) -> Iterator[Stepper]:
        """Takes a step at a time, up to the end."""
        while not self.done:
            yield self.step()

    def _values(self, place: Place) -> np.ndarray:
        columns = np.arange(place.first, place.first + place.count, dtype=np.uintp)
        out = np.empty(place.count)
        self._live.call(lib.motus_run_values, ffi.from_buffer("size_t[]", columns), place.count, doubles(out))
        return out

    def __getitem__(self, name: str) -> Any:
        """The present numbers of a name: ``s["x'"]``, ``s["energy"]``."""
        place = find(self._live.system, name)
        values = shaped(self._values(place), Place(0, place.count, place.shape))
        return values.item() if place.shape == () else values

    @property
    def state(self) -> dict[str, float]:
        """The numbers of the state, by name."""
        count = lib.motus_positions(self._live.system) + lib.motus_velocities(self._live.system)
        values = self._values(Place(1, count, (count,))).tolist()
        return {column_name(self._live.system, 1 + k): value for k, value in enumerate(values)}

    def trace(self) -> list[dict[str, Any]]:
        """Takes a step, and returns what the method does in it: kicks, drifts, stages, with the states after them."""
        entries, count = ffi.new("motus_trace_entry ***"), ffi.new("size_t *")
        self._live.call(lib.motus_run_trace, entries, count)
        nx, nv = lib.motus_positions(self._live.system), lib.motus_velocities(self._live.system)
        found = []
        for k in range(count[0]):
            e = entries[0][k]
            one = {name: getattr(e, name) for name in ("stage", "stages", "iterations", "time", "step", "coefficient",
                                                       "weight", "weight_x", "error")}
            for name, size in (("x", nx), ("v", nv), ("a", nv)):
                array = getattr(e, name)
                one[name] = np.frombuffer(ffi.buffer(array, 8 * size)).copy() if array != ffi.NULL and size else None
            found.append({"kind": KINDS.get(e.kind, ""), **one})
        return found

    def save(self) -> str:
        """Returns the exact restart state, a text."""
        return self._live.save()

    @property
    def statistics(self) -> dict[str, Any]:
        return self._live.statistics()

    def __reduce__(self) -> Any:
        return _again, (self.model, self.save(), {k: v for k, v in self._how.items() if k != "progress"})

    def __copy__(self) -> Stepper:
        return _again(self.model, self.save(), self._how)


def _again(model: Model, state: str, how: dict[str, Any]) -> Stepper:
    return Stepper(model, state=state, **how)
