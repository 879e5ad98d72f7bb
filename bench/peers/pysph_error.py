#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Time to an error beside PySPH (Debian package python3-pysph), both in one run, turn by turn:
    vortices  of Taylor & Green, Re = 100, t = 1, from a lattice jittered by a fifth, error L1 of speed; n is L/dx
    column    of water twice as high as wide, front to T = 3.4 against Martin & Moyce (1952), rms of Z/Z_data - 1
              after the best shift of time between 0.05 and 0.3; n is H/dx; both codes in a tank of 8 a

    cmake --preset bench && cmake --build --preset bench --target bench_work_precision
    /usr/bin/python3 bench/peers/pysph_error.py [--case column] [--levels 25,50,100] [--repeats 3] [--schemes tvf,edac]

PySPH runs its own examples (pysph.examples.taylor_green, dam_break_2d) with its own schemes, each at its own time step or a
multiple that still is stable (edac@2); ours at the Courant numbers of docs/guide.md. PySPH's generated code is compiled with
-O3 -march=native -ffast-math, ours without the last. One thread each. CPU seconds of the steps only: what each does before the
first step, compiling included, and looking at the front are left out. Of repeats the least counts."""
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


class Clock:
    """CPU seconds of the steps of a run: begin() when one is over and looked at, end() when the next one is."""

    def __init__(self):
        self.steps, self.seconds, self.since = 0, 0.0, None

    def end(self):
        if self.since is not None:  # the first step compiles
            self.seconds += time.process_time() - self.since
        self.steps += 1

    def begin(self):
        self.since = time.process_time()

    def total(self):
        return self.seconds * self.steps / (self.steps - 1)


def lengthen(solver, times):
    """Takes a fixed step of so many times the scheme's own."""
    if times:
        solver.set_adaptive_timestep(False)
        solver.set_time_step(times * solver.dt)


def vortices(arguments, times):
    import numpy as np
    from pysph.examples import taylor_green

    clock = Clock()

    class Vortices(taylor_green.TaylorGreen):
        def consume_user_options(self):
            super().consume_user_options()
            self.tf = 1.0

        def configure_scheme(self):
            super().configure_scheme()
            self.scheme.configure_solver(kernel=taylor_green.QuinticSpline(dim=2), tf=self.tf, dt=self.dt, pfreq=10**9)
            lengthen(self.scheme.get_solver(), times)

        def post_step(self, solver):
            clock.end()
            clock.begin()

    app = Vortices()
    app.run(["--disable-output", "--max-steps", "1000000", *arguments])
    fluid = app.particles[0]
    x, y, u, v = fluid.get("x", "y", "u", "v", only_real_particles=True)
    u_e, v_e, _ = taylor_green.exact_solution(1.0, -8 * np.pi**2 / 100, app.solver.t, x, y)
    was, exact = np.sqrt(u**2 + v**2), np.sqrt(u_e**2 + v_e**2)
    return clock, len(x), float(np.abs(was - exact).sum() / exact.sum())


def error_of_front(front):
    """Of (T, Z) pairs: as tests/models/series.hpp."""
    import numpy as np

    with open(root / "tests/data/martin_moyce_1952_n2_2_front.csv") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    data = np.array([(float(r["T"]), float(r["Z"])) for r in rows if float(r["T"]) <= 3.4])
    T, Z = np.array(front).T
    return min(float(np.sqrt(np.mean((np.interp(data[:, 0] - s, T, Z) / data[:, 1] - 1) ** 2))) for s in np.arange(0.05, 0.3005, 0.001))


