"""Models: equations of motion, typed."""
from __future__ import annotations

import difflib
import os
import pathlib
import re
from typing import Any, Iterator, Mapping, Optional, Union

import numpy as np

from ._motus import ffi, lib
from .calls import Using, check, new, new_error, strings
from .errors import TextError, UnknownNameError, text
from .places import column_name

Number = Union[float, int, "np.ndarray", list, tuple, str]


def written(value: Any, what: str) -> str:
    """Writes a number, a vector or a list in the language: ``0.1``, ``(1, 2)``, ``[1, 2, 3]``."""
    if isinstance(value, str):
        return value
    if what.endswith("(0)") and isinstance(value, (list, np.ndarray)) and np.ndim(value) == 1:
        value = tuple(np.asarray(value).tolist())  # an initial value is a number or a vector, and never a list
    if isinstance(value, tuple) and 2 <= len(value):
        return "(" + ", ".join(written(v, what) for v in value) + ")"
    array = np.asarray(value)
    if array.dtype.kind not in "fiub":
        raise TypeError(f"{what} is {type(value).__name__} of {array.dtype}: numbers are wanted, or an expression as text")
    if array.ndim == 0:
        return repr(array.item())
    return "[" + ", ".join(written(v, what) for v in array) + "]"


def system_of(source: str, name: str, sets: list[str], draft: int = 0) -> Any:
    """Reads a text."""
    definition, err, made = new("text_def"), new_error(), ffi.new("motus_system **")
    body, file = source.encode(), ffi.new("char[]", name.encode())
    array, kept = strings(sets)
    buffer = ffi.from_buffer("char[]", body)
    definition.text, definition.length, definition.file, definition.draft = buffer, len(body), file, draft
    definition.set, definition.set_count = array, len(sets)
    check(lib.motus_system_from_text(definition, made, err), err)
    return ffi.gc(made[0], lib.motus_system_destroy)


