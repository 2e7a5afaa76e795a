"""What the module promises besides numbers: names, shapes, views, errors, interrupts, threads, pickles."""
import contextlib
import copy
import inspect
import io
import multiprocessing
import os
import pathlib
import pickle
import re
import signal
import threading
import time
import unittest

import motus
import numpy as np
from motus._motus import lib

HEADER = (pathlib.Path(__file__).parents[2] / "include" / "motus.h").read_text(encoding="utf-8")
SPRING = "x'' = -x\nx(0) = 1\nx'(0) = 0\n"
PAIR = "r[i]'' = -r[i] for i = 1..3\nr[i](0) = (i, 0) for i = 1..3\nr[i]'(0) = (0, 1) for i = 1..3\nenergy = |r[1]'|^2/2\n"


class Names(unittest.TestCase):
    def test_every_call_of_the_header_is_there(self):
        calls = set(re.findall(r"\b(motus_\w+)\(", "".join(re.findall(r"MOTUS_API[^;]*;", HEADER))))
        self.assertGreater(len(calls), 90)
        self.assertEqual(calls - set(dir(lib)), set())

    def test_every_status_has_a_class(self):
        words = [motus.errors.text(lib.motus_status_word(k)) for k in range(1, lib.MOTUS_STATUS_COUNT)]
        self.assertEqual(set(words), set(motus.errors.CLASSES))

    def test_every_public_name_says_what_it_is(self):
        for name in motus.__all__:
            made = getattr(motus, name)
            if inspect.isclass(made) and issubclass(made, motus.Error):
                continue
            self.assertTrue(inspect.getdoc(made) if not isinstance(made, str) else made, name)

    def test_version(self):
        self.assertEqual(motus.__version__, re.search(r'MOTUS_VERSION "(.*)"', HEADER)[1])


