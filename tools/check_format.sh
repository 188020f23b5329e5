#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Fails when a C++ file is not as clang-format 14 would write it; with --fix it rewrites them instead.
set -euo pipefail
cd "$(dirname "$0")/.."
mode=(--dry-run --Werror)
[ "${1:-}" = --fix ] && mode=(-i)
git ls-files --cached --others --exclude-standard '*.hpp' '*.cpp' | xargs -r clang-format-14 "${mode[@]}"
echo "check_format: ok"
