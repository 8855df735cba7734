# make run    environment, two FMUs, the paper's free oscillation compared with the reference
# make test   the tests of the code
# make test-release  the other tests: of what a release consists of (wheel, site, its pages and the scenarios carried out
#             as printed, binaries for other platforms, sanitizers, benchmarks), and studies of many fits and runs
# make env    the whole environment, with Numba and the tools of tests and documentation (make run needs a third)
# make test-quick  what takes less than a minute: no compiler, no site; with the FMUs that make fmu made
# make fmu    the twelve FMUs in build/fmi2/, and two with sensitivities in build/fmi2/sensitivities/ (COMPILER=openmodelica makes them with an installed OpenModelica,
#             COMPILER_OPTIONS="omc=/opt/openmodelica" with one that is not on the path), for this machine's
#             platform (PLATFORMS=all: Linux, Windows and macOS; PLATFORMS="x86_64-linux x86_64-windows": those);
#             FMI=3: of FMI 3.0, in build/fmi3/; FMI="2 3": both
# make fmu-msl  FMUs of the examples that need the Modelica Standard Library, in build/msl/; skipped where MODELICAPATH
#             does not lead to it
# make ssp    operator and joystick as one system: build/joystick.ssp
# make fuzz  random FMI calls (with clang), damaged files and tables, random models, SECONDS=60 in all; corpora in
#             build/fuzz/
# make lint   ruff, mypy, the C compilers with every warning an error, the Modelica checks
# make lint-js  the JavaScript of the pages by Biome, which npm gets; skipped where it cannot, which with CI=true is
#             an error
# make try-rumoca  what another release of rumoca changes: its intermediate forms, and the tests that fail with it
#             (RUMOCA=0.10.1; by default the newest)
# make bench  speed as ratios within one run
# make figure  the figure of the README and the drawings of the documentation
# make figures  every figure and table of the paper, in results/
# make claims  docs/claims.md: what the paper says, and what comes out here
# make docs   the documentation as a site, in build/docs/; any warning is an error
# make docs-links  the links of the documentation that lead elsewhere, tried over the network
# make wheel  wheel and source distribution, in dist/; the same bytes each time
# make lock   pin the newest versions that pyproject.toml allows
# make clean  remove what was made (the environment stays; "make distclean" removes it too)

# The first interpreter on the path that is new enough.
PYTHON ?= $(shell for p in python3.13 python3.12 python3.11 python3 python; do \
	$$p -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && echo $$p && break; done)
COMPILER ?= rumoca
COMPILER_OPTIONS ?=
PLATFORMS ?=
FMI ?= 2
SECONDS ?= 60
FUZZ_OPTIONS ?=
FMU_SETTINGS = --compiler $(COMPILER) $(addprefix --option ,$(COMPILER_OPTIONS)) $(addprefix --platform ,$(PLATFORMS))

VENV := .venv
BIN := $(VENV)/bin
RUN_READY := $(VENV)/.ready-to-run
READY := $(VENV)/.ready
MODELS := $(addprefix PreloadedSprings.,Joystick.Joystick Joystick.JoystickPowerLaw \
	Joystick.JoystickFriction Joystick.JoystickFrictionPowerLaw Joystick.JoystickInverse \
	Joystick.JoystickInversePowerLaw Operator.Operator Operator.HeldJoystick \
	Operator.HeldJoystickPowerLaw Operator.MountedJoystick Operator.MountedJoystickPowerLaw \
	Examples.OperatedJoystick)
# Beside some of them, in sensitivities/: the same with derivatives of their runs, which rumoca can.
SENSITIVE := pyjoystick/fmu/shipped.py
FMU_SOURCES := $(shell find modelica fmu_build -name '*.mo' -o -name 'package.order' -o -name '*.[ch]' \
	-o -name '*.py' -o -name '*.toml' -o -name '*.jinja' -o -name '*.csv') $(SENSITIVE)

# Processes of tests: one more than there are cores, because many wait for other programs.
WORKERS ?= $(shell expr $$(getconf _NPROCESSORS_ONLN) + 1)

# Anew, because what the pages show is made from the sources; warnings are errors.
SPHINX = $(BIN)/python -m sphinx --fail-on-warning --keep-going --nitpicky --fresh-env --quiet \
	--doctree-dir build/doctrees

