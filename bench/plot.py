# SPDX-License-Identifier: BSD-3-Clause
"""Prints the table of a benchmark and draws it: python3 bench/plot.py NAME, from build/bench/NAME.json."""
import json
import re
import sys
from pathlib import Path

from style import BLUE, GREY, ORANGE, plt

FOLDER = Path(__file__).resolve().parent.parent / "build" / "bench"


class Run:
    """The figures of one run: {benchmark: its counters}, and where they come from."""

    def __init__(self, name):
        data = json.loads((FOLDER / f"{name}.json").read_text())
        self.context = data["context"]
        self.all = {}
        for b in data["benchmarks"]:
            if b.get("run_type") == "aggregate" or "error_message" in b:
                continue
            self.all[re.sub(r"/(iterations|min_time|repeats):[^/]*", "", b["name"])] = b

    def __getitem__(self, benchmark):
        return self.all[benchmark]

    def get(self, benchmark, counter="ns"):
        return self.all.get(benchmark, {}).get(counter)

    def footer(self, threads="1 thread"):
        c = self.context
        return (
            f"{c.get('cpu', 'unknown processor')} ({c['num_cpus']} cores), {c.get('compiler', '?')} -O3 -march=native, "
            f"commit {c.get('commit', '?')}, {threads}, {c['date'][:10]}"
        )


def save(figure, name, footer):
    figure.text(0.01, 0.005, footer, fontsize=9, color=GREY)
    for kind in ("png", "svg"):
        figure.savefig(FOLDER / f"{name}.{kind}", dpi=110)
    print(f"plot: {FOLDER.name}/{name}.png and .svg in {FOLDER.parent.name}/")


def number(x):
    return f"{x:.3g}" if abs(x) < 100 else f"{x:.0f}"


def table(rows, header):
    """Columns as wide as they need be; numbers to the right."""
    said = lambda c: c if isinstance(c, str) else "" if c is None else number(c)
    text = [[said(c) for c in r] for r in rows]
    width = [max(len(r[k]) for r in [header, *text]) for k in range(len(header))]
    for r in [header, *text]:
        print("  ".join(c.ljust(w) if k == 0 else c.rjust(w) for k, (c, w) in enumerate(zip(r, width))).rstrip())


def bars(axis, labels, series, title, unit):
    """Horizontal groups of bars, one group a label; series: (name, colour, values)."""
    height = 0.8 / len(series)
    for s, (name, colour, values) in enumerate(series):
        at = [k + (s - (len(series) - 1) / 2) * height for k in range(len(labels))]
        shown = [v if v is not None else 0 for v in values]
        axis.barh(at, shown, height * 0.92, color=colour, label=name)
        for y, v in zip(at, values):
            if v is not None:
                axis.annotate(number(v), (v, y), (3, 0), textcoords="offset points", va="center", fontsize=9)
    axis.set_yticks(range(len(labels)), labels)
    axis.invert_yaxis()
    axis.grid(axis="y", visible=False)
    axis.set_xlabel(unit)
    axis.set_title(title)
    axis.margins(x=0.12)
    if len(series) > 1:
        axis.legend(loc="best", fontsize=10)


def added_to_a_fluid(run):
    """What each feature costs a pair where it is named; what it costs where it is not, instructions/absent tests."""
    one_loop = "in the loop of the fluid"
    fused = ["LaminarViscosity", "MonaghanCleary", "ArtificialViscosity", "MolteniColagrossi", "DensityDiffusion"]
    fused += ["TensileCorrection", "Xsph"]
    types = ("double", "float")
    base = [run.get(f"added/none/{t}") for t in types]
    if base[0] is None:
        return
    rows = [["continuity and pressure force", one_loop, *base]]
    for name in fused:
        values = [run.get(f"added/{name}/{t}") for t in types]
        rows.append([name, one_loop, *(v - b for v, b in zip(values, base))])
    own = [("Shifting", "a pass each step"), ("SurfaceShifting", "a pass each step")]
    own += [(f"DensityReinit by {k}", "a pass every n steps") for k in ("Shepard", "Mls")]
    for name, work in own:
        rows.append([name, work, *(run.get(f"term/{name}/{t}/records") for t in types)])
    for name in ("wall ByContinuity", "wall Adami"):
        rows.append([name, "wall <- fluid pairs", *(run.get(f"added/{name}/{t}") for t in types)])
    print("\nwhat a feature adds, from L1, ns a pair")
    table(rows, ["", "where", "double", "float"])
    print("a feature that is not named adds no instruction: ctest -R instructions/absent")


