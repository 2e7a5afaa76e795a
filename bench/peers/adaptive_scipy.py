"""SciPy's DOP853: a problem of bench/problems.h by a tolerance.

    adaptive_scipy.py PROBLEM UNTIL TOLERANCE START...

Forces are as one writes them for speed: floats for few bodies, arrays for many. Prints the seconds of solve_ivp, then the state at the
end.
"""
import math
import sys
import time

import numpy
from scipy.integrate import solve_ivp


def kepler(t, y):
    p, q, u, v = y.tolist()
    rr = p * p + q * q
    k = 1 / (rr * math.sqrt(rr))
    return u, v, -k * p, -k * q


def arenstorf(t, y, mu=0.012277471, nu=1 - 0.012277471):
    p, q, u, v = y.tolist()
    d1, d2 = (p + mu)**2 + q * q, (p - nu)**2 + q * q
    k1, k2 = nu / (d1 * math.sqrt(d1)), mu / (d2 * math.sqrt(d2))
    return u, v, p + 2 * v - k1 * (p + mu) - k2 * (p - nu), q - 2 * u - (k1 + k2) * q


def henon(t, y):
    p, q, u, v = y.tolist()
    return u, v, -p - 2 * p * q, -q - p * p + q * q


def gravity(masses, dimensions):
    count = len(masses)
    eye = numpy.eye(count)

    def rates(t, y):
        r = y[:dimensions * count].reshape(count, dimensions)
        apart = r[None, :, :] - r[:, None, :]
        rr = (apart * apart).sum(axis=2) + eye
        a = (apart * (masses / (rr * numpy.sqrt(rr)))[:, :, None]).sum(axis=1)
        return numpy.concatenate((y[dimensions * count:], a.ravel()))

    return rates


FORCES = {
    "kepler": kepler,
    "arenstorf": arenstorf,
    "henon": henon,
    "pleiades": gravity(numpy.arange(1.0, 8.0), 2),
    "solar": gravity(2.95912208286e-4 * numpy.array([1.00000597682, 0.000954786104043, 0.000285583733151, 0.0000437273164546,
                                                     0.0000517759138449, 1 / 1.3e8]), 3),
}
until, tolerance, state = float(sys.argv[2]), float(sys.argv[3]), [float(y) for y in sys.argv[4:]]
begin = time.process_time()
found = solve_ivp(FORCES[sys.argv[1]], (0.0, until), state, method="DOP853", rtol=tolerance, atol=tolerance, t_eval=(until,))
print(time.process_time() - begin, *(repr(float(y)) for y in found.y[:, -1]))
