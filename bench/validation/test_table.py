# SPDX-License-Identifier: BSD-3-Clause
import tempfile
import unittest
from pathlib import Path

import run
import table


def row(n, value, what="error of depth", sense="<=", gate="0.01", status="met", scene="a scene"):
    return {"test": "A.B", "case": "V01", "scene": scene, "what": what, "n": str(n), "value": str(value), "sense": sense,
            "gate": gate, "status": status, "cpu_s": "1"}  # fmt: skip


class Table(unittest.TestCase):
    def test_the_order_is_that_between_the_coarsest_and_the_finest(self):
        self.assertEqual(table.observed_order([(20, 0.04), (80, 0.0025), (40, 0.03)]), "2.00")
        self.assertEqual(table.observed_order([(20, 0.04)]), "")

    def test_a_quantity_is_a_line_with_all_its_resolutions(self):
        (line,) = table.lines_of([row(40, 0.005), row(20, 0.02, status="known gap")])
        self.assertEqual(line["values"], "20: 2 %; 40: 0.5 %")
        self.assertEqual(line["gate"], "<= 1 %")
        self.assertEqual(line["order"], "2.00")
        self.assertEqual(line["status"], "met; known gap at 20")

    def test_one_that_is_missed_is_told_so(self):
        (line,) = table.lines_of([row(40, 0.02, status="missed"), row(20, 0.005)])
        self.assertEqual(line["status"], "missed")

    def test_a_number_with_two_gates_is_told_once(self):
        (line,) = table.lines_of([row(40, 1.3, "slope", ">=", "1.2"), row(40, 1.3, "slope", "<=", "1.4")])
        self.assertEqual(line["values"], "40: 1.3")
        self.assertEqual(line["gate"], ">= 1.2, <= 1.4")

    def test_a_section_gives_way_and_the_rest_stays(self):
        self.assertEqual(table.section("a\n## H\nold\n\n## I\nb\n", "## H", "new"), "a\n## H\n\nnew\n\n## I\nb\n")

    def test_rows_of_a_test_that_runs_again_are_exchanged(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "t.csv"
            table.replace(path, "test", "A", [{"test": "A", "n": "1"}])
            table.replace(path, "test", "B", [{"test": "B", "n": "2"}])
            table.replace(path, "test", "A", [{"test": "A", "n": "3"}])
            self.assertEqual([(r["test"], r["n"]) for r in table.rows_of(path)], [("B", "2"), ("A", "3")])

    def test_what_was_not_run_is_not_met(self):
        case = {"case": "V01", "tests": "models:A.*"}
        waits = {"test": "LongA.B", "passed": "0", "known_gap": "0", "failed": "0", "cpu_s": ""}
        self.assertEqual(table.status_of(case, [waits], []), "tests not run yet: 1")

    def test_every_case_of_the_catalogue_names_tests_or_says_why_not(self):
        for case in table.catalogue():
            for where in [] if case["tests"].startswith("-") else case["tests"].split():
                self.assertRegex(where, r"^[a-z]+:.+")

    def test_filters_are_those_of_googletest(self):
        self.assertTrue(run.matches("LongA.B/0", "C.*:LongA.*"))
        self.assertTrue(run.is_long("In/LongA.B") and not run.is_long("A.LongB"))


if __name__ == "__main__":
    unittest.main()
