"""Sweeps and studies: the numbers are those of single runs, and of the program."""
import csv
import os
import pathlib
import subprocess
import tempfile
import unittest

import motus
import numpy as np

FOUNDING = "F = 0.1\nx'' = -x + x^3 + F cos(t)\nx(0) = 0\nx'(0) = 0\nuntil 10\nstep 0.01\n"


class Sweeps(unittest.TestCase):
    def test_each_is_a_run(self):
        m = motus.Model(FOUNDING)
        F = np.linspace(0, 0.2, 9)
        s = m.sweep(F=F, record="final, max(x)")
        self.assertEqual(list(s), ["F", "x", "x'", "max(x)"])
        for k in (0, 4, 8):
            r = m.replace(F=F[k]).run(method="verlet")
            self.assertEqual((s["x"][k], s["max(x)"][k]), (r.final["x"], r.x.max()))
        self.assertTrue(np.shares_memory(s["x"], s.table) and np.isnan(s.stopped).all())

    def test_a_product(self):
        s = motus.Model(FOUNDING).sweep(F=[0, 0.1], x=[0, 0.1, 0.2], product=True, record="x")
        self.assertEqual(s["x"].shape, (2, 3))
        one = motus.Model(FOUNDING).replace(F=0.1, x=0.2).run(method="verlet")
        self.assertEqual(s["x"][1, 2], one.final["x"])
        with self.assertRaisesRegex(TypeError, "product=True"):
            motus.Model(FOUNDING).sweep(F=[0, 0.1], x=[0, 0.1, 0.2])
        with self.assertRaises(TypeError):
            motus.Model(FOUNDING).sweep()
        with self.assertRaises(motus.UnknownNameError):
            motus.Model(FOUNDING).sweep(G=[0, 1])

    def test_errors_hold(self):
        s = motus.Model("w = 1\nx'' = -w^2 x\nx(0) = 1\nx'(0) = 0\n").sweep(w=[1, 2, 3], until=10, step=0.01, error=True, record="x")
        off = abs(s["x"] - np.cos(10 * s["w"]))
        self.assertTrue((off <= s.errors[0]).all() and (off > s.errors[0] / 1000).all())

    def test_the_program_has_the_same_bits(self):
        with tempfile.TemporaryDirectory() as place:
            path = pathlib.Path(place)
            (path / "m.motus").write_text(FOUNDING)
            subprocess.run([os.environ["MOTUS"], "sweep", "m.motus", "--vary", "F=0:0.2:9", "--record", "x,max(x)", "-o", "rows.csv", "-q"],
                           cwd=path, check=True, stdout=subprocess.DEVNULL)
            lines = [line for line in (path / "rows.csv").read_text().splitlines() if not line.startswith("#")]
        rows = list(csv.DictReader(lines))
        s = motus.Model(FOUNDING).sweep(F=[float(row["F"]) for row in rows], record="x, max(x)")
        for name in ("x", "max(x)"):
            np.testing.assert_equal(s[name], [float(row[name]) for row in rows])


class Studies(unittest.TestCase):
    def test_tables(self):
        m = motus.Model(FOUNDING)
        t = m.compare(["verlet", "rk4"])
        self.assertLess(t["rk4"]["error_max_x"], t["verlet"]["error_max_x"])
        self.assertEqual(t["method"].tolist(), ["verlet", "rk4"])
        self.assertIn("<td>verlet</td>", t._repr_html_())
        c = m.converge(["verlet", "rk4"])
        self.assertTrue(c.passed and abs(c["verlet"]["observed"] - 2) < 0.05 and len(c["rk4"]["points"]) > 3)
        r = m.rank(["verlet", "dop853"], finest=1e-6)
        self.assertLess(r["dop853"]["1e-06"], r["verlet"]["1e-06"])
        with self.assertRaises(motus.MethodError):
            m.compare(["verle"])
