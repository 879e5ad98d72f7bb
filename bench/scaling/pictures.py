# SPDX-License-Identifier: BSD-3-Clause
"""The pictures: the drawing of cells, what ranks count, the model's curves, a diary of one step, the sweep of cells."""
import csv
import sys
from pathlib import Path

from matplotlib.patches import Patch, Rectangle

sys.path.append(str(Path(__file__).resolve().parent.parent))
from style import BLUE, GREEN, GREY, ORANGE, PURPLE, plt

RANKS = (BLUE, ORANGE, GREEN, PURPLE)


def save(figure, path):
    figure.savefig(path, dpi=90)
    plt.close(figure)
    print(f"picture: {path}")


def decomposition(table, path):
    """Cells of four ranks on the curve; then rank 1 alone: its particles, its ghosts, its pairs of cells, its bins."""
    rows = list(csv.DictReader(open(table)))
    of = lambda what, rank=None: [r for r in rows if r["what"] == what and (rank is None or r["rank"] == str(rank))]
    edge = 3
    figure, (left, right) = plt.subplots(1, 2, figsize=(15, 6.4), layout="constrained")
    for r in of("cell"):
        x, y = edge * int(r["x"]), edge * int(r["y"])
        left.add_patch(Rectangle((x, y), edge, edge, fc=RANKS[int(r["rank"])] + "22", ec="#404040", lw=1.2))
    path_of = [(edge * (int(r["x"]) + 0.5), edge * (int(r["y"]) + 0.5)) for r in sorted(of("cell"), key=lambda r: int(r["of"]))]
    left.plot(*zip(*path_of), color="black", lw=1.4, alpha=0.75)
    for r in of("own"):
        left.plot(float(r["x"]), float(r["y"]), ".", ms=4, color=RANKS[int(r["rank"])])
    handles = [Patch(color=c + "aa", label=f"rank {k}") for k, c in enumerate(RANKS)]
    handles.append(plt.Line2D([], [], color="black", lw=1.4, label="Hilbert's curve: a rank owns a stretch"))
    left.legend(handles=handles, loc="upper right", fontsize=10, frameon=True)
    left.set_title("Cells of 3 x 3 patches, and who owns them")

    me = 1
    mine = {(int(r["x"]), int(r["y"])) for r in of("cell", me)}
    for x in range(6):
        for y in range(4):
            right.add_patch(Rectangle((edge * x, edge * y), edge, edge, fc="none", ec="#bbbbbb", lw=0.8))
    for x, y in mine:
        right.add_patch(Rectangle((edge * x, edge * y), edge, edge, fc=RANKS[me] + "22", ec="#404040", lw=1.4))
    target = min(mine, key=lambda c: abs(c[0] - 3) + abs(c[1] - 1))
    for k in range(1, 12):  # bins: four along x in a range, one across
        right.plot([edge * target[0] + k / 4] * 2, [edge * target[1], edge * (target[1] + 1)], color="#d6604d55", lw=0.7)
    for k in range(1, 3):
        right.plot([edge * target[0], edge * (target[0] + 1)], [edge * target[1] + k] * 2, color="#d6604d55", lw=0.7)
    for r in of("ghost", me):
        right.plot(float(r["x"]), float(r["y"]), "o", ms=4, mfc="none", mec="#505050", mew=0.9)
    for r in of("own", me):
        right.plot(float(r["x"]), float(r["y"]), ".", ms=5, color=RANKS[me])
    centre = lambda c: (edge * (c[0] + 0.5), edge * (c[1] + 0.5))
    for r in of("pair", me):
        a, b = (int(r["x"]), int(r["y"])), tuple(int(v) for v in r["of"].split())
        if a != target:
            continue
        inside = b in mine
        (x, y), (u, v) = centre(a), centre(b)
        right.plot([x, u], [y, v], color="black", lw=1.5, ls="-" if inside else (0, (4, 2)))
        right.plot(u, v, "o", ms=6, color="black" if inside else "white", mec="black", zorder=5)
    right.plot(*centre(target), "s", ms=9, color="black")
    right.legend(
        handles=[
            plt.Line2D([], [], ls="", marker=".", ms=9, color=RANKS[me], label="its own particles"),
            plt.Line2D([], [], ls="", marker="o", mfc="none", mec="#505050", label="ghosts: records of others, by patches within a range"),
            plt.Line2D([], [], color="#d6604d", lw=1, label="bins of one cell: a quarter of a range along x"),
            plt.Line2D([], [], color="black", lw=1.5, label="pairs of that target cell with cells at home"),
            plt.Line2D([], [], color="black", lw=1.5, ls=(0, (4, 2)), label="with cells of others: it waits for these"),
        ],
        loc="upper right",
        fontsize=9,
        frameon=True,
    )
    right.set_title("What rank 1 holds; the pairs of one of its target cells")
    for axis in (left, right):
        axis.set_xlim(-0.2, 18.2)
        axis.set_ylim(-0.2, 13.6)
        axis.set_aspect("equal")
        axis.grid(False)
        axis.set_xlabel("x [ranges]")
    left.set_ylabel("y [ranges]")
    save(figure, path)


