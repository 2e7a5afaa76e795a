"""`solve_ivp` and `solve`: against SciPy's meaning, closed forms, and the language."""
import ctypes
import traceback
import unittest

import motus
import numpy as np
from motus._motus import ffi

KIND = "int(void *, double, const double *, const double *, double *)"


def spring(t, y):
    return y[1], -y[0]


class Solve(unittest.TestCase):
    def test_a_function_and_a_text_agree(self):
        s = motus.solve_ivp(spring, (0, 20), [1, 0], "DOP853")
        w = motus.solve("x'' = -x\nx(0) = 0\nx'(0) = 0\n", (0, 20), 1, 0, "dop853")
        np.testing.assert_allclose(s.y[:, -1], [np.cos(20), -np.sin(20)], atol=1e-7)
        np.testing.assert_allclose(w.y[:, -1], s.y[:, -1], atol=1e-7)
        self.assertTrue((abs(s.y[:, -1] - [np.cos(20), -np.sin(20)]) <= s.error).all())
        self.assertEqual((s.success, s.status, s.y.shape[1], s.t[0], s.t[-1]), (True, 0, len(s.t), 0, 20))
        self.assertIn("calls of the function", s.note)

    def test_rows(self):
        times = np.linspace(0, 10, 7)
        s = motus.solve_ivp(spring, (0, 10), [1, 0], t_eval=times, dense_output=True)
        np.testing.assert_allclose(s.y[0], np.cos(times), atol=1e-7)
        np.testing.assert_allclose(s.sol([7, 3])[1], -np.sin([7, 3]), atol=1e-7)
        self.assertEqual(s.sol(3).shape, (2,))
        back = motus.solve_ivp(spring, (10, 0), [np.cos(10), -np.sin(10)])
        np.testing.assert_allclose(back.y[:, -1], [1, 0], atol=1e-7)

    def test_events(self):
        def crosses(t, y):
            return y[0]

        def lands(t, y):
            return y[1] + 0.5

        lands.terminal, lands.direction = True, 1
        s = motus.solve_ivp(spring, (0, 20), [1, 0], events=[crosses, lands])
        np.testing.assert_allclose(s.t_events[0], [np.pi / 2], atol=1e-8)
        np.testing.assert_allclose(s.t_events[1], [np.pi - np.arcsin(0.5)], atol=1e-8)
        np.testing.assert_allclose(s.y_events[0][0], [0, -1], atol=1e-8)
        self.assertEqual((s.status, s.t[-1]), (1, s.t_events[1][0]))
        self.assertEqual(len(motus.solve_ivp(spring, (0, 20), [1, 0], events=crosses).t_events[0]), 6)

    def test_arguments(self):
        s = motus.solve_ivp(lambda t, y, k: (y[1], -k * y[0]), (0, 1), [1, 0], args=(4,))
        self.assertAlmostEqual(s.y[0, -1], np.cos(2), 7)
        with self.assertRaises(TypeError):
            motus.solve_ivp(spring, (0, 1), [1, 0], first_step=0.1)
        with self.assertRaises(motus.MethodError):
            motus.solve_ivp(spring, (0, 1), [1, 0], "LSODA")
        with self.assertRaisesRegex(TypeError, "a text, a function"):
            motus.solve_ivp([1], (0, 1), [1, 0])
        with self.assertRaises(TypeError):
            motus.solve_ivp(spring, (0, 1), [[1, 0]])
        with self.assertRaisesRegex(TypeError, "complex"):
            motus.solve_ivp(lambda t, y: 1j * y, (0, 1), [1 + 0j])
        with self.assertRaisesRegex(ValueError, "direction"):
            motus.solve_ivp(spring, (0, 10), [1, 0], t_eval=[5, 3])
        np.testing.assert_allclose(motus.solve_ivp("x'' = -x", (0, 10), [1, 0]).y[:, -1], [np.cos(10), -np.sin(10)], atol=1e-8)
        with self.assertRaises(ValueError):
            motus.solve_ivp(lambda t, y: [1, 2, 3], (0, 1), [1, 0])

    def test_an_exception_comes_back_with_its_place(self):
        def fails(t, y):
            if t > 1:
                raise ZeroDivisionError("mine")
            return spring(t, y)

        try:
            motus.solve_ivp(fails, (0, 10), [1, 0])
        except ZeroDivisionError as error:
            self.assertIn("fails", [frame.name for frame in traceback.extract_tb(error.__traceback__)])
        else:
            self.fail("the exception is lost")

    def test_second_order(self):
        s = motus.solve(lambda t, x, v: -x, (0, 10), [1, 2], [0, 0], "verlet", step=0.01, reads_velocity=False)
        self.assertEqual(s.y.shape, (4, 1001))
        np.testing.assert_allclose(s.y[:2, -1], [np.cos(10), 2 * np.cos(10)], atol=1e-3)
        with self.assertRaises(motus.CallbackError):
            motus.solve(lambda t, x, v: -v, (0, 10), 1, 1, "verlet", step=0.01, reads_velocity=False)

    def test_compiled_functions(self):
        want = motus.solve_ivp(spring, (0, 10), [1, 0]).y[:, -1]

        def force(context, t, x, v, a):
            a[0], a[1] = v[1], -v[0]
            return 0

        numbers = ctypes.POINTER(ctypes.c_double)
        by_ctypes = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_void_p, ctypes.c_double, numbers, numbers, numbers)(force)
        by_cffi = ffi.callback(KIND, force)
        for compiled in (by_ctypes, by_cffi, int(ffi.cast("uintptr_t", by_cffi))):
            np.testing.assert_equal(motus.solve_ivp(compiled, (0, 10), [1, 0]).y[:, -1], want)
        try:
            import numba
        except ImportError:
            self.skipTest("no numba")
        np.testing.assert_equal(motus.solve_ivp(numba.cfunc(motus.signature)(force), (0, 10), [1, 0]).y[:, -1], want)
