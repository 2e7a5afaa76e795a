"""The loops of notebook.py compiled by numba, its cache on: what becomes of them with one line more.

Prints the last position and the seconds that a second call took, which finds everything compiled.
"""
import math
import sys
import time

import numpy as np
from numba import njit

h = 0.001


@njit(cache=True)
def driven(steps=100000):
    x = np.zeros(steps + 1)
    x[1] = h**2 / 20
    for n in range(1, steps):
        x[n + 1] = 2 * x[n] - x[n - 1] + h**2 * (-x[n] + x[n]**3 + 0.1 * math.cos(n * h))
    return x


@njit(cache=True)
def damped(steps=3000):
    x = np.zeros(steps + 1)
    x[0] = 10
    x[1] = 10 - 500 * h**2
    for n in range(1, steps):
        x[n + 1] = (2 * x[n] - (1 - h / 2) * x[n - 1] - h**2 * x[n]**3) / (1 + h / 2)
    return x


loop = {"driven": driven, "damped": damped}[sys.argv[1]]
loop()
start = time.perf_counter()
x = loop()
print(repr(float(x[-1])), time.perf_counter() - start)