# By uv, which is faster: the user's, or one that pip gets and that goes afterwards (make UV=none for pip alone). Where
# uv fails, as it does not read what pip is set to, by pip. Bytecode is made at first use, and only of what is used.
UV ?= $(shell uv --version > /dev/null 2>&1 && echo uv)
OWN_UV := $(VENV)/uv
PIP_INSTALL = $(BIN)/python -m pip install --quiet --disable-pip-version-check --no-compile
get_uv = $(if $(UV),true,$(PIP_INSTALL) --target $(OWN_UV) uv 2> /dev/null || true)
install = $(or $(UV),$(OWN_UV)/bin/uv --no-cache) pip install --quiet --python $(BIN)/python $(1) 2> /dev/null || \
	$(PIP_INSTALL) $(1)

# Without bytecode every process of the tests would compile its modules anew.
unexport PYTHONDONTWRITEBYTECODE

# Each process of the tests has one core at most. More threads of the linear algebra would wait for it, busily:
# a singular value decomposition for a fit then takes up to 40 times the processor time.
test test-release test-quick: export OPENBLAS_NUM_THREADS = 1

.DELETE_ON_ERROR:
.PHONY: FORCE run env test test-fmus test-release test-quick fuzz fmu fmu-msl ssp lint lint-types lint-c lint-js try-rumoca bench figure figures claims docs docs-links wheel lock clean distclean

run: build/fmi2/.first
	$(BIN)/python scenarios/free_oscillation.py

PYTEST_ALL = $(BIN)/python -m pytest --numprocesses $(WORKERS) --dist loadgroup --no-loadscope-reorder

test: $(READY) test-fmus
	$(PYTEST_ALL) --part code

test-release: $(READY) test-fmus
	$(PYTEST_ALL) --part release

# Where another compiler is asked for, the tests make the FMUs of FMI 3 themselves.
test-fmus: $(READY)
	@$(MAKE) --no-print-directory --jobs 2 build/fmi2/.built \
		$(if $(filter rumoca,$(COMPILER)),build/fmi3/.built)

test-quick: $(READY)
	$(BIN)/python -m pytest --part quick --numprocesses auto

fuzz: $(READY) fmu
	$(BIN)/python -m tests.fuzz --seconds $(SECONDS) $(FUZZ_OPTIONS)

fmu: $(FMI:%=build/fmi%/.built)

# FMI 3 in reverse order: where both versions are made at the same time, each finds half of the C code in the cache.
reverse = $(if $(1),$(call reverse,$(wordlist 2,$(words $(1)),$(1))) $(firstword $(1)))

