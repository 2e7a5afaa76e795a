"""What goes wrong, as exceptions: a class for every status of the library, all of them :class:`Error`."""
from __future__ import annotations

from typing import Any

from ._motus import ffi, lib

__all__ = ["Error"]


def text(value: Any) -> str:
    """Returns a string of the library; "" for NULL."""
    return ffi.string(value).decode("utf-8", "replace") if value != ffi.NULL else ""


class Error(Exception):
    """Something that motus could not do: one sentence, and where the text, the motion or the argument is wrong.

    Attributes:
        message: the sentence.
        hint: what to do, or "".
        line, column: of an error in a model's text its place, both from 1; else 0.
        source, caret: the line of the text, and blanks and carets to print under it, or "".
        file: the name of the model, or "".
        time: of a failure of a run its time; else NaN.
        variable: the number that failed, ``"r[3].y"``, or the event; else "".
        cause: why a run failed, ``"singular"``, as far as that is known; else "".
        status: the word of the library's status, ``"diverged"``.
    """

    status = ""

    def __init__(self, message: str, **where: Any) -> None:
        super().__init__(message)
        self.message = message
        self.hint: str = where.get("hint", "")
        self.line: int = where.get("line", 0)
        self.column: int = where.get("column", 0)
        self.source: str = where.get("source", "")
        self.caret: str = where.get("caret", "")
        self.file: str = where.get("file", "")
        self.time: float = where.get("time", float("nan"))
        self.variable: str = where.get("variable", "")
        self.cause: str = where.get("cause", "")

    def __str__(self) -> str:
        place = f"{self.file}:" * bool(self.file) + f"{self.line}:{self.column}:" * bool(self.line)
        lines = [f"{place} {self.message}" if place else self.message]
        if self.source:
            lines += ["    " + self.source, "    " + self.caret]
        if self.hint:
            lines.append("  hint: " + self.hint)
        return "\n".join(lines)

    def __reduce__(self) -> Any:
        return _again, (type(self), self.message, {k: v for k, v in vars(self).items() if k != "message"})


def _again(kind: type[Error], message: str, where: dict[str, Any]) -> Error:
    return kind(message, **where)


class OutOfMemoryError(Error, MemoryError): status = "memory"
class DivergedError(Error, RuntimeError): status = "diverged"
class SolveError(Error, RuntimeError): status = "solve"
class CallbackError(Error, RuntimeError): status = "callback"
class CancelledError(Error, RuntimeError): status = "cancelled"
class FileError(Error, OSError): status = "file"
class OrderError(Error, RuntimeError): status = "order"
class ToolError(Error, RuntimeError): status = "tool"
class ArgumentError(Error, ValueError): status = "argument"
class TextError(Error, ValueError): status = "syntax"
class UnknownNameError(Error, ValueError): status = "name"
class ShapeError(Error, ValueError): status = "shape"
class LimitError(Error, ValueError): status = "limit"
class MethodError(Error, ValueError): status = "method"
class StateError(Error, ValueError): status = "state"
class UnavailableError(Error, RuntimeError): status = "unavailable"
class SingularError(Error, RuntimeError): status = "singular"
class UnresolvedError(Error, RuntimeError): status = "unresolved"
class AccuracyError(Error, RuntimeError): status = "accuracy"
class StepsError(Error, RuntimeError): status = "steps"
class EventsError(Error, RuntimeError): status = "events"


CLASSES: dict[str, type[Error]] = {c.status: c for c in Error.__subclasses__()}
__all__ += [c.__name__ for c in CLASSES.values()]


def error_of(err: Any) -> Error:
    """Makes the exception of a ``motus_error``."""
    kind = CLASSES.get(text(lib.motus_status_word(err.status)), Error)
    return kind(text(err.message), hint=text(err.hint), line=err.line, column=err.column, source=text(err.source),
                caret=text(err.caret), file=text(err.file), time=err.time, variable=text(err.variable),
                cause=text(lib.motus_cause_word(err.cause)))