class Model:
    """Equations of motion, typed, with the numbers in them.

    >>> m = Model("x'' = -x + x^3 + F cos(t)", F=0.1, x=0, v=0)
    >>> m.F
    0.1
    >>> m.replace(F=0.2)["F"]
    0.2

    Args:
        source: the text, or the path of a file with it.
        start: initial values by their names, ``{"x": 1, "x'": 0, "r": (1, 0)}``.
        numbers: parameters by their names, and initial values of variables, ``x=1``; ``v`` is the velocity of a model
            with one variable, if nothing else has that name. What the text gives is replaced; what it does not give is
            added to it. A tuple is a vector; a list or an array is a list; a text is an expression.

    Raises:
        motus.TextError, motus.UnknownNameError, motus.ShapeError, motus.LimitError, motus.ArgumentError: with the
            place in the text.
    """

    def __init__(self, source: Union[str, os.PathLike], start: Optional[Mapping[str, Number]] = None,
                 **numbers: Number) -> None:
        name = ""
        if isinstance(source, os.PathLike) or ("\n" not in source and ";" not in source and "=" not in source):
            name = os.fspath(source)
            source = pathlib.Path(name).read_text(encoding="utf-8")
        self._read(source, name, *self._sorted(source, start or {}, numbers))

    def _read(self, source: str, name: str, lines: list[str], sets: list[str]) -> None:
        own = source.rstrip("\n")
        whole = "\n".join([own, *lines, ""])
        try:
            system = system_of(whole, name, sets)
        except TextError as error:
            if lines and error.line > own.count("\n") + 1:
                system_of(own, name, [], draft=1)  # its place is in the lines that were added: the text's own is wanted
            raise
        for key, value in (("text", whole), ("file", name), ("_sets", sets), ("_system", system),
                           ("_using", Using("model"))):
            object.__setattr__(self, key, value)

    @staticmethod
    def _sorted(source: str, start: Mapping[str, Number], numbers: Mapping[str, Number]) -> tuple[list[str], list[str]]:
        """Returns the lines that numbers add to a text, and what they replace in it."""
        plain = re.sub(r"#.*", "", source)
        variables = dict.fromkeys(re.findall(r"([^\W\d]\w*)(?:\[[^]]*\])?''?\s*=", plain))
        given: dict[str, Number] = {}
        for name, value in start.items():
            given[name if name.endswith(")") else name + "(0)"] = value
        for name, value in numbers.items():
            defined = re.search(rf"(?<!\w){re.escape(name)}\s*=", plain)
            if name == "v" and not defined and name not in variables and len(variables) == 1:
                given[next(iter(variables)) + "'(0)"] = value
            else:
                given[name + "(0)" * (name in variables)] = value
        lines, sets = [], []
        words = re.findall(r"[^\W\d]\w*", plain)
        for name, value in given.items():
            there = re.search(rf"(?<!\w){re.escape(name)}\s*=", plain)
            bare = re.match(r"\w*", name)[0]  # type: ignore[index]
            if bare not in words:
                near = difflib.get_close_matches(bare, words, 1)
                raise UnknownNameError(f"the text has no {bare}", hint=f"did you mean {near[0]}?" if near else "")
            line = f"{name} = {written(value, name)}"
            (sets if there else lines).append(line)
        return lines, sets

    def replace(self, start: Optional[Mapping[str, Number]] = None, **numbers: Number) -> Model:
        """Returns the model with other numbers, given as to :class:`Model`."""
        lines, sets = self._sorted(self.text, start or {}, numbers)
        kept = {s.split(" =")[0]: s for s in self._sets}
        kept.update((s.split(" =")[0], s) for s in sets)
        other = object.__new__(type(self))
        other._read(self.text, self.file, lines, list(kept.values()))
        return other

    # --- numbers

    def _numbers(self) -> Iterator[tuple[str, int, bool]]:
        """Every number that may be set: its name, its place, and whether it is an initial value."""
        parameter, initial = new("parameter"), new("initial")
        for k in range(lib.motus_parameter_count(self._system)):
            lib.motus_parameter_at(self._system, k, parameter)
            yield text(parameter.name), k, False
        for k in range(lib.motus_initial_count(self._system)):
            lib.motus_initial_at(self._system, k, initial)
            yield text(initial.name), k, True

    def __getitem__(self, name: str) -> Any:
        """The numbers of a parameter or an initial value: ``m["F"]``, ``m["x(0)"]``, ``m["r'(0)"]``."""
        for other, k, is_initial in self._numbers():
            if other == name:
                return self._initial(k) if is_initial else self._parameter(k)
        raise KeyError(f"{name!r} is no parameter and no initial value{self._meant(name)}")

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError(f"a model does not change: m.replace({name}=…) returns one with another {name}")

    def __getattr__(self, name: str) -> Any:
        if not name.startswith("_"):
            for other, k, is_initial in self._numbers():
                if other == name and not is_initial:
                    return self._parameter(k)
        raise AttributeError(f"a model has neither an attribute nor a parameter {name!r}{self._meant(name)}"
                             if not name.startswith("_") else name)

    def _meant(self, name: str) -> str:
        public = [a for a in dir(type(self)) if not a.startswith("_")]
        near = difflib.get_close_matches(name, [n for n, _, _ in self._numbers()] + public, 1)
        return f": did you mean {near[0]!r}?" if near else ""

    def _parameter(self, k: int) -> Any:
        p = new("parameter")
        lib.motus_parameter_at(self._system, k, p)
        out = np.empty(p.count)
        lib.motus_parameter_values(self._system, k, ffi.from_buffer("double[]", out, require_writable=True))
        shape = [p.last[d] - p.first[d] + 1 for d in range(p.dimensions)] + [p.components] * (p.components > 0)
        return out.reshape(shape) if shape else out.item()

    def _initial(self, k: int) -> Any:
        i, variable = new("initial"), new("variable")
        lib.motus_initial_at(self._system, k, i)
        lib.motus_variable_at(self._system, i.variable, variable)
        out = np.empty(i.count)
        lib.motus_initial_values(self._system, k, ffi.from_buffer("double[]", out, require_writable=True))
        shape = [variable.last[d] - variable.first[d] + 1 for d in range(variable.dimensions)]
        shape += [variable.components] * (variable.components > 0)
        if not shape:
            return out.item()
        return out.reshape(shape) if np.prod(shape) == i.count else out

    # --- what it holds

    @property
    def parameters(self) -> dict[str, Any]:
        """The parameters with their numbers, in the order of the text."""
        return {name: self._parameter(k) for name, k, is_initial in self._numbers() if not is_initial}

    @property
    def initial(self) -> dict[str, Any]:
        """The initial values, ``{"x(0)": 1.0, "x'(0)": 0.0}``."""
        return {name: self._initial(k) for name, k, is_initial in self._numbers() if is_initial}

    @property
    def columns(self) -> list[str]:
        """The names of all numbers that can be observed along a run."""
        return [column_name(self._system, k) for k in range(lib.motus_column_count(self._system))]

    def explain(self) -> str:
        """Says in words what is known of the equations and the events."""
        with self._using:
            return text(lib.motus_explain(self._system)) + text(lib.motus_explain_events(self._system))

    @property
    def methods(self) -> list[str]:
        """The methods that admit the model."""
        every = (text(lib.motus_method_at(k).name) for k in range(lib.motus_method_count()))
        return [m for m in every if lib.motus_method_admits(self._system, m.encode(), ffi.NULL) == lib.MOTUS_OK]

    def run(self, until: Optional[float] = None, **how: Any) -> Any:
        """Integrates the model: see :class:`motus.Run` for the arguments and the result.

        >>> r = Model("x'' = -x", x=1, v=0).run(until=3)
        >>> round(r.final["x"], 9)
        -0.989992497
        """
        from .run import Run

        return Run(self, until, **how)

    def start(self, until: Optional[float] = None, **how: Any) -> Any:
        """Begins a run that takes steps when it is told to: see :class:`motus.Stepper`."""
        from .stepper import Stepper

        return Stepper(self, until, **how)

    def sweep(self, vary: Optional[Mapping[str, Any]] = None, **how: Any) -> Any:
        """Computes many trajectories: see :func:`motus.sweep`."""
        from .sweep import sweep

        return sweep(self, vary, **how)

    def compare(self, methods: Any = None, **how: Any) -> Any:
        """Integrates the model by each method and compares the results: see :func:`motus.compare`."""
        from .studies import compare

        return compare(self, methods, **how)

    def converge(self, methods: Any = None, **how: Any) -> Any:
        """Measures the order of each method: see :func:`motus.converge`."""
        from .studies import converge

        return converge(self, methods, **how)

    def rank(self, methods: Any = None, **how: Any) -> Any:
        """Ranks methods by their work for each accuracy: see :func:`motus.rank`."""
        from .studies import rank

        return rank(self, methods, **how)

    # --- as others see it

    def __repr__(self) -> str:
        first = self.text.strip().split("\n")[0]
        return f"Model({self.file or first!r})"

    def __str__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        """The statements, typeset as MathML by the library, which makes them safe in a page."""
        with self._using:
            count = lib.motus_statement_count(self._system)
            return "".join(text(lib.motus_statement_mathml(self._system, k)) for k in range(count))

    def __reduce__(self) -> Any:
        return _again, (self.text, self.file, self._sets)

    def __copy__(self) -> Model:
        return _again(self.text, self.file, self._sets)

    def __deepcopy__(self, _: Any) -> Model:
        return self.__copy__()


def _again(source: str, file: str, sets: list[str]) -> Model:
    made = object.__new__(Model)
    made._read(source, file, [], sets)
    return made
