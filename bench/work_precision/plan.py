# SPDX-License-Identifier: BSD-3-Clause
"""Which points are measured for which figure."""
from measure import Point


def taylor_green(machine, paper):
    """W1: ladders in resolution for all families; in dt, and in the speed of sound, for a few."""
    points = []
    levels = (25, 50, 100, 200) if paper else (25, 50, 100)
    for f in machine.find("taylor_green"):
        points += [Point("W1", "resolution", f, 8 * (n / 100) ** 3, n=n) for n in levels]
    for f in machine.find("taylor_green", kernel="quintic_spline", precision="double", formulation=SHIFTED):
        for cfl in (0.0625, 0.125, 0.25, 0.5, 1.0, 1.5, 2.0):
            points.append(Point("W1", "dt", f, 1 * 0.25 / cfl, n=50, cfl=cfl))
    for f in machine.find("taylor_green", kernel=("quintic_spline", "wendland_c4"), precision="double",
                          integrator="symplectic_euler", formulation=SHIFTED):  # fmt: skip
        for n in levels:
            c = 10 * n / 25
            points.append(Point("W1", "sound", f, 8 * (n / 100) ** 3 * n / 25, n=n, sound=c))
    return points


SHIFTED = "sigma2+diffusion+shifting"
FIGURES = {"W1": taylor_green}


def points(machine, figures, paper):
    return [p for name in figures for p in FIGURES[name](machine, paper)]
