# SPDX-License-Identifier: BSD-3-Clause
"""Draws one panel: error over work for each family, with its repeats, its stops, slopes and marks of time."""
import io
import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import matplotlib.ticker

import ladder

COLOUR = {"cubic_spline": "#b2182b", "quintic_spline": "#2166ac", "wendland_c2": "#4d9221", "wendland_c4": "#e08214"}
MARKER = {"runge_kutta2": "s", "leapfrog": "o", "symplectic_euler": "^", "forward_euler": "v"}
INTEGRATOR = {"forward_euler": "#762a83", "symplectic_euler": "#4d9221", "runge_kutta2": "#b2182b", "leapfrog": "#2166ac"}
GREY = "#737373"
plt.rcParams.update(
    {
        "font.size": 10,
        "axes.titlesize": 11,
        "axes.titlelocation": "left",
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "axes.axisbelow": True,
        "grid.color": "#e8e8e8",
        "legend.frameon": False,
        "legend.fontsize": 8,
        "svg.fonttype": "none",
        "lines.linewidth": 1.3,
    }
)


def look_of(row):
    """Colour by kernel, marker by integrator, dashes for float, so that two families differ where they differ."""
    look = {"color": COLOUR.get(row["kernel"], "#000000"), "marker": MARKER.get(row["integrator"], "D")}
    look["ls"] = "--" if row["precision"] == "float" else "-"
    return look


def work(row, axis):
    return ladder.seconds(row) if axis == "time" else row["N"] * row["force_evals"]


def spread(row):
    """Least and most of the repeats, in the clock that is drawn; of a machine with others on it that is CPU time."""
    if ladder.seconds(row) == row["wall_s_min"] and not BUSY:
        return row["wall_s_min"], row["wall_s_max"]
    return ladder.seconds(row), max(ladder.seconds(row), row["cpu_s_max"])


def panel(axes, rows, err_name, axis="time", look=look_of, name=None, cost=3.0, title=""):
    """\\param cost  work grows as 1/dx (or 1/dt) to this power: a scheme of order p falls by p/cost.  name(row): legend"""
    crosses = []
    for family, points in ladder.ladders(rows).items():
        good = [r for r in points if r["status"] == "OK" and r["err_name"] == err_name and r["err"] > 0]
        bad = [r for r in points if r["status"] != "OK"]
        style = look(points[0])
        if good:
            x = [work(r, axis) for r in good]
            y = [r["err"] for r in good]
            label = name(points[0]) if name else family
            axes.plot(x, y, mfc="white", ms=0, **{**style, "marker": None}, label="_")
            for k, (a, b) in enumerate(zip(x, y)):
                axes.plot([a], [b], ms=4 + 1.4 * k, mfc="white", ls="none", color=style["color"], marker=style["marker"])
            axes.plot([], [], ms=5, mfc="white", label=label, **style)
            if axis == "time":
                lo, hi = zip(*(spread(r) for r in good))
                axes.fill_betweenx(y, lo, hi, color=style["color"], alpha=0.18, lw=0)
        crosses += [(work(r, axis), style["color"], r["status"]) for r in bad]
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_title(title)
    lo, hi = axes.get_ylim()
    axes.set_ylim(lo, hi * 1.6 if crosses else hi)
    top = axes.get_ylim()[1]
    least = axes.get_xlim()[0]  # what is stopped in its first step has taken no time
    for k, (x, colour, _) in enumerate(sorted((max(x, least), colour, status) for x, colour, status in crosses)):
        y = top * (top / axes.get_ylim()[0]) ** (-0.035 * (k % 3))
        axes.plot([x], [y], marker="X", ms=9, mfc="none", color=colour, ls="none", clip_on=False)
    for status in sorted({status for _, _, status in crosses}):
        axes.plot([], [], marker="X", ms=8, mfc="none", color=GREY, ls="none", label=f"stopped: {status}")
    for which in (axes.xaxis, axes.yaxis):
        lo, hi = which.get_view_interval()
        if hi < 30 * lo:  # less than one and a half decades: the digits between are wanted
            narrow = hi < 4 * lo
            which.set_minor_locator(matplotlib.ticker.LogLocator(subs=(1.5, 2, 3, 4, 5, 6, 8) if narrow else (2, 3, 5)))
            which.set_minor_formatter(lambda v, _: f"{v:.3g}")
            plt.setp(which.get_minorticklabels(), fontsize=7)
    if axis == "time":
        left, right = axes.get_xlim()
        for at, text in ((1, "1 s"), (60, "1 min")):
            if left < at < right * 2:
                axes.axvline(at, ls=(0, (4, 3)), color=GREY, lw=0.8)
                axes.annotate(text, (at, axes.get_ylim()[0]), (2, 3), textcoords="offset points", fontsize=8, color=GREY)
    if cost:
        triangles(axes, cost)
    axes.set_xlabel(f"time of the step loop, {CLOCK} [s]" if axis == "time" else "particle updates (N x evaluations)")
    axes.set_ylabel(LONG.get(err_name, err_name))


BUSY, CLOCK = False, "1 thread"
LONG = {
    "L1_speed": "L1 of speed [-]",
    "L1_velocity": "L1 of velocity [-]",
    "L1_p": "mean error of p over its largest [-]",
    "L2_u": "L2 of u [-]",
    "omega": "frequency, relative error [-]",
    "amplitude": "amplitude, change in a period [-]",
    "wave": "wave at the end, error over its amplitude [-]",
    "front": "rms of Z/Z_data - 1, shifted [-]",
    "front_finest": "rms of Z/Z_finest - 1 [-]",
    "density": "largest |rho/rho0 - 1| [-]",
    "restitution": "rms of e - 1 [-]",
    "energy_a_contact": "|mean change of energy| a contact [-]",
}


def triangles(axes, cost):
    """What order 1 and 2 would be: lower left, a third of a decade of the refined quantity wide."""
    x0, x1 = (math.log10(v) for v in axes.get_xlim())
    y0, y1 = (math.log10(v) for v in axes.get_ylim())
    wide = 0.16 * (x1 - x0)
    a = x0 + 0.05 * (x1 - x0)
    for order in (1, 2):
        fall = order * wide / cost
        top = y0 + 0.06 * (y1 - y0) + fall
        x, y = [a, a + wide, a, a], [top, top - fall, top - fall, top]
        axes.plot([10**v for v in x], [10**v for v in y], color=GREY, lw=0.9)
        axes.annotate(f"order {order}", (10 ** (a + 0.5 * wide), 10 ** (top - fall)), (0, -9), ha="center",
                      textcoords="offset points", fontsize=7, color=GREY)  # fmt: skip
        a += wide * 1.35


def legend(axes, size=7.5):
    """Beside the panel, so that it hides nothing."""
    if axes.get_legend_handles_labels()[1]:
        axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.02), fontsize=size, borderaxespad=0.2)


def svg(figure, name):
    """The text of a figure to stand within a page: ids of its own, no prolog."""
    plt.rcParams["svg.hashsalt"] = name
    out = io.StringIO()
    figure.savefig(out, format="svg", metadata={"Date": None}, bbox_inches="tight")
    plt.close(figure)
    text = out.getvalue()
    return text[text.index("<svg") :]
