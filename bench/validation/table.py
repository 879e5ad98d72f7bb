# SPDX-License-Identifier: BSD-3-Clause
"""The table of all cases, from docs/results/validation/measured.csv and tests.csv, into docs/results/validation.md."""
import csv
import math
import re
from pathlib import Path

here = Path(__file__).resolve().parent
HEADINGS = ("## All cases", "## All numbers")  # each up to the next heading is written here


def catalogue():
    with open(here / "cases.csv") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def rows_of(path):
    if not path.exists():
        return []
    with open(path) as file:
        return list(csv.DictReader(file))


def replace(path, column, value, rows):
    """The rows whose column has the value make room for others."""
    stay = [row for row in rows_of(path) if row[column] != value] + rows
    if not stay:
        return
    with open(path, "w", newline="") as file:
        writer = csv.DictWriter(file, list(stay[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(stay)


def is_share(what):
    """Errors and shares of something are told in percent."""
    return bool(re.search(r"\b(error|off by|drift|change|rise|above|lost|over nu)\b", what)) and "[" not in what


def shown(value, what):
    value = float(value)
    if what.startswith("order") or not is_share(what):
        return f"{value:.3g}"
    if abs(value) < 1e-5:
        return f"{value:.1e}"
    return f"{100 * value:.2g} %" if abs(value) < 0.995 else f"{100 * value:.0f} %"


def observed_order(points):
    """Of an error over its coarsest and finest resolution; none where it is not an error or does not fall."""
    points = sorted(points)
    if len(points) < 2 or min(e for _, e in points) <= 0:
        return ""
    (n0, e0), (n1, e1) = points[0], points[-1]
    return f"{math.log(e0 / e1) / math.log(n1 / n0):.2f}" if n1 > n0 else ""


def lines_of(measured):
    """One line a quantity of a scene: value at each resolution, gate, order, CPU seconds, status."""
    groups = {}
    for row in measured:
        groups.setdefault((row["case"], row["scene"], row["what"]), []).append(row)
    lines = []
    for (case, scene, what), rows in groups.items():
        rows.sort(key=lambda r: int(r["n"]))
        best = {}
        for r in rows:  # a resolution that is run by two tests is the same run
            best[(int(r["n"]), r["sense"] == ">=")] = r
        values = "; ".join((f"{n}: " if n else "") + shown(best[n, up]["value"], what)
                           for n, up in best if not (up and (n, False) in best))
        gates = sorted({f"{r['sense']} {shown(r['gate'], what)}" for r in rows if r["gate"]}, reverse=True)
        order = ""
        if what.startswith("error"):
            order = observed_order([(n, abs(float(r["value"]))) for (n, _), r in best.items() if n])
        found = {r["status"] for r in rows}
        status = next((s for s in ("missed", "known gap", "met") if s in found), "told")
        if {"met", "known gap"} <= found:
            status = "met; known gap at " + ", ".join(r["n"] for r in rows if r["status"] == "known gap")
        cpu = "; ".join(f"{float(best[key]['cpu_s']):.2g}" for key in best if key[0] and not (key[1] and (key[0], False) in best))
        lines.append({"case": case, "scene": scene, "what": what, "values": values, "gate": ", ".join(gates), "order": order,
                      "cpu": cpu, "status": status})  # fmt: skip
    return lines


def markdown(head, rows):
    return "\n".join(["| " + " | ".join(head) + " |", "|" + "---|" * len(head), *("| " + " | ".join(row) + " |" for row in rows)])


def status_of(case, tests, measured):
    """In words: gates met, gaps, failures, and what was not run."""
    if case["tests"].startswith("-"):
        return "not there: " + case["tests"][1:]
    ran = [t for t in tests if t["cpu_s"]]
    waiting = len(tests) - len(ran)
    gated = [m for m in measured if m["gate"]]
    gaps = {(m["scene"], m["what"], m["n"]) for m in measured if m["status"] == "known gap"}
    found = []
    if met := sum(m["status"] == "met" for m in gated):
        found.append(f"gates met: {met}")
    if gaps or any(int(t["known_gap"]) for t in ran):
        found.append(f"**known gaps: {len(gaps) or sum(int(t['known_gap']) for t in ran)}**")
    if failed := sum(int(t["failed"]) for t in ran):
        found.append(f"**tests that fail: {failed}**")
    if measured and not gated:
        found.append("told, the plan has no gate")
    if ran and not measured:
        found.append(f"tests that pass: {sum(int(t['passed']) for t in ran)}")
    if waiting or not ran:
        found.append(f"tests not run yet: {waiting or 'all'}")
    return ", ".join(found)


def overview(into, cases, tests, measured):
    rows = []
    for c in cases:
        mine = [t for t in tests if t["case"] == c["case"]]
        there = c["figure"] and (into / c["figure"]).exists()
        cpu = sum(float(t["cpu_s"] or 0) for t in mine)
        rows.append([f"[{c['case']}]({c['figure']})" if there else c["case"], c["title"], c["reference"], f"{cpu:.2g} s" if cpu else "",
                     status_of(c, mine, [m for m in measured if m["case"] == c["case"]])])  # fmt: skip
    return markdown(("case", "what", "reference", "CPU time", "status"), rows)


def details(measured):
    rows, last = [], ("", "")
    for line in lines_of(sorted(measured, key=lambda m: m["case"])):
        case = line["case"] if line["case"] != last[0] else ""
        scene = line["scene"] if (line["case"], line["scene"]) != last else ""
        last = (line["case"], line["scene"])
        rows.append([case, scene, line["what"], line["gate"], line["values"], line["order"], line["cpu"], line["status"]])
    return markdown(("case", "scene", "quantity", "gate", "n: reached", "order", "CPU s", "status"), rows)


def section(text, heading, body):
    """The text with what stands between a heading and the next one of its level exchanged."""
    start = text.index(heading + "\n") + len(heading) + 1
    end = text.find("\n## ", start)
    return text[:start] + "\n" + body + "\n" + (text[end:] if end >= 0 else "")


def write(into):
    cases, store = catalogue(), into / "validation"
    tests, measured = rows_of(store / "tests.csv"), rows_of(store / "measured.csv")
    page = into / "validation.md"
    text = page.read_text()
    commits = sorted({f"{t['commit']} ({t['date']})" for t in tests if t["commit"]})
    note = (
        "Written by `bash bench/run.sh validation` (with `--long` the long tests too) from [tests.csv](validation/tests.csv); a case\n"
        "links its figure. CPU time is that of all its tests that were run, on one machine that does other work too. Commits: "
        + ", ".join(commits) + ".\n\n"
    )  # fmt: skip
    text = section(text, HEADINGS[0], note + overview(into, cases, tests, measured))
    note = (
        "From [measured.csv](validation/measured.csv), which the tests write. n is the number of spacings in the length of the case, without\n"
        "it the number is of no one resolution. The order is that between the coarsest and the finest n. CPU s is the time from the start of the\n"
        "scene to the number, for each n.\n\n"
    )
    page.write_text(section(text, HEADINGS[1], note + details(measured)))
