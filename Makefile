# SPDX-License-Identifier: BSD-3-Clause
# Each verb does all its own set-up; `make` alone explains them.
SHELL := /bin/bash
PRESET ?= release
DATASETS := /usr/share/mrpt/datasets
DEMO_OUT ?= build/demo

.PHONY: help packages configure build demo test bench fuzz install clean
help:
	@echo "make demo     localize a real log (from mrpt-common): a table here, a picture in $(DEMO_OUT)"
	@echo "make test     build everything and run all tests"
	@echo "make bench    measure speed (Google Benchmark)"
	@echo "make fuzz     feed broken logs to the reader for 60 s under address and undefined sanitizers"
	@echo "make build    build only, into build/$(PRESET); PRESET=dev, asan, tsan, tidy for other builds"
	@echo "make install  install (PREFIX=/usr/local)"
	@echo "make clean    remove build/"
	@echo "Missing Debian packages (packages.txt) are installed first; that needs root or sudo."

packages:
	@missing=$$(grep -v '^#' packages.txt | xargs dpkg-query -W -f '$${Package} $${Status}\n' 2>&1 \
	  | awk '/no packages found matching/ {print $$NF; next} !/install ok installed$$/ {print $$1}'); \
	[ -z "$$missing" ] && exit 0; \
	sudo=; [ "$$(id -u)" = 0 ] || sudo=sudo; \
	echo "installing:" $$missing; \
	$$sudo apt-get update -qq && DEBIAN_FRONTEND=noninteractive $$sudo apt-get install -y --no-install-recommends -qq $$missing

build: packages configure
	@cmake --build --preset $(PRESET)

configure:
	@cmake --preset $(PRESET) > build-$(PRESET).log 2>&1 || { cat build-$(PRESET).log; exit 1; }; rm -f build-$(PRESET).log

test: build
	@ctest --preset $(PRESET) -j2

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

install: build
	cmake --install build/$(PRESET) --prefix $(or $(PREFIX),/usr/local)

clean:
	rm -rf build
