# Everything a developer runs. `make test` sets itself up: it needs Rust (rustup) and Python 3.10 or later.
.PHONY: test lint rust docs python bench clean

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin

test: lint rust docs python

lint:
	cargo fmt --all --check
	cargo clippy --workspace --all-targets --all-features --quiet -- -D warnings

rust:
	cargo test --quiet --all-features
	cargo check --quiet --no-default-features

docs:
	RUSTDOCFLAGS="-D warnings" cargo doc --quiet --no-deps --all-features

# the wheel, in an environment of its own; built without optimising, since tests need no speed
$(BIN)/python:
	$(PYTHON) -m venv $(VENV)

python: $(BIN)/python
	$(BIN)/python -m pip install --quiet --upgrade pip
	MATURIN_PEP517_ARGS="--profile dev" $(BIN)/python -m pip install --quiet --force-reinstall ".[dev]"
	$(BIN)/ruff check python examples benches
	$(BIN)/ruff format --check python examples benches
	$(BIN)/python -m mypy.stubtest bryla
	$(BIN)/python -m pytest -q python/tests

bench:
	cargo bench --all-features

clean:
	rm -rf $(VENV) target out
