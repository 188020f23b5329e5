#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs a build into a scratch folder, and builds and runs a project that knows nothing but find_package(Octavo). The
# project also compiles every piece of C++ that README and docs show.
set -euo pipefail
build=$1 compiler=$2
here=$(cd "$(dirname "$0")" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake --install "$build" --prefix "$scratch/installed" > "$scratch/log"
flags=$(sed -n 's/^OCTAVO_SANITIZE:STRING=//p' "$build/CMakeCache.txt")
cp -r "$here/consumer" "$scratch/source"
python3 "$here/snippets.py" "$here/../.." "$scratch/source"
cmake -S "$scratch/source" -B "$scratch/build" -G Ninja -DCMAKE_PREFIX_PATH="$scratch/installed" \
      -DCMAKE_CXX_COMPILER="$compiler" ${flags:+-DCMAKE_CXX_FLAGS=-fsanitize=$flags} >> "$scratch/log"
cmake --build "$scratch/build" >> "$scratch/log" || { cat "$scratch/log"; exit 1; }
"$scratch/build/consumer"
for installed in bin/octavo share/man/man1/octavo.1 share/bash-completion/completions/octavo; do
    [ -s "$scratch/installed/$installed" ] || { echo "not installed: $installed"; exit 1; }
done