def kernel(run):
    names = lambda prefix: list(dict.fromkeys(b.split("/")[1] for b in run.all if b.startswith(prefix + "/")))
    kernels = [f"{k}/{f}" for k in names("kernel") for f in "fg"]
    types = [("double", BLUE), ("float", ORANGE)]
    print("kernels, ns a value")
    columns = [f"{t}/{v}" for t, _ in types for v in ("scalar", "packs")]
    table([[k] + [run.get(f"kernel/{k}/{c}") for c in columns] for k in kernels], ["", *columns])
    terms = names("term")
    print("\npair terms from L1, ns a pair")
    columns = [f"{t}/{v}" for t, _ in types for v in ("scalar", "records", "packs")]
    table([[k] + [run.get(f"term/{k}/{c}") for c in columns] for k in terms], ["", *columns])
    added_to_a_fluid(run)
    stages = names("stage")
    print("\nstages of an evaluation and of a rebuild, ns a particle")
    table([[k, run.get(f"stage/{k}")] for k in stages], ["", "ns"])
    print("\nselection, ns a candidate: 2D %.3f, 3D %.3f" % (run.get("selection/2D"), run.get("selection/3D")))
    steps = names("integrator")
    print("\nintegrators, ns a particle and step")
    scenes = ["dam_break", "gravity"]
    table([[k] + [run.get(f"integrator/{k}/{s}") for s in scenes] for k in steps], ["", "dam break", "gravity only"])

    figure, axes = plt.subplots(2, 2, figsize=(15, 12), layout="constrained", gridspec_kw={"height_ratios": [1.5, 1]})
    figure.get_layout_engine().set(rect=(0, 0.025, 1, 0.975))
    bars(
        axes[0, 0],
        terms,
        [
            ("double, packs that lie ready", BLUE, [run.get(f"term/{k}/double/packs") for k in terms]),
            ("double, records from lists", "#92c5de", [run.get(f"term/{k}/double/records") for k in terms]),
            ("float, packs that lie ready", ORANGE, [run.get(f"term/{k}/float/packs") for k in terms]),
            ("float, records from lists", "#f4a582", [run.get(f"term/{k}/float/records") for k in terms]),
        ],
        "Pair terms, all data in the first-level cache",
        "ns a pair",
    )
    bars(
        axes[0, 1],
        terms,
        [(f"{t}, one at a time", c, [run.get(f"term/{k}/{t}/scalar") for k in terms]) for t, c in types],
        "The same without packs",
        "ns a pair",
    )
    bars(
        axes[1, 0],
        kernels,
        [(f"{t}, packs", c, [run.get(f"kernel/{k}/{t}/packs") for k in kernels]) for t, c in types],
        "Kernels: shape f and slope g",
        "ns a value",
    )
    bars(
        axes[1, 1],
        stages + [f"step, {k}" for k in steps],
        [("", BLUE, [run.get(f"stage/{k}") for k in stages] + [run.get(f"integrator/{k}/dam_break") for k in steps])],
        "Stages on a block of 85,184; whole steps on one of 1,728",
        "ns a particle",
    )
    save(figure, "kernel", run.footer())


