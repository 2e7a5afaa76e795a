"""The module's numbers are those of the program, bit for bit."""
import json
import os
import pathlib
import subprocess
import unittest

import motus
import numpy as np
from motus.places import find

PROGRAM, MODELS = os.environ["MOTUS"], pathlib.Path(__file__).parents[2] / "models"


def program(path, *words):
    """What the program says of a run; None: it refuses it."""
    done = subprocess.run([PROGRAM, "run", str(path), "--json", *words], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    return json.loads(done.stdout)["state"] if done.returncode == 0 else None


def short(model, path):
    """An end for a run by every method of a model, 50 of its own steps away."""
    how = model.run(times=[], error="none", method="verlet" if "verlet" in model.methods else model.methods[0])
    step = how.statistics["step"]
    start = model.start(error="none").t
    return start + 50 * (step if step == step else 0.01)


class Models(unittest.TestCase):
    def agree(self, run, state):
        self.assertTrue(state)
        numbers = list(run.final.values())
        for name, value in state.items():
            place = find(run.model._system, name)
            np.testing.assert_equal(numbers[place.first : place.first + place.count], np.ravel(value), name)


for path in sorted(MODELS.glob("*.motus")):
    def by_default(self, path=path):
        self.agree(motus.Model(path).run(times=[]), program(path))

    def by_every_method(self, path=path):
        model = motus.Model(path)
        until = short(model, path)
        for method in model.methods:
            with self.subTest(method):
                state = program(path, "--method", method, "--until", repr(until))
                if state is None:
                    with self.assertRaises(motus.Error):
                        model.run(until, method=method, times=[])
                else:
                    self.agree(model.run(until, method=method, times=[]), state)

    setattr(Models, "test_" + path.stem, by_default)
    setattr(Models, "test_every_method_" + path.stem, by_every_method)
