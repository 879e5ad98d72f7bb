# SPDX-License-Identifier: BSD-3-Clause
"""docs/results/scaling/README.md: tables and pictures of what was counted, measured and modelled."""
import json
import math
import statistics
from pathlib import Path

import model
import pictures

DOCS = Path(__file__).resolve().parent.parent.parent / "docs" / "results" / "scaling"
RANKS = 16384
DIARIES = {
    "overlap": {"patient": 0, "delay": 0},
    "patient": {"patient": 1, "delay": 0},
    "overlap_slow": {"patient": 0, "delay": 0.003},
    "patient_slow": {"patient": 1, "delay": 0.003},
}


def machine_of(measured, tables):
    """The constants of the model: from one rank with cells of 2 and of 8, from two for what a message costs here, from the
    counts."""
    one, large, two = measured["1/2"], measured["1/8"], measured["2/2"]
    evaluations = 2 * one["steps"]

    def parts(m):  # of an evaluation: in tasks, outside [s]
        evaluation = 1e-3 * m["ms_step"] / 2
        return m["busy"][0] * evaluation, (1 - m["busy"][0]) * evaluation

    (tasks, besides), (tasks_of_large, besides_of_large) = parts(one), parts(large)
    more = one["reach"] - large["reach"]
    a_task, a_list = (tasks - tasks_of_large) / more, (besides - besides_of_large) / more  # of a particle in reach
    small = [t for t in tables.values() if len(t) <= 128]  # the least of them: others may have been busy
    near = lambda r: sum(r[k] for k in ("out_particles_0", "in_particles_0", "out_particles_1", "in_particles_1"))
    values = lambda r: 8 * (r["out_particles_0"] + r["in_particles_0"]) + 5 * (r["out_particles_1"] + r["in_particles_1"])
    return model.Machine(
        pair=(tasks - a_task * one["reach"]) / (one["pairs"] / evaluations),
        particle=(besides - a_list * one["reach"]) / one["markers"],
        record=a_task,
        listed=a_list,
        memory=min(m["megabyte"] for m in measured.values() if m["megabyte"] > 0) / 2**20,
        meet=min(statistics.median(r["meet"] / near(r) for r in t) for t in small),
        copy=min(statistics.median(r["copy"] / values(r) for r in t) for t in small),
        turn=2.5e-9,
        rebuilds=one["rebuilds"] / one["steps"],
        boxes=one["patch_exchanges"] / one["steps"],
        reductions=(two["reductions"] / two["ranks"] - 5 * two["rebuilds"] / 4) / two["steps"],
    )


def here(measured, machine):
    """This machine as a network: what two processes on it take."""
    runs = [m for m in measured.values() if m["ranks"] == 2]
    latency = min(m["latency"] for m in runs)
    return model.Network("shared memory of this machine", "measured", latency, latency / 2, machine.memory,
                         min(m["agreement"] for m in runs), 2)


def percent(x):
    return f"{100 * x:.1f} %"


