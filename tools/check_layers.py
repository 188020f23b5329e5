#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fail when a folder of the library includes a folder that is not of a lower level in octavo/LAYERS."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]octavo/([a-z_0-9]+)/')


def read_layers(path):
    """The level of each folder: {name: level}."""
    layers = {}
    for line in path.read_text().splitlines():
        if line and not line.startswith("#"):
            level, name, _purpose = line.split(maxsplit=2)
            layers[name] = int(level)
    return layers


def breaches(layers):
    """A sentence for each include that goes sideways or up, and for each folder without a layer."""
    for folder in sorted(p for p in (ROOT / "octavo").iterdir() if p.is_dir()):
        if folder.name not in layers:
            yield f"octavo/{folder.name}: not in octavo/LAYERS"
            continue
        for source in sorted(folder.rglob("*.[ch]pp")):
            for number, line in enumerate(source.read_text().splitlines(), 1):
                match = INCLUDE.match(line)
                if not match or match[1] == folder.name:
                    continue
                if match[1] not in layers:
                    yield f"{source.relative_to(ROOT)}:{number}: includes octavo/{match[1]}, which is no layer"
                elif layers[match[1]] >= layers[folder.name]:
                    yield (f"{source.relative_to(ROOT)}:{number}: {folder.name} (level {layers[folder.name]}) "
                           f"includes {match[1]} (level {layers[match[1]]})")


def main():
    found = list(breaches(read_layers(ROOT / "octavo" / "LAYERS")))
    for sentence in found:
        print(sentence, file=sys.stderr)
    print(f"check_layers: {len(found)} breaches")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
