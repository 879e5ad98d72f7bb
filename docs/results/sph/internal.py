#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the figures of internal.md from the curves that the tests of models leave; `bash bench/run.sh validation` runs both."""

import csv
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

here = Path(__file__).resolve().parent


def table(name):
    with open(here / name) as file:
        return list(csv.DictReader(file))


def finish(figure, axes, name):
    for a in axes:
        a.grid(alpha=0.3)
        a.legend()
    figure.tight_layout()
    figure.savefig(here / name, dpi=80)
    plt.close(figure)


def channels():
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.6))
    for a, flow in zip(axes, ("couette", "poiseuille")):
        rows = table(f"{flow}_50_profile.csv")
        for n, t in enumerate(sorted({row["t"] for row in rows}, key=float)):
            part = sorted((float(r["y_over_L"]), float(r["u_over_V0"]), float(r["exact"])) for r in rows if r["t"] == t)
            y, u, exact = zip(*part)
            a.plot(exact, y, "k-", lw=0.8, label="series" if n == 0 else None)
            a.plot(u[::4], y[::4], "o", ms=4, mfc="none", label=f"t = {t} s")
        a.set(xlabel="u / V0", ylabel="y / L", title=f"{flow}, 50 across")
    finish(figure, axes, "channels.png")


def decay():
    figure, axes = plt.subplots(figsize=(6, 4.2))
    for name, mark, label in (("", "o", "from a lattice"), ("_jittered", "x", "from a jittered lattice")):
        rows = table(f"taylor_green_50{name}.csv")
        t = [float(row["t"]) for row in rows]
        if not name:
            axes.plot(t, [float(row["exact"]) for row in rows], "k-", lw=0.8, label="exact")
        axes.plot(t, [float(row["speed"]) for row in rows], mark, mfc="none", label=label)
    axes.set(xlabel="t U / L", ylabel="speed / that at the start", title="Taylor-Green vortices, Re = 100, 50 x 50")
    finish(figure, [axes], "taylor_green_decay.png")


def cavity():
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.6))
    for a, component in zip(axes, "uv"):
        rows = [row for row in table("cavity_50_profiles.csv") if row["component"] == component]
        place = [float(row["place"]) for row in rows]
        a.plot(place, [float(row["reference"]) for row in rows], "k+", ms=9, label="finite differences")
        a.plot(place, [float(row["run"]) for row in rows], "o", mfc="none", label="50 x 50")
        a.set(xlabel="y / L" if component == "u" else "x / L", ylabel=f"{component} / U", title="through the centre, Re = 100")
    finish(figure, axes, "cavity_profiles.png")


if __name__ == "__main__":
    channels()
    decay()
    cavity()
