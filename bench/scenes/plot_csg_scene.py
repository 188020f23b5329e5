#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the comparison of the two methods from tables of octavo_csg_scene.

usage: plot_csg_scene.py DEPTH TABLE.csv... > PLOT.svg

Three panels over the number of primitives, both axes logarithmic: seconds, bytes at the peak, primitive tests.
"""
import csv
import math
import sys

WIDTH, HEIGHT, MARGIN = 300, 240, 46
COLORS = {"top-down": "#0b6e99", "classic": "#c2571a"}


def read(paths, depth):
    """{method: [(primitives, seconds, bytes, tests)]}, by primitives."""
    rows = {method: [] for method in COLORS}
    for path in paths:
        with open(path, newline="") as table:
            for row in csv.DictReader(table):
                if int(row["depth"]) == depth:
                    tests = float(row["tests_per_octant"]) * int(row["octants"])
                    rows[row["method"]].append(
                        (int(row["primitives"]), float(row["seconds"]), int(row["peak_bytes"]), tests))
    return {method: sorted(values) for method, values in rows.items() if values}


def decades(values):
    low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
    return low, max(high, low + 1)


def panel(left, title, rows, column):
    xs = [row[0] for values in rows.values() for row in values]
    ys = [row[column] for values in rows.values() for row in values]
    (x0, x1), (y0, y1) = decades(xs), decades(ys)

    def place(x, y):
        across = (math.log10(x) - x0) / (x1 - x0) * (WIDTH - 2 * MARGIN)
        up = (math.log10(y) - y0) / (y1 - y0) * (HEIGHT - 2 * MARGIN)
        return left + MARGIN + across, HEIGHT - MARGIN - up

    parts = [f'<text x="{left + WIDTH / 2}" y="22" text-anchor="middle" font-size="13">{title}</text>']
    for power in range(x0, x1 + 1):
        x, bottom = place(10**power, 10**y0)
        parts.append(f'<path d="M{x:.1f} {bottom:.1f}V{MARGIN}" stroke="#ddd"/>')
        parts.append(f'<text x="{x:.1f}" y="{bottom + 16:.1f}" text-anchor="middle">{10**power:,}</text>'.replace(",", " "))
    for power in range(y0, y1 + 1):
        x, y = place(10**x0, 10**power)
        parts.append(f'<path d="M{x:.1f} {y:.1f}H{left + WIDTH - MARGIN}" stroke="#ddd"/>')
        parts.append(f'<text x="{x - 5:.1f}" y="{y + 4:.1f}" text-anchor="end">10<tspan dy="-4" font-size="8">'
                     f'{power}</tspan></text>')
    for method, values in rows.items():
        points = [place(row[0], row[column]) for row in values]
        path = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
        parts.append(f'<path d="{path}" fill="none" stroke="{COLORS[method]}" stroke-width="2"/>')
        parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{COLORS[method]}"/>' for x, y in points]
    return "\n".join(parts)


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    depth = int(sys.argv[1])
    rows = read(sys.argv[2:], depth)
    if not rows:
        sys.exit(f"no rows of depth {depth}")
    titles = ["CPU seconds", "bytes at the peak", "primitive tests"]
    body = "\n".join(panel(i * WIDTH, title, rows, i + 1) for i, title in enumerate(titles))
    legend = "".join(f'<tspan fill="{color}" dx="14">● {method}</tspan>' for method, color in COLORS.items())
    print(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {3 * WIDTH} {HEIGHT + 20}" '
          f'font-family="sans-serif" font-size="10"><rect width="100%" height="100%" fill="#fff"/>\n{body}\n'
          f'<text x="{1.5 * WIDTH}" y="{HEIGHT + 12}" text-anchor="middle" font-size="12">{legend}'
          f'<tspan fill="#444" dx="14">over the number of primitives, depth {depth}</tspan></text>\n</svg>')


if __name__ == "__main__":
    main()
