#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Draws the figures of validation.md from the curves that the tests of models leave; `bash bench/run.sh validation` runs both."""

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


def curve(name):
    """A curve of a run, or None if it is not there."""
    for folder in (here / "validation", here / "sph", here):
        if (folder / name).exists():
            return table(folder / name)
    return None


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


def finish(figure, axes, name):
    for one in axes:
        one.grid(alpha=0.3)
        one.legend(fontsize=8)
    save(figure, "validation/" + name)


def taylor_green():
    panels = []
    for re, part in (("", "Re = 100"), ("_Re1000", "Re = 1000")):
        runs = [(n, mark, run) for n, mark in ((25, "v"), (50, "o"), (100, "x")) if (run := curve(f"taylor_green_{n}{re}_jittered.csv"))]
        panels += [(runs, part)] if runs else []
    figure, axes = plt.subplots(1, len(panels), figsize=(5.5 * len(panels), 4.2), squeeze=False)
    for one, (runs, part) in zip(axes[0], panels):
        one.plot(runs[0][2]["t"], runs[0][2]["exact"], "k-", lw=0.8, label="exact")
        for n, mark, run in runs:
            one.plot(run["t"], run["speed"], mark, ms=4, mfc="none", label=f"{n} x {n}")
        one.set(xlabel="t U / L", ylabel="speed / that at the start", title=f"vortices from a jittered lattice, {part}")
    finish(figure, axes[0], "taylor_green.png")


def cavity():
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.6))
    for name, mark, label in (("cavity_50_profiles.csv", "o", "Re = 100, 50 x 50"), ("cavity_100_Re1000_profiles.csv", "s", "Re = 1000, 100 x 100")):
        for folder in (here / "validation", here / "sph"):
            if not (folder / name).exists():
                continue
            with open(folder / name) as file:
                rows = list(csv.DictReader(file))
            for one, component in zip(axes, "uv"):
                mine = sorted((float(r["place"]), float(r["run"]), float(r["reference"])) for r in rows if r["component"] == component)
                place, run, reference = zip(*mine)
                one.plot(place, reference, "k+", ms=9, label="finite differences" if mark == "o" else None)
                one.plot(place, run, mark, mfc="none", label=label)
    for one, component in zip(axes, "uv"):
        one.set(xlabel="y / L" if component == "u" else "x / L", ylabel=f"{component} / U", title=f"{component} through the centre")
    finish(figure, axes, "cavity.png")


def koshizuka_oka():
    run, data = curve("dam_break_40.csv"), table(data_of("koshizuka_oka_1996_exp_front"))
    other = table(data_of("martin_moyce_1952_n2_2_front"))
    figure, axes = plt.subplots(figsize=(6, 4.6))
    axes.plot(run["T"], run["Z"], "-", label="H/dx = 40, as it stands")
    axes.plot(data["T"], data["Z"], "ks", mfc="none", label="Koshizuka & Oka 1996")
    axes.plot(other["T"], other["Z"], "o", color="gray", mfc="none", label="Martin & Moyce 1952")
    axes.set(xlim=(0, 3.6), ylim=(1, 4.8), xlabel="T = t sqrt(2 g/a)", ylabel="Z = x/a", title="front, column 1 : 2")
    finish(figure, [axes], "koshizuka_oka.png")


def data_of(name):
    return data / f"{name}.csv"


def lobovsky():
    runs = [(label, run) for n, label in ((120, "2D, H/dx = 120"), (30, "3D, H/dx = 30")) if (run := curve(f"lobovsky_{n}.csv"))]
    if not runs:
        return
    figure, grid = plt.subplots(2, 2, figsize=(11, 7), sharex=True)
    reference = table(data_of("lobovsky_2014_pressure_H300"))
    for one, sensor, height in zip(grid.flat, ("P_S1", "P_S2", "P_S3", "P_S4"), (3, 15, 30, 80)):
        for label, run in runs:
            one.plot(run["tau"], run[sensor], lw=0.7, label=label)
        one.plot(reference["tau"], reference[sensor], "k-", lw=1, label="Lobovsky et al. 2014")
        one.set(xlim=(2.2, 5.05), ylim=(-0.1, 3.2 if height < 80 else 1.2), title=f"{sensor[2:]}, {height} mm", xlabel="t sqrt(g/H)", ylabel="p / (rho g H)")
    finish(figure, grid.flat, "lobovsky.png")


