# Everything a checkout can do, on a machine with Python (3.11 or later), pip and make.
#
#   make demo               press three rough surfaces: tables, files and pictures in out/demo/
#   make demo FILE=part.x3p the same with a measured surface of yours (where it lacks them: ARGS="--unit nm --size 1mm";
#                           of what bodies: ARGS="--materials steel,aluminium")
#   make thesis FIG=fig27   compute and draw a figure of the thesis in out/thesis/ (FIG=list: which there are)
#   make test               run the tests                 (ARGS="-k curve" for some of them)
#   make browser            install what those of the page need, if it can be had: Playwright, and a Chromium if there is none
#   make ccx                install what those in CalculiX need, if it can be had: ccx, where apt-get can install it
#   make mpi                the tests on several processes, if mpi4py and an MPI can be had
#   make nox                the tests with the kernels of other processors (ARGS="-s tests lowest": see noxfile.py)
#   make quick              the tests without the slow ones
#   make check              in two minutes: style, prose, types, and the tests of the whole house and of what was changed
#   make lint               style, prose, and types on Linux, macOS and Windows
#   make docs               build the site of the documentation in build/docs
#   make bench              compare with other programs, where they can be installed
#   make clean              remove what the above have made
#
# PYTHON=python3.12 picks the interpreter of the environment that the first call builds in .venv.

PYTHON ?= python3
FILE ?=
FIG ?= list
ARGS ?=

ENV := .venv
BIN := $(ENV)/bin
BENCH_ENV := build/bench-env
MPI_ENV := build/mpi-env
ASKED := pyproject.toml reproduction/pyproject.toml
# Dependencies come as wheels: nothing is built here, and a missing wheel is an error at once. Python compiles a module
# when it is first imported: most modules of PyTorch, JAX and SciPy never are.
INSTALL = -m pip install -qq --disable-pip-version-check --only-binary=:all: --no-compile
# Without a network six tries, pip's own number, take as long as a hang.
export PIP_RETRIES ?= 2
export PIP_DEFAULT_TIMEOUT ?= 15
# Hundreds of tests start the program, which would be compiled anew each time.
unexport PYTHONDONTWRITEBYTECODE
# PyTorch built for processors alone, which only some indices and folders of wheels hold; the common one is several GB.
TORCH ?= torch==2.13.0+cpu
JAX ?= jax==0.10.2
STYLE = $(BIN)/python -m ruff check . && $(BIN)/python -m ruff format --check . && $(BIN)/python .ci/prose.py
APT = DEBIAN_FRONTEND=noninteractive timeout 120 apt-get install -y -qq
# A process a core, so one thread for the linear algebra of each.
ONE_THREAD := OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 MKL_NUM_THREADS=1

.PHONY: help demo thesis test quick browser ccx mpi nox check lint docs bench clean
.DEFAULT_GOAL := help

help:
	@sed -n '3,19s/^# *//p' Makefile

# A file of the user's may be in any format that instruments write.
demo: $(if $(FILE),$(ENV)/.ready-to-read,$(ENV)/.ready)
	@$(BIN)/python examples/demo.py $(if $(FILE),--file "$(FILE)") $(ARGS) \
	  && echo "demo: OK - see out/demo/" || { status=$$?; echo "demo: FAILED"; exit $$status; }

thesis: $(ENV)/.ready
	@$(BIN)/roughcontact thesis $(FIG) --out out/thesis $(ARGS) \
	  && echo "thesis: OK" || { status=$$?; echo "thesis: FAILED"; exit $$status; }

test: $(ENV)/.ready-to-test
	@$(ONE_THREAD) $(BIN)/python -m pytest -n auto $(ARGS) \
	  && echo "test: OK" || { echo "test: FAILED"; exit 1; }

quick: $(ENV)/.ready-to-test
	@$(ONE_THREAD) $(BIN)/python -m pytest -q -n auto -m "not slow" $(ARGS) \
	  && echo "quick: OK" || { echo "quick: FAILED"; exit 1; }

# What the tests in a browser need beside it; where it cannot be had they are skipped, and say so.
browser: $(ENV)/.ready-to-test
	@$(BIN)/python $(INSTALL) -e ".[browser]" && { command -v chromium || command -v chromium-browser || command -v google-chrome \
	  || timeout 300 $(BIN)/python -m playwright install chromium; } >/dev/null 2>&1 \
	  && echo "browser: OK" || echo "browser: cannot be had here, its tests are skipped"

# The finite elements in which tables of an interface are tested; where they cannot be had those tests are skipped.
ccx:
	@{ command -v ccx || { test "$$(id -u)" = 0 && command -v apt-get && { $(APT) calculix-ccx \
	  || { timeout 120 apt-get update -qq && $(APT) calculix-ccx; }; }; }; } >/dev/null 2>&1 \
	  && echo "ccx: OK" || echo "ccx: cannot be had here, its tests are skipped"

# In an environment of their own, which sees what is in the other: with mpi4py installed, whatever looks for it listens
# to the network and reads through it.
mpi: $(MPI_ENV)/.ready
	@if $(MPI_ENV)/bin/python -c "import mpi4py.MPI" 2>/dev/null; \
	  then $(ONE_THREAD) $(MPI_ENV)/bin/python -m pytest -q tests/slabs/test_mpi*.py $(ARGS) \
	    && echo "mpi: OK" || { echo "mpi: FAILED"; exit 1; }; \
	  else echo "mpi: cannot be had here, the tests on several processes are skipped"; fi

