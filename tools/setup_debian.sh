#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the Debian packages that Octavo needs and that are missing; does nothing when all are there.
#   tools/setup_debian.sh            to build and run
#   tools/setup_debian.sh --tests    also to run the test suite and the style checks
#   tools/setup_debian.sh --bench    also the systems that the benchmarks compare with
#   tools/setup_debian.sh --fuzz     also the compiler that builds the fuzzers
set -euo pipefail

packages=(g++ cmake ninja-build pkg-config libtbb-dev zlib1g-dev libpugixml-dev nlohmann-json3-dev libcli11-dev
          libfmt-dev libcairo2-dev libassimp-dev libpolyclipping-dev)
for option in "$@"; do
    case $option in
        --tests) packages+=(libgtest-dev libgmock-dev libboost-dev libgmp-dev clang-format-14 python3 man-db
                   calculix-ccx python3-meshio libp4est-dev libopenmpi-dev) ;;
        --bench) packages+=(libbenchmark-dev libopenvdb-dev libcgal-dev libembree-dev libboost-iostreams-dev
                   libp4est-dev libopenmpi-dev) ;;
        --fuzz) packages+=(clang-14 libclang-rt-14-dev) ;;
        *) echo "setup_debian.sh: unknown option $option" >&2; exit 2 ;;
    esac
done

missing=()
for package in "${packages[@]}"; do
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

echo "installing: ${missing[*]}"
sudo=()
[ "$(id -u)" -eq 0 ] || sudo=(sudo)
"${sudo[@]}" apt-get update -qq
"${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
