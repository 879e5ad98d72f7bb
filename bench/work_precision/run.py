# SPDX-License-Identifier: BSD-3-Clause
"""Measures the ladders of the work-precision figures and writes table and page: bash bench/run.sh work_precision."""
import argparse
import datetime
import json
import math
import sys
from pathlib import Path

import ladder
import page
import plan
from measure import Machine, measure


def options():
    p = argparse.ArgumentParser(prog="bench/run.sh work_precision", description=__doc__)
    p.add_argument("--set", choices=("default", "paper"), default="default", help="paper: a level more, and hours")
    p.add_argument("--figures", default=",".join(plan.FIGURES), help="of " + ",".join(plan.FIGURES))
    p.add_argument("--budget", type=float, help="CPU seconds of all figures (default 625; paper 14400)")
    p.add_argument("--longest", type=float, help="CPU seconds of one run (default 30; paper 600)")
    p.add_argument("--continue", action="store_true", dest="go_on", help="keep the points that the tables hold")
    p.add_argument("--into", type=Path, help="folder of the page and the tables (default build/bench/work_precision)")
    p.add_argument("--page-only", action="store_true", help="draw again from the tables")
    p.add_argument("--executable", type=Path, help=argparse.SUPPRESS)
    p.add_argument("--context", default="{}", help=argparse.SUPPRESS)
    o = p.parse_args()
    o.figures = [f for f in o.figures.split(",") if f]
    for f in o.figures:
        if f not in plan.FIGURES:
            p.error(f"there is no figure {f}; choose of {', '.join(plan.FIGURES)}")
    return o


def main():
    o = options()
    paper = o.set == "paper"
    root = Path(__file__).resolve().parents[2]
    into = o.into or root / "build/bench/work_precision"
    into.mkdir(parents=True, exist_ok=True)
    if not o.page_only:
        machine = Machine(o.executable)
        whole = o.budget or (14400 if paper else sum(plan.BUDGET.values()))
        for name in o.figures:
            table = into / f"{name.lower()}.csv"
            points = plan.FIGURES[name](machine, paper)
            kept = held(table, points) if o.go_on and table.exists() else []
            points = [p for p in points if not any(same(p, r) for r in kept)]
            share = whole * plan.BUDGET[name] / sum(plan.BUDGET.values())
            rows, skipped = measure(machine, points, share, o.longest or (600 if paper else 30),
                                    lambda line: print(line, file=sys.stderr))  # fmt: skip
            facts = json.loads(o.context) | {"date": datetime.date.today().isoformat(), "set": o.set}
            facts["busy"] = busy(kept + rows)
            facts["skipped"] = [f"{p.ladder}, n {p.setting['n']}, {p.family['family']}: {p.skipped}" for p in skipped]
            remarks = ["SPDX-License-Identifier: BSD-3-Clause", json.dumps(facts)]
            ladder.write(table, kept + rows, remarks)
    page.write(into)


def same(point, row):
    f, s = point.family, point.setting
    return (row["figure"], row["ladder"], row["case"], row["family"]) == (
        point.figure, point.ladder, f["case"], f["family"]
    ) and all(abs(row[k] - s[k]) <= 1e-5 * abs(s[k]) for k in ladder.SETTING if k in s)  # fmt: skip


def held(table, points):
    """The rows of a table that belong to the plan."""
    return [r for r in ladder.read(table) if any(same(p, r) for p in points)]


def busy(rows):
    """How much longer than its CPU time a run took, in the middle: above 1.05 the core was shared."""
    over = sorted(r["wall_s_min"] / r["cpu_s_min"] for r in rows if r["threads"] == 1 and r["cpu_s_min"] > 0.01)
    return over[len(over) // 2] if over else math.nan


if __name__ == "__main__":
    main()
