# SPDX-License-Identifier: BSD-3-Clause
"""python3 -m unittest discover bench/work_precision"""
import math
import tempfile
import unittest
from pathlib import Path

import ladder
import measure
import model


def row(**more):
    """A point of a ladder that falls as E = 2 n^-1.5 at 1e-7 s an update, of n^2 particles."""
    n, re = more.get("n", 50.0), more.get("reynolds", 100.0)
    case = model.CASES["taylor_green"]
    end, dt = case.end_and_dt(1.0, n, 0.25, 10.0, {"length": 1.0, "reynolds": re})
    evals = 2 * end / dt
    base = {"case": "taylor_green", "family": "F", "kernel": "k", "h_dx": 1.0, "formulation": "f", "integrator": "i"}
    base |= {"precision": "double", "N": n * n, "dt": dt, "steps": end / dt, "force_evals": evals, "pairs": 1.0}
    time = 1e-7 * n * n * evals
    base |= {"wall_s_min": time, "wall_s_med": time, "wall_s_max": time, "cpu_s": time, "cpu_s_min": time, "cpu_s_max": time}
    base |= {"err_name": "L1_velocity", "err": 2 * n**-1.5 * (re / 100) ** 0.25, "status": "OK", "figure": "W1"}
    base |= {"ladder": "resolution", "n": n, "cfl": 0.25, "sound": 10.0, "reynolds": re, "length": 1.0, "until": 1.0}
    base |= {"threads": 1.0, "omega_dt": 0.1, "skin": 0.0, "cell": 0.0, "setup_s": 0.0, "repeats": 1.0}
    return base | more


class Slope(unittest.TestCase):
    def test_is_that_of_a_power(self):
        x = [10, 25, 80]
        self.assertAlmostEqual(ladder.slope(x, [3 * v**-1.7 for v in x]), -1.7)

    def test_of_one_point_is_not_a_number(self):
        self.assertTrue(math.isnan(ladder.slope([10], [1])))
        self.assertTrue(math.isnan(ladder.slope([10, 10], [1, 2])))


class Between(unittest.TestCase):
    def test_follows_each_stretch(self):
        x, y = [10, 20, 40], [1.0, 0.25, 0.125]
        self.assertAlmostEqual(ladder.between(x, y, 15), (15 / 10) ** -2.0)
        self.assertAlmostEqual(ladder.between(x, y, 30), 0.25 * (30 / 20) ** -1.0)

    def test_goes_on_beyond_the_ends(self):
        self.assertAlmostEqual(ladder.between([10, 20], [1.0, 0.25], 40), 1 / 16)


class FirstBelow(unittest.TestCase):
    def test_is_where_the_line_crosses(self):
        self.assertAlmostEqual(ladder.first_below([1, 10], [0.1, 0.001], 0.01), math.sqrt(10))

    def test_is_the_first_of_several(self):
        self.assertAlmostEqual(ladder.first_below([1, 10, 100], [0.1, 0.001, 0.0001], 0.01), math.sqrt(10))

    def test_does_not_trust_a_dip(self):
        at = ladder.first_below([1, 10, 100], [0.005, 0.1, 0.001], 0.01)
        self.assertGreater(at, 10)

    def test_of_what_never_comes_down_is_not_a_number(self):
        self.assertTrue(math.isnan(ladder.first_below([1, 10], [0.1, 0.05], 0.01)))


