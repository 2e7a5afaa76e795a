#!/usr/bin/env python3
"""Writes the C text of the extension module, which CMake compiles: build.py INCLUDE OUT.c COMPILER"""
import sys

import cffi

from declarations import CALLBACKS, declarations, source


def main(include, out, compiler):
    builder = cffi.FFI()
    builder.cdef(declarations(include, compiler))
    builder.cdef(CALLBACKS)
    builder.set_source("motus._motus", source(), py_limited_api=True)
    builder.emit_c_code(out)


if __name__ == "__main__":
    main(*sys.argv[1:])
