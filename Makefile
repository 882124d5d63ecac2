# Two commands on a machine that has only Python 3.11 or later and make: `make demo` and `make test`.
# Each sets up what it needs in .venv, with the versions of constraints.txt.

PYTHON ?= $(firstword $(foreach p,python3 python3.14 python3.13 python3.12 python3.11,\
	$(shell $(p) -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && echo $(p))))
BIN := .venv/bin
# For our own environment alone: the benchmark's peers need other versions, in environments of their own.
# Not an absolute path: pip splits this at blanks, which a checkout's folder may have.
INSTALL := PIP_CONSTRAINT=constraints.txt $(BIN)/python -m pip install --quiet
export PIP_DISABLE_PIP_VERSION_CHECK := 1

.PHONY: demo test test-all page-tools lint page docs bench clean
.DEFAULT_GOAL := demo

.venv/core: pyproject.toml constraints.txt
	@test -n "$(PYTHON)" || { echo "bayesmap needs Python 3.11 or later; name one with make PYTHON=..."; exit 1; }
	$(PYTHON) -m venv .venv
	$(INSTALL) --editable .
	@touch $@

.venv/dev: .venv/core
	$(INSTALL) --editable '.[dev]'
	@touch $@

.venv/docs: .venv/core
	$(INSTALL) --editable '.[docs]'
	@touch $@

demo: .venv/core          ## infer the tutorial's map; pictures, the saved run and the JSON land in runs/demo
	$(BIN)/bayesmap demo --output runs/demo --force

# A worker that dies fails the run: pytest-xdist can wait for ever for the one that it starts in its place.
TESTS := $(BIN)/python -m pytest -n auto --dist loadgroup --no-loadscope-reorder --max-worker-restart=0

# The page's own tests need its tools, and skip without them.
page-tools:
	@! command -v npm >/dev/null || $(MAKE) --no-print-directory page/node_modules || echo "npm cannot install the page's tools"

test: .venv/dev page-tools  ## the landing run: a test of every family, on all cores
	$(TESTS)

test-all: .venv/dev page-tools  ## all tests: before a release, and after a big change
	$(TESTS) --full

lint: .venv/dev           ## style and types; the page's too where there is npm
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/mypy
	@if ! command -v npm >/dev/null; then echo "skipped: the page's types, for want of npm"; \
	elif ! $(MAKE) --no-print-directory page/node_modules; then echo "skipped: the page's types, npm cannot install TypeScript"; \
	else npm --prefix page run --silent check && npm --prefix page run --silent fresh; fi

docs: .venv/docs          ## the site, in build/site; it works without a network
	NO_MKDOCS_2_WARNING=1 $(BIN)/python -m mkdocs build --strict

page: .venv/core page/node_modules  ## build the page's one file from its sources; node is needed for this alone
	$(BIN)/python page/write_messages.py
	npm --prefix page run --silent check
	npm --prefix page run --silent build

page/node_modules: page/package-lock.json
	npm --prefix page ci --silent
	@touch $@

bench: .venv/dev          ## speed against peers and against the committed baseline; DEVICE=cuda:0 for a GPU
	$(BIN)/python -m benchmarks.run --device $(or $(DEVICE),cpu) $(BENCH)

clean:                    ## remove what the commands above made
	rm -rf .venv .bench runs build dist page/node_modules .pytest_cache .ruff_cache .mypy_cache .hypothesis
