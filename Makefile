# Two commands do everything on a fresh machine: `make demo` and `make test`.

PYTHON ?= $(shell command -v python3.11 || command -v python3)
VENV := .venv
BIN := $(VENV)/bin
SIDE_BY_SIDE := $(BIN)/python -m pytest -q --numprocesses auto --durations 15
DEMO := demo
LAB := .lab

.PHONY: help demo test proof lab bench lint format coverage clean

help: ## Show this list.
	@grep -E '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 12

$(VENV)/installed: pyproject.toml constraints.txt
	@test -n "$(PYTHON)" || { echo "Python 3.11 or newer is needed"; exit 2; }
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check \
	    --constraint constraints.txt --editable .
	@touch $@

$(VENV)/developed: $(VENV)/installed
	$(BIN)/python -m pip install --quiet --disable-pip-version-check \
	    --constraint constraints.txt --editable '.[dev]'
	@touch $@

demo: $(VENV)/installed ## Run the whole line once on simulated instruments, into ./demo.
	$(BIN)/paintlink demo --once --no-web --dir $(DEMO)

lint: $(VENV)/developed ## Style, types, import contracts.
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports

test: lint ## Every check but the long proofs.
	$(SIDE_BY_SIDE) --dist loadfile -m "not proof"

proof: $(VENV)/developed ## The long proofs: kill sweeps, fuzzing at full count.
	$(SIDE_BY_SIDE) --dist loadgroup -m proof --timeout 1200

coverage: $(VENV)/developed ## What the tests of `make test` reach.
	$(SIDE_BY_SIDE) --dist loadfile -m "not proof" --cov --cov-report=term:skip-covered

lab: $(VENV)/developed ## The drivers on a real kernel with real USB, in a virtual machine.
	tools/lab/build.sh $(LAB)
	tools/lab/run.sh $(LAB) "cd $(CURDIR) && $(BIN)/python -u -m tests.lab.guest"

bench: $(VENV)/developed ## Measure; figures are ratios within one run.
	$(BIN)/python -m pip install --quiet --disable-pip-version-check \
	    --constraint constraints.txt --editable '.[bench]'
	@for script in benchmarks/*.py; do echo "== $$script"; $(BIN)/python $$script; done

format: $(VENV)/developed ## Lay out the code.
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

clean: ## Remove what was built.
	rm -rf $(VENV) $(LAB) build dist demo .mypy_cache .pytest_cache .ruff_cache .coverage