class Table(unittest.TestCase):
    def test_comes_back_as_it_was_written(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "t.csv"
            ladder.write(path, [row(), row(n=25.0, status="EnergyRunaway", err=math.nan)], ["a remark"])
            back = ladder.read(path)
        self.assertEqual(back[0]["family"], "F")
        self.assertAlmostEqual(back[0]["err"], row()["err"], 7)
        self.assertEqual(back[1]["status"], "EnergyRunaway")
        self.assertTrue(math.isnan(back[1]["err"]))

    def test_without_a_column_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "t.csv"
            path.write_text("case,family\na,b\n", encoding="utf-8")
            with self.assertRaisesRegex(ValueError, "lacks the columns"):
                ladder.read(path)


class Model(unittest.TestCase):
    def setUp(self):
        self.case = model.CASES["taylor_green"]
        rows = [row(n=n) for n in (25.0, 50.0, 100.0)] + [row(n=n, reynolds=400.0) for n in (25.0, 50.0)]
        self.known = model.Known(rows, self.case)

    def test_finds_the_resolution_for_an_error(self):
        offer = self.known.offers({"reynolds": 100, "length": 1}, error=0.01)[0]
        self.assertEqual(offer.n, math.ceil((2 / 0.01) ** (1 / 1.5)))
        self.assertAlmostEqual(offer.time, row(n=float(offer.n))["cpu_s"], 6)

    def test_does_not_trust_a_dip(self):
        rows = [row(n=25.0), row(n=50.0, err=1e-4), row(n=100.0)]
        offer = model.Known(rows, self.case).offers({"reynolds": 100, "length": 1}, error=0.001)
        self.assertEqual(offer, [])

    def test_finds_the_resolution_for_a_budget(self):
        offer = self.known.offers({"reynolds": 100, "length": 1}, budget=row(n=70.0)["cpu_s"] * 1.001)[0]
        self.assertEqual(offer.n, 70)

    def test_knows_what_reynolds_and_length_change(self):
        one = self.known.ladders[0]
        self.assertAlmostEqual(one.error(50, {"reynolds": 200, "length": 1}), row(reynolds=200.0)["err"], 9)
        self.assertAlmostEqual(one.error(50, {"reynolds": 100, "length": 3}), row()["err"], 9)
        self.assertAlmostEqual(one.time(50, {"reynolds": 100, "length": 3}), row()["cpu_s"], 9)
        viscous = {"reynolds": 1, "length": 1}  # the step is that of viscosity
        self.assertAlmostEqual(one.time(50, viscous), row(reynolds=1.0)["cpu_s"], 6)
        self.assertGreater(one.time(50, viscous), 1.5 * one.time(50, {"reynolds": 100, "length": 1}))

    def test_offers_nothing_that_was_not_reached(self):
        self.assertEqual(self.known.offers({"reynolds": 100, "length": 1}, error=1e-4), [])

    def test_warns_far_from_what_was_measured(self):
        here = {"reynolds": 5000, "length": 1}
        offer = self.known.offers(here, error=0.05)[0]
        self.assertTrue(any("far from what was measured" in w for w in self.known.warnings(here, offer)))

    def test_passes_over_what_was_stopped(self):
        rows = [row(n=n, status="EnergyRunaway", err=math.nan, err_name="") for n in (25.0, 50.0)]
        known = model.Known(rows + [row(n=25.0), row(n=50.0)], self.case)
        self.assertEqual(len(known.ladders), 1)


class Measuring(unittest.TestCase):
    class Machine:
        """Runs nothing; takes 1e-6 n^3 s."""

        def __init__(self):
            self.calls = []

        def run(self, family, setting, at_most):
            self.calls.append(setting["n"])
            cost = 1e-6 * setting["n"] ** 3
            return {"N": 1, "dt": 1, "steps": 1, "force_evals": 1, "pairs": 1, "wall_s": cost, "cpu_s": cost, "setup_s": 0.0,
                    "status": "OK", "errors": {"e": 1.0 / setting["n"]}}  # fmt: skip

    def measured(self, levels, budget, longest):
        family = dict.fromkeys(ladder.FAMILY, "x") | {"case": "c", "h_dx": 1.0, "index": 0}
        points = [measure.Point("W1", "resolution", family, 1e-3 * n, n=n) for n in levels]
        machine = self.Machine()
        return machine, *measure.measure(machine, points, budget, longest, lambda line: None)

    def test_repeats_what_is_short(self):
        machine, rows, _ = self.measured([50, 100], budget=100, longest=10)
        self.assertEqual(sorted(machine.calls), [50] * 5 + [100] * 2)
        self.assertEqual({r["repeats"] for r in rows}, {5.0, 2.0})

    def test_skips_and_names_what_is_too_long(self):
        machine, rows, skipped = self.measured([50, 100, 200], budget=100, longest=2)
        self.assertNotIn(200, machine.calls)
        self.assertRegex(skipped[0].skipped, "would take 8 s, more than the 2 s of a run")

    def test_stays_within_the_budget(self):
        machine, _, skipped = self.measured([50, 100, 200], budget=5, longest=100)
        self.assertLessEqual(sum(1e-6 * n**3 for n in machine.calls), 5)
        self.assertRegex(skipped[0].skipped, "left of 5 s")


if __name__ == "__main__":
    unittest.main()