build/fmi%/.built: $(FMU_SOURCES) $(RUN_READY) build/fmi%/.settings
	$(BIN)/python -m fmu_build $(if $(filter 3,$*),$(call reverse,$(MODELS)),$(MODELS)) --fmi $* \
		--output build/fmi$* $(FMU_SETTINGS)
	rm -rf build/fmi$*/sensitivities
	$(if $(filter rumoca,$(COMPILER)),requests=$$($(BIN)/python -I $(SENSITIVE)$(if $(filter 3,$*), | sort -r)) && \
		for one in $$requests; do \
		$(BIN)/python -m fmu_build PreloadedSprings.Joystick.$${one%%=*} --fmi $* \
		--output build/fmi$*/sensitivities $(FMU_SETTINGS) --sensitivity $${one#*=} || exit 1; done)
	touch $(@D)/.first $@

# What a first run needs.
build/fmi%/.first: $(FMU_SOURCES) $(RUN_READY) build/fmi%/.settings
	$(BIN)/python -m fmu_build $(addprefix PreloadedSprings.Joystick.,Joystick JoystickPowerLaw) --fmi $* \
		--output build/fmi$* $(FMU_SETTINGS)
	touch $@

# Changes with the settings that are asked for, and then only, so that FMUs with others are made anew.
.PRECIOUS: build/fmi%/.settings
build/fmi%/.settings: FORCE
	@mkdir -p $(@D)
	@echo "$(FMU_SETTINGS)" | cmp -s - $@ || echo "$(FMU_SETTINGS)" > $@

MSL_MODELS := $(addprefix PreloadedSpringsMSL.Examples.,ForceFeedback Drivetrain OpposingSprings ActuatorLoadCurve)

fmu-msl: $(RUN_READY)
	@if [ -z "$(wildcard $(addsuffix /Modelica*/package.mo,$(subst :, ,$(MODELICAPATH))))" ]; then \
	echo "fmu-msl: skipped, MODELICAPATH names no folder that contains Modelica"; \
	else $(BIN)/python -m fmu_build $(MSL_MODELS) --output build/msl $(FMU_SETTINGS); fi

ssp: fmu
	$(BIN)/python -m pyjoystick ssp build/joystick.ssp

lint: $(READY)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(MAKE) --no-print-directory --jobs 2 --output-sync lint-types lint-c

lint-types:
	$(BIN)/mypy
	$(BIN)/python -m tests.lint.modelica

lint-c:
	$(BIN)/python -m tests.lint.c_sources

BIOME := npx --yes @biomejs/biome@2.6.8

lint-js:
	@if ! command -v npm > /dev/null; then echo "lint-js: skipped, npm is not installed"; test -z "$(CI)"; \
	elif ! $(BIOME) --version > /dev/null 2>&1; then echo "lint-js: skipped, npm cannot get Biome"; test -z "$(CI)"; \
	else $(BIOME) ci fmu_build/explore/assets pyjoystick/reports/live_page/assets docs/_static; fi

try-rumoca: $(READY)
	$(BIN)/python -m tests.rumoca_release $(RUMOCA)

bench: $(READY) fmu
	$(BIN)/python -m benchmarks

# What runs and builds FMUs: a third of what the tests need.
$(RUN_READY): requirements.lock pyproject.toml locked_part.py
	@test -n "$(PYTHON)" || { echo "Python 3.11 or newer is needed (make PYTHON=/path/to/python)"; exit 1; }
	@echo "Setting up the environment in $(VENV)/ ..."
	@$(PYTHON) -m venv $(VENV)
	@$(PYTHON) locked_part.py build openmodelica > $(VENV)/requirements.txt
	@$(get_uv)
	@$(call install,--no-deps --require-hashes -r $(VENV)/requirements.txt)
	@$(call install,--no-deps --no-build-isolation --editable .)
	@rm -rf $(OWN_UV)
	@touch $@

$(READY): $(RUN_READY)
	@echo "Adding what tests, checks and documentation need ..."
	@$(get_uv)
	@$(call install,--require-hashes -r requirements.lock)
	@rm -rf $(OWN_UV)
	@touch $@

env: $(READY)

figure: fmu
	$(BIN)/python docs/free_oscillation.py
	cd docs && ../$(BIN)/python -m figures

# Each scenario is a process of its own, two at a time.
SCENARIOS := $(basename $(notdir $(wildcard scenarios/fig*.py))) ergonomics free_oscillation period tables_1_and_2

figures: fmu
	$(MAKE) --no-print-directory --jobs 2 --output-sync $(addprefix scenario-,$(SCENARIOS))

scenario-%:
	$(BIN)/python scenarios/$*.py

claims: fmu
	$(BIN)/python docs/claims.py

docs: $(READY) fmu
	$(SPHINX) --builder html docs build/docs

docs-links: $(READY) fmu
	$(SPHINX) --builder linkcheck docs build/docs-links

# From the source distribution, so that nothing gets into the wheel that is not in there.
wheel: $(RUN_READY)
	rm -rf dist
	$(BIN)/python -m hatchling build --target sdist --directory dist
	mkdir dist/sources && tar -xzf dist/*.tar.gz --strip-components=1 -C dist/sources
	cd dist/sources && ../../$(BIN)/python -m hatchling build --target wheel --directory ..
	rm -rf dist/sources

lock:
	$(BIN)/python -m pip install --quiet uv
	$(BIN)/uv pip compile pyproject.toml --all-extras --universal --python-version 3.11 \
		--generate-hashes --no-emit-index-url --quiet --upgrade --output-file requirements.lock

clean:
	rm -rf build results dist .pytest_cache .mypy_cache .ruff_cache .hypothesis
	find . -name __pycache__ -not -path './$(VENV)/*' -exec rm -rf {} +

distclean: clean
	rm -rf $(VENV)
