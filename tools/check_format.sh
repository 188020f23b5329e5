#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Fails when a C++ file is not as clang-format 14 would write it, or a comment has more than 120 characters a line; with
# --fix it rewrites the files instead, but for comments.
set -euo pipefail
cd "$(dirname "$0")/.."
mode=(--dry-run --Werror)
[ "${1:-}" = --fix ] && mode=(-i)
git ls-files --cached --others --exclude-standard '*.hpp' '*.cpp' | xargs -r clang-format-14 "${mode[@]}"
if git ls-files --cached --others --exclude-standard '*.hpp' '*.cpp' | LC_ALL=C.UTF-8 xargs -r grep -nE '^.{121,}$'; then
    echo "check_format: these lines have more than 120 characters" >&2
    exit 1
fi
echo "check_format: ok"
