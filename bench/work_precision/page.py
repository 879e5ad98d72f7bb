# SPDX-License-Identifier: BSD-3-Clause
"""One page of all figures that have a table in a folder; nothing else is needed to read it."""
import html
import json
import math

import diagram
import ladder
from diagram import plt

SHIFTED = "sigma2+diffusion+shifting"


def short(row):
    return f"{row['kernel'].replace('_', ' ')} {row['h_dx']:g}, {row['integrator'].replace('_', ' ')}"


def grid(rows, columns, title, width=6.4, height=4.6):
    figure, axes = plt.subplots(rows, columns, figsize=(width * columns, height * rows), layout="constrained", squeeze=False)
    figure.suptitle(title, x=0.01, ha="left", fontsize=13, fontweight="bold")
    return figure, axes


def w1(rows):
    main = [r for r in rows if r["ladder"] == "resolution" and r["formulation"] == SHIFTED and r["precision"] == "double"]
    figure, axes = grid(3, 2, "W1. Taylor-Green vortices, Re = 100, t = 1 L/U, from a lattice jittered by a fifth")
    diagram.panel(axes[0, 0], main, "L1_speed", name=short, title="kernels and integrators, over time")
    axes[0, 0].legend(loc="upper right")
    diagram.panel(axes[0, 1], main, "L1_speed", axis="updates", name=short, title="the same over particle updates")
    diagram.panel(axes[1, 0], main, "L1_p", name=short, title="pressure")
    others = [r for r in rows if r["ladder"] == "resolution" and r not in main]
    base = [r for r in main if r["kernel"] == "quintic_spline" and r["integrator"] == "symplectic_euler"]
    named = lambda r: f"{short(r)}, {r['formulation']}, {r['precision']}"
    colours = {}
    look = lambda r: diagram.look_of(r) | {"color": colours.setdefault(r["formulation"], f"C{len(colours)}")}
    diagram.panel(axes[1, 1], base + others, "L1_speed", look=look, name=named, title="formulations and float")
    if axes[1, 1].get_legend_handles_labels()[1]:
        axes[1, 1].legend(loc="upper right", fontsize=6.5)
    dt = [r for r in rows if r["ladder"] == "dt"]
    diagram.panel(axes[2, 0], dt, "L1_speed", name=short, cost=1, title="ladder in dt, 50 x 50: C = 1/16 to 2")
    axes[2, 0].legend(loc="best")
    sound = [r | {"family": r["family"] + r["ladder"]} for r in rows
             if r["ladder"] in ("sound", "resolution") and r["integrator"] == "symplectic_euler"
             and r["kernel"] in ("quintic_spline", "wendland_c4") and r["formulation"] == SHIFTED
             and r["precision"] == "double"]  # fmt: skip
    raised = lambda r: diagram.look_of(r) | {"ls": ":" if r["ladder"] == "sound" else "-"}
    said = lambda r: short(r).split(",")[0] + (", c0 = 10 U to 40 U" if r["ladder"] == "sound" else ", c0 = 10 U")
    diagram.panel(axes[2, 1], sound, "L1_speed", axis="updates", look=raised, name=said,
                  title="speed of sound raised with resolution")  # fmt: skip
    axes[2, 1].legend(loc="best")
    return figure, [best(rows, "resolution", "L1_speed", (0.03, 0.01, 0.005))]


def best(rows, which, err_name, targets, seed=None):
    """Time to an error, error for a time, observed order, and how much faster than the seed's composition."""
    found = []
    for family, points in ladder.ladders(rows, ladder=which, err_name=err_name).items():
        good = [r for r in points if r["status"] == "OK"]
        if not good:
            continue
        n, t, e = ([f(r) for r in good] for f in (lambda r: r["n"], ladder.seconds, lambda r: r["err"]))
        to = [ladder.first_below(t, e, target) for target in targets]
        at = [ladder.between(t, e, budget) if len(t) > 1 and t[0] <= budget <= t[-1] else math.nan for budget in (1, 10)]
        finest = good[-1]
        found.append((family, to, at, -ladder.slope(n, e), finest))
    reference = next((f for f in found if f[0] == seed), None)
    header = ["family", *(f"time to {100 * x:g} %" for x in targets), "error in 1 s", "in 10 s", "order", "finest", "error there"]
    if reference:
        header.append(f"speed-up at {100 * targets[0]:g} % over the seed's")
    lines = []
    for family, to, at, order, finest in sorted(found, key=lambda f: [math.inf if math.isnan(v) else v for v in f[1]]):
        line = [family, *(number(v, " s") for v in to), *(percent(v) for v in at), number(order)]
        line += [f"{finest['n']:.0f}", percent(finest["err"])]
        if reference:
            line.append(number(reference[1][0] / to[0]))
        lines.append(line)
    return table(header, lines)