def column(arguments, times):
    import numpy as np
    from pysph.examples import dam_break_2d

    clock, front = Clock(), []
    unit = math.sqrt(dam_break_2d.fluid_column_width / (2 * dam_break_2d.g))

    class Column(dam_break_2d.DamBreak2D):
        def create_particles(self):  # the example's own has mass and h of one spacing, whatever --dx, and a tank of 4 a
            dx, rho = self.dx, dam_break_2d.ro
            x, y = dx * np.mgrid[1 : round(dam_break_2d.fluid_column_width / dx) + 1, 1 : round(dam_break_2d.fluid_column_height / dx) + 1]
            wall_x, wall_y = dam_break_2d.get_2d_tank(dx=dx, length=8.0, height=4.0, base_center=[4.0, 0.0], num_layers=4)
            of = {"h": self.h, "m": rho * dx * dx, "rho": rho}
            fluid = dam_break_2d.get_particle_array(name="fluid", x=x.ravel(), y=y.ravel(), **of)
            wall = dam_break_2d.get_particle_array(name="boundary", x=wall_x, y=wall_y, **of)
            self.scheme.setup_properties([fluid, wall])
            self.kernel_corrections(fluid, wall)
            return [fluid, wall]

        def configure_scheme(self):
            super().configure_scheme()
            solver = self.scheme.get_solver()
            solver.set_final_time(3.5 * unit)
            solver.set_print_freq(10**9)
            solver.set_output_at_times([])
            lengthen(solver, times)

        def look(self, T):
            if front and T < front[-1][0] + 0.02:
                return
            x = np.sort(self.particles[0].get("x", only_real_particles=True))
            if not front:
                self.left = x[0] - self.dx / 2
            front.append((T, (x[math.ceil(0.995 * len(x)) - 1] + self.dx / 2 - self.left) / dam_break_2d.fluid_column_width))

        def pre_step(self, solver):
            if not front:
                self.look(0.0)

        def post_step(self, solver):
            clock.end()
            self.look(solver.t / unit)
            clock.begin()

        def post_process(self, *of):
            pass

    app = Column()
    app.run(["--disable-output", "--max-steps", "1000000", *arguments])
    return clock, len(app.particles[0].get("x", only_real_particles=True)), error_of_front(front)


def one(case, times, arguments):
    """A run of PySPH in this process: prints a line of JSON."""
    clock, N, error = {"vortices": vortices, "column": column}[case](arguments, times)
    print("RESULT " + json.dumps({"N": N, "steps": clock.steps, "cpu_s": clock.total(), "error": error}))


def peer(case, scheme, n):
    scheme, _, times = scheme.partition("@")
    arguments = [f"--scheme={scheme.split('+')[0]}"]
    if case == "column":
        arguments += [f"--dx={2 / n}"]
    else:
        arguments += [f"--nx={n}", "--re=100", "--perturb=0.4"]  # of [0, 0.4) dx
    if "+shift" in scheme:
        arguments += ["--shift-freq=1", "--shift-kind=fickian", "--shift-parameter=4"]
    environment = dict(os.environ, OMP_NUM_THREADS="1", CFLAGS="-O3 -march=native -ffast-math")
    with tempfile.TemporaryDirectory() as scratch:
        command = [sys.executable, __file__, "--one", case, times or "0", *arguments, "-d", scratch + "/out"]
        done = subprocess.run(command, capture_output=True, text=True, env=environment, cwd=scratch)
    lines = [line for line in done.stdout.splitlines() if line.startswith("RESULT ")]
    if not lines and "diverging" not in done.stdout + done.stderr:
        raise RuntimeError(f"{' '.join(command)}: {done.stdout[-500:]}{done.stderr[-2000:]}")
    return json.loads(lines[0][7:]) if lines else None


def ours(executable, family, n):
    command = [executable, "--family", str(family["family"]), "--n", str(n), *family["setting"]]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    run = json.loads(done.stdout)
    return {"N": run["N"], "steps": run["steps"], "cpu_s": run["cpu_s"], "error": run["errors"][family["error"]]}


def time_to(error, ladder):
    """Where a ladder first comes below an error, by interpolation of logarithms between its levels; (seconds, how)."""
    points = [(run["error"], run["cpu_s"]) for run in ladder]
    if points[0][0] <= error:
        return points[0][1], "at most"
    for (e0, t0), (e1, t1) in zip(points, points[1:]):
        if e1 <= error < e0:
            return t0 * (t1 / t0) ** (math.log(e0 / error) / math.log(e0 / e1)), ""
    return None, "not reached"