def cell_size(run):
    rows = []
    for name, b in run.all.items():
        if not name.startswith("cell_size/"):
            continue
        p = {k: int(v) for k, v in re.findall(r"(\w+):(\d+)", name)}
        rows.append({**p, "skin": p["skin_permille"] / 1000, "h": p["h_tenths"] / 10, **b})
    values = lambda key: sorted({r[key] for r in rows})
    cells, finer, skins, hs = values("cell"), values("finer"), values("skin"), values("h")

    def at(counter, **where):
        return next((r[counter] for r in rows if all(r[k] == v for k, v in where.items())), None)

    usual = {"cell": 4, "finer": 4, "skin": 0.07}
    for h in hs:
        pairs = at("pairs", h=h, **usual)
        print(f"h/dx {h}: {pairs:.1f} pairs a particle; ns a particle, with lists kept as long as in a dam break")
        lines = []
        for c in cells:
            for s in skins:
                flow = [at("flow_ns", cell=c, finer=f, skin=s, h=h) for f in finer]
                parts = [at(k, cell=c, finer=4, skin=s, h=h) for k in ("sweep_ns", "rebuild_ns", "slots_pair")]
                lines.append([f"cell {c:2}, skin {s:.2f}", *flow, *parts])
        table(lines, ["", *(f"finer {f}" for f in finer), "sweep", "rebuild", "slots/pair"])
        best = min((r for r in rows if r["h"] == h), key=lambda r: r["flow_ns"])
        print(f"least: {best['flow_ns']:.0f} at cell {best['cell']}, finer {best['finer']}, skin {best['skin']}\n")

    figure, axes = plt.subplots(len(hs), 4, figsize=(18, 4.1 * len(hs)), layout="constrained", squeeze=False)
    figure.get_layout_engine().set(rect=(0, 0.025, 1, 0.975), w_pad=0.12, h_pad=0.08)
    shades = [plt.get_cmap("viridis")(0.88 * k / max(1, len(skins) - 1)) for k in range(len(skins))]
    over_cell = lambda counter, s, h: (cells, [at(counter, cell=c, finer=4, skin=s, h=h) for c in cells])
    over_finer = lambda counter, s, h: (finer, [at(counter, cell=4, finer=f, skin=s, h=h) for f in finer])
    panels = [
        ("sweep_ns", over_cell, "sweep", "edge of a cell [ranges]"),
        ("rebuild_ns", over_cell, "rebuild", "edge of a cell [ranges]"),
        ("rebuild_ns", over_finer, "rebuild", "bins in a range along x"),
        ("flow_ns", over_cell, "evaluation in a dam break*", "edge of a cell [ranges]"),
    ]
    for row, h in zip(axes, hs):
        for axis, (counter, over, title, across) in zip(row, panels):
            for s, colour in zip(skins, shades):
                slots = at("slots_pair", cell=4, finer=4, skin=s, h=h)
                x, y = over(counter, s, h)
                axis.plot(x, y, "o-", color=colour, label=f"skin {s:.2f}: {slots:.2f} slots a pair")
            axis.set_xscale("log", base=2)
            axis.set_xticks(x, [str(v) for v in x])
            axis.set_xlabel(across)
            axis.set_ylim(bottom=0)
            axis.set_title(f"h/dx {h}: {title}")
        row[0].set_ylabel("ns a particle")
        row[0].legend(fontsize=10, loc="lower left")
    note = "* sweep, and the part of a rebuild at the rate that the flow of a dam break asks for"
    figure.text(0.01, 0.022, note, fontsize=10)
    figure.get_layout_engine().set(rect=(0, 0.045, 1, 0.955))
    save(figure, "cell_size", run.footer())


def figures(run):
    """(what, reached, limit, aim, unit); more is better where the limit is a speed-up."""
    one, two = "dam_break_big<Double>/threads:1", "dam_break_big<Double>/threads:2"
    get = run.get
    speed_up = get(one, "wall_ns_pair") / get(two, "wall_ns_pair") if one in run.all and two in run.all else None
    return [
        ("dam break big, a directed pair [ns]", get(one, "cpu_ns_pair"), 4.0, 3.2),
        ("dam break big, a marker [ns]", get(one, "cpu_ns_marker"), 140, 110),
        ("two threads, times as fast", speed_up, 1.8, None),
        ("sweep over the same terms on packs from L1", get("sweep", "over_packs"), 2.2, 1.8),
        ("float over double, sweep", get("sweep", "float_over_double"), 0.75, None),
        ("discs, a particle-step [ns]", get("dense_discs/threads:1", "cpu_ns_marker"), 18, None),
        ("the seed's 139,332 markers, a step [ms]", get("dam_break_seed", "ms_step"), 15, 10),
        ("steps between walls of Adami over by continuity", get("walls", "step_over"), 1.35, None),
        ("bytes a marker", get(one, "bytes_a_marker"), 450, None),
    ]


