# SPDX-License-Identifier: BSD-3-Clause
# Each verb does all its own set-up; `make` alone explains them.
SHELL := /bin/bash
PRESET ?= release
PACKAGES := packages.txt
TESTS ?=
DATASETS := /usr/share/mrpt/datasets
DEMO_OUT ?= build/demo

.PHONY: help packages configure build demo test bench fuzz fuzz-bands gate install clean
help:
	@echo "make demo     localize a real log (from mrpt-common): a table here, a picture in $(DEMO_OUT)"
	@echo "make test     build everything and run all tests; TESTS='core maps' for these folders of tests/ alone"
	@echo "make bench    measure speed (Google Benchmark)"
	@echo "make fuzz     broken logs into the reader for 60 s under asan; fuzz-bands: random problems into the bands"
	@echo "make gate     all that must hold before a release: tests, fuzzers, sanitizers, clang, clang-tidy (hours)"
	@echo "make build    build only, into build/$(PRESET); PRESET=dev, asan, tsan, tidy for other builds"
	@echo "make install  install (PREFIX=/usr/local)"
	@echo "make clean    remove build/"
	@echo "Missing Debian packages (packages.txt) are installed first; that needs root or sudo."

packages:
	@missing=$$(grep -hv '^#' $(PACKAGES) | xargs dpkg-query -W -f '$${Package} $${Status}\n' 2>&1 \
	  | awk '/no packages found matching/ {print $$NF; next} !/install ok installed$$/ {print $$1}'); \
	[ -z "$$missing" ] && exit 0; \
	sudo=; [ "$$(id -u)" = 0 ] || sudo=sudo; \
	echo "installing:" $$missing; \
	$$sudo apt-get update -qq && DEBIAN_FRONTEND=noninteractive $$sudo apt-get install -y --no-install-recommends -qq $$missing

build: packages configure
	@cmake --build --preset $(PRESET)

configure:
	@cmake --preset $(PRESET) > build-$(PRESET).log 2>&1 || { cat build-$(PRESET).log; exit 1; }; rm -f build-$(PRESET).log

# tests of some folders: their programs are built, no more
space := $(empty) $(empty)
test: $(if $(TESTS),packages configure,build)
	$(if $(TESTS),@cmake --build --preset $(PRESET) --target $(TESTS:%=test_%))
	@ctest --preset $(PRESET) -j2 $(if $(TESTS),-R '^($(subst $(space),|,$(strip $(TESTS))))$$')

demo: packages configure
	@cmake --build --preset $(PRESET) --target sidestep-localize
	@build/$(PRESET)/bin/sidestep-localize $(DATASETS)/uwb_ro-localization_demo.rawlog \
	  -c share/robots/uwb-demo.yaml --sensors odometry,beacons \
	  --ground-truth $(DATASETS)/uwb_ro-localization_demo_GT.txt -o $(DEMO_OUT) -w
	@echo "picture: $(DEMO_OUT)/trajectory.png"

bench: build
	@for b in build/$(PRESET)/bin/bench_*; do $$b || exit 1; done

fuzz: packages
	@$(MAKE) --no-print-directory configure PRESET=asan
	@cmake --build --preset asan --target fuzz_rawlog_reader
	@build/asan/bin/fuzz_rawlog_reader tests/data --seconds 60

fuzz-bands: packages
	@$(MAKE) --no-print-directory configure PRESET=asan
	@cmake --build --preset asan --target fuzz_band_planner
	@build/asan/bin/fuzz_band_planner --problems 2000

# Tests with threads go under tsan, all under asan; clang reads everything with its own warnings and clang-tidy's.
THREADED := datasets planning simulation evaluation apps
gate:
	@$(MAKE) --no-print-directory packages PACKAGES="packages.txt packages.gate.txt"
	@$(MAKE) --no-print-directory test
	@$(MAKE) --no-print-directory fuzz
	@$(MAKE) --no-print-directory fuzz-bands
	@$(MAKE) --no-print-directory test PRESET=asan
	@$(MAKE) --no-print-directory test PRESET=tsan TESTS="$(THREADED)"
	@$(MAKE) --no-print-directory build PRESET=tidy
	@echo "the gate holds"

install: build
	cmake --install build/$(PRESET) --prefix $(or $(PREFIX),/usr/local)

clean:
	rm -rf build
