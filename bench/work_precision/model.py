# SPDX-License-Identifier: BSD-3-Clause
"""What a ladder says of a run that was not measured: another resolution, Reynolds number or length.

Time: seconds a particle update, from the ladder, times particles, evaluations a step and steps; the steps follow from the
engine's own criteria, dt = min(C h/(c0 + U), C/2 h^2/nu), so that they know of Re and L.
Error: between the points of a ladder E = a n^-p (each stretch has its own p, so that a floor of Mach number or disorder
shows as a small p). A case is one of dimensionless numbers: L changes nothing at the same n and Re. With Re the error goes
as Re^q between the numbers at which a short ladder was measured, each family and each n with its own q.
"""
import math
from dataclasses import dataclass

import ladder

BEYOND = 1.42  # how far past its finest level a ladder is believed, half of a level


@dataclass
class Case:
    figure: str
    reynolds: float
    length: float  # [m]
    errors: tuple
    until: float

    @property
    def table(self):
        return f"{self.figure.lower()}.csv"

    def describe(self, here):
        return f"Re {here['reynolds']:g}, L {here['length']:g} m"


class Vortices(Case):
    def end_and_dt(self, h_dx, n, cfl, sound, here):
        """Units: U = 1 m/s."""
        L, h = here["length"], h_dx * here["length"] / n
        return self.until * L, min(cfl * h / (sound + 1), 0.5 * cfl * h * h * here["reynolds"] / L)


class Channel(Case):
    def end_and_dt(self, h_dx, n, cfl, sound, here):
        """Units: nu = 1e-6 m^2/s; the fluid starts at rest and comes near its speed at the end."""
        nu, L = 1e-6, here["length"]
        V0, h = here["reynolds"] * nu / L, h_dx * L / n
        return self.until * L * L / nu, min(cfl * h / (sound * V0 + 0.6 * V0), 0.5 * cfl * h * h / nu)


CASES = {
    "taylor_green": Vortices("W1", 100, 1, ("L1_velocity", "L1_speed", "L1_p"), 1),
    "poiseuille": Channel("W2", 0.0125, 1e-3, ("L2_u",), 0.225),
}


@dataclass
class Offer:
    family: str
    h_dx: float
    cfl: float
    sound: float
    n: int
    error: float
    time: float
    inside: bool  # the ladder was measured there
    of_its_own: bool  # what Re does was measured for this family

    def setting(self, here):
        return {"n": self.n, "cfl": self.cfl, "sound": self.sound, **here}


class Ladder:
    """One family at one C and one speed of sound, at the case's own Re and maybe at others."""

    def __init__(self, rows, case):
        rows = [r for r in rows if r["length"] == case.length]
        own = {r["n"]: r for r in rows if r["reynolds"] == case.reynolds}
        self.rows = [own[n] for n in sorted(own)]
        self.case, self.first = case, rows[0]
        self.n = [r["n"] for r in self.rows]
        self.e = [r["err"] for r in self.rows]
        self.with_re = {}  # n: {Re: error over that at the case's Re}
        for r in rows:
            if r["n"] in own:
                self.with_re.setdefault(r["n"], {})[r["reynolds"]] = r["err"] / own[r["n"]]["err"]
        self.with_re = {n: each for n, each in self.with_re.items() if len(each) >= 2}
        self.seen = {case.reynolds}.union(*self.with_re.values()) if self.with_re else {case.reynolds}

    def error(self, n, here, of_others=1.0):
        return ladder.between(self.n, self.e, n) * self.change(n, here, of_others)

    def change(self, n, here, of_others=1.0):
        """The error at another Re over that at the case's: log-log in Re at each n, and between the n; constant beyond."""
        if here["reynolds"] == self.case.reynolds:
            return 1.0
        if not self.with_re:
            return of_others
        at = sorted(self.with_re)
        values = [ladder.between(list(each), list(each.values()), here["reynolds"]) for _, each in sorted(self.with_re.items())]
        return values[0] if len(at) < 2 else ladder.between(at, values, min(max(n, at[0]), at[-1]))

    def time(self, n, here):
        f = self.first
        end, dt = self.case.end_and_dt(f["h_dx"], n, f["cfl"], f["sound"], here)
        evaluations = self.rows[0]["force_evals"] / self.rows[0]["steps"]
        particles = ladder.between(self.n, [r["N"] for r in self.rows], n)
        update = ladder.between(self.n, [ladder.seconds(r) / (r["N"] * r["force_evals"]) for r in self.rows], n)
        return update * particles * evaluations * end / dt


class Known:
    """All ladders of a case."""

    def __init__(self, rows, case, err_name=None):
        self.case, self.err_name = case, err_name or case.errors[0]
        names = {r["err_name"] for r in rows}
        if self.err_name not in names:
            raise SystemExit(f"advise: no error is called {self.err_name}; there are {', '.join(sorted(names - {''}))}")
        found = {}
        for r in rows:
            if r["err_name"] == self.err_name and r["status"] == "OK" and r["err"] > 0 and r["threads"] == 1:
                found.setdefault((r["family"], r["cfl"], r["sound"]), []).append(r)
        self.ladders = [one for one in (Ladder(r, case) for r in found.values()) if len(one.n) >= 2]

    def keep(self, wanted):
        self.ladders = [one for one in self.ladders if wanted(one.first)]

    def usual_change(self, n, here):
        """What Re does to the families of which it was measured: the middle one."""
        values = sorted(one.change(n, here) for one in self.ladders if one.with_re)
        return values[len(values) // 2] if values else 1.0

    def offers(self, here, error=None, budget=None):
        """Best first: the least time for an error, or the least error for a budget; one for each ladder."""
        found = []
        for one in self.ladders:
            sizes = range(int(one.n[0]), int(one.n[-1] * BEYOND) + 1)
            fits = [n for n in sizes if (self.error(one, n, here) <= error if error else one.time(n, here) <= budget)]
            if error:  # from where on it stays there: a dip between two signs is luck
                above = [n for n in sizes if n not in set(fits)]
                fits = [n for n in fits if not above or n > above[-1]]
            if not fits:
                continue
            n = fits[0] if error else fits[-1]
            found.append(
                Offer(one.first["family"], one.first["h_dx"], one.first["cfl"], one.first["sound"], n, self.error(one, n, here),
                      one.time(n, here), n <= one.n[-1], bool(one.with_re) or here["reynolds"] == self.case.reynolds)
            )  # fmt: skip
        return sorted(found, key=lambda o: (o.time, o.error) if error else (o.error, o.time))

    def error(self, one, n, here):
        return one.error(n, here, self.usual_change(n, here))

    def reach(self, here):
        least = min((self.error(one, one.n[-1], here) for one in self.ladders), default=math.nan)
        return f"the least error of their finest levels is {least:.2g}"

    def warnings(self, here, offer):
        if not offer.inside:
            yield "n is beyond the finest level that was measured"
        if not offer.of_its_own:
            yield "no ladder of this family was measured at another Re: that of the others is taken"
        seen = set().union(*(one.seen for one in self.ladders))
        if not min(seen) / 2 <= here["reynolds"] <= 2 * max(seen):
            yield f"Re {here['reynolds']:g} is far from what was measured, {min(seen):g} to {max(seen):g}"

    @staticmethod
    def clock(run):
        return run["wall_s"] if run["wall_s"] < 1.05 * run["cpu_s"] else run["cpu_s"]

    @staticmethod
    def clock_name(run):
        return "" if run["wall_s"] < 1.05 * run["cpu_s"] else f" (CPU time; wall time, on shared cores, {run['wall_s']:.3g} s)"