def timeline(diaries, path, titles):
    """diaries: for each row of pictures, {rank: entries of the diary}."""
    figure, axes = plt.subplots(len(diaries), 1, figsize=(14, 2.1 * len(diaries) + 0.9), layout="constrained", sharex=True)
    for axis, ranks, title in zip(axes, diaries, titles):
        start = min(e[2] for entries in ranks.values() for e in entries)
        for rank, entries in ranks.items():
            for kind, tag, begin, end in entries:
                at, length = 1e3 * (begin - start), 1e3 * (end - begin)
                if kind == 0:
                    axis.barh(rank, length, left=at, height=0.62, color=BLUE, lw=0)
                elif kind == 3:
                    axis.barh(rank, length, left=at, height=0.62, color=ORANGE if tag >= 0 else "#c9c9c9", lw=0)
                elif kind == 1 and tag in (0, 1):
                    axis.plot(1e3 * (begin - start), rank + 0.42, marker="v", ms=6, color="black", clip_on=False)
                elif kind == 2 and tag in (0, 1):
                    axis.plot(1e3 * (begin - start), rank - 0.42, marker="^", ms=6, color=GREEN, clip_on=False)
        axis.set_yticks(sorted(ranks), [f"rank {r}" for r in sorted(ranks)])
        axis.set_ylim(-0.7, max(ranks) + 0.7)
        axis.grid(axis="y", visible=False)
        axis.set_title(title)
    axes[-1].set_xlabel("time since the step began [ms]")
    figure.legend(
        handles=[
            Patch(color=BLUE, label="tasks"),
            Patch(color=ORANGE, label="waits for values of others"),
            Patch(color="#c9c9c9", label="agrees with all (reductions, lists)"),
            plt.Line2D([], [], ls="", marker="v", color="black", label="values sent"),
            plt.Line2D([], [], ls="", marker="^", color=GREEN, label="values received"),
        ],
        loc="lower center",
        ncol=5,
        fontsize=10,
    )
    figure.get_layout_engine().set(rect=(0, 0.06, 1, 0.94))
    save(figure, path)


def counts(series, path):
    """series: {name: [(ranks, {what: value})]} of counted ranks."""
    what = [
        ("neighbours", "ranks that one sends to: mean (line), most"),
        ("values", "particles sent over owned: mean (line), most"),
        ("imbalance", "work: largest over mean"),
    ]
    figure, axes = plt.subplots(1, 3, figsize=(15, 4.6), layout="constrained")
    for axis, (key, title) in zip(axes, what):
        for colour, (name, points) in zip((BLUE, ORANGE, GREEN, PURPLE), series.items()):
            xs = [r for r, _ in points]
            axis.plot(xs, [p[key][0] for _, p in points], "-o", ms=5, color=colour, label=name)
            if len(points[0][1][key]) > 1:
                axis.plot(xs, [p[key][1] for _, p in points], ":", marker="^", ms=5, color=colour)
        axis.set_xscale("log", base=2)
        axis.set_title(title, fontsize=11)
        axis.set_xlabel("ranks")
        axis.set_ylim(bottom=1 if key == "imbalance" else 0)
    axes[0].legend(fontsize=10)
    save(figure, path)


