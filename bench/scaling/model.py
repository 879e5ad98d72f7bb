# SPDX-License-Identifier: BSD-3-Clause
"""The stated model: what counted ranks would take on a network whose constants others have measured. MODELLED, always."""
import csv
import math
from dataclasses import dataclass

WORD = "MODELLED"


@dataclass
class Network:
    """LogGP: L + 2 o is the time of a short message, G that of a byte; all ranks of a node share one card."""

    name: str
    source: str
    latency: float  # of 8 bytes from node to node, L + 2 o [s]
    overhead: float  # o, of a core for a message, at each end [s]
    byte: float  # G, of the card of a node [s]
    stage: float  # of an all-reduce of 8 bytes, for each doubling of ranks [s]
    node: int  # ranks that share a card


# OSU micro-benchmarks of CSCS (osu_latency, osu_bw, osu_allreduce on 16 nodes), the reference values by which the centre
# accepts its machine: ReFrame, cscs-checks/microbenchmarks/osu/osu_tests.py, commit 099e1c3. o is not among them: half of
# the latency is the most that it can be.
REFRAME = "CSCS, ReFrame: cscs-checks/microbenchmarks/osu/osu_tests.py, commit 099e1c3"
ARIES = Network("Cray Aries, Piz Daint, nodes of 12 cores", REFRAME, 1.30e-6, 0.65e-6, 1 / 9607e6, 16.87e-6 / 4, 12)
ARIES_36 = Network("Cray Aries, Piz Daint, nodes of 36 cores", REFRAME, 1.61e-6, 0.81e-6, 1 / 9649e6, 10.85e-6 / 4, 36)


@dataclass
class Machine:
    """What this machine takes, by measurement."""

    pair: float  # a directed pair, in the tasks of cells [s]
    record: float  # a particle in reach of a task of a cell, in the task [s]
    listed: float  # the same and evaluation, outside of tasks: lists [s]
    particle: float  # a particle and evaluation, outside of these tasks [s]
    memory: float  # a byte from one process to another of the same node [s]
    meet: float  # lists of who needs what: a particle that is sent or received, at a rebuild [s]
    copy: float  # a value that is packed and landed [s]
    turn: float  # of the search for cuts: a rank's work for one cut [s]
    rebuilds: float  # of lists, a step
    boxes: float  # exchanges of boxes of patches, a step
    reductions: float  # of a value or a few, a step, without those of the balance
    evaluations: int = 2  # a step
    looks: int = 4  # rebuilds between two looks of the balance


@dataclass
class Step:
    """A step of the rank that takes longest [s]."""

    ranks: int
    particles: float  # of a rank, on average
    work: float  # of a rank, on average: pairs and particles
    dearest: float  # of the rank that takes longest: imbalance is in it
    messages: float  # handing values over: packing, overheads, and what is not hidden
    exposed: float  # of these: waiting that no work hides
    waits: float  # the same of a rank, on average
    meetings: float  # at rebuilds
    agreement: float  # reductions
    balance: float  # looking for cuts
    imbalance: float  # of work, largest over mean
    idle: float  # of all ranks, on average: what of a step is neither work nor handing over [-]

    @property
    def time(self):
        return self.dearest + self.messages + self.meetings + self.agreement + self.balance

    @property
    def efficiency(self):
        return self.work / self.time


def table(path):
    with open(path) as f:
        rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(f)]
    return rows


def all_reduce(network, ranks, machine, size=8):
    """Recursive doubling for what is short; what is long goes through the card of a node once there and once back, and
    through the memory of the node for each doubling of its ranks."""
    short = network.stage * math.ceil(math.log2(max(ranks, 1)))
    if size <= 1024:
        return short
    inside = math.ceil(math.log2(min(network.node, ranks)))
    return short + 2 * size * (network.byte * (ranks > network.node) + machine.memory * inside)


def cuts(network, ranks, machine):
    """One search for new cuts: a sum of a value for each rank, then of two, and this rank's work for them."""
    return all_reduce(network, ranks, machine, 8 * ranks) + all_reduce(network, ranks, machine, 16 * ranks) + 2 * ranks * machine.turn


def far_of(row, network, ranks):
    """Bytes that a rank sends to other nodes in an evaluation."""
    return 8 * {12: row["far_12"], 36: row["far_36"]}.get(network.node, 0) if ranks > network.node else 0


BOX = 48  # bytes: the box of a patch


def waiting(water, walls, of_walls, free, late, row):
    """Time of an evaluation in which a rank has nothing to run. Messages of other nodes come evenly over the time `water` for
    which their cards send, so that a cell that waits for j of them can run at water j / (j + 1) on average.
    of_walls: tasks of walls that wait for no other node; free[j]: of water that see no marker; late: of water that wait for no
    marker of another node"""
    t = of_walls
    for j, tasks in enumerate(free):
        t = max(t, water * j / (j + 1)) + tasks
    done = of_walls + sum(free)
    if row["wall_cells"] == 0 and row["in_1"] == 0:  # the last message lets its share of cells run
        return max(t, water + sum(free[1:]) / max(1, row["in_0"])) - done
    exposed = max(t, water) - done
    if row["in_1"] > 0:  # markers are sent when the last water has come to their owner
        exposed += max(0.0, walls - max(0.0, late - sum(free)))
    return exposed


