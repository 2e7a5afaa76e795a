"""motus: Newton's second law, x'' = a(x, x', t), integrated, with the error of the answer.

>>> import motus
>>> m = motus.Model("x'' = -x + x^3 + F cos(t)", F=0.1, x=0, v=0)
>>> r = m.run(until=100)
>>> round(r.final["x"], 7)
0.0477831

Begin with :class:`Model`: its methods `run`, `start`, `sweep`, `compare`, `converge` and `rank` do the rest. `solve_ivp`
and `solve` take functions.
"""
from . import errors
from ._motus import ffi as _ffi, lib as _lib
from .errors import *  # noqa: F403
from .model import Model
from .callback import signature
from .run import Event, Run
from .solve import Result, solve, solve_ivp
from .stepper import Stepper
from .studies import compare, converge, rank
from .sweep import Sweep, sweep
from .tables import Table

__version__ = _ffi.string(_lib.motus_version()).decode()
__all__ = ["Event", "Model", "Result", "Run", "Stepper", "Sweep", "Table", "compare", "converge", "rank",
           "signature", "solve", "solve_ivp", "sweep", *errors.__all__]