def number(x, unit=""):
    return "" if math.isnan(x) else f"{x:.2g}{unit}" if x < 10 else f"{x:.0f}{unit}"


def percent(x):
    return "" if math.isnan(x) else f"{100 * x:.2g} %"


def table(header, lines):
    cell = lambda kind, values: "".join(f"<{kind}>{html.escape(str(v))}</{kind}>" for v in values)
    body = "".join(f"<tr>{cell('td', line)}</tr>\n" for line in lines)
    return f"<table><thead><tr>{cell('th', header)}</tr></thead><tbody>\n{body}</tbody></table>"


FIGURES = {"W1": w1}

HOW = """<p>Each point is a run: right is more work, down is less error. A line is a <em>family</em>, one composition of kernel
(with h/dx), formulation, integrator and precision, on a ladder of resolutions (markers grow with it) or of time steps. The
lowest line at the error that you need is the cheapest family for it. The triangles show how an error of first and of second
order in what is refined would fall. Shaded: least to most of the repeats. A hollow cross at the top is a run that the watch
stopped, with its reason: stability is part of the diagram. Time is that of the step loop, without set-up and output; one
thread on one core; the same machine, compiler and flags for all points, in random order.</p>"""
STYLE = """body{font:15px/1.5 system-ui,sans-serif;max-width:1280px;margin:2em auto;padding:0 1em;color:#222}
svg{width:100%;height:auto}table{border-collapse:collapse;font-size:13px;margin:1em 0}td,th{padding:2px 10px;text-align:right;
border-bottom:1px solid #e4e4e4}td:first-child,th:first-child{text-align:left}footer,.remark{color:#666;font-size:13px}
pre{font-size:12px;overflow:auto;background:#f6f6f6;padding:1em}"""


def footer(facts):
    busy = facts.get("busy", math.nan)
    clock = "wall time" if not busy > 1.05 else (
        f"CPU time, since the cores were shared: wall time was {busy:.1f} times as long")  # fmt: skip
    return (f"{facts.get('cpu', 'unknown processor')}, {facts.get('compiler', '?')} -O3 -march=native, commit "
            f"{facts.get('commit', '?')}, 1 thread, {clock}, {facts.get('date', '?')}, set {facts.get('set', '?')}")  # fmt: skip


def facts_of(path):
    with open(path, encoding="utf-8") as file:
        for line in file:
            if line.startswith("# {"):
                return json.loads(line[2:])
    return {}


def write(into):
    """Draws every figure that has a table in the folder, and the page."""
    parts = []
    for name, draw in FIGURES.items():
        path = into / f"{name.lower()}.csv"
        if not path.exists():
            continue
        rows, facts = ladder.read(path), facts_of(path)
        if not rows:
            continue
        diagram.CLOCK = "1 thread" if not facts.get("busy", 1) > 1.05 else "CPU time of 1 thread"
        figure, tables = draw(rows)
        figure.text(0.005, -0.01, footer(facts), fontsize=8, color=diagram.GREY, va="top")
        plt.rcParams["savefig.bbox"] = "tight"
        drawn = diagram.svg(figure, name)
        (into / f"{name.lower()}.svg").write_text('<?xml version="1.0" encoding="utf-8"?>\n' + drawn, encoding="utf-8")
        skipped = "".join(f"<li>{html.escape(s)}</li>" for s in facts.get("skipped", []))
        parts.append(
            f'<section id="{name}">{drawn}\n' + "\n".join(tables)
            + (f'<div class="remark">Not measured:<ul>{skipped}</ul></div>' if skipped else "")
            + f'<p class="remark">{html.escape(footer(facts))}</p>'
            + f"<details><summary>{name.lower()}.csv</summary><pre>{html.escape(path.read_text(encoding='utf-8'))}</pre></details>"
            + "</section>"
        )
    out = into / "index.html"
    out.write_text(
        '<!doctype html>\n<html lang="en"><head><meta charset="utf-8"><title>Error against work</title>'
        f"<style>{STYLE}</style></head><body><h1>Error against work</h1>{HOW}\n" + "\n".join(parts) + "</body></html>\n",
        encoding="utf-8",
    )
    print(f"page: {out}")
