# The two commands of a newcomer. Everything else is plain CMake: see CMakePresets.json.
.PHONY: demo test build format

build:
	tools/setup_debian.sh
	cmake --preset release -DOCTAVO_BUILD_TESTS=OFF
	cmake --build --preset release

demo: build
	tools/demo.sh build/release/cli/octavo out/demo

test:
	tools/setup_debian.sh --tests
	cmake --preset release -DOCTAVO_BUILD_TESTS=ON
	cmake --build --preset release
	ctest --preset release -j $$(nproc)

format:
	tools/check_format.sh --fix