class Manual(unittest.TestCase):
    def test_the_example_of_the_readme_prints_what_it_says(self):
        text = (pathlib.Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
        example = re.search(r"```python\n(.*?)```", text, re.S)[1]
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            exec(example, {})
        self.assertEqual(out.getvalue().strip(), re.search(r"print\(.*# (.*)", example)[1])


class Models(unittest.TestCase):
    def test_what_a_text_lacks_is_added_to_it(self):
        m = motus.Model("x'' = -k x", k=4, x=1, v=0.5)
        self.assertEqual((m.k, m["x(0)"], m["x'(0)"]), (4, 1, 0.5))
        self.assertEqual(motus.Model(m.text).initial, m.initial)

    def test_what_it_has_is_replaced(self):
        m = motus.Model("k = 1\nx'' = -k x\nx(0) = 1\nx'(0) = 0\n")
        other = m.replace(k=9, v=2)
        self.assertEqual((m.k, other.k, other["x'(0)"], other["x(0)"]), (1, 9, 2, 1))
        self.assertEqual(other.replace(x=3).k, 9)

    def test_lists_and_vectors(self):
        m = motus.Model("r'' = g - sum(i = 1..3: w[i]) r", g=(0, -9.81), w=np.array([1, 2, 3.5]),
                        start={"r": (1, 2), "r'": (0, 0)})
        np.testing.assert_equal(m.g, [0, -9.81])
        np.testing.assert_equal(m.w, [1, 2, 3.5])

    def test_an_unknown_name_says_which_is_meant(self):
        m = motus.Model("omega = 1\nx'' = -omega^2 x\nx(0) = 1\nx'(0) = 0\n")
        with self.assertRaisesRegex(AttributeError, "did you mean 'omega'"):
            m.omeg
        with self.assertRaisesRegex(KeyError, "x\\(0\\)"):
            m["x(O)"]
        with self.assertRaisesRegex(AttributeError, "did you mean 'compare'"):
            m.compar
        with self.assertRaises(TypeError):
            m.run(until=1, stepp=3)
        with self.assertRaisesRegex(ValueError, "'cheap', 'full'"):
            m.run(until=1, error="some")

    def test_an_error_has_its_place(self):
        with self.assertRaises(motus.UnknownNameError) as caught:
            motus.Model("x'' = -x + yy\nx(0) = 1\nx'(0) = 0\n")
        e = caught.exception
        self.assertEqual((e.line, e.column, e.source, e.caret.strip()), (1, 12, "x'' = -x + yy", "^^"))
        self.assertIsInstance(e, ValueError)
        again = pickle.loads(pickle.dumps(e))
        self.assertEqual((type(again), str(again)), (type(e), str(e)))

    def test_an_error_in_the_text_stands_in_the_text(self):
        with self.assertRaises(motus.TextError) as caught:
            motus.Model("x'' = -x +", x=1, v=0)
        self.assertEqual(caught.exception.line, 1)

    def test_a_name_that_the_text_lacks_is_an_error(self):
        for make in (lambda: motus.Model("x'' = -x + F", F=0, x=0, v=0, k=3), lambda: motus.Model("x'' = -x + F", F=0, x=0, v=0).replace(f=1)):
            with self.assertRaisesRegex(motus.UnknownNameError, "the text has no"):
                make()

    def test_a_model_does_not_change(self):
        m = motus.Model("x'' = -F x", F=1, x=1, v=0)
        with self.assertRaisesRegex(AttributeError, "replace"):
            m.F = 4
        np.testing.assert_equal(motus.Model("r'' = -r", r=np.array([1, 0]), start={"r'": [0, 1]})["r(0)"], [1, 0])

    def test_numbers_that_are_none(self):
        with self.assertRaisesRegex(TypeError, "k is"):
            motus.Model("x'' = -k x", k=object(), x=1, v=0)
        with self.assertRaises(motus.Error):
            motus.Model("x'' = -k x", k=float("nan"), x=1, v=0)

    def test_html_is_escaped(self):
        html = motus.Model("x'' = -x # <script>alert(1)</script>\nx(0) = 1\nx'(0) = 0\n")._repr_html_()
        self.assertIn("<math", html)
        self.assertNotIn("script>", html)


class Runs(unittest.TestCase):
    def test_views_have_the_shape_of_families_and_vectors(self):
        r = motus.Model(PAIR).run(until=1, method="verlet", step=0.01)
        self.assertEqual((r.r.shape, r["r'"].shape, r.energy.shape), ((101, 3, 2), (101, 3, 2), (101,)))
        self.assertTrue(np.shares_memory(r.r, r.table) and np.shares_memory(r.energy, r.table))
        np.testing.assert_equal(r.r[:, 2, 1], r["r[3].y"])
        self.assertEqual(r.r[-1, 2, 1], r.final["r[3].y"])

    def test_rows(self):
        m = motus.Model(SPRING)
        self.assertEqual(len(m.run(until=1, method="verlet", step=0.01).t), 101)
        np.testing.assert_allclose(m.run(until=1, every=0.3).t, [0, 0.3, 0.6, 0.9, 1])
        np.testing.assert_equal(m.run(until=1, times=[0.25, 0.5]).t, [0.25, 0.5])
        np.testing.assert_allclose(m.run(until=-1, every=0.5).t, [0, -0.5, -1])
        self.assertEqual(len(m.run(until=1).t), 1001)
        r = m.run(until=10, columns=["x'"])
        self.assertEqual((r.names, r["x'"].shape), (["x'"], (1001,)))
        with self.assertRaises(TypeError):
            m.run(until=1, every=0.1, times=[1])

    def test_the_error_holds(self):
        for method, step in (("verlet", 0.01), ("rk4", 0.01), (None, None)):
            r = motus.Model(SPRING).run(until=20, method=method, step=step)
            off = abs(r.final["x"] - np.cos(20))
            self.assertLessEqual(off, r.error["x"])
            self.assertGreater(off, r.error["x"] / 1000)

    def test_an_event_ends_the_run(self):
        r = motus.Model("x'' = -1\nx(0) = 2\nx'(0) = 0\nwhen x = 0 falling as ground: record, stop\n").run(until=10, every=0.75)
        np.testing.assert_allclose(r.t, [0, 0.75, 1.5, 2])
        self.assertEqual((len(r.events), r.events[0].name), (1, "ground"))
        self.assertAlmostEqual(r.x[-1], 0, 12)

    def test_at_is_the_dense_output(self):
        r = motus.Model(SPRING).run(until=10, method="dop853", tolerance=1e-10)
        times = np.array([7.5, 0.3, 3])
        np.testing.assert_allclose(r.at(times)["x"], np.cos(times), atol=1e-8)
        self.assertEqual(r.at(3.0)["x"].shape, ())

    def test_a_failure_says_when(self):
        with self.assertRaises(motus.Error) as caught:
            motus.Model("x'' = x^3\nx(0) = 1\nx'(0) = 1\n").run(until=10)
        self.assertEqual(caught.exception.cause, "singular")
        self.assertLess(caught.exception.time, 10)

    def test_a_stepper_goes_on_to_the_same_bits(self):
        m = motus.Model(SPRING)
        whole = m.run(until=10, method="dop853", tolerance=1e-9)
        s = m.start(until=10, method="dop853", tolerance=1e-9).step(5)
        for again in (s, copy.copy(s), pickle.loads(pickle.dumps(s)), m.start(until=10, method="dop853", tolerance=1e-9, state=s.save())):
            self.assertEqual(again.finish()["x"], whole.final["x"])

    def test_pickles(self):
        m = motus.Model(PAIR)
        r = pickle.loads(pickle.dumps(m.run(until=1, method="verlet", step=0.01)))
        self.assertEqual((r.r.shape, len(r.final)), ((101, 3, 2), len(r.names)))
        self.assertEqual(pickle.loads(pickle.dumps(m)).text, m.text)

    def test_a_pickle_compiles_and_runs_nothing(self):
        body = pickle.dumps(motus.Model(SPRING))
        names = set(re.findall(rb"motus[.\w]*", body))
        self.assertTrue(all(n.startswith(b"motus.model") for n in names), names)


def square(k):
    return motus.Model(SPRING).run(until=k, method="verlet", step=0.01).final["x"]


class Citizen(unittest.TestCase):
    def interrupted(self, call):
        timer = threading.Timer(0.15, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):  # what would take hours ends
            call()
        timer.join()

    def test_ctrl_c_ends_what_computes(self):
        m = motus.Model("x'' = -x + x^3 + F cos(t)", F=0.1, x=0, v=0)
        self.interrupted(lambda: m.run(until=1e8, method="verlet", step=1e-3, times=[]))
        self.interrupted(lambda: m.sweep(F=np.linspace(0, 0.1, 10**7), until=1000, step=1e-3))
        self.interrupted(lambda: m.compare(until=1e4, step=1e-3))
        self.interrupted(lambda: motus.solve_ivp(lambda t, y: (y[1], -y[0]), (0, 1e7), [1, 0]))
        self.assertAlmostEqual(m.run(until=100).final["x"], 0.0477830956567, 10)

    def test_a_stepper_that_was_interrupted_goes_on(self):
        s = motus.Model(SPRING).start(until=1e8, method="verlet", step=1e-2, error="none")
        self.interrupted(s.finish)
        t = s.t
        self.assertTrue(0 < t < 1e8)
        self.assertEqual(s.step().t, t + 1e-2 if t + 1e-2 == s.t else s.t)

    def test_two_threads(self):
        s = motus.Model(SPRING).start(until=1e8, method="verlet", step=1e-2, error="none")
        stop = threading.Event()
        s._live.watch.progress = lambda part: stop.is_set()
        caught = []

        def finish():
            try:
                s.finish()
            except motus.CancelledError as e:
                caught.append(e)

        other = threading.Thread(target=finish)
        other.start()
        time.sleep(0.1)
        with self.assertRaisesRegex(RuntimeError, "another thread"):
            s.step()
        stop.set()
        other.join()
        self.assertEqual(len(caught), 1)

    def test_the_gil_is_free_meanwhile(self):
        s = motus.Model(SPRING).start(until=1e5, method="verlet", step=1e-2, error="none", machine="interpreter")
        other = threading.Thread(target=s.finish)
        other.start()
        counted = 0
        while other.is_alive():
            counted += 1
        self.assertGreater(counted, 1000)

    def test_fork_and_spawn(self):
        want = [square(k) for k in (1, 2, 3)]
        for how in ("fork", "spawn"):
            with multiprocessing.get_context(how).Pool(2) as pool:
                self.assertEqual(pool.map(square, (1, 2, 3)), want)

    def test_progress_cancels(self):
        seen = []
        with self.assertRaises(motus.CancelledError):
            motus.Model(SPRING).run(until=1e7, method="verlet", step=1e-2, times=[], progress=lambda part: seen.append(part) or len(seen) > 3)
        self.assertEqual(len(seen), 4)
        with self.assertRaisesRegex(ZeroDivisionError, "mine"):
            motus.Model(SPRING).run(until=1e7, method="verlet", step=1e-2, times=[], progress=lambda part: (_ for _ in ()).throw(ZeroDivisionError("mine")))
