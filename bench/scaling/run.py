# SPDX-License-Identifier: BSD-3-Clause
"""bash bench/run.sh scaling: counts ranks, measures on the cores that are here, models the rest, writes the page."""
import argparse
import json
import subprocess
import sys
from pathlib import Path

import page
import pictures

ROOT = Path(__file__).resolve().parent.parent.parent
KEPT = ROOT / "build" / "bench" / "scaling"
STATE = ROOT / "build" / "bench" / "dam_break_big_0.30.bin"
LOOK = 2.0e-3  # four rebuilds of the lists of the developed flow [s]
STRONG = (8, 16, 32, 64, 128, 256, 504)
CELLS = (1, 2, 3, 4, 6)
# (ranks, finer, cell): each particle of the computed state is cut into finer^3
COUNTED = [(p, 1, 2) for p in STRONG] + [(p, 3, 2) for p in STRONG] + [(64, 2, c) for c in CELLS]
COUNTED += [(8, 2, 2), (27, 3, 2), (60, 4, 2), (115, 5, 2), (193, 6, 2), (301, 7, 2)]  # 1e5 particles a rank
COUNTED += [(87, 2, 2), (266, 3, 2), (600, 4, 2), (1150, 5, 2), (1925, 6, 2), (3012, 7, 2)]  # 1e4
COUNTED += [(4096, 7, 2)]  # as memory allows: 13 GB


def build(name):
    found = [f for f in (ROOT / "build" / "bench" / "bench" / "scaling").glob(name) if f.is_file()]
    if not found:
        sys.exit(f"run.py: {name} was not built")
    return str(found[0])


def count(anew, missing=True):
    """Tables of all counts. \param missing  whether those that are not there are made"""
    tables = {}
    for ranks, finer, cell in COUNTED:
        table = KEPT / f"count_{ranks}_{finer}_{cell}.csv"
        if missing and (anew or not table.exists()):
            print(f"counting {ranks} ranks, finer {finer}, cell {cell}", flush=True)
            command = [build("bench_scaling"), str(ranks), str(finer), str(cell), str(LOOK), str(STATE), str(table)]
            if subprocess.run(command, check=False).returncode != 0:
                table.unlink(missing_ok=True)
                print(f"  {ranks} ranks are left out: no memory for them")
                continue
        if table.exists() and table.stat().st_size > 0:
            tables[ranks, finer, cell] = page.model.table(table)
    return tables


def on_processes(ranks, **options):
    """One run of whole scenes on so many processes: what it prints."""
    words = [f"{k}={v}" for k, v in options.items()]
    command = ["bash", str(ROOT / "tools" / "mpirun.sh"), str(ranks), build("bench_scaling_on_processes"), *words]
    out = subprocess.run(command, check=True, capture_output=True, text=True, cwd=ROOT).stdout
    return json.loads(out.strip().splitlines()[-1])


def measure(anew, again=False):
    """Cost of a step on one and two cores; turn by turn, the least of three, since others may be busy. Asked for alone it
    tries again, and keeps what is less."""
    kept = KEPT / "measured.json"
    measured = json.loads(kept.read_text()) if kept.exists() and not anew else {}
    if measured and not again:
        return measured
    for _ in range(3):
        for cell in (2, 4, 8):
            for ranks in (1, 2):
                run = on_processes(ranks, steps=40, repeats=1, cell=cell)
                key = f"{ranks}/{cell}"
                if key not in measured or run["ms_step"] < measured[key]["ms_step"]:
                    measured[key] = run
    kept.write_text(json.dumps(measured, indent=1))
    return measured


def diaries(anew):
    """One step on two processes: with overlap and without, as the machine is and with messages that take 3 ms."""
    for name, options in page.DIARIES.items():
        if anew or not (KEPT / f"{name}_1.csv").exists():
            on_processes(2, steps=20, repeats=1, cell=2, diary=KEPT / name, **options)
    return [pictures.diary(str(KEPT / name), 2) for name in page.DIARIES]


def sweep(anew):
    """The seeds' study: --cell by ranks and threads on both seed cases [ms a step]."""
    kept = KEPT / "cells.json"
    if kept.exists() and not anew:
        return json.loads(kept.read_text())
    found = []
    for scene, steps in (("seed", 10), ("granular", 10)):
        for ranks, threads in ((1, 1), (1, 2), (2, 1), (2, 2)):
            for cell in (1, 2, 4, 8, 16, 32):
                run = on_processes(ranks, scene=scene, steps=steps, repeats=2, cell=cell, threads=threads)
                found.append({k: run[k] for k in ("scene", "ranks", "threads", "cell", "ms_step", "markers", "imbalance")})
                print(f"  {scene} {ranks} x {threads}, cell {cell}: {run['ms_step']:.2f} ms", flush=True)
    kept.write_text(json.dumps(found, indent=1))
    return found


def main():
    ask = argparse.ArgumentParser(description=__doc__)
    ask.add_argument("--executable", help="as bench/run.sh has built it")
    ask.add_argument("--context", default="{}", help="machine, compiler, commit")
    ask.add_argument("--only", choices=("count", "measure", "diaries", "cells", "page"), help="a part")
    ask.add_argument("--anew", action="store_true", help="forget what was kept in build/bench/scaling")
    o = ask.parse_args()
    KEPT.mkdir(parents=True, exist_ok=True)
    if not STATE.exists():
        sys.exit("run.py: the developed flow is not there: bash bench/run.sh step computes it")
    if o.only == "cells":
        page.cells(sweep(o.anew), json.loads(o.context))
        return
    parts = (("count", count), ("measure", measure), ("diaries", diaries))
    if o.only == "measure":
        measure(o.anew, again=True)
        return
    if o.only in dict(parts):
        dict(parts)[o.only](o.anew)
        return
    tables = count(o.anew, missing=o.only != "page")
    measured, steps = measure(o.anew), diaries(o.anew)
    drawing = KEPT / "draw.csv"
    subprocess.run([build("bench_scaling_draw"), str(drawing)], check=True)
    pictures.decomposition(drawing, ROOT / "docs" / "models" / "decomposition.png")
    page.write(tables, measured, steps, json.loads(o.context))


if __name__ == "__main__":
    main()
