#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Time to an error beside PySPH (Debian package python3-pysph): vortices of Taylor & Green, Re = 100, t = 1, from a lattice jittered
by a fifth, error L1 of speed, both in one run, turn by turn.

    cmake --preset bench && cmake --build --preset bench --target bench_work_precision
    /usr/bin/python3 bench/peers/pysph_error.py [--levels 25,50,100] [--repeats 3] [--schemes tvf,edac]

PySPH runs its own example (pysph.examples.taylor_green) with its own schemes, each at its own time step; its generated code is
compiled with -O3 -march=native -ffast-math, ours without the last. One thread each. CPU seconds of the steps only: what each does before
the first step, compiling included, is left out. Of repeats the least counts."""
import argparse
import csv
import json
import math
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

root = Path(__file__).resolve().parent.parent.parent


def one(arguments):
    """A run of PySPH in this process: prints a line of JSON."""
    import numpy as np
    from pysph.examples import taylor_green

    class Vortices(taylor_green.TaylorGreen):
        stamps = []

        def consume_user_options(self):
            super().consume_user_options()
            self.tf = 1.0

        def configure_scheme(self):
            super().configure_scheme()
            self.scheme.configure_solver(kernel=taylor_green.QuinticSpline(dim=2), tf=self.tf, dt=self.dt, pfreq=10**9)

        def post_step(self, solver):
            self.stamps.append(time.process_time())

    app = Vortices()
    app.run(["--disable-output", "--max-steps", "1000000", *arguments])
    fluid = app.particles[0]
    x, y, u, v = fluid.get("x", "y", "u", "v", only_real_particles=True)
    u_e, v_e, _ = taylor_green.exact_solution(1.0, -8 * np.pi**2 / 100, app.solver.t, x, y)
    was, exact = np.sqrt(u**2 + v**2), np.sqrt(u_e**2 + v_e**2)
    steps = len(app.stamps)
    cpu = (app.stamps[-1] - app.stamps[0]) * steps / (steps - 1)
    error = float(np.abs(was - exact).sum() / exact.sum())
    print("RESULT " + json.dumps({"N": len(x), "steps": steps, "t": app.solver.t, "cpu_s": cpu, "error": error}))


def peer(scheme, n):
    arguments = [f"--scheme={scheme.split('+')[0]}", f"--nx={n}", "--re=100", "--perturb=0.4"]  # of [0, 0.4) dx
    if "+shift" in scheme:
        arguments += ["--shift-freq=1", "--shift-kind=fickian", "--shift-parameter=4"]
    environment = dict(os.environ, OMP_NUM_THREADS="1", CFLAGS="-O3 -march=native -ffast-math")
    with tempfile.TemporaryDirectory() as scratch:
        command = [sys.executable, __file__, "--one", *arguments, "-d", scratch + "/out"]
        done = subprocess.run(command, capture_output=True, text=True, env=environment, cwd=scratch)
    lines = [line for line in done.stdout.splitlines() if line.startswith("RESULT ")]
    if not lines:
        raise RuntimeError(f"{' '.join(command)}: {done.stdout[-500:]}{done.stderr[-2000:]}")
    return json.loads(lines[0][7:])


def ours(executable, family, n):
    command = [executable, "--family", str(family["family"]), "--n", str(n), "--cfl", str(family["C"])]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    run = json.loads(done.stdout)
    return {"N": run["N"], "steps": run["steps"], "cpu_s": run["cpu_s"], "error": run["errors"]["L1_speed"]}


def time_to(error, ladder):
    """By interpolation of logarithms between levels; (seconds, how)."""
    points = sorted((run["error"], run["cpu_s"]) for run in ladder)[::-1]
    if points[0][0] <= error:
        return points[0][1], "at most"
    for (e0, t0), (e1, t1) in zip(points, points[1:]):
        if e1 <= error <= e0:
            return t0 * (t1 / t0) ** (math.log(e0 / error) / math.log(e0 / e1)), ""
    return None, "not reached"


def main():
    if "--one" in sys.argv:
        sys.argv.remove("--one")
        return one(sys.argv[1:])
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--levels", default="25,50,100")
    options.add_argument("--schemes", default="tvf,edac", help="of PySPH: tvf, edac, gtvf, wcsph, wcsph+shift, ...")
    options.add_argument("--repeats", type=int, default=3)
    options.add_argument("--executable", type=Path, default=root / "build/bench/bench/work_precision/bench_work_precision")
    options.add_argument("--into", type=Path, default=root / "build" / "bench" / "peers")
    args = options.parse_args()
    listed = subprocess.run([args.executable, "--list"], check=True, capture_output=True, text=True).stdout
    mine = []
    for family in map(json.loads, listed.splitlines()):
        usual = (family["case"], family["formulation"], family["precision"]) == ("taylor_green", "sigma2+diffusion+shifting", "double")
        if usual and (family["kernel"], family["integrator"]) in {("quintic_spline", "symplectic_euler"), ("wendland_c2", "symplectic_euler")}:
            mine.append(family | {"C": 0.25})
    runners = {f"PySPH {s}": (lambda n, s=s: peer(s, n)) for s in args.schemes.split(",")}
    runners |= {f"spate {f['kernel']} {f['h_dx']:g}": (lambda n, f=f: ours(args.executable, f, n)) for f in mine}
    ladders = {name: [] for name in runners}
    for n in map(int, args.levels.split(",")):
        best = {}
        for _ in range(args.repeats):
            for name, run in runners.items():
                now = run(n) | {"n": n}
                if name not in best or now["cpu_s"] < best[name]["cpu_s"]:
                    best[name] = now
        for name, run in best.items():
            ladders[name].append(run)
            print(f"{name:24} n {n:4}: {run['steps']:6} steps, {run['cpu_s']:9.3f} s, error {100 * run['error']:.3f} %", flush=True)
    args.into.mkdir(parents=True, exist_ok=True)
    with open(args.into / "pysph_error.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("code", "n", "N", "steps", "cpu_s", "error"))
        writer.writerows((name, r["n"], r["N"], r["steps"], f"{r['cpu_s']:.5g}", f"{r['error']:.6g}") for name, ladder in ladders.items() for r in ladder)
    for error in (0.03, 0.01):
        found = {name: time_to(error, ladder) for name, ladder in ladders.items()}
        print(f"time to {100 * error:g} %: " + ", ".join(f"{name} {how} {'' if t is None else f'{t:.3g} s'}".replace("  ", " ") for name, (t, how) in found.items()))
        times = {name: t for name, (t, how) in found.items() if t is not None}
        theirs, own = ({k: t for k, t in times.items() if k.startswith(who)} for who in ("PySPH", "spate"))
        if theirs and own:
            print(f"    the best of PySPH over the best of spate: {min(theirs.values()) / min(own.values()):.1f}")


if __name__ == "__main__":
    sys.exit(main())