def impact():
    runs = [(n, run) for n in (40, 80) if (run := curve(f"impact_{n}.csv"))]
    if not runs:
        return
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.2))
    for n, run in runs:
        axes[0].plot(run["tau"], run["front"], label=f"H/dx = {n}")
        axes[1].plot(run["tau"], run["P"], lw=0.7, label=f"H/dx = {n}")
    axes[0].plot([1, 2], [2.947, 4.665], "k+", ms=10, label="another code, H/dx = 400")
    reference = table(data_of("buchner_2002_pressure"))
    axes[1].plot(reference["tau"], reference["P"], "ko", ms=3, mfc="none", label="Buchner 2002")
    axes[0].set(xlim=(0, 2.6), xlabel="t sqrt(g/H)", ylabel="front / H", title="front")
    axes[1].set(xlim=(2, 7), ylim=(-0.2, 2), xlabel="t sqrt(g/H)", ylabel="p / (rho g H)", title="pressure on the wall, 0.2 H up")
    finish(figure, axes, "impact.png")


def spheric2():
    run = curve("spheric2.csv")
    if run is None:
        return
    reference = table(data_of("spheric2_kleefsman_2005"))
    figure, grid = plt.subplots(2, 2, figsize=(11, 7))
    names = ("P1", "h_x2638", "h_x1488", "h_x0496")
    for one, name in zip(grid.flat, names):
        scale = 1e3 if name == "P1" else 1
        one.plot(run["t"], [y / scale for y in run[name]], lw=0.8, label="dx = 0.02 m")
        one.plot(reference["t"], [y / scale for y in reference[name]], "k-", lw=0.8, label="Kleefsman et al. 2005")
        one.set(xlim=(0, 2), xlabel="t [s]", ylabel="p [kPa]" if name == "P1" else "depth [m]", title=name)
    finish(figure, grid.flat, "spheric2.png")


def shallow():
    runs = [(what, run) for what in ("dry", "wet") if (run := curve(f"shallow_{what}.csv"))]
    if not runs:
        return
    figure, axes = plt.subplots(1, 2, figsize=(11, 4))
    for one, (what, run) in zip(axes, runs):
        one.plot(run["x_over_t"], run["solution"], "k-", lw=0.8, label="shallow water")
        one.plot(run["x_over_t"], run["depth"], "o", ms=3, mfc="none", label="H/dx = 20")
        one.set(xlabel="x / (t sqrt(g H))", ylabel="depth / H", title=f"{what} bed, t = 6 sqrt(H/g)")
    finish(figure, axes, "shallow.png")


def grains():
    if (run := curve("elastic_box.csv")) is not None:
        figure, axes = plt.subplots(figsize=(6, 4))
        axes.plot(run["step"], run["energy_change"], lw=0.8, label="leapfrog, 25 steps a contact")
        axes.set(xlabel="step", ylabel="E / E(0) - 1", title="1024 discs in an elastic box")
        finish(figure, [axes], "elastic_box.png")
    gas, column = curve("haff.csv"), curve("column_collapse.csv")
    if gas is None and column is None:
        return
    figure, axes = plt.subplots(1, 2, figsize=(11, 4))
    if gas is not None:
        axes[0].semilogy(gas["t_over_tau"], gas["T_over_T0"], "o", mfc="none", label="mean of 24 gases")
        axes[0].semilogy(gas["t_over_tau"], gas["law"], "k-", lw=0.8, label="Haff 1983")
        axes[0].set(xlabel="t / tau", ylabel="T / T0", title="granular gas, e = 0.9")
    if column is not None:
        a = sorted(column["aspect"])
        axes[1].loglog(column["aspect"], column["runout"], "o", mfc="none", label="discs, 64 across")
        axes[1].loglog(a, [3.25 * x**0.7 for x in a], "k-", lw=0.8, label="3.25 a^0.7, Staron & Hinch 2005")
        axes[1].loglog(a, [3.80 * x**0.73 for x in a], "k--", lw=0.8, label="3.80 a^0.73, rods, Nguyen et al. 2015")
        axes[1].set(xlabel="height / width", ylabel="runout / width", title="column of discs")
        axes[1].set(xticks=(3, 4, 6, 8, 10, 15, 20), yticks=(7, 10, 15, 20, 30, 40))
        axes[1].minorticks_off()
        for axis in (axes[1].xaxis, axes[1].yaxis):
            axis.set_major_formatter("{x:.0f}")
    finish(figure, axes, "granular.png")


if __name__ == "__main__":
    dam_break()
    if (here / "still_water_50_profile_adami.csv").exists():
        still_water()
    if (here / "elliptical_drop_40_cubic_spline.csv").exists():
        elliptical_drop()
    if (here / "standing_wave_50_500.csv").exists():
        standing_wave()
    (here / "validation").mkdir(exist_ok=True)
    taylor_green()
    cavity()
    koshizuka_oka()
    lobovsky()
    impact()
    spheric2()
    shallow()
    grains()
