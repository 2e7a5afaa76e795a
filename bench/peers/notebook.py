"""The founding notebook's two examples, each as a loop over a NumPy array: Verlet's recursion as one writes it first.

    notebook.py driven    x'' = -x + x^3 + 0.1 cos t from rest at 0, 100 000 steps of 0.001
    notebook.py damped    x'' = -x' - x^3 from 10 at rest, 3000 steps of 0.001

Prints the last position and the seconds that the loop alone took.
"""
import sys
import time

import numpy as np

h = 0.001


def driven(steps=100000):
    x = np.zeros(steps + 1)
    x[1] = h**2 / 20
    for n in range(1, steps):
        x[n + 1] = 2 * x[n] - x[n - 1] + h**2 * (-x[n] + x[n]**3 + 0.1 * np.cos(n * h))
    return x


def damped(steps=3000):
    x = np.zeros(steps + 1)
    x[0] = 10
    x[1] = 10 - 500 * h**2
    for n in range(1, steps):
        x[n + 1] = (2 * x[n] - (1 - h / 2) * x[n - 1] - h**2 * x[n]**3) / (1 + h / 2)
    return x


loop = {"driven": driven, "damped": damped}[sys.argv[1]]
start = time.perf_counter()
x = loop()
print(repr(float(x[-1])), time.perf_counter() - start)
