# Counterpoise: every task by one name. `make help` lists them.
#
# Needs Python 3.11 or newer, a C compiler and make; all else comes from the lock files into .venv.

SHELL := /bin/sh
PYTHON ?= $(shell command -v python3.11 || command -v python3)
CC ?= cc
VENV := .venv
IN_VENV := PATH="$(CURDIR)/$(VENV)/bin:$$PATH" CC="$(CC)"
COUNTERPOISE := $(IN_VENV) "$(CURDIR)/$(VENV)/bin/python" -m generator
# Tests run in two processes: threads of BLAS beside them only wait for each other.
PYTEST := $(IN_VENV) OPENBLAS_NUM_THREADS=1 "$(CURDIR)/$(VENV)/bin/python" -m pytest
UV := uv==0.13.8
LOCKING := --upgrade --universal --python-version 3.11 --generate-hashes --no-annotate --no-emit-find-links \
    --no-emit-index-url --custom-compile-command 'make lock'

# A stamp carries a checksum of what the environment was made from, and of the folder that its scripts point to:
# touched files cost nothing, a changed lock or a moved checkout makes the environment anew.
stamp = $(VENV)/.$(1)-$(shell { cat $(2) pyproject.toml; pwd; } | cksum | tr -cd '0-9')
RUNTIME = $(call stamp,runtime,requirements.lock)
TESTING = $(call stamp,testing,requirements.lock requirements-test.lock)
BENCHING = $(call stamp,benching,requirements.lock requirements-test.lock requirements-bench.lock)

export robot
out ?= generated
# Where make was called from, so that `make -C checkout robot=mine.yaml` finds a file beside the caller.
export CALLER := $(PWD)

