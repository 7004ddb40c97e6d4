# `make demo` and `make test` set up whatever they need first. `make help` lists every target.

PYTHON ?= python3.12
VENV := .venv
BIN := $(VENV)/bin
PACKAGES := $(VENV)/.packages-installed
DEVELOPMENT := $(VENV)/.development-installed
LIBRARIES := $(VENV)/.system-libraries-work
TESTED_WITH := $(VENV)/.chromium-and-vulkan-tried
# Tests that share fixtures, such as recorded datasets, stay in one process (tests/conftest.py). Groups
# run as they are collected, the small ones of tests/unit last: so the processes end together.
PYTEST := $(BIN)/pytest -rs --numprocesses=auto --maxprocesses=4 --dist=loadgroup \
	--no-loadscope-reorder

DEMO := outputs/demo

# Everything is on this machine: nothing is looked up on the Hub.
demo: export HF_HUB_OFFLINE := 1

# On a busy machine, threads that spin while they wait for each other take most of the time.
demo test test-slow: export OMP_NUM_THREADS := 1
demo test test-slow: export OMP_WAIT_POLICY := PASSIVE
# Tests start many programs: Python compiles ours for each of them where it may not keep the result.
test test-slow: export PYTHONDONTWRITEBYTECODE :=

export PIP_DISABLE_PIP_VERSION_CHECK := 1

.DEFAULT_GOAL := help
.PHONY: help setup demo results-cpu results-gpu test test-slow docs lint kernels format clean

help:  ## List the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "make %-11s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

setup: $(PACKAGES) $(LIBRARIES)  ## Create .venv to record, train and evaluate; OpenGL, FFmpeg

# Hours to nights: what is there stands, and a killed one goes on. First it says what it costs.
results-cpu: setup  ## Record, train and evaluate every row of docs/results.md that needs no GPU
	$(BIN)/labutopia-experiment experiment=results_cpu

results-gpu: setup  ## The same with pictures, as the paper has it; needs one GPU
	$(BIN)/labutopia-experiment experiment=results_gpu

# The main job in small, with the commands that a user types.
demo: setup  ## Record, train and evaluate a small policy on a CPU, and print its table
	rm -rf $(DEMO)
	$(BIN)/labutopia-record task=level1/pick obs=state episodes=200 root=$(DEMO)/dataset
	$(BIN)/lerobot-train --config_path=policies/act/train_state.json \
		--dataset.repo_id=local/pick --dataset.root=$(DEMO)/dataset --output_dir=$(DEMO)/train
	$(BIN)/python eval/run.py task=level1/pick episodes=50 policy=random out=$(DEMO)/eval/random
	$(BIN)/python eval/run.py task=level1/pick episodes=50 policy=expert out=$(DEMO)/eval/expert
	$(BIN)/python eval/run.py task=level1/pick episodes=50 policy=act policy.path=$(DEMO)/train \
		out=$(DEMO)/eval/act
	$(BIN)/labutopia-view level1/pick --headless --out $(DEMO)
	$(BIN)/python eval/report.py $(DEMO)/eval
	@echo "Expert: $(DEMO)/level1-pick.png and .mp4. Policies: $(DEMO)/eval/*/videos"

test: $(TESTED_WITH)  ## Check style and types, then run every test but the sweeps
	@$(MAKE) --no-print-directory --jobs=2 --output-sync=target lint kernels
	$(PYTEST) -m "not slow"

test-slow: $(TESTED_WITH)  ## Run the sweeps: ten episodes of every expert, more attacks, trainings, kills, leaks
	$(PYTEST) -m slow

docs: $(DEVELOPMENT)  ## Build the site into build/site, offline; a link that leads nowhere fails
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --quiet

lint: $(DEVELOPMENT)  ## Check style, format and types
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/mypy

kernels: setup
	$(BIN)/python scripts/compile_kernels.py

format: $(DEVELOPMENT)  ## Mend style and format
	$(BIN)/ruff check --fix
	$(BIN)/ruff format

clean:  ## Remove the environment and the caches; recordings and results stay
	rm -rf $(VENV) build dist .mypy_cache .pytest_cache .ruff_cache
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

# A missing stamp means that an installation never ended: pip cannot mend half a package, so the
# environment starts afresh. With the stamp, only what has changed is installed.
$(PACKAGES): pyproject.toml constraints.txt
	@$(PYTHON) -c 'import sys; raise SystemExit(not (3, 12) <= sys.version_info < (3, 14))' 2>/dev/null || { \
		echo 'Python 3.12 is needed, and "$(PYTHON)" is not one.' \
			'Install it (Debian and Ubuntu: apt-get install python3.12 python3.12-venv),' \
			'or name one: make PYTHON=/path/to/python3.12' >&2; exit 1; }
	@test -e $@ || $(PYTHON) -m venv --clear $(VENV)
	@rm -f $@
	@echo "Installing the pinned packages; the first time takes a few minutes"
	@$(BIN)/python -m pip install --quiet --progress-bar off --no-compile -c constraints.txt -e .
	@$(BIN)/python -m compileall -q -j 0 $(VENV)/lib >/dev/null || true  # pip uses one core for it
	@touch $@

# Tests, types, style and site: as many packages again, which nobody needs who only uses the benchmark.
$(DEVELOPMENT): $(PACKAGES)
	@echo "Installing what tests, types and the site need"
	@mv $(PACKAGES) $@.half
	@$(BIN)/python -m pip install --quiet --progress-bar off -c constraints.txt -e '.[dev]'
	@mv $@.half $(PACKAGES)
	@touch $@

# Tests open the page of results in Chromium and draw with Filament; without them they are skipped.
$(TESTED_WITH): scripts/install_chromium.sh scripts/install_system_libraries.sh $(DEVELOPMENT) $(LIBRARIES)
	@scripts/install_chromium.sh
	@scripts/install_system_libraries.sh $(BIN)/python vulkan
	@touch $@

$(LIBRARIES): $(PACKAGES) scripts/install_system_libraries.sh
	@scripts/install_system_libraries.sh $(BIN)/python opengl ffmpeg
	@touch $@
