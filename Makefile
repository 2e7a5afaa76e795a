# make              the program, build/motus, and the library
# make demo         runs and compares the founding models; tables here, plots in out/
# make lab          the page: build/lab/ for a server, build/lab/motus-lab.html for a double click
# make python       the Python module, build/python/motus
# make test         the tests of a change, in minutes: see test/steps; ends with "N passed, N failed"
# make test-all     every test: besides, sanitizers, fuzzers, browsers, MPI, Slurm, aarch64, musl; names what this machine cannot run
# make test-aarch64 every test program, compiled for aarch64 and run by qemu (make test-all does a part of it)
# make bench        ratios to hand-written code and to other libraries, and the page's times; RESULTS=bench/results keeps them
# make install      PREFIX=/usr/local DESTDIR=
# make fuzz         the fuzzers for FUZZ_SECONDS (60)      make tidy   clang-tidy      make manual   doc/ from the rows
# make format       the layout of the C, by .clang-format
# make functions    the elementary functions against MPFR: 1e7 random arguments each, and the hard ones (a quarter of an hour)
# make clean
#
# demo, lab, python, test, test-all, bench, fuzz and tidy install what is missing where they may (cmake/need.sh); the others say what is missing.
# Building is CMake's work: CMakeLists.txt, CMakePresets.json.

PREFIX ?= /usr/local
FUZZ_SECONDS ?= 60
RESULTS ?= build/bench
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
# The makes that CMake starts take their parallelism from here, not from this make's job server.
CMAKE = MAKEFLAGS=--no-print-directory CMAKE_BUILD_PARALLEL_LEVEL=$(JOBS) cmake

.PHONY: all demo lab python test test-all test-aarch64 bench install clean fuzz format tidy functions manual need-demo
.NOTPARALLEL:

all:
	@cmake/need.sh --check build
	@mkdir -p build
	@$(CMAKE) --preset release >build/configure.log 2>&1 || { cat build/configure.log; exit 1; }
	@$(CMAKE) --build build --target motus_static motus_shared motus_program

need-demo:
	@cmake/need.sh build demo

demo: need-demo all
	@cmake/demo.sh

lab:
	@cmake/need.sh build lab
	@JOBS=$(JOBS) cmake/lab.sh

python: all
	@cmake/need.sh python
	@$(CMAKE) --preset release -DMOTUS_PYTHON=ON >build/configure.log 2>&1 || { cat build/configure.log; exit 1; }
	@$(CMAKE) --build build --target motus_python

test:
	@cmake/need.sh build demo test
	@MAKEFLAGS= CMAKE_BUILD_PARALLEL_LEVEL=$(JOBS) test/summary test

test-all:
	@cmake/need.sh build demo test
	@cmake/need.sh --where-possible archives cluster cross musl lab page python fuzz format
	@MAKEFLAGS= CMAKE_BUILD_PARALLEL_LEVEL=$(JOBS) test/summary all

test-aarch64: all
	@cmake/need.sh build test cross aarch64
	@test/aarch64.sh all

# A library that is not installed, or a missed limit, is no failure.
bench:
	@cmake/need.sh build
	@cmake/need.sh bench || echo "motus: the comparison omits what is missing" >&2
	@mkdir -p build
	@$(CMAKE) --preset release -DMOTUS_BENCH=ON >build/configure.log 2>&1 || { cat build/configure.log; exit 1; }
	@$(CMAKE) --build build --target motus_program motus_bench
	@mkdir -p $(RESULTS)
	@build/bench/bench --save $(RESULTS)
	@if command -v node >/dev/null 2>&1; then node bench/page.mjs --save $(RESULTS); else echo "The page is not measured: that needs node."; fi

install: all
	@case '$(PREFIX)' in /*) prefix='$(PREFIX)' ;; *) prefix='$(CURDIR)/$(PREFIX)' ;; esac; \
	    $(CMAKE) --preset release -DCMAKE_INSTALL_PREFIX="$$prefix" >build/configure.log
	@$(CMAKE) --install build

fuzz:
	@cmake/need.sh build test fuzz
	@$(CMAKE) --preset asan >/dev/null && $(CMAKE) --build --preset asan --target fuzzers
	@FUZZ_SECONDS=$(FUZZ_SECONDS) cmake/fuzz.sh

# The layout of every C file, by .clang-format; test/format.sh checks it.
format:
	@cmake/need.sh format
	@git ls-files '*.[ch]' | xargs clang-format -i

tidy:
	@cmake/need.sh build tidy
	@$(CMAKE) --preset release >/dev/null
	@run-clang-tidy -quiet -p build '^$(CURDIR)/(base|core|lang|machine|api|study|archive|tell|cli)/'

functions:
	@cmake/need.sh build test
	@mkdir -p build
	@$(CMAKE) --preset release -DMOTUS_TESTS=ON >build/configure.log 2>&1 || { cat build/configure.log; exit 1; }
	@$(CMAKE) --build build --target functions_native_test
	@build/test/functions_native_test 10000000

manual: all
	@cmake/manual.sh

clean:
	rm -rf build out