def main():
    if sys.argv[1:2] == ["--one"]:
        return one(sys.argv[2], float(sys.argv[3]), sys.argv[4:])
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--case", default="vortices", choices=("vortices", "column"))
    options.add_argument("--levels", help="default: 25,50,100 of vortices, 20,40,80 of the column")
    options.add_argument("--schemes", help="of PySPH: tvf, edac, gtvf, wcsph, aha, wcsph+shift, ..., edac@3 with a fixed step of 3 times its own (tvf,edac,edac@2; wcsph@3,edac,edac@3)")
    options.add_argument("--repeats", type=int, default=3)
    options.add_argument("--executable", type=Path, default=root / "build/bench/bench/work_precision/bench_work_precision")
    options.add_argument("--into", type=Path, default=root / "build" / "bench" / "peers")
    args = options.parse_args()
    of_column = args.case == "column"
    args.levels = args.levels or ("20,40,80" if of_column else "25,50,100")
    args.schemes = args.schemes or ("wcsph@3,edac,edac@3" if of_column else "tvf,edac,edac@2")
    listed = subprocess.run([args.executable, "--list"], check=True, capture_output=True, text=True).stdout
    if of_column:
        name, formulation, error = "dam_break", "sigma2+diffusion+adami", "front"
        setting = ["--length", "0.6", "--until", "3.5"]
        kinds = (("cubic_spline", "symplectic_euler", "0.2"), ("cubic_spline", "symplectic_euler", "0.8"))
    else:
        name, formulation, error, setting = "taylor_green", "sigma2+diffusion+shifting", "L1_speed", []
        kinds = (("quintic_spline", "symplectic_euler", "0.25"), ("wendland_c4", "leapfrog", "1"))
    mine = []
    for kernel, integrator, cfl in kinds:
        of = {"case": name, "formulation": formulation, "precision": "double", "kernel": kernel, "integrator": integrator}
        family = next(f for f in map(json.loads, listed.splitlines()) if all(f[k] == v for k, v in of.items()))
        mine.append(family | {"setting": [*setting, "--cfl", cfl], "error": error, "cfl": cfl})
    runners = {f"PySPH {s}": (lambda n, s=s: peer(args.case, s, n)) for s in args.schemes.split(",")}
    runners |= {f"spate {f['kernel']} {f['h_dx']:g} {f['integrator']} C {f['cfl']}": (lambda n, f=f: ours(args.executable, f, n)) for f in mine}
    ladders = {name: [] for name in runners}
    for n in map(int, args.levels.split(",")):
        best = {}
        for _ in range(args.repeats):
            for name, run in list(runners.items()):
                now = run(n)
                if now is None:
                    print(f"{name:48} n {n:4}: diverges", flush=True)
                    del runners[name]
                    continue
                now |= {"n": n}
                if name not in best or now["cpu_s"] < best[name]["cpu_s"]:
                    best[name] = now
        for name, run in best.items():
            ladders[name].append(run)
            print(f"{name:48} n {n:4}: {run['steps']:6} steps, {run['cpu_s']:9.3f} s, error {100 * run['error']:.3f} %", flush=True)
    args.into.mkdir(parents=True, exist_ok=True)
    with open(args.into / f"pysph_error_{args.case}.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("code", "n", "N", "steps", "cpu_s", "error"))
        writer.writerows((name, r["n"], r["N"], r["steps"], f"{r['cpu_s']:.5g}", f"{r['error']:.6g}") for name, ladder in ladders.items() for r in ladder)
    for error in (0.03, 0.01):
        found = {name: time_to(error, ladder) for name, ladder in ladders.items() if ladder}
        print(f"time to {100 * error:g} %: " + ", ".join(f"{name} {how} {'' if t is None else f'{t:.3g} s'}".replace("  ", " ") for name, (t, how) in found.items()))
        times = {name: t for name, (t, how) in found.items() if t is not None}
        theirs, own = ({k: t for k, t in times.items() if k.startswith(who)} for who in ("PySPH", "spate"))
        if theirs and own:
            print(f"    the best of PySPH over the best of spate: {min(theirs.values()) / min(own.values()):.1f}")


if __name__ == "__main__":
    sys.exit(main())
