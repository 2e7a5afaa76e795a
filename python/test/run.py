"""Runs the tests of the module: the examples of every docstring, and the cases of test_*.py; a line `ok` or `not ok` for each."""
import doctest
import importlib
import pathlib
import pkgutil
import sys
import unittest

import motus

sys.path.insert(0, str(pathlib.Path(__file__).parent))


class Lines(unittest.TestResult):
    def addSuccess(self, test):
        print("ok -", test.id(), flush=True)

    def addSkip(self, test, reason):
        print("ok -", test.id(), "# SKIP", reason, flush=True)

    def addFailure(self, test, err):
        super().addFailure(test, err)
        print("not ok -", test.id(), flush=True)
        print("    " + self._exc_info_to_string(err, test).replace("\n", "\n    "), flush=True)

    addError = addFailure

    def addSubTest(self, test, subtest, err):
        if err is not None:
            self.addFailure(subtest, err)


def examples():
    """The examples of the docstrings."""
    names = vars(motus)
    for module in [motus] + [importlib.import_module("motus." + m.name) for m in pkgutil.iter_modules(motus.__path__) if m.name != "_motus"]:
        for test in doctest.DocTestFinder().find(module, extraglobs=dict(names, np=__import__("numpy"))):
            if test.examples:
                yield doctest.DocTestCase(test)


def main(only):
    suite = unittest.TestSuite(examples())
    for file in sorted(pathlib.Path(__file__).parent.glob("test_*.py")):
        suite.addTests(unittest.defaultTestLoader.loadTestsFromName(file.stem))
    if only:
        suite = unittest.TestSuite(t for s in suite for t in (s if isinstance(s, unittest.TestSuite) else [s]) if any(o in str(t) or o in t.id() for o in only))
    result = Lines()
    suite.run(result)
    return result.wasSuccessful()


if __name__ == "__main__":
    sys.exit(not main(sys.argv[1:]))
