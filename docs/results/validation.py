#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the figures of validation.md from the tables that the tests of models leave in this folder:

    SPATE_RESULTS=docs/results build/gcc/tests/test_models
    python3 docs/results/validation.py
"""

import csv
import math
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

here = Path(__file__).resolve().parent
data = here.parent.parent / "tests" / "data"
shift = 0.10  # of the front in time, common to all resolutions: see validation.md


def table(path):
    with open(path) as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


def save(figure, name):
    figure.tight_layout()
    figure.savefig(here / name, dpi=80)
    plt.close(figure)


def dam_break():
    front, height = (table(data / f"martin_moyce_1952_n2_2_{what}.csv") for what in ("front", "height"))
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.6))
    for n, style in ((20, ":"), (40, "--"), (80, "-")):
        run = table(here / f"dam_break_{n}.csv")
        left.plot([t + shift for t in run["T"]], run["Z"], style, label=f"H/dx = {n}")
        right.plot(run["tau"], run["h_over_H"], style, label=f"H/dx = {n}")
    left.plot(front["T"], front["Z"], "ko", mfc="none", label="Martin & Moyce 1952")
    right.plot(height["tau"], height["H"], "ko", mfc="none", label="Martin & Moyce 1952")
    left.set(xlim=(0, 3.6), ylim=(1, 4.6), xlabel=f"T = t sqrt(2 g/a) (runs start {shift:.2f} later)", ylabel="Z = x/a",
             title="front")
    right.set(xlim=(0, 2.5), ylim=(0, 1.05), xlabel="t sqrt(g/a) (as it is)", ylabel="h / 2a", title="height at the wall")
    for axes in (left, right):
        axes.grid(alpha=0.3)
        axes.legend()
    save(figure, "dam_break_martin_moyce.png")


def still_water():
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.6))
    for name, label in (("_adami", "cubic spline, h = 1.2 dx"), ("_wendland_c2", "Wendland C2, h = 2 dx")):
        run = table(here / f"still_water_50_profile{name}.csv")
        floor = max(run["exact"])
        left.plot([p / floor for p in run["p"]], run["z"], ".", ms=3, label=label)
        right.plot([100 * (p - e) / floor for p, e in zip(run["p"], run["exact"])], run["z"], ".", ms=3, label=label)
        if name == "_adami":
            exact = sorted(zip(run["z"], run["exact"]))
            left.plot([e / floor for _, e in exact], [z for z, _ in exact], "k-", lw=0.8, label="exact")
    left.set(xlabel="pressure / that of the lowest row", ylabel="z [m]", title="still water, H/dx = 50, t = 20 sqrt(H/g)")
    right.set(xlabel="error of pressure / that of the lowest row [%]", ylabel="z [m]", title="every seventh particle")
    for axes in (left, right):
        axes.grid(alpha=0.3)
        axes.legend()
    save(figure, "still_water_pressure.png")


def elliptical_drop():
    figure, axes = plt.subplots(figsize=(6, 4.6))
    exact = table(data / "elliptical_drop.csv")
    for what, colour in (("minor", "C0"), ("major", "C1")):
        axes.plot(exact["A0t"], exact[what], "k-", lw=0.8, label="solution" if what == "minor" else None)
        for kernel, mark in (("cubic_spline", "o"), ("wendland_c2", "+")):
            run = table(here / f"elliptical_drop_40_{kernel}.csv")
            axes.plot(run["A0t"], run[what], mark, color=colour, mfc="none", label=f"{what}, {kernel.replace('_', ' ')}")
    axes.set(xlim=(0, 2.05), ylim=(0, 4), xlabel="A0 t", ylabel="semi-axis / R", title="elliptical drop, R/dx = 40")
    axes.grid(alpha=0.3)
    axes.legend()
    save(figure, "sph/elliptical_drop.png")


def standing_wave():
    figure, axes = plt.subplots(figsize=(8, 4))
    for n, style in ((20, ":"), (50, "-")):
        run = table(here / f"standing_wave_{n}_500.csv")
        axes.plot(run["t_over_period"], run["kinetic"], style, label=f"H/dx = {n}")
    t = [k / 100 for k in range(326)]
    k, omega = math.pi, math.sqrt(math.pi * math.tanh(math.pi))
    decay = 4 / 500 * k * k * math.pi / omega
    axes.plot(t, [math.exp(-decay * x) * math.cos(math.pi * x) ** 2 for x in t], "k--", lw=0.8, label="linear theory")
    axes.set(xlabel="t / (pi/omega)", ylabel="E_k / E_k(0)", title="standing wave, Re = 500, Wendland C2, h = 2 dx")
    axes.grid(alpha=0.3)
    axes.legend()
    save(figure, "sph/standing_wave.png")


if __name__ == "__main__":
    dam_break()
    if (here / "still_water_50_profile_adami.csv").exists():
        still_water()
    if (here / "elliptical_drop_40_cubic_spline.csv").exists():
        elliptical_drop()
    if (here / "standing_wave_50_500.csv").exists():
        standing_wave()
