# SPDX-License-Identifier: BSD-3-Clause
"""The measured ladders: their table, slopes, and what lies between two of their points. Standard library only."""
import csv
import math

FAMILY = ("case", "family", "kernel", "h_dx", "formulation", "integrator", "precision")
COLUMNS = FAMILY + (
    "N", "dt", "steps", "force_evals", "pairs", "wall_s_min", "wall_s_med", "wall_s_max", "cpu_s", "err_name", "err", "status"
)  # fmt: skip
# What else a point was run at; figure and ladder say where it is drawn.
SETTING = ("figure", "ladder", "n", "cfl", "sound", "reynolds", "length", "until", "threads", "omega_dt", "skin", "cell")
MORE = SETTING + ("setup_s", "repeats", "cpu_s_min", "cpu_s_max")
TEXT = ("case", "family", "kernel", "formulation", "integrator", "precision", "err_name", "status", "figure", "ladder")


def read(path):
    """Rows of a table that write() left; lines with # are remarks."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    missing = [c for c in COLUMNS if rows and c not in rows[0]]
    if missing:
        raise ValueError(f"{path} lacks the columns {', '.join(missing)}: measure again")
    return [{k: v if k in TEXT else float(v) if v else math.nan for k, v in row.items()} for row in rows]


def write(path, rows, remarks=()):
    with open(path, "w", newline="", encoding="utf-8") as file:
        for remark in remarks:
            file.write(f"# {remark}\n")
        out = csv.DictWriter(file, COLUMNS + MORE, lineterminator="\n")
        out.writeheader()
        for row in rows:
            out.writerow({k: shown(row.get(k, "")) for k in COLUMNS + MORE})


def shown(value):
    if not isinstance(value, float):
        return value
    return "" if math.isnan(value) else f"{value:.7g}"


def family_name(f):
    return f"{f['kernel']} {float(f['h_dx']):g}, {f['formulation']}, {f['integrator']}, {f['precision']}"


def slope(x, y):
    """Of log y over log x by least squares; NaN for fewer than two places."""
    points = [(math.log(a), math.log(b)) for a, b in zip(x, y) if a > 0 and b > 0]
    n = len(points)
    if n < 2:
        return math.nan
    mx, my = sum(a for a, _ in points) / n, sum(b for _, b in points) / n
    over = sum((a - mx) ** 2 for a, _ in points)
    return sum((a - mx) * (b - my) for a, b in points) / over if over > 0 else math.nan


def between(x, y, at):
    """y at a place, by straight lines in log-log; beyond the ends the last line goes on."""
    points = sorted((math.log(a), math.log(b)) for a, b in zip(x, y) if a > 0 and b > 0)
    if len(points) < 2:
        return math.nan
    t = math.log(at)
    k = 1
    while k < len(points) - 1 and points[k][0] < t:
        k += 1
    (a, u), (b, v) = points[k - 1], points[k]
    return math.exp(u + (v - u) * (t - a) / (b - a)) if b > a else math.nan


def first_below(x, y, target):
    """The least x from which a ladder (rising in x) stays at or below a target, within the ladder; NaN if it never does."""
    points = sorted((a, b) for a, b in zip(x, y) if a > 0 and b > 0)
    if not points or points[-1][1] > target:
        return math.nan
    k = len(points) - 1
    while k > 0 and points[k - 1][1] <= target:
        k -= 1
    if k == 0:
        return points[0][0]
    (a, u), (b, v) = points[k - 1], points[k]
    share = (math.log(u) - math.log(target)) / (math.log(u) - math.log(v))
    return math.exp(math.log(a) + share * (math.log(b) - math.log(a)))


def ladders(rows, **where):
    """{family: its rows by rising n, then by falling dt} of those rows that are as asked."""
    found = {}
    for row in rows:
        if all(row[k] == v for k, v in where.items()):
            found.setdefault(row["family"], []).append(row)
    for each in found.values():
        each.sort(key=lambda r: (r["n"], -r["cfl"], -r["omega_dt"]))
    return found


def seconds(row):
    """Of the step loop, the least of the repeats: of wall time where the core was ours, of CPU time where it was shared."""
    return row["wall_s_min"] if row["wall_s_min"] < 1.05 * row["cpu_s_min"] else row["cpu_s_min"]
