# SPDX-License-Identifier: BSD-3-Clause
"""Names the cheapest composition for an error, or the most exact one for a budget, from the measured ladders; runs it."""
import argparse
import csv
import math
import sys
from pathlib import Path

import ladder
import model
from measure import Machine, Point, enough

# Cases that are on no ladder: other Re, other L, and levels between those of the ladders.
HELD_OUT = (
    "--case taylor_green --error 0.01 --reynolds 70",
    "--case taylor_green --error 0.005 --reynolds 140",
    "--case taylor_green --error 0.01 --reynolds 280 --length 2",
    "--case taylor_green --error 0.004 --length 0.3",
    "--case taylor_green --budget 1s --reynolds 140",
    "--case taylor_green --error 0.01 --reynolds 140 --family quintic,symplectic",
    "--case taylor_green --error 0.02 --length 2 --precision float",
    "--case taylor_green --error 0.008 --reynolds 70 --family wendland_c4,runge_kutta2",
    "--case poiseuille --error 0.01 --reynolds 0.05",
    "--case poiseuille --error 0.01 --length 2e-3",
    "--case poiseuille --error 0.02 --family quintic,adami --reynolds 0.1",
)
FACTOR = 1.5  # within which a prediction must be


def parser():
    p = argparse.ArgumentParser(prog="bench/run.sh advise", description=__doc__)
    p.add_argument("--case", choices=sorted(model.CASES), default="taylor_green")
    goal = p.add_mutually_exclusive_group(required=True)
    goal.add_argument("--error", type=float, help="relative error that may be left, as 0.01")
    goal.add_argument("--budget", help="seconds that the run may take, as 10s")
    goal.add_argument("--check", action="store_true", help=f"predict and run {len(HELD_OUT)} cases that are on no ladder")
    p.add_argument("--reynolds", type=float, help="of the case (default: that of the ladders)")
    p.add_argument("--length", type=float, help="of the case [m] (default: that of the ladders)")
    p.add_argument("--of", help="which error (default: the first of the case)")
    p.add_argument("--precision", choices=("double", "float"), help="only this one")
    p.add_argument("--family", help="only families that contain these words, as quintic,leapfrog")
    p.add_argument("--dry", action="store_true", help="do not run it")
    p.add_argument("--tables", type=Path, help="folder of the ladders (default build/bench/work_precision)")
    p.add_argument("--executable", type=Path, help=argparse.SUPPRESS)
    p.add_argument("--context", help=argparse.SUPPRESS)
    return p


def options(words=None):
    p = parser()
    o = p.parse_args(words)
    if o.budget is not None:
        try:
            o.budget = float(o.budget.rstrip("s"))
        except ValueError:
            p.error(f"--budget {o.budget}: seconds, as 10s")
    for name in ("error", "budget", "reynolds", "length"):
        value = getattr(o, name)
        if value is not None and not (value > 0 and math.isfinite(value)):
            p.error(f"--{name} {value}: a number above 0")
    return o


def tables_of(o):
    return o.tables or Path(__file__).resolve().parents[2] / "build/bench/work_precision"


def known_of(o, case):
    table = tables_of(o) / case.table
    if not table.exists():
        sys.exit(f"advise: {table} is not there; measure first: bash bench/run.sh work_precision --figures {case.figure}")
    known = model.Known(ladder.read(table), case, o.of)
    if o.precision:
        known.keep(lambda f: f["precision"] == o.precision)
    if o.family:
        known.keep(lambda f: all(word in f["family"] for word in o.family.split(",")))
    return known


def least_of(point):
    n = len(point.runs)
    return f", the least of {n} runs" if n > 1 else ""


def advise(o):
    """Prints the offers; what was predicted of the best one, and what came out."""
    case = model.CASES[o.case]
    known = known_of(o, case)
    here = {"reynolds": o.reynolds or case.reynolds, "length": o.length or case.length, "until": case.until}
    offers = known.offers(here, error=o.error, budget=o.budget)
    if not offers:
        asked = f"comes down to {o.error:g}" if o.error else f"fits in {o.budget:g} s"
        sys.exit(f"advise: no measured ladder {asked}; {known.reach(here)}")
    asked = f"{known.err_name} at most {o.error:g}" if o.error else f"{known.err_name} in {o.budget:g} s"
    print(f"{o.case}, {case.describe(here)}, {asked}: the best of {len(offers)} ladders")
    print(f"{'':4}{'family':72}{'C':>6}{'n':>6}{'dt':>11}{'error':>10}{'time':>10}")
    for k, offer in enumerate(offers[:5]):
        dt = case.end_and_dt(offer.h_dx, offer.n, offer.cfl, offer.sound, here)[1]
        print(f"{k + 1:>2}. {offer.family:72}{offer.cfl:>6g}{offer.n:>6d}{dt:>9.2g} s{offer.error:>10.2g}{offer.time:>8.2g} s")
    for warning in known.warnings(here, offers[0]):
        print(f"    {warning}")
    if o.dry:
        return None
    best = offers[0]
    machine = Machine(o.executable)
    family = next((f for f in machine.families if f["family"] == best.family and f["case"] == o.case), None)
    if family is None:
        sys.exit(f"advise: {best.family} is not in the executable: measure again")
    point = Point(case.figure, "advise", family, best.time, **best.setting(here))
    while not point.runs or not enough(point):  # as the ladders were measured
        point.runs.append(machine.run(family, point.setting, at_most=max(600, 20 * best.time)))
    r = point.runs[0]
    if r["status"] != "OK":
        sys.exit(f"advise: the run ended in {r['status']} after {r['wall_s']:.2g} s")
    got, took = r["errors"][known.err_name], min(known.clock(one) for one in point.runs)
    print(f"run: C {best.cfl:g}, n {best.n}, dt {r['dt']:.3g} s, {r['steps']} steps of {r['N']} particles")
    print(f"  error {got:.3g}: {got / best.error:.2f} of the prediction, {best.error:.3g}")
    print(f"  time {took:.3g} s: {took / best.time:.2f} of the prediction, {best.time:.3g} s{known.clock_name(r)}{least_of(point)}")
    return {"family": best.family, "C": best.cfl, "n": best.n, "error_predicted": best.error, "error": got,
            "time_predicted": best.time, "time": took}  # fmt: skip


def check(o):
    lines = []
    for words in HELD_OUT:
        print(f"\n$ bash bench/run.sh advise {words}")
        one = options([*words.split(), "--tables", str(tables_of(o)), "--executable", str(o.executable)])
        lines.append({"asked": words} | advise(one))
    off = lambda line, k: max(line[k] / line[k + "_predicted"], line[k + "_predicted"] / line[k])
    with open(tables_of(o) / "advise.csv", "w", newline="", encoding="utf-8") as file:
        out = csv.DictWriter(file, list(lines[0]), lineterminator="\n")
        out.writeheader()
        out.writerows({k: f"{v:.4g}" if isinstance(v, float) else v for k, v in line.items()} for line in lines)
    bad = [line for line in lines if off(line, "error") > FACTOR or off(line, "time") > FACTOR]
    worst = {k: max(off(line, k) for line in lines) for k in ("error", "time")}
    print(f"\n{len(lines) - len(bad)} of {len(lines)} held-out cases within a factor {FACTOR}; "
          f"worst: error {worst['error']:.2f}, time {worst['time']:.2f}")  # fmt: skip
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    given = options()
    if given.check:
        check(given)
    else:
        advise(given)
