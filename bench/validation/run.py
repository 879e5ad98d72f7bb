#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the tests of the validation plan, keeps what they measure, and writes the table and the figures of docs/results.

A test of tests/models is run by itself, so that what was measured is kept when a later one is interrupted. Its numbers are rows
of docs/results/validation/measured.csv; rows of tests that were not run this time stay, with their commit."""
import argparse
import csv
import fnmatch
import json
import os
import subprocess
import sys
import tempfile
from datetime import date
from pathlib import Path

import table

root = Path(__file__).resolve().parent.parent.parent
NUMBERS = ("test", "case", "scene", "what", "n", "value", "sense", "gate", "status", "cpu_s")


def matches(name, pattern):
    return any(fnmatch.fnmatchcase(name, one) for one in pattern.split(":"))


def tests_of(executable, pattern):
    """The names of the tests of an executable that a filter of GoogleTest names."""
    listed = subprocess.run([executable, "--gtest_list_tests"], check=True, capture_output=True, text=True).stdout
    names, suite = [], ""
    for line in listed.splitlines():
        word = line.split("#")[0].rstrip()
        if line.startswith(" "):
            names.append(suite + word.strip())
        elif word.endswith("."):
            suite = word
    return [name for name in names if matches(name, pattern)]


def is_long(name):
    return name.startswith("Long") or "/Long" in name


def run(executable, names, at_most):
    """Runs tests in one process: (counts, CPU seconds, rows, curves), or None if it took too long."""
    with tempfile.TemporaryDirectory() as scratch:
        report = Path(scratch) / "report.json"
        environment = dict(os.environ, SPATE_RESULTS=scratch, OMP_WAIT_POLICY="passive")
        command = [executable, "--gtest_filter=" + ":".join(names), f"--gtest_output=json:{report}"]
        before = os.times()
        try:
            done = subprocess.run(command, cwd=executable.parent, env=environment, capture_output=True, text=True, timeout=at_most)
        except subprocess.TimeoutExpired:
            return None
        after = os.times()
        cpu = after.children_user + after.children_system - before.children_user - before.children_system
        counts = {"passed": 0, "known_gap": 0, "failed": 0}
        if not report.exists():  # it did not come to its end
            counts["failed"] = len(names)
        else:
            for suite in json.loads(report.read_text())["testsuites"]:
                for one in suite["testsuite"]:
                    skipped = one["result"] == "SKIPPED"
                    counts["failed" if "failures" in one else "known_gap" if skipped else "passed"] += 1
        if counts["failed"]:
            sys.stderr.write(done.stdout[-3000:] + done.stderr[-1000:])
        file = Path(scratch) / "measured.csv"
        rows = [dict(zip(NUMBERS, row)) for row in csv.reader(file.read_text().splitlines())] if file.exists() else []
        return counts, cpu, rows, {p.name: p.read_text() for p in Path(scratch).glob("*.csv") if p != file}


DRAWN = ("taylor_green_*_Re1000_jittered.csv", "cavity_100*_profiles.csv", "lobovsky_*", "impact_*", "spheric2.csv",
         "shallow_*", "elastic_box.csv", "haff.csv", "column_collapse.csv")  # fmt: skip


def keep(folder, curves):
    """A curve stays where there is one of its name; a new one that a figure draws goes to docs/results/validation."""
    for name, text in curves.items():
        old = [p for p in (folder / "sph" / name, folder / name) if p.exists()]
        if old:
            old[0].write_text(text)
        elif any(fnmatch.fnmatchcase(name, one) for one in DRAWN):
            head, *rows = text.splitlines()
            rows = rows[:: max(1, len(rows) // 1000)]  # enough to be drawn
            (folder / "validation" / name).write_text("\n".join([head, *rows]) + "\n")


def commit():
    said = subprocess.run(["git", "describe", "--always", "--dirty=+"], cwd=root, capture_output=True, text=True)
    return said.stdout.strip() or "unknown"


def main():
    options = argparse.ArgumentParser(prog="bash bench/run.sh validation", description=__doc__)
    options.add_argument("--long", action="store_true", help="also the tests whose suite begins with Long: hours")
    options.add_argument("--only", default="", metavar="V15,...", help="only these cases")
    options.add_argument("--filter", default="*", metavar="PATTERN", help="only tests of this name, such as 'LongTaylor*'")
    options.add_argument("--page-only", action="store_true", help="write the table and draw again from what was measured")
    options.add_argument("--at-most", type=float, default=14400, help="seconds that a test may take (%(default).0f)")
    options.add_argument("--build", type=Path, default=root / "build" / "gcc" / "tests", help="folder of test_models, ...")
    options.add_argument("--into", type=Path, default=root / "docs" / "results", help="what is written (%(default)s)")
    args = options.parse_args()
    store, cases = args.into / "validation", table.catalogue()
    store.mkdir(parents=True, exist_ok=True)
    only = [one for one in args.only.split(",") if one]
    for one in only:
        if one not in [c["case"] for c in cases]:
            options.error(f"there is no case {one}; they are {', '.join(c['case'] for c in cases)}")
    stamp = {"commit": commit(), "date": date.today().isoformat()}
    failed = 0
    for case in cases if not args.page_only else []:
        if (only and case["case"] not in only) or case["tests"].startswith("-"):
            continue
        for where in case["tests"].split():
            folder, pattern = where.split(":", 1)
            executable = (args.build / f"test_{folder}").resolve()
            if not executable.exists():
                print(f"{case['case']}: {executable} is not built", flush=True)
                continue
            names = [n for n in tests_of(executable, pattern) if (args.long or not is_long(n)) and matches(n, args.filter)]
            alone = folder == "models"
            known = {row["test"] for row in table.rows_of(store / "tests.csv")}
            for gone in known - set(tests_of(executable, "*")) if alone else ():
                if gone in {row["test"] for row in table.rows_of(store / "tests.csv") if row["case"] == case["case"]}:
                    table.replace(store / "tests.csv", "test", gone, [])
                    table.replace(store / "measured.csv", "test", gone, [])
            for name in tests_of(executable, pattern) if alone else []:
                if name not in known and name not in names:  # there, and not run: the table says so
                    nothing = {"passed": 0, "known_gap": 0, "failed": 0, "cpu_s": "", "commit": "", "date": ""}
                    table.replace(store / "tests.csv", "test", name, [{"test": name, "case": case["case"], **nothing}])
            for batch in [[n] for n in names] if alone else [names] if names else []:
                outcome = run(executable, batch, args.at_most)
                if outcome is None:
                    print(f"{case['case']}: {batch[0]} took more than {args.at_most:.0f} s and was given up", flush=True)
                    continue
                counts, cpu, rows, curves = outcome
                failed += counts["failed"]
                label = batch[0] if alone else where
                print(f"{case['case']}: {label}: {counts}, {cpu:.1f} s of CPU", flush=True)
                table.replace(store / "tests.csv", "test", label,
                              [{"test": label, "case": case["case"], **counts, "cpu_s": f"{cpu:.3g}", **stamp}])
                table.replace(store / "measured.csv", "test", label, [{**row, **stamp} for row in rows])
                keep(args.into, curves)
    table.write(args.into)
    for script in ("validation.py", "sph/internal.py"):
        if (root / "docs" / "results" / script).exists():
            subprocess.run([sys.executable, "-B", str(root / "docs" / "results" / script)], check=True)
    print(f"table: {args.into / 'validation.md'}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