def of_a_rank(row, of_node, network, machine, ranks):
    """(work, handing over, waiting that is not hidden, meeting) of one rank in a step.
    of_node: bytes that all ranks of its node send to other nodes"""
    n = machine.evaluations
    work = n * (machine.pair * row["later"] + machine.particle * row["particles"] + (machine.record + machine.listed) * row["reach"])
    if ranks == 1:
        return work, 0.0, 0.0, 0.0
    values = 8 * (row["out_particles_0"] + row["in_particles_0"]) + 5 * (row["out_particles_1"] + row["in_particles_1"])
    messages = row["out_0"] + row["out_1"] + row["in_0"] + row["in_1"]
    sent = 8 * (8 * row["out_particles_0"] + 5 * row["out_particles_1"])
    far = far_of(row, network, ranks)
    # All ranks of the node send at once through its card. Records of walls follow when those of water have come.
    wire = lambda part: network.latency + of_node * network.byte * part
    of_water = 8 * 8 * row["out_particles_0"] / max(1, sent)
    water, walls = wire(of_water), wire(1 - of_water)
    # A pair of a task that runs meanwhile, with its part of the records that the task reads.
    pair = machine.pair + machine.record * row["reach"] / max(1, row["later"])
    of = lambda what: pair * row[f"{what}_{network.node}"]
    if network.node in (12, 36):
        free = [pair * row[f"free_{network.node}_{j}"] for j in range(6)]
        exposed = n * waiting(water, walls, of("walls"), free, of("late"), row)
    else:  # one node, all messages are near
        exposed = n * max(0.0, water + walls - pair * row["inner"])
    # What stays within the node is copied by the ranks themselves.
    over = n * (machine.copy * values + network.overhead * messages + machine.memory * (sent - far))
    # Boxes of patches: nothing runs meanwhile.
    outside = far / max(1, sent)
    over += machine.boxes * (network.overhead * (row["out_0"] + row["in_0"]) + network.latency
                             + BOX * row["patches"] * (outside * network.byte * network.node + machine.memory * (1 - outside)))
    near = row["out_particles_0"] + row["in_particles_0"] + row["out_particles_1"] + row["in_particles_1"]
    meeting = machine.rebuilds * (machine.meet * near + network.overhead * 2 * row["meet_parcels"]
                                  + row["meet_sent"] * (outside * network.byte * network.node + machine.memory * (1 - outside)))
    return work, over, exposed, meeting


def step(rows, network, machine):
    """The step of counted ranks."""
    ranks = len(rows)
    of_node = [0.0] * (ranks // network.node + 1)  # what goes through the card of each node
    for k, r in enumerate(rows):
        of_node[k // network.node] += far_of(r, network, ranks)
    each = [of_a_rank(r, of_node[k // network.node], network, machine, ranks) for k, r in enumerate(rows)]
    mean_work = sum(e[0] for e in each) / ranks
    longest = max(each, key=sum)
    agreement = balance = 0.0
    if ranks > 1:
        scatters = machine.rebuilds * (rows[0]["meet_scatters"] + 1)
        agreement = (machine.reductions + scatters) * all_reduce(network, ranks, machine)
        balance = machine.rebuilds / machine.looks * cuts(network, ranks, machine)
    whole = sum(longest) + agreement + balance
    own = sum(e[0] + e[1] + e[3] for e in each) / ranks
    return Step(
        ranks=ranks,
        particles=sum(r["particles"] for r in rows) / ranks,
        work=mean_work,
        dearest=longest[0],
        messages=longest[1] + longest[2],
        exposed=longest[2],
        waits=sum(e[2] for e in each) / ranks,
        meetings=longest[3],
        agreement=agreement,
        balance=balance,
        imbalance=max(e[0] for e in each) / mean_work,
        idle=1 - own / whole,
    )


def fitted(points, of):
    """Least squares y = a + b of(x), y not falling with x."""
    xs, ys = [of(x) for x, _ in points], [y for _, y in points]
    mx, my = sum(xs) / len(xs), sum(ys) / len(ys)
    over = sum((x - mx) ** 2 for x in xs)
    b = sum((x - mx) * (y - my) for x, y in zip(xs, ys)) / over if over > 0 else 0.0
    b = max(0.0, b) if of(2) > of(1) else min(0.0, b)
    return my - b * mx, b


# How what a rank loses grows with the number of ranks P of like load. By faces: the worst ranks are those that are
# surrounded; of P ranks in a domain about P^(2/3) lie at its faces and are not, so that what is missing to a rank within a
# large domain falls like P^(-1/3). By doublings: each adds as much, for ever.
LAWS = {"faces": lambda p: p ** (-1 / 3), "doublings": math.log2}


def lost(s):
    """What the slowest rank takes by itself and with its neighbours, over the mean work."""
    return (s.dearest + s.messages + s.meetings) / s.work


def extrapolated(steps, ranks, network, machine, law="faces"):
    """Efficiency at more ranks, of as many particles each. What a rank loses by itself and with its neighbours goes on by the
    law as among the counted ranks, and from the last of them where that has lost more than the law says; what all ranks do
    together follows from the network, of as many ranks."""
    of = LAWS[law]
    a, b = fitted([(s.ranks, lost(s)) for s in steps], of)
    work = sum(s.work for s in steps) / len(steps)
    together = (machine.reductions + 5 * machine.rebuilds) * all_reduce(network, ranks, machine)
    together += machine.rebuilds / machine.looks * cuts(network, ranks, machine)
    last = steps[-1]
    above = max(0.0, lost(last) - a - b * of(last.ranks))
    return 1 / (a + above + b * of(ranks) + together / work)