nox: $(ENV)/.ready-to-test
	@$(BIN)/python -m nox $(ARGS) \
	  && echo "nox: OK" || { echo "nox: FAILED"; exit 1; }

check: $(ENV)/.ready-to-test
	@$(STYLE) && $(BIN)/python -m mypy --platform linux --cache-dir .mypy_cache/linux \
	  && $(ONE_THREAD) $(BIN)/python -m pytest -q -n auto $$($(BIN)/python .ci/quick.py) $(ARGS) \
	  && echo "check: OK" || { echo "check: FAILED"; exit 1; }

# Types on all systems at once, each with its own cache.
lint: $(ENV)/.ready-to-test
	@$(STYLE) && printf '%s\n' linux darwin win32 \
	    | xargs -P 3 -I SYSTEM $(BIN)/python -m mypy --platform SYSTEM --cache-dir .mypy_cache/SYSTEM \
	  && echo "lint: OK" || { echo "lint: FAILED"; exit 1; }

docs: $(ENV)/.ready-to-write
	@rm -rf build/docs
	@$(BIN)/python -m sphinx -qEW --keep-going -j auto -d build/doctrees docs build/docs \
	  && $(BIN)/python docs/search_check.py build/docs \
	  && echo "docs: OK - see build/docs/index.html" || { echo "docs: FAILED"; exit 1; }

bench: $(BENCH_ENV)/.ready
	@$(BENCH_ENV)/bin/python benchmarks/suite run $(ARGS) \
	  && echo "bench: OK" || { echo "bench: FAILED"; exit 1; }

clean:
	rm -rf $(ENV) build docs/gallery docs/project/[A-Z]*.md docs/api dist out .nox .pytest_cache .mypy_cache .ruff_cache .hypothesis
	find . -name __pycache__ -type d -prune -exec rm -rf {} +
	@echo "clean: OK"

# pip is called where what pyproject.toml asks for has changed, here or in reproduction/, not whenever the file is newer.
$(ENV)/.ready: $(ASKED)
	@$(call create,$(ENV))
	@$(BIN)/python .ci/install.py $@ "Installing roughcontact and the figures of the thesis into $(ENV) ..."

$(ENV)/.ready-to-read: $(ENV)/.ready $(ASKED)
	@$(BIN)/python .ci/install.py $@ "Installing the readers of instrument formats ..." formats

$(ENV)/.ready-to-test: $(ENV)/.ready $(ASKED)
	@$(BIN)/python .ci/install.py $@ "Installing what the tests need ..." formats page test lint
	@for each in "$(TORCH)" "$(JAX)"; do \
	  $(BIN)/python $(INSTALL) "$$each" 2>/dev/null || echo "$$each: not found here, its tests are skipped"; done

$(MPI_ENV)/.ready: $(ENV)/.ready-to-test
	@$(call create,$(MPI_ENV))
	@echo "Installing what the tests on several processes need ..."
	@$(BIN)/python -c "import site; print('import site; site.addsitedir(%r)' % site.getsitepackages()[0])" \
	  > "$$($(MPI_ENV)/bin/python -c 'import site; print(site.getsitepackages()[0])')/tests.pth"
	@{ $(MPI_ENV)/bin/python $(INSTALL) -e ".[mpi]" && { command -v mpiexec || $(MPI_ENV)/bin/python $(INSTALL) mpich; }; } >/dev/null 2>&1 || true
	@touch $@

$(ENV)/.ready-to-write: $(ENV)/.ready $(ASKED)
	@$(BIN)/python .ci/install.py $@ "Installing what the site is built with ..." formats docs
	@$(BIN)/python $(INSTALL) -e ".[browser]" 2>/dev/null || echo "playwright: not found here, the site's search is not asked"

# The other programs live in an environment of their own; some of them are under licences that this
# project does not take in. One that cannot be installed is left out of the comparison.
$(BENCH_ENV)/.ready: pyproject.toml
	@$(call create,$(BENCH_ENV))
	@echo "Installing roughcontact and its peers into $(BENCH_ENV) ..."
	@$(BENCH_ENV)/bin/python $(INSTALL) -e .
	@for peer in tamaas ContactMechanics Adhesion reynoldsflow rfgen; do \
	  $(BENCH_ENV)/bin/python $(INSTALL) $$peer || echo "$$peer: cannot be installed here, not shown"; done
	@CMAKE_ARGS="-DASPHER_NATIVE=ON" $(BENCH_ENV)/bin/python -m pip install -qq --no-binary=aspher aspher \
	  || echo "aspher: needs g++, cmake and Eigen (Debian: libeigen3-dev) to build, not shown"
	@touch $@

# $(call create,FOLDER): an environment with pip. Some systems ship Python without ensurepip; their pip then serves.
define create
$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null \
  || { echo "Python 3.11 or later is needed, and '$(PYTHON)' is not: name one, as in 'make PYTHON=python3.12'"; exit 1; }; \
test -x $(1)/bin/python && $(1)/bin/python -m pip --version >/dev/null 2>&1 \
  || $(PYTHON) -m venv --clear $(1) 2>/dev/null \
  || { $(PYTHON) -m venv --clear --without-pip $(1) && $(PYTHON) -m pip --python $(1)/bin/python install -qq pip; }
endef