def step(run):
    rows = figures(run)
    limits = [[w, v, f"{'>=' if 'times' in w else '<='} {limit}", aim] for w, v, limit, aim in rows]
    table(limits, ["figure to reach", "reached", "limit", "aim"])
    print()
    scenes = [b for b in run.all if "cpu_ns_pair" in run[b]]
    columns = ["cpu_ns_pair", "wall_ns_pair", "cpu_ns_marker", "wall_ns_marker", "steps", "rebuilds", "pairs_a_marker"]
    table([[b] + [run.get(b, c) for c in columns] for b in scenes], ["whole steps", *columns])
    if "walls" in run.all:
        print()
        columns = ["adami_ms", "by_continuity_ms", "rates_over", "adami_ms_step", "by_continuity_ms_step", "step_over"]
        table([["dam break big"] + [run.get("walls", c) for c in columns]], ["walls: rates, steps", *columns])
    if "sweep" in run.all:
        print()
        columns = ["double_ns_pair", "float_ns_pair", "records_ns_pair", "packs_ns_pair", "over_records", "slots_pair"]
        table([["dam break big"] + [run.get("sweep", c) for c in columns]], ["sweep", *columns])

        one = "dam_break_big<Double>/threads:1"
        if one in run.all:
            whole = run.get(one, "cpu_ns_marker")
            sweep, rates = run.get("sweep", "sweep_ns_marker"), run.get("sweep", "rates_ns_marker")
            lists = run.get("sweep", "rebuild_ns_marker") * run.get(one, "rebuilds") / (2 * run.get(one, "steps"))
            print()
            table(
                [["ns a marker", sweep, rates - sweep, lists, whole - rates - lists, whole]],
                ["dam break big", "sweep", "state and packing", "rebuilds", "all else", "an evaluation"],
            )

    known = [r for r in rows if r[1] is not None]
    figure, axis = plt.subplots(figsize=(11, 0.75 * len(known) + 1.8), layout="constrained")
    figure.get_layout_engine().set(rect=(0, 0.05, 1, 0.95))
    share = lambda what, v, limit: limit / v if "times" in what else v / limit
    parts = [share(w, v, limit) for w, v, limit, _ in known]
    axis.barh(range(len(known)), parts, 0.6, color=[BLUE if p <= 1 else ORANGE for p in parts])
    for k, ((what, v, limit, aim), p) in enumerate(zip(known, parts)):
        axis.annotate(f"{v:.3g} (limit {limit:g})", (max(p, 1), k), (6, 0), textcoords="offset points", va="center")
        if aim:
            x = share(what, aim, limit)
            axis.plot([x, x], [k - 0.36, k + 0.36], color="black", lw=2, label="aim" if k == 0 else None)
    axis.axvline(1, color=GREY, lw=1.5, ls="--", label="limit")
    axis.set_yticks(range(len(known)), [w for w, *_ in known])
    axis.invert_yaxis()
    axis.grid(axis="y", visible=False)
    axis.set_xlim(0, max(1.25, 1.35 * max(parts)))
    axis.set_xlabel("share of the limit (for the speed-up: limit over what was reached)")
    axis.set_title("Figures to reach: double, one thread unless said")
    axis.legend(loc="lower right")
    save(figure, "step", run.footer("1 and 2 threads"))


def term_deleted(run):
    counts = {}
    for line in (FOLDER / "instructions.txt").read_text().splitlines():
        parts, terms = line.split(", ")[:-1], line.rsplit(", ", 1)[1]
        left_out = [t for t in ("ArtificialViscosity", "Fourtakas") if t not in terms]
        counts[tuple(left_out)] = parts
    sweeps = {
        "all terms": ("all", ()),
        "without ArtificialViscosity": ("no_viscosity", ("ArtificialViscosity",)),
        "without DensityDiffusion": ("no_diffusion", ("Fourtakas",)),
        "without both": ("neither", ("ArtificialViscosity", "Fourtakas")),
    }
    rows = [[n, run.get("term_deleted", f"{c}_ns_pair"), *counts[left_out]] for n, (c, left_out) in sweeps.items()]
    table(rows, ["sweep", "ns a pair", "inner loop", "", "", ""])


def hand_loop(run):
    for name, b in run.all.items():
        table([[k, v] for k, v in b.items() if isinstance(v, float) and k not in ("real_time", "cpu_time")], [name, ""])


