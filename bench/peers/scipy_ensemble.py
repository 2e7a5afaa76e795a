"""SciPy, one trajectory after another: x'' = -x + x^3 + F cos t from rest at 0 to t = 1, F as given.

A fixed step would be a thousand calls of Python for nothing, so SciPy may choose its steps; the tolerance is what makes its answer as
good as a thousand steps of rk4 (1e-13). Prints x of the last trajectory and the seconds per trajectory of the faster of odeint
and solve_ivp.
"""
import math
import sys
import time

from scipy.integrate import odeint, solve_ivp

amplitudes = [float(a) for a in sys.argv[1:]]


def rates(t, y, F):
    return y[1], -y[0] + y[0]**3 + F * math.cos(t)


def by_odeint(F):
    return odeint(rates, (0.0, 0.0), (0.0, 1.0), args=(F,), tfirst=True, rtol=1e-12, atol=1e-13)[-1, 0]


def by_solve_ivp(F):
    return solve_ivp(rates, (0.0, 1.0), (0.0, 0.0), method="DOP853", args=(F,), rtol=1e-12, atol=1e-13).y[0, -1]


best = math.inf
for solver in by_odeint, by_solve_ivp:
    solver(amplitudes[0])
    start = time.perf_counter()
    for F in amplitudes:
        x = solver(F)
    took = (time.perf_counter() - start) / len(amplitudes)
    if took < best:
        best, answer = took, x
print(repr(float(answer)), best)