def weak(series, limits, path, title):
    figure, axis = plt.subplots(figsize=(9, 5.2), layout="constrained")
    for colour, limit, (name, counted, beyond) in zip((BLUE, ORANGE), limits, series):
        axis.plot(*zip(*counted), "o", ms=7, color=colour, label=f"{name}: ranks counted")
        axis.plot(*zip(*beyond), "--", lw=1.5, color=colour, label="extrapolated by the stated law")
        axis.plot(*beyond[-1], "o", ms=9, mfc="white", mec=colour, mew=2)
        below = beyond[-1][1] < limit
        axis.annotate(f"{100 * beyond[-1][1]:.0f} %", beyond[-1], (-4, -20 if below else 10), textcoords="offset points", ha="right", color=colour)
    for colour, limit in zip((BLUE, ORANGE), limits):
        axis.plot([16384 * 0.7, 16384 * 1.5], [limit, limit], color=colour, lw=3)
    axis.annotate("limits", (16384, limits[0]), (0, -16), textcoords="offset points", ha="center", fontsize=10)
    axis.set_xscale("log", base=2)
    axis.set_ylim(0, 1.05)
    axis.set_xlabel("ranks")
    axis.set_ylabel("weak efficiency, MODELLED")
    axis.set_title(title)
    axis.legend(loc="lower left", fontsize=10)
    save(figure, path)


def strong(series, path, title):
    figure, axis = plt.subplots(figsize=(8, 5.4), layout="constrained")
    ranks = [r for r, _ in series[0][1]]
    axis.plot(ranks, [r / ranks[0] for r in ranks], color=GREY, ls="--", lw=1.2, label="ideal")
    for colour, (name, points) in zip((BLUE, ORANGE, GREEN), series):
        axis.plot(*zip(*points), "-o", ms=6, color=colour, label=name)
    axis.set_xscale("log", base=2)
    axis.set_yscale("log", base=2)
    axis.set_xticks(ranks, [str(r) for r in ranks])
    axis.set_xlabel("ranks")
    axis.set_ylabel(f"speed-up over {ranks[0]} ranks, MODELLED")
    axis.set_title(title)
    axis.legend(loc="upper left")
    save(figure, path)


def idle(points, path, title):
    """points: (cells a rank, idle fraction, efficiency)"""
    figure, axis = plt.subplots(figsize=(8, 4.8), layout="constrained")
    points = sorted(points)
    axis.plot([p[0] for p in points], [p[1] for p in points], "-o", color=ORANGE, label="idle, mean of all ranks")
    axis.plot([p[0] for p in points], [1 - p[2] for p in points], "-s", color=BLUE, label="lost in all: 1 - efficiency")
    axis.set_xscale("log", base=2)
    axis.set_ylim(bottom=0)
    axis.set_xlabel("cells a rank")
    axis.set_ylabel("part of a step, MODELLED")
    axis.set_title(title)
    axis.legend()
    save(figure, path)


def heat(tables, path):
    """tables: [(title, rows of (ranks, threads), columns of cells, {(row, cell): ms})]"""
    figure, axes = plt.subplots(1, len(tables), figsize=(7.6 * len(tables), 4.2), layout="constrained")
    for axis, (title, rows, cells, ms) in zip(axes, tables):
        values = [[ms.get((r, c), float("nan")) for c in cells] for r in rows]
        least = [min(v for v in row if v == v) for row in values]
        image = axis.imshow([[v / l for v in row] for row, l in zip(values, least)], cmap="YlOrRd", vmin=1, vmax=2, aspect="auto")
        best = min((v, i, j) for i, row in enumerate(values) for j, v in enumerate(row) if v == v)
        for i, row in enumerate(values):
            for j, v in enumerate(row):
                if v == v:
                    axis.text(j, i, f"{v:.3g}", ha="center", va="center", fontsize=10,
                              color="white" if v / least[i] > 1.7 else "black",
                              weight="bold" if v == least[i] else "normal")
        axis.add_patch(Rectangle((best[2] - 0.5, best[1] - 0.5), 1, 1, fill=False, ec="black", lw=2.5))
        axis.set_xticks(range(len(cells)), [str(c) for c in cells])
        axis.set_yticks(range(len(rows)), [f"{r} x {t}" for r, t in rows])
        axis.set_xlabel("--cell: edge of a cell in ranges")
        axis.set_ylabel("ranks x threads")
        axis.grid(False)
        axis.set_title(title)
        figure.colorbar(image, ax=axis, label="over the best of the row")
    save(figure, path)


def diary(prefix, ranks):
    entries = {}
    for r in range(ranks):
        with open(f"{prefix}_{r}.csv") as f:
            entries[r] = [(int(e["kind"]), int(e["tag"]), float(e["begin"]), float(e["end"])) for e in csv.DictReader(f)]
    return entries