def markdown(header, rows):
    lines = ["| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
    return "\n".join(lines + ["| " + " | ".join(str(c) for c in r) + " |" for r in rows])


def mean(rows, key):
    return statistics.fmean(r[key] for r in rows)


def most(rows, key):
    return max(r[key] for r in rows)


def counted(rows):
    """What ranks count, without any model."""
    # pairs, what small cells cost besides (a_record of count.cpp), and what a particle does (Balance.a_particle)
    work = lambda r, k: r[k] + 2 * r["reach"] + 10 * r["particles"]
    sent = lambda r: (r["out_particles_0"] + r["out_particles_1"]) / max(r["particles"], 1)
    partners = lambda r: max(r["out_0"], r["in_0"], r["out_1"], r["in_1"])
    over = lambda k: max(work(r, k) for r in rows) / statistics.fmean(work(r, k) for r in rows)
    return {
        "neighbours": (statistics.fmean(partners(r) for r in rows), max(partners(r) for r in rows)),
        "values": (statistics.fmean(sent(r) for r in rows), max(sent(r) for r in rows)),
        "imbalance": (over("pairs"), over("later")),
        "pairs": max(r["pairs"] for r in rows) / mean(rows, "pairs"),
    }


def size(n):
    return f"{n:,.0f}"


def table_of_counts(tables):
    rows = []
    for (ranks, finer, cell), t in sorted(tables.items()):
        c = counted(t)
        messages = mean(t, "out_0") + mean(t, "out_1")
        kilobytes = 8 * (8 * mean(t, "out_particles_0") + 5 * mean(t, "out_particles_1")) / 1000
        rows.append(
            (
                size(ranks), size(mean(t, "particles")), cell, f"{mean(t, 'cells'):.0f}",
                f"{c['neighbours'][0]:.1f} / {c['neighbours'][1]:.0f}", f"{messages:.1f} / {most(t, 'out_0') + most(t, 'out_1'):.0f}",
                f"{kilobytes:.0f}", percent(mean(t, "inner") / mean(t, "pairs")), f"{c['imbalance'][0]:.3f}", f"{c['imbalance'][1]:.3f}",
                f"{t[0]['cut_wide']:.0f}",
            )
        )
    header = ("ranks", "particles a rank", "cell", "cells a rank", "neighbours, mean / most", "messages an evaluation, mean / most",
              "kB an evaluation, mean", "pairs that wait for nobody", "work, largest / mean", "at the next look", "sums for new cuts")
    return markdown(header, rows)


def write(tables, measured, steps, context):
    DOCS.mkdir(parents=True, exist_ok=True)
    machine = machine_of(measured, tables)
    networks = (model.ARIES, model.ARIES_36)
    of = lambda key, network=model.ARIES: model.step(tables[key], network, machine)
    near_1e5 = [k for k in ((8, 2, 2), (27, 3, 2), (60, 4, 2), (115, 5, 2), (193, 6, 2), (301, 7, 2)) if k in tables]
    near_1e4 = [k for k in ((87, 2, 2), (266, 3, 2), (600, 4, 2), (1150, 5, 2), (1925, 6, 2), (3012, 7, 2)) if k in tables]

    # ---- weak
    weak, table, foretold = {}, [], []
    for network in networks:
        for name, keys in (("1e5", near_1e5), ("1e4", near_1e4)):
            counted_steps = [of(k, network) for k in keys]
            at = [counted_steps[-1].ranks * 2**k for k in range(int(math.log2(RANKS / counted_steps[-1].ranks)) + 1)] + [RANKS]
            beyond = [(p, model.extrapolated(counted_steps, p, network, machine)) for p in at]
            weak[network.name, name] = ([(s.ranks, s.efficiency) for s in counted_steps], beyond)
            for law in model.LAWS:
                for seen in (3, len(counted_steps)):
                    fitted, rest = counted_steps[:seen], counted_steps[seen:]
                    ahead = lambda p: percent(model.extrapolated(fitted, p, network, machine, law))
                    foretold.append((network.name, name, law, size(fitted[-1].ranks), ", ".join(
                        f"{size(s.ranks)}: {ahead(s.ranks)} ({percent(s.efficiency)})" for s in rest) or "-", ahead(RANKS)))
            limit = {"1e5": 0.85, "1e4": 0.70}[name]
            reached = beyond[-1][1]
            table.append((network.name, name, *(percent(s.efficiency) for s in counted_steps), f"**{percent(reached)}**",
                          f"{100 * limit:.0f} %", "reached" if reached >= limit else "**missed**"))
    first = networks[0].name
    pictures.weak(
        [("100,000 particles a rank", *weak[first, "1e5"]), ("10,000 particles a rank", *weak[first, "1e4"])],
        (0.85, 0.70), DOCS / "weak.png", f"MODELLED: weak efficiency, developed dam break\n{first}",
    )
    weak_table = markdown(
        ("network", "particles a rank", "counted", *[""] * (len(near_1e5) - 1), f"{size(RANKS)} ranks", "limit", ""), table
    )
    foretold_table = markdown(
        ("network", "particles a rank", "law", "fitted to counts up to", "foretold beyond (counted)", f"{size(RANKS)} ranks"), foretold
    )
    ranks_of = lambda keys: ", ".join(size(k[0]) for k in keys)

    worst = of(near_1e4[-1])

    # ---- where a step goes
    parts = []
    for key in (near_1e5[-1], near_1e4[-1], *(k for k in ((4096, 7, 2),) if k in tables)):
        s = of(key)
        share = lambda x: percent(x / s.time)
        parts.append((size(s.ranks), size(s.particles), f"{1e3 * s.time:.2f}", share(s.work), share(s.dearest - s.work),
                      share(s.messages - s.exposed), share(s.exposed), share(s.meetings), share(s.agreement), share(s.balance)))
    parts_table = markdown(
        ("ranks", "particles a rank", "step [ms]", "mean work", "more work than the mean", "handing over", "waiting", "rebuilds' messages",
         "reductions", "looking for cuts"), parts)

    # ---- strong
    deck = (8, 16, 32, 64, 128, 256, 504)
    curves, rows = [], []
    for finer in (3, 1):
        found = [of((p, finer, 2)) for p in deck if (p, finer, 2) in tables]
        whole = found[0].particles * found[0].ranks
        curves.append((f"{whole / 1e6:.2f} million particles", [(s.ranks, found[0].time / s.time) for s in found]))
        rows += [(size(whole), s.ranks, size(s.particles), f"{1e3 * s.time:.2f}", f"{found[0].time / s.time:.1f}",
                  percent(found[0].time / s.time * found[0].ranks / s.ranks), percent(s.idle)) for s in found]
    pictures.strong(curves, DOCS / "strong.png", f"MODELLED: strong scaling, 8 to 504 ranks as in the deck\n{first}")
    strong_table = markdown(("particles", "ranks", "a rank", "step [ms]", "speed-up over 8", "efficiency", "idle"), rows)

    # ---- idle
    by_cells, rows = [], []
    for key in sorted(k for k in tables if k[:2] == (64, 2)):
        s, cells = of(key), mean(tables[key], "cells")
        by_cells.append((cells, s.idle, s.efficiency))
        rows.append((key[2], f"{cells:.0f}", f"{1e3 * s.time:.2f}", f"{s.imbalance:.3f}", percent(mean(tables[key], "inner") / mean(tables[key], "pairs")),
                     percent(s.idle), percent(s.efficiency)))
    pictures.idle(by_cells, DOCS / "idle.png", f"MODELLED: idle and lost time against cells a rank, 64 ranks\n{first}")
    idle_table = markdown(("--cell", "cells a rank", "step [ms]", "work, largest / mean", "pairs that wait for nobody", "idle", "efficiency"), rows)

    # ---- counts
    series = {
        "1e5 particles a rank": [(k[0], counted(tables[k])) for k in near_1e5],
        "1e4 particles a rank": [(k[0], counted(tables[k])) for k in near_1e4],
        "2.7 million particles": [(k, counted(tables[k, 3, 2])) for k in deck if (k, 3, 2) in tables],
    }
    pictures.counts(series, DOCS / "counts.png")

    # ---- measured
    rows = []
    local = here(measured, machine)
    for ranks, cells in (("1", "2"), ("1", "8"), ("1", "4"), ("2", "2"), ("2", "4")):
        m = measured[f"{ranks}/{cells}"]
        each = {k: 0.0 for k in next(iter(tables.values()))[0]}
        half = {**each, "later": m["pairs"] / (2 * m["steps"]) / m["ranks"], "particles": m["markers"] / m["ranks"],
                "reach": m["reach"] / m["ranks"]}
        if m["ranks"] == 2:
            boxes = m["patch_bytes"] / max(1, m["patch_exchanges"]) / model.BOX
            half.update(out_particles_0=m["first"][0], in_particles_0=m["first"][2], out_particles_1=m["first"][1],
                        in_particles_1=m["first"][3], out_0=1, in_0=1, out_1=1, in_1=1, meet_scatters=4, meet_parcels=4,
                        meet_sent=m["sent"] / 2 / m["rebuilds"], patches=boxes, inner=half["later"] * m["early"] / m["tasks"])
        predicted = model.step([half] * m["ranks"], local, machine).time
        error = 1e3 * predicted / m["ms_step"] - 1
        fitted = ranks == "1" and cells != "4"
        serial = measured[f"1/{cells}"]["ms_step"]
        rows.append((ranks, cells, f"{m['ms_step']:.2f}", f"{m['ms_step'] / serial:.3f}", f"{1e3 * predicted:.2f}",
                     f"{100 * error:+.1f} %" + (" (fitted)" if fitted else ""), " and ".join(percent(b) for b in m["busy"]),
                     " and ".join(percent(b) for b in m["idle"]), f"{m['imbalance']:.3f}"))
    measured_table = markdown(("ranks", "--cell", "measured [ms a step]", "over 1 rank", "MODELLED [ms]", "model over measured", "in tasks of cells",
                               "waiting for values", "cost, largest / mean"), rows)
    pictures.timeline(
        steps, DOCS / "timeline.png",
        ("with overlap: tasks run while messages fly", "without: each rank waits when it has sent",
         "with overlap, messages that take 3 ms", "without, messages that take 3 ms"),
    )
    million = machine.rebuilds / machine.looks * model.cuts(model.ARIES, 10**6, machine)
    biggest = max(tables)
    rows = tables[biggest]
    grown = [("cuts", "8 bytes a rank of the job", "131 kB", "8 MB"), ("sums while new cuts are looked for", "24 bytes a rank of the job, for a moment", "393 kB", "24 MB"),
             ("neighbours", "none", f"{counted(tables[near_1e4[-1]])['neighbours'][0]:.0f} ranks", "the same"),
             ("records of others, links", "none", f"{mean(tables[near_1e4[-1]], 'bytes') / 1e6:.1f} MB without the records", "the same"),
             ("messages at the start", "none: particles are dealt in blocks of 256", f"{mean(tables[near_1e4[-1]], 'start_parcels'):.0f} (at {near_1e4[-1][0]} ranks)", "about one a block"),
             ("reductions", "log P in depth", f"{machine.reductions:.1f} a step", "the same")]
    held = markdown(("what a rank holds or sends, 1e4 particles", "grows with the ranks of the job", f"at {size(RANKS)}", "at a million"), grown)
    constants = markdown(
        ("constant", "value", "from"),
        [
            ("a directed pair, in tasks of cells", f"{1e9 * machine.pair:.2f} ns", "measured, one rank, --cell 2 and 8"),
            ("a particle in reach of a task: in the task; for lists", f"{1e9 * machine.record:.2f} ns; {1e9 * machine.listed:.2f} ns", "measured, the same"),
            ("a particle and evaluation, outside of tasks", f"{1e9 * machine.particle:.1f} ns", "measured, the same"),
            ("a value packed or landed", f"{1e9 * machine.copy:.2f} ns", "measured, virtual ranks (CPU time of the thread, without the transport)"),
            ("a particle sent or received, at a rebuild", f"{1e9 * machine.meet:.0f} ns", "measured, virtual ranks, likewise"),
            ("a byte between processes of a node", f"{1e9 * machine.memory:.3f} ns", "measured, a megabyte there and back"),
            ("a cut and turn of the search for cuts", f"{1e9 * machine.turn:.1f} ns", "set: a few instructions for a cut that is elsewhere"),
            ("rebuilds, reductions, exchanges of boxes, a step", f"{machine.rebuilds:.2f}; {machine.reductions:.2f}; {machine.boxes:.2f}", "counted, one and two ranks"),
            *[(f"{n.name}: L + 2 o; o; G of a node; all-reduce for a doubling",
               f"{1e6 * n.latency:.2f} us; {1e6 * n.overhead:.2f} us; {1e9 * n.byte:.3f} ns; {1e6 * n.stage:.2f} us", n.source) for n in networks],
        ],
    )
    text = TEMPLATE.format(
        machine=f"{context.get('cpu', '?')}, {context.get('compiler', '?')} -O3 -march=native, commit {context.get('commit', '?')}",
        ranks_1e5=ranks_of(near_1e5), ranks_1e4=ranks_of(near_1e4), weak=weak_table, foretold=foretold_table, worst_wait=percent(worst.exposed / worst.time), mean_wait=percent(worst.waits / worst.time),
        worst_ranks=size(worst.ranks), parts=parts_table, strong=strong_table, idle=idle_table,
        counts=table_of_counts(tables), measured=measured_table, held=held, constants=constants, largest=size(biggest[0]),
        largest_load=size(mean(rows, "particles")), million=f"{1e3 * million:.1f}",
        cells="[cells.md](cells.md)" if (DOCS / "cells.md").exists() else "`bash bench/run.sh cell_size`",
    )
    (DOCS / "README.md").write_text(text)
    print(f"page: {DOCS / 'README.md'}")


def cells(found, context):
    """The seeds' study: its own page and heat map."""
    DOCS.mkdir(parents=True, exist_ok=True)
    titles = {"seed": "CharmSPH's dam break, 139,332 markers", "granular": "the granular deck, 262,144 discs"}
    tables, text = [], []
    for scene, title in titles.items():
        runs = [f for f in found if f["scene"] == scene]
        rows = sorted({(f["ranks"], f["threads"]) for f in runs})
        columns = sorted({f["cell"] for f in runs})
        ms = {((f["ranks"], f["threads"]), f["cell"]): f["ms_step"] for f in runs}
        tables.append((f"{title}: ms a step", rows, columns, ms))
        best = min(ms, key=ms.get)
        text.append(f"\n## {title[0].upper() + title[1:]}\n")
        text.append(markdown(("ranks x threads", *(f"--cell {c}" for c in columns)),
                             [(f"{r[0]} x {r[1]}", *(f"{ms[r, c]:.2f}" if (r, c) in ms else "-" for c in columns)) for r in rows]))
        text.append(f"\nBest: --cell {best[1]} with {best[0][0]} ranks of {best[0][1]} threads, {ms[best]:.2f} ms a step.")
    pictures.heat(tables, DOCS / "cells.png")
    (DOCS / "cells.md").write_text(CELLS.format(
        machine=f"{context.get('cpu', '?')}, {context.get('compiler', '?')} -O3 -march=native, commit {context.get('commit', '?')}",
        text="\n".join(text), brute=brute_force()))
    print(f"page: {DOCS / 'cells.md'}")


def brute_force():
    """The decks' own way, as bench/cell_size.cpp has measured it beside the engine's."""
    file = Path(__file__).resolve().parent.parent.parent / "build" / "bench" / "cell_size.json"
    found = json.loads(file.read_text())["benchmarks"] if file.exists() else []
    brute = {int(b["name"].split("cell:")[1].split("/")[0]): b for b in found if b["name"].startswith("brute_force/")}
    if not brute:
        return ""
    sweep = {int(b["name"].split("cell:")[1].split("/")[0]): b["flow_ns"] for b in found
             if b["name"].startswith("cell_size/") and "finer:4/skin_permille:70/h_tenths:12" in b["name"]}
    rows = [(c, f"{b['tests']:,.0f}", f"{b['ns']:,.0f}", f"{sweep[c]:,.0f}" if c in sweep else "-") for c, b in sorted(brute.items())]
    return BRUTE + markdown(("--cell", "tests a particle", "brute force [ns a particle]", "lists [ns a particle]"), rows) + "\n"


BRUTE = """
## Brute force inside of cells

As in the decks: no bins, no lists, every particle of the 27 cells around is tested. A block of 64,000 particles in 3D, one core, forces of
pressure alone; lists: all terms of a fluid, with their part of a rebuild. In one process brute force wants the smallest cells there are:
the tests grow with the cube of the edge. What made 4h (here 2) best for CharmSPH is then the price of its messages and tasks.

"""

TEMPLATE = """# Many ranks

`bash bench/run.sh scaling` writes this page.

The load is the developed dam break `big` at t = 0.30 s (80,000 particles of water, 58,428 markers), as it is or with each
particle cut into m^3 and the walls laid anew. Machine: {machine}.

Three kinds of numbers are on this page, and each table says which:

- **counted**: the library's own decomposition, halo and balance, run on so many virtual ranks without the physics. For 2, 3 and 8
  ranks each rank sends as many particles as in whole scenes on as many processes, to the last one.
- **measured**: whole scenes on one and two cores of this machine.
- **MODELLED**: what counted ranks would take on a network whose constants are from others, by the formulas below.

## Weak scaling, MODELLED

![weak scaling](weak.png)

{weak}

Counted: {ranks_1e5} ranks of 1e5, {ranks_1e4} of 1e4 particles. The last column but two is extrapolated by the law "faces".
Efficiency is the mean work of a rank over the time of a step; work is what one rank would do for it, with cells as small.

**The law.** What a rank loses by itself and with its neighbours, over its work, grows until it is surrounded: neighbours and messages
are bounded. Of P ranks about P^(2/3) lie at the faces of the domain, a share of P^(-1/3): y = a - b P^(-1/3), "faces". The other
law, y = a + b log2 P, "doublings", grows for ever. Both are fitted to the first three counts, and asked for those that they have not
seen; what all ranks do together follows from the network in both. Where the last count is darker than its law, the law goes on from
there.

{foretold}

Where a count is darker than foretold, its slowest rank is of a sort that fewer ranks do not have: of a node in a sheet of water on a
wall, as thick as a cell or two. All its cells see the wall; those at the rank's edge wait for walls that wait for water, and its node
has a large surface: {worst_wait} of the step of {worst_ranks} ranks is that wait, {mean_wait} on the mean of all ranks.

Where a step goes, MODELLED on the first network:

{parts}

## Strong scaling, MODELLED

8 to 504 ranks, as in the deck of CharmSPH, whose text has no numbers to compare with. The smaller load has the size of its
scene; 504 ranks have 275 particles each.

![strong scaling](strong.png)

{strong}

## Idle time against cells a rank, MODELLED

The deck's figure 3: over-decomposition reduces idle time. 64 ranks of 13,600 particles.

![idle](idle.png)

{idle}

Small cells are a finer measure for cuts and let more pairs run while messages fly. What they cost in tasks is in {cells}.

## Measured on one and two cores

Scene `big` in developed flow, 40 steps from t = 0.30 s, balance on, processes of MPI; of each ten steps the least over repeats.

{measured}

Constants are from one rank with --cell 2 and 8; the rows of --cell 4, and of two ranks, are foretold. The aims are 0.6 of one rank's time for two, and 15 % between model and measurement; the
table says what was reached. Each row is the least of several runs on two cores of a shared host: two ranks, which need both, suffer
more from others' work than one.

## A step on two processes

![timeline](timeline.png)

The lower two rows hold messages back for 3 ms, as a slow network would: with overlap the tasks of inner cells fill the time. A
test on virtual ranks (`tests/backend/overlap.cpp`) proves that target cells run before the last message has come.

## Counted

![counts](counts.png)

In the third picture the line is right after cells have moved, triangles when the next look is due.

{counts}

The largest run is {largest} ranks with {largest_load} particles each. In one process the cuts that each rank holds, and what is summed to
find them, grow with the square of the ranks: 6 GB for 16,384.

## What grows with the number of ranks

{held}

At a million ranks new cuts, if looked for at every look, would take {million} ms a step (MODELLED); they are looked for only where
costs differ by more than 5 %.

## The model

    (1)  work       = 2 (pairs t_pair + records (t_record + t_listed) + particles t_particle)     of the rank that takes longest; pairs when the next look is due
    (2)  handing    = 2 (values t_copy + messages o + t_memory near) + x (messages o + L + 2 o + boxes)     8 values a particle of water, 5 a marker
    (3)  waiting    = of each exchange what no task fills: below
    (4)  rebuilds   = r (particles sent and received t_meet + 2 o parcels + their bytes)
    (5)  reductions = (n + 5 r) A log2 P
    (6)  cuts       = r / 4 (allreduce(8 P bytes) + allreduce(16 P bytes) + 2 P t_turn)      as if every look led to new cuts

records: particles in reach of a task, those in the patches of its cell and in the patches around; small cells have more of them for a
pair. near: bytes that a rank sends within its node, and copies itself. x: exchanges of boxes of patches, by which ranks see whether
lists are stale; nothing hides them.

(3): W = L + 2 o + G far, far the bytes of water that all ranks of a node send to other nodes, through one card, ranks numbered along
the curve. They come evenly over W: a cell that waits for j ranks of other nodes, itself or by walls that it sees, can run at
W j / (j + 1) on average. Meanwhile run cells of walls that wait for no other node, then cells of water that see no wall of another
rank. At W a rank that sees walls has its own, and they fly, hidden by the cells of water that wait for no walls of another node and
have not run yet. One that sees none is done when the last message has come and its share of cells has run. All-reduces of P values go through the card once there and back, and through the memory
of a node for each doubling of its ranks.

{constants}
"""

CELLS = """# The edge of cells

`bash bench/run.sh cell_size` writes this page.

The seeds' study of hyper-parameters: --cell by ranks and threads on both seed cases, whole steps, the least of two runs for each ten
steps. No choice changes a bit of the result. Machine: {machine}.

![heat map](cells.png)
{text}
{brute}
## Beside the decks

CharmSPH found cells of 4h best on every number of nodes: smaller ones drown in messages of the runtime, larger ones in tests of
distances, since all particles of a pair of cells are tested. The granular deck found 64 x 64 cells of 8 x 8 particles best for 262,144 discs on 16
processors. Here bins find neighbours within cells, so that large cells cost no more tests, and the edge matters for caches and
balance alone.
"""
