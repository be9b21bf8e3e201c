# Argand's commands; `make help` lists them.  CMake does the building (CMakePresets.json).
PREFIX ?= /usr/local
JOBS ?= $(shell nproc 2>/dev/null || echo 2)

.PHONY: help render build test sanitize clang bench accuracy plots tables format install clean

help: ## what can be made (the default)
	@echo "Argand: a physically based real-time renderer."
	@echo
	@sed -n 's/^\([a-z]*\):[^#]*## \(.*\)/  make \1|\2/p' Makefile | \
	    while IFS='|' read -r target text; do printf '%-16s%s\n' "$$target" "$$text"; done

render: build ## build, then render a built-in scene to out/spheres.png
	@mkdir -p out
	@build/release/argand render demo:spheres -o out/spheres.png

build: ## install missing packages, build build/release/argand and libargand.so
	@scripts/packages.sh build run
	@test -f build/release/build.ninja || cmake --preset release
	@cmake --build --preset release -j $(JOBS)

test: ## build with validation and run every test
	@scripts/packages.sh build run test
	@test -f build/debug/build.ninja || cmake --preset debug
	@cmake --build --preset debug -j $(JOBS)
	@ctest --test-dir build/debug --output-on-failure -j $(JOBS)

sanitize: ## run the tests under AddressSanitizer and UBSan
	@scripts/packages.sh build run test
	@test -f build/asan-ubsan/build.ninja || cmake --preset asan-ubsan
	@cmake --build --preset asan-ubsan -j $(JOBS)
	@ctest --test-dir build/asan-ubsan --output-on-failure -j $(JOBS) \
	    -LE 'vulkan|statistics|window'
	@ASAN_OPTIONS=detect_leaks=0 ctest --test-dir build/asan-ubsan --output-on-failure -j $(JOBS) \
	    -L vulkan

clang: ## build everything with clang too: no warnings there either
	@scripts/packages.sh build run test
	@test -f build/clang/build.ninja || cmake --preset debug -B build/clang \
	    -DCMAKE_C_COMPILER=clang -DCMAKE_C_FLAGS_DEBUG=-O0
	@cmake --build build/clang -j $(JOBS)

bench: ## build and run the benchmarks
	@scripts/packages.sh build run test
	@test -f build/bench/build.ninja || cmake --preset release -B build/bench -DARGAND_BENCH=ON
	@cmake --build build/bench -j $(JOBS)
	@for scene in spheres grid million nodes; do \
	    build/bench/bench/bench_frames demo:$$scene || exit 1; done
	@build/bench/bench/bench_scale
	@build/bench/bench/bench_light_cost
	@build/bench/bench/bench_lights
	@build/bench/bench/bench_rays demo:million

accuracy: ## print the area lights' errors against quadrature, methods side by side
	@scripts/packages.sh build run test
	@test -f build/bench/build.ninja || cmake --preset release -B build/bench -DARGAND_BENCH=ON
	@cmake --build build/bench -j $(JOBS) --target accuracy accuracy_area
	@build/bench/bench/accuracy && build/bench/bench/accuracy 10 0.6
	@build/bench/bench/accuracy_area

plots: ## draw the errors of the sphere light's methods to docs/accuracy-*.svg
	@scripts/packages.sh build run test plots
	@test -f build/bench/build.ninja || cmake --preset release -B build/bench -DARGAND_BENCH=ON
	@cmake --build build/bench -j $(JOBS) --target accuracy
	@build/bench/bench/accuracy --tsv >build/bench/accuracy.tsv
	@gnuplot -e 'table="build/bench/accuracy.tsv"; folder="docs"' scripts/accuracy.gp

tables: build ## fit the table of linearly transformed cosines again (a minute)
	@cmake --build --preset release -j $(JOBS) --target tables
	@build/release/tools/tables src/bake/ltc_table.c

format: ## lay out all C with clang-format
	@scripts/packages.sh format
	@git ls-files '*.c' '*.h' | xargs clang-format -i

install: build ## install below PREFIX (/usr/local); DESTDIR is honoured
	@cmake --install build/release --prefix '$(PREFIX)'
	@test -n '$(DESTDIR)' || test "$$(id -u)" -ne 0 || ldconfig # the loader finds it

clean: ## remove build/ and out/
	@rm -rf build out
