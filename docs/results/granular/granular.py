#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws energy.png from the histories of the seed's box by three schemes; README.md of this folder says how they are made."""

import csv
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

here = Path(__file__).resolve().parent
figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.6))
for name, style in (("forward_euler", "C3-"), ("symplectic_euler", "C0--"), ("leapfrog", "C1-")):
    with open(here / f"energy_{name}.csv") as file:
        rows = list(csv.DictReader(file))
    time = [float(row["t"]) for row in rows]
    total = [float(row["kinetic"]) + float(row["elastic"]) for row in rows]
    change = [100 * (e / total[0] - 1) for e in total]
    left.plot(time, change, style, label=name.replace("_", " "))
    if name != "forward_euler":
        right.plot(time, change, style, label=name.replace("_", " "))
left.set_ylim(-0.3, 6)
left.axhline(5, color="0.6", lw=0.8)
left.text(0.03, 5.15, "the watch stops the run", color="0.4")
left.set(xlabel="t [s]", ylabel="total energy over its start - 1 [%]", title="three schemes at t_c/25")
right.set(xlabel="t [s]", ylabel="total energy over its start - 1 [%]", title="the symplectic ones alone")
for axes in (left, right):
    axes.grid(alpha=0.3)
    axes.legend()
figure.tight_layout()
figure.savefig(here / "energy.png", dpi=80)
