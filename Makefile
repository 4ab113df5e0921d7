# The two commands of the README are `make demo` and `make test`; each installs what it needs.
.DEFAULT_GOAL := help
.PHONY: help demo test sanitize fuzz bench bench-guard reproduce lint docs format install package clean
export INPUT ARGS
export CMAKE_BUILD_PARALLEL_LEVEL ?= $(shell nproc)

help:  ## List the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-11s %s\n", $$1, $$2 }' Makefile

demo:  ## Segment example scans, or INPUT=scan.ply [ARGS="--parts 5"]; results in out/
	@scripts/demo.sh

test:  ## Build, run every test and the quick lint checks
	@scripts/test.sh

sanitize:  ## Run the tests under sanitizers: ARGS=asan-ubsan or ARGS=tsan for one of the two
	@scripts/sanitize.sh $(ARGS)

fuzz:  ## Fuzz what reads files and requests: ARGS="--seconds 600 ply gltf"
	@scripts/fuzz.sh $(ARGS)

bench:  ## Run the benchmarks: ARGS="segmentation --help"
	@scripts/install-dependencies.sh
	@cmake --preset release
	@cmake --build --preset release --target morsel_bench
	@build/release/apps/morsel-bench/morsel-bench $(or $(ARGS),--help)

bench-guard:  ## Say which of the small cases got slower than apps/morsel-bench/record.json
	@$(MAKE) --no-print-directory bench \
	  ARGS="scaling --points 10000 30000 --files 0 --against apps/morsel-bench/record.json"

reproduce:  ## Measure all that the paper shows: out/reproduction/index.html; ARGS="--psb DIR"
	@scripts/reproduce.sh

lint:  ## Check formatting, layers, shell scripts and clang-tidy
	@scripts/lint.sh

format:  ## Format all C++ and TypeScript files in place
	@scripts/install-dependencies.sh --lint
	@scripts/format.sh

docs:  ## Build the documentation: build/docs/site/index.html
	@scripts/docs.sh

install:  ## Build and install the program and the library to PREFIX (default /usr/local)
	@scripts/install-dependencies.sh
	@cmake --preset release
	@cmake --build --preset release --target morsel morsel_cli
	@cmake --install build/release --prefix "$(or $(PREFIX),/usr/local)"

package:  ## Build the Debian packages: build/package/*.deb
	@scripts/package.sh

clean:  ## Remove everything that was built or written
	@rm -rf build out
