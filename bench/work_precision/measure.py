# SPDX-License-Identifier: BSD-3-Clause
"""Runs points of ladders with the executable of this folder: repeats, random order, budgets."""
import json
import math
import os
import random
import statistics
import subprocess
import sys
import time

import ladder

SETTINGS = ("n", "cfl", "sound", "reynolds", "length", "until", "jitter", "omega_dt", "skin", "cell", "threads")
DEFAULTS = {"cfl": 0.25, "sound": 10, "reynolds": 100, "length": 1, "until": 1, "jitter": 0.2, "omega_dt": 0.1}
DEFAULTS |= {"skin": 0, "cell": 0, "threads": 1}


class Machine:
    """The executable, and the families that are compiled into it."""

    def __init__(self, executable):
        self.executable = str(executable)
        self.quiet = os.getloadavg()[0] < 1.5  # else the scheduler finds a better core than we do
        listed = subprocess.run([self.executable, "--list"], check=True, capture_output=True, text=True).stdout
        self.families = []
        for line in listed.splitlines():
            f = json.loads(line)
            f["index"], f["family"] = f["family"], ladder.family_name(f)
            self.families.append(f)

    def find(self, case, **where):
        return [f for f in self.families if f["case"] == case and all(f[k] in ok(v) for k, v in where.items())]

    def run(self, family, setting, at_most=120.0):
        """One run: what the executable prints."""
        command = [self.executable, "--family", str(family["index"]), "--at_most", f"{at_most:.6g}"]
        for name in SETTINGS:
            if name in setting:
                command += [f"--{name}", f"{setting[name]:.9g}"]
        if setting.get("threads", 1) == 1 and self.quiet:  # one core: no move between two
            command = ["taskset", "-c", str(max(os.sched_getaffinity(0))), *command]
        environment = dict(os.environ, OMP_WAIT_POLICY="passive")
        done = subprocess.run(command, capture_output=True, text=True, env=environment)
        if done.returncode != 0:
            raise RuntimeError(f"{family['family']} with {setting}: {done.stderr.strip()}")
        return json.loads(done.stdout)


def ok(value):
    return value if isinstance(value, (tuple, list, set)) else (value,)


class Point:
    def __init__(self, figure, ladder_name, family, guess, **setting):
        self.figure, self.ladder, self.family = figure, ladder_name, family
        self.setting = DEFAULTS | setting
        self.guess = guess  # CPU seconds, before anything is known; later points of a ladder know better
        self.runs = []
        self.skipped = None

    @property
    def cpu(self):
        return min(r["cpu_s"] for r in self.runs)

    def rows(self):
        """One row for each error of the point."""
        s = self.setting
        base = {k: self.family[k] for k in ladder.FAMILY}
        base |= {"figure": self.figure, "ladder": self.ladder} | {k: float(s[k]) for k in ladder.SETTING if k in s}
        r = self.runs[0]
        for k in ("N", "dt", "steps", "force_evals", "pairs", "status"):
            base[k] = r[k]
        wall, cpu = [q["wall_s"] for q in self.runs], [q["cpu_s"] for q in self.runs]
        base |= {"wall_s_min": min(wall), "wall_s_med": statistics.median(wall), "wall_s_max": max(wall)}
        base |= {"cpu_s": statistics.median(cpu), "cpu_s_min": min(cpu), "cpu_s_max": max(cpu)}
        base |= {"setup_s": min(q["setup_s"] for q in self.runs), "repeats": float(len(self.runs))}
        errors = r["errors"] if r["status"] == "OK" else {}
        if self.family["case"] == "anatomy":  # times, no errors: the least is what the code costs
            errors = {k: min(q["errors"][k] for q in self.runs) for k in errors}
        elif any(q["errors"] != r["errors"] for q in self.runs):
            print(f"measure: {self.family['family']} n {s['n']}: repeats differ in their errors", file=sys.stderr)
        return [base | {"err_name": k, "err": v} for k, v in errors.items()] or [base | {"err_name": "", "err": math.nan}]


def expected(point, points):
    """CPU seconds of a point, from the nearest one of its ladder: as n^3 in the plane (steps too), as 1/dt."""
    same = [p for p in points if p.runs and p.family is point.family and p.figure == point.figure]
    done = [p for p in same if p.runs[0]["status"] == "OK"]
    if not done:
        return point.guess
    a = point.setting
    near = min(done, key=lambda p: (p.ladder != point.ladder, abs(math.log(p.setting["n"] / a["n"]))))
    b = near.setting
    power = {"contact": 0, "acoustic": 2}.get(point.family["case"], 3)
    return near.cpu * (a["n"] / b["n"]) ** power * (a["sound"] / b["sound"]) * (a["until"] / b["until"]) * (
        b["cfl"] / a["cfl"]
    ) * (b["omega_dt"] / a["omega_dt"])


def enough(point):
    """At least five repeats or two seconds (numerics D.3), and a fifth of a second or fifteen."""
    spent, n = sum(r["cpu_s"] for r in point.runs), len(point.runs)
    return point.runs[0]["status"] != "OK" or spent >= 2 or (n >= 5 and spent >= 0.2) or n >= 15


def measure(machine, points, budget, longest, say=print, seed=1):
    """Runs all points once from coarse to fine, then repeats them in random order. Budgets in CPU seconds: on a machine
    with nothing else to do that is time."""
    dice = random.Random(seed)
    spent, began = 0.0, time.monotonic()

    def run(point):
        nonlocal spent
        r = machine.run(point.family, point.setting, at_most=2 * longest)
        spent += r["cpu_s"] + r["setup_s"]
        if r["status"] == "OverBudget":
            point.skipped = f"was given up after {r['wall_s']:.0f} s"
            return
        point.runs.append(r)

    first = list(points)
    dice.shuffle(first)
    first.sort(key=lambda p: p.guess)
    for point in first:
        cost = expected(point, points)
        if cost > longest:
            point.skipped = f"would take {cost:.0f} s, more than the {longest:.0f} s of a run"
        elif spent + cost > budget:
            point.skipped = f"would take {cost:.0f} s of the {max(budget - spent, 0):.0f} s that are left of {budget:.0f} s"
        else:
            run(point)
            say(f"{spent:6.1f} s  {point.figure} {point.ladder}, n {point.setting['n']}: {point.family['family']}")
    while True:
        again = [p for p in points if p.runs and not enough(p) and spent + p.cpu <= budget]
        if not again:
            break
        dice.shuffle(again)
        for point in again:
            if spent + point.cpu <= budget:
                run(point)
    say(f"measured {sum(len(p.runs) for p in points)} runs of {len(points)} points in {spent:.0f} s of CPU time, "
        f"{time.monotonic() - began:.0f} s of wall time")  # fmt: skip
    return [row for p in points if p.runs for row in p.rows()], [p for p in points if p.skipped]
