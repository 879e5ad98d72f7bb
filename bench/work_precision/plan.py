# SPDX-License-Identifier: BSD-3-Clause
"""Which points are measured for which figure (numerics D.2); the last number of a Point is a guess of its CPU seconds."""
from measure import Point
from names import CORRECTED, DAM, SHIFTED

OTHER_RE = (50, 200, 400)  # of the vortices: what the error does with Re, for advise


def taylor_green(machine, paper):
    """W1: ladders in resolution for all families at C = 0.25; at C = 1 for the integrator that bears it; in dt; in the speed
    of sound; at other Re for advise."""
    points = []
    levels = (25, 50, 100, 200) if paper else (25, 50, 100)
    for f in machine.find("taylor_green"):
        points += [Point("W1", "resolution", f, 8 * (n / 100) ** 3, n=n) for n in levels]
    for f in machine.find("taylor_green", formulation=CORRECTED):
        points += [Point("W1", "reynolds", f, 12 * (n / 100) ** 3, n=n, reynolds=re) for n in levels[:2] for re in OTHER_RE]
        points += [Point("W1", "sound", f, 48 * (n / 100) ** 4, n=n, sound=10 * n / 25) for n in levels]
    for f in machine.find("taylor_green", precision="double", formulation=SHIFTED):
        if f["kernel"] != "cubic_spline" and f["integrator"] == "symplectic_euler":
            points += [Point("W1", "reynolds", f, 8 * (n / 100) ** 3, n=n, reynolds=re)
                       for n in levels[: 3 if paper else 2] for re in OTHER_RE]  # fmt: skip
        if f["kernel"] == "quintic_spline":
            points += [Point("W1", "dt", f, 0.25 / cfl, n=50, cfl=cfl) for cfl in (0.125, 0.25, 0.5, 1.0, 1.5, 2.0)]
        if f["integrator"] != "leapfrog" or f["kernel"] == "cubic_spline":
            continue
        points += [Point("W1", "long steps", f, 2 * (n / 100) ** 3, n=n, cfl=1) for n in levels]  # a fourth as many
        for n in levels:
            if n == 25 and f["h_dx"] > 1:
                continue  # lists with their usual skin do not last a step of 2 dx/c0 there: long steps show it
            points += [Point("W1", "reynolds", f, 2 * (n / 100) ** 3, n=n, cfl=1, reynolds=re)
                       for re in (25, *OTHER_RE) if n <= 50 or (n == 100 and re != 200)]  # fmt: skip
            points.append(Point("W1", "sound", f, 2 * (n / 100) ** 3 * n / 25, n=n, cfl=1, sound=10 * n / 25))
    return points


def poiseuille(machine, paper):
    levels = (10, 20, 40, 80, 160) if paper else (10, 20, 40, 80)
    points = [Point("W2", "resolution", f, 0.3 * (n / 40) ** 3, n=n, **MORRIS)
              for f in machine.find("poiseuille") for n in levels]  # fmt: skip
    for f in machine.find("poiseuille", formulation="adami+no_slip"):
        points += [Point("W2", "reynolds", f, 0.3 * (n / 40) ** 3, n=n, **MORRIS | {"reynolds": 0.25}) for n in (10, 20)]
    return points


MORRIS = {"reynolds": 0.0125, "length": 1e-3, "until": 0.225}


def acoustic(machine, paper):
    """W3: in dt at 32 points a wave; in resolution, against the lattice's own frequency."""
    points = []
    for f in machine.find("acoustic"):
        for cfl in (0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2, 1.6, 2.0):
            points.append(Point("W3", "dt", f, 0.05 / cfl, n=32, cfl=cfl, until=10))
        for n in (8, 16, 32, 64) if not paper else (8, 16, 32, 64, 128):
            points.append(Point("W3", "resolution", f, 0.1 * (n / 32) ** 2, n=n, cfl=0.25, until=10))
    return points


def dam_break(machine, paper):
    levels = (20, 40, 80, 160) if paper else (20, 40, 80)
    points = []
    for f in machine.find("dam_break"):
        points += [Point("W5", "resolution", f, 3 * (n / 80) ** 3, n=n, **FALL) for n in levels]
        if f["family"] == DAM:  # what all are compared with
            points.append(Point("W5", "reference", f, 3 * (levels[-1] / 40) ** 3, n=2 * levels[-1], **FALL))
        if f["precision"] == "double" and f["formulation"] == "sigma2+diffusion+adami" and f["kernel"] == "cubic_spline":
            for cfl in (0.1, 0.2, 0.4, 0.8, 1.2):
                points.append(Point("W5", "dt", f, 0.3 / cfl, n=40, **FALL | {"cfl": cfl}))
    return points


FALL = {"cfl": 0.2, "length": 0.6, "until": 3.5, "reynolds": 0}


def contact(machine, paper):
    """W6: in omega dt, none of them a whole part of pi or the seed's sqrt 2; and where the watch stops them."""
    ladder = [1.37 / 1.93**k for k in range(8 if not paper else 12)]
    points = []
    for f in machine.find("contact"):
        points += [Point("W6", "dt", f, 0.01, n=1, omega_dt=z) for z in ladder]
        points += [Point("W6", "watched", f, 0.01, n=1, omega_dt=z, skin=1) for z in ladder]
    return points


def anatomy(machine, paper):
    """W9: features; and the seed's study of skin and cell, on the vortices."""
    points = [Point("W9", "features", f, 0.6, n=24) for f in machine.find("anatomy")]
    scene = machine.find("taylor_green", kernel="quintic_spline", integrator="runge_kutta2", precision="double",
                         formulation=SHIFTED)  # fmt: skip
    for f in scene:
        for skin in (0.03, 0.06, 0.09, 0.12, 0.18, 0.25, 0.4):
            points.append(Point("W9", "skin", f, 0.8, n=100, until=0.1, skin=skin))
        for cell in (1, 2, 4, 8, 16):
            points.append(Point("W9", "cell", f, 0.8, n=100, until=0.1, cell=cell))
        for threads in (1, 2):
            points.append(Point("W9", "threads", f, 2, n=200, until=0.02, cell=4, threads=threads))
    return points


FIGURES = {"W1": taylor_green, "W2": poiseuille, "W3": acoustic, "W5": dam_break, "W6": contact, "W9": anatomy}


BUDGET = {"W1": 320, "W2": 60, "W3": 25, "W5": 150, "W6": 10, "W9": 60}  # CPU seconds of the default set
