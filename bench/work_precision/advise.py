# SPDX-License-Identifier: BSD-3-Clause
"""Names the cheapest composition for an error, or the most exact one for a budget, from the measured ladders; runs it."""
import argparse
import json
import math
import sys
from pathlib import Path

import ladder
import model
from measure import DEFAULTS, Machine


def options():
    p = argparse.ArgumentParser(prog="bench/run.sh advise", description=__doc__)
    p.add_argument("--case", choices=sorted(model.CASES), default="taylor_green")
    goal = p.add_mutually_exclusive_group(required=True)
    goal.add_argument("--error", type=float, help="relative error that may be left, as 0.01")
    goal.add_argument("--budget", help="seconds that the run may take, as 10s")
    p.add_argument("--reynolds", type=float, help="of the case (default: that of the ladders)")
    p.add_argument("--length", type=float, help="of the case [m] (default: that of the ladders)")
    p.add_argument("--of", help="which error (default: the first of the case)")
    p.add_argument("--precision", choices=("double", "float"), help="only this one")
    p.add_argument("--family", help="only families that contain these words")
    p.add_argument("--dry", action="store_true", help="do not run it")
    p.add_argument("--tables", type=Path, help="folder of the ladders (default build/bench/work_precision)")
    p.add_argument("--executable", type=Path, help=argparse.SUPPRESS)
    p.add_argument("--context", help=argparse.SUPPRESS)
    o = p.parse_args()
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


def main():
    o = options()
    case = model.CASES[o.case]
    folder = o.tables or Path(__file__).resolve().parents[2] / "build/bench/work_precision"
    table = folder / case.table
    if not table.exists():
        sys.exit(f"advise: {table} is not there; measure first: bash bench/run.sh work_precision --figures {case.figure}")
    known = model.Known(ladder.read(table), case, o.of)
    if o.precision:
        known.keep(lambda f: f["precision"] == o.precision)
    if o.family:
        known.keep(lambda f: all(word in f["family"] for word in o.family.split()))
    here = {"reynolds": o.reynolds or case.reynolds, "length": o.length or case.length}
    offers = known.offers(here, error=o.error, budget=o.budget)
    if not offers:
        sys.exit(f"advise: no measured ladder {'comes down to ' + str(o.error) if o.error else 'fits'}; {known.reach(here)}")
    asked = f"error {o.error:g}" if o.error else f"{o.budget:g} s"
    print(f"{o.case}, {case.describe(here)}, {known.err_name}, {asked}: the best of {len(offers)} ladders")
    print(f"{'':4}{'family':78}{'C':>6}{'n':>6}{'error':>10}{'time':>10}")
    for k, offer in enumerate(offers[:5]):
        print(f"{k + 1:>2}. {offer.family:78}{offer.cfl:>6g}{offer.n:>6d}{offer.error:>10.2g}{offer.time:>8.2g} s")
    for warning in known.warnings(here, offers[0]):
        print(f"    {warning}")
    if o.dry:
        return
    best = offers[0]
    machine = Machine(o.executable)
    family = next((f for f in machine.families if f["family"] == best.family and f["case"] == o.case), None)
    if family is None:
        sys.exit(f"advise: {best.family} is in {table}, not in the executable: measure again")
    r = machine.run(family, DEFAULTS | best.setting(here), at_most=max(600, 20 * best.time))
    if r["status"] != "OK":
        sys.exit(f"advise: the run ended in {r['status']} after {r['wall_s']:.2g} s")
    got = r["errors"][known.err_name]
    took = known.clock(r)
    print(f"run: {best.family}, C {best.cfl:g}, n {best.n}, dt {r['dt']:.4g} s, {r['steps']} steps of {r['N']} particles")
    print(f"  error {got:.3g}: predicted {best.error:.3g}, {ratio(got, best.error)}")
    print(f"  time {took:.3g} s: predicted {best.time:.3g} s, {ratio(took, best.time)}" + known.clock_name(r))


def ratio(a, b):
    return f"{a / b:.2f} of it"


if __name__ == "__main__":
    main()