# A folder that is asked for is the caller's, too; that of the house is this one's.
INTO = into="$(or $(out),$(CURDIR)/generated)"; \
    case "$$into" in /*) ;; *) [ "$(origin out)" = file ] || into="$${CALLER:-.}/$$into" ;; esac

.DEFAULT_GOAL := $(if $(robot),generate,help)
.NOTPARALLEL:
.PHONY: help generate all-robots list excite simulate identify gains stiffness output-error compare diagnose \
    example-diagnosis study-diagnosis setup test test-long test-extra format lock bench twins reproduce clean distclean

help: ## this list
	@echo 'make robot=NAME             generate, compile and self-test a robot of robots/, say robot=kr500'
	@echo 'make robot=PATH.yaml        the same for a robot file of your own; out=DIR, from where you are, instead of generated/'
	@echo 'make robot=... build_in=SET the same with a parameter set as numbers in the code, into generated/<robot>_<SET>/'
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/\1|\2/p' Makefile | while IFS='|' read -r name text; \
	    do printf '%-27s %s\n' "make $$name" "$$text"; done

generate: $(RUNTIME)
	@file="$$robot"; \
	if [ -z "$$file" ]; then echo 'error: Makefile:1:1: no robot, expected make robot=NAME or robot=PATH.yaml' >&2; exit 2; fi; \
	if [ ! -e "$$file" ] && [ -n "$$CALLER" ] && [ -e "$$CALLER/$$file" ]; then file="$$CALLER/$$file"; fi; \
	$(INTO); $(COUNTERPOISE) generate "$$file" --out "$$into" --self-test --library \
	    $(if $(build_in),--build-in "$(build_in)")

all-robots: $(RUNTIME) ## generate, compile and self-test every robot of robots/
	@$(INTO); for file in robots/*.yaml; do $(COUNTERPOISE) generate "$$file" --out "$$into" --self-test --library || exit $$?; done

list: $(RUNTIME) ## the robots of robots/ and their parameter sets
	@$(COUNTERPOISE) list

# These run where make was called, so that files beside the caller are found and results stay there.
IN_CALLER := @cd "$${CALLER:-.}" && $(COUNTERPOISE)

excite: $(TESTING) ## robot=NAME: a motion that shows the parameters, before the robot moves; options="..."
	$(IN_CALLER) excite "$$robot" $(options)

simulate: $(TESTING) ## robot=NAME: a run of the simulated robot; options="--noise 0.3 ..."
	$(IN_CALLER) simulate "$$robot" $(options)

identify: $(TESTING) ## robot=NAME data="A.csv B.csv" test=C.csv: parameters from recorded runs
	$(IN_CALLER) identify "$$robot" --data $(data) $(if $(test),--test $(test)) $(options)

gains: $(TESTING) ## robot=NAME empty=A.csv loaded=B.csv: drive gains from runs without and with a payload
	$(IN_CALLER) gains "$$robot" --empty $(empty) --loaded $(loaded) $(options)

stiffness: $(TESTING) ## robot=NAME data=A.csv options="--locked 2": stiffness of drive trains
	$(IN_CALLER) stiffness "$$robot" --data $(data) $(options)

compare: $(TESTING) ## a=A/results.json b=NAME:SET: where two results differ, and whether it can be noise
	$(IN_CALLER) compare $(a) $(b) $(options)

output-error: $(TESTING) ## robot=NAME data="A.csv B.csv" test=C.csv: parameters by simulation in open loop
	$(IN_CALLER) output-error "$$robot" --data $(data) $(if $(test),--test $(test)) $(options)

diagnose: $(TESTING) ## robot=NAME data="A.csv B.csv" validate=C.csv test=D.csv prior=SET: what the model lacks
	$(IN_CALLER) diagnose "$$robot" $(data) $(if $(validate),--validate $(validate)) $(if $(test),--test $(test)) \
	    $(if $(prior),--prior $(prior)) $(options)

example-diagnosis: $(TESTING) ## simulate a robot with effects that its file lacks, find them, write the example of README.md and docs/diagnosis.md anew
	@$(IN_VENV) "$(CURDIR)/$(VENV)/bin/python" -m benchmarks.example_diagnosis

setup: $(TESTING) ## install the packages for simulate, excite, identify, diagnose, ... into .venv

test: $(TESTING) ## every test that needs Python and a C compiler alone
	@$(PYTEST) -n 2 --dist worksteal -m "not long" --ignore=tests/extra tests

test-long: $(TESTING) ## further and longer cases of what make test and make test-extra hold, and what a diagnosis costs
	@$(PYTEST) -n 2 --dist worksteal -m long tests

test-extra: $(TESTING) ## tests with clang, valgrind, an Arm compiler and a browser, where installed
	@$(PYTEST) -n 2 --dist worksteal -m "not long" tests/extra

bench: $(BENCHING) ## time the generated code beside other libraries, into docs/performance.md; only=NAME for one study
	@$(IN_VENV) "$(CURDIR)/$(VENV)/bin/python" -m benchmarks.bench $(if $(only),only="$(only)")

format: $(TESTING) ## lay out the Python files and sort their imports
	@"$(VENV)/bin/python" -m ruff check --quiet --fix-only --select I .
	@"$(VENV)/bin/python" -m ruff format --quiet .

lock: ## resolve the lock files anew (asks the package registry)
	$(PYTHON) -m venv --clear build/lock
	build/lock/bin/python -m pip install --quiet $(UV)
	build/lock/bin/uv pip compile --quiet pyproject.toml --group build $(LOCKING) --output-file requirements.lock
	build/lock/bin/uv pip compile --quiet pyproject.toml --extra identification --group build --group test \
	    --constraint requirements.lock $(LOCKING) --output-file requirements-test.lock
	build/lock/bin/uv pip compile --quiet pyproject.toml --extra identification --group build --group test --group bench \
	    --constraint requirements-test.lock $(LOCKING) --output-file requirements-bench.lock

study-diagnosis: $(TESTING) ## hide effects in simulated robots; what the diagnosis names, into docs/diagnosis_study.md; cases=N of each kind (200: thousands of runs)
	@$(IN_VENV) "$(CURDIR)/$(VENV)/bin/python" -m benchmarks.diagnosis_study $(if $(cases),--cases $(cases)) $(options)

twins: $(TESTING) ## derive the simulated twins of the report's robots anew, into robots/ and docs/
	@$(IN_VENV) "$(CURDIR)/$(VENV)/bin/python" -m benchmarks.twins

reproduce: $(TESTING) ## play sections 5 and 6 of the report on the twins, into docs/reproduction.md; seeds=N, only=NAME
	@$(IN_VENV) "$(CURDIR)/$(VENV)/bin/python" -m benchmarks.reproduce $(if $(seeds),seeds=$(seeds)) $(if $(only),only="$(only)")

clean: ## remove caches and build folders; keeps .venv and generated/
	rm -rf build dist .hypothesis .mypy_cache .pytest_cache .ruff_cache .import_linter_cache
	find . -name __pycache__ -type d -not -path './$(VENV)/*' -prune -exec rm -rf {} +

distclean: clean ## clean, and remove .venv
	rm -rf $(VENV)

# The whole environment is made anew when the runtime lock changes, so that it never holds a stale package. Removed, and
# not cleared: where .venv is a link, the environment that it points to is of another checkout.
$(RUNTIME):
	@"$(PYTHON)" -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	    { echo 'error: Makefile:1:1: no Python 3.11, expected python3.11 on the PATH or make PYTHON=...' >&2; exit 2; }
	@echo 'setting up $(VENV) from requirements.lock'
	@rm -rf $(VENV)
	@"$(PYTHON)" -m venv $(VENV)
	@$(VENV)/bin/python -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements.lock
	@$(VENV)/bin/python -m pip install --quiet --disable-pip-version-check --no-deps --no-build-isolation --editable .
	@touch $@

$(TESTING): $(RUNTIME)
	@echo 'adding the test tools from requirements-test.lock'
	@$(VENV)/bin/python -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements-test.lock
	@$(VENV)/bin/python -m pip download --quiet --disable-pip-version-check --only-binary :all: --dest $(VENV)/wheels \
	    --require-hashes -r requirements.lock
	@touch $@

$(BENCHING): $(TESTING)
	@echo 'adding the other libraries from requirements-bench.lock'
	@$(VENV)/bin/python -m pip install --quiet --disable-pip-version-check --require-hashes -r requirements-bench.lock
	@touch $@