def map_of(axis, points, none=None):
    """Stable, bounded, stopped; theory's curve over them. none: where the row of y = 0 is drawn."""
    for state, colour, label in ((0, "#a6cbe8", "stable"), (1, "#f6c34d", "bounded: grows, no stop"), (2, ORANGE, "stopped")):
        own = [p for p in points if p["state"] == state]
        axis.scatter([p["x"] for p in own], [p["y"] or none for p in own], s=22, marker="s", color=colour, label=label)
    rows = sorted({(p["y"] or none, p["limit"]) for p in points if p.get("limit")})
    above = [r for r in rows if r[0] != none]
    if above:
        axis.plot([x for _, x in above], [y for y, _ in above], color="black", lw=1.6, label="theory: largest |R| is 1")
    for y, x in rows:
        if y == none:
            axis.plot([x], [y], "k|", ms=11, mew=2)
    axis.set_xscale("log")
    axis.set_yscale("log")
    axis.grid(visible=False)


def stability(run):
    groups = {}
    for name, b in run.all.items():
        groups.setdefault(re.sub(r"(/-?\d+)+$", "", name), []).append(b)
    rows, none = [], 10**-3.4
    for name, points in groups.items():
        said = lambda p, least: p["theory"] * 1000 > least  # growth over the half of a run that is compared
        wrong = sum((p["state"] == 0 and said(p, 0.1)) or (p["state"] > 0 and p["theory"] < 1e-11) for p in points)
        wrong += sum(p["state"] < 2 and 2 * said(p, 11.5) for p in points)  # 1e10 over the run
        states = [f"{sum(p['state'] == k for p in points)}" for k in range(3)]
        most = max(p["steps"] for p in points if p["state"] == 2) if states[2] != "0" else 0
        rows.append([name, str(len(points)), *states, str(wrong), f"{most:.0f}" if most else ""])
    table(rows, ["map", "points", "stable", "bounded", "stopped", "against theory", "steps of the latest stop"])
    schemes = ("ForwardEuler", "RungeKutta2", "SymplecticEuler", "Leapfrog")
    for what, damping in (("lattice", "viscosity"), ("chain", "dashpots")):
        figure, axes = plt.subplots(2, 2, figsize=(12, 8.6), layout="constrained", sharex=True, sharey=True)
        figure.get_layout_engine().set(rect=(0, 0.03, 1, 0.93))
        for axis, scheme in zip(axes.flat, schemes):
            map_of(axis, groups[f"{what}<{scheme}>"], none)
            axis.set_title(scheme)
            axis.axvline(1, color=GREY, lw=1, ls=":")
            axis.set_xlim(2.5e-3, 3)
            axis.set_yticks([none, 1e-3, 1e-2, 0.1, 1], ["none", "0.001", "0.01", "0.1", "1"])
            axis.minorticks_off()
        for axis in axes[1]:
            axis.set_xlabel("dt over 2 / largest omega, the limit without damping")
        for axis in axes[:, 0]:
            axis.set_ylabel(f"largest gamma of {damping} over largest omega")
        figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="upper center", ncol=4)
        save(figure, f"stability_{what}", run.footer())
    figure, axes = plt.subplots(1, 2, figsize=(12, 4.8), layout="constrained", sharey=True)
    figure.get_layout_engine().set(rect=(0, 0.05, 1, 0.88))
    for axis, kind, title in zip(axes, ("fixed", "by_criterion"), ("dt = 1e-5 s", "dt by the criterion of contacts")):
        map_of(axis, groups[f"two_masses/{kind}"])
        axis.set(xlabel="stiffness [N/m]", title=f"Leapfrog, {title}")
    axes[0].set_ylabel("ratio of the two masses in turn")
    figure.legend(*axes[0].get_legend_handles_labels(), loc="upper center", ncol=4)
    save(figure, "stability_masses", run.footer())


if __name__ == "__main__":
    draw = {f.__name__: f for f in (kernel, cell_size, step, term_deleted, hand_loop, stability)}
    if len(sys.argv) == 2 and sys.argv[1] in draw:
        draw[sys.argv[1]](Run(sys.argv[1]))
