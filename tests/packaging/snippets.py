#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes each piece of C++ that README.md and docs/ show as a source file: snippets.py PROJECT FOLDER.

Pieces are statements after their #include lines; `mesh`, `other` and `lattice` are taken as given.
"""
import pathlib
import re
import sys

GIVEN = """#include <octavo/mesh/mesh.hpp>
extern const octavo::mesh::Mesh mesh, other;
extern const octavo::exact::Lattice lattice;
"""

project, folder = map(pathlib.Path, sys.argv[1:])
pages = [project / "README.md", *sorted((project / "docs").rglob("*.md"))]
pieces = [(page, piece) for page in pages for piece in re.findall(r"```cpp\n(.*?)```", page.read_text(), re.S)]
if not pieces:
    sys.exit("README.md and docs/ show no C++")
for number, (page, piece) in enumerate(pieces):
    lines = piece.splitlines()
    includes = [line for line in lines if line.startswith("#include")]
    statements = [line for line in lines if not line.startswith("#include")]
    source = [f"// {page.relative_to(project)}", *includes, GIVEN, "void snippet() {", *statements, "}"]
    (folder / f"snippet_{number}.cpp").write_text("\n".join(source) + "\n")
