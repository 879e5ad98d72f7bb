# SPDX-License-Identifier: BSD-3-Clause
"""Counts the instructions of the innermost loop of each sweep in an executable: python3 instructions.py EXECUTABLE.

That loop is the smallest one in spate::sweep_cell that takes a square root (of the distance of a pair).
"""
import re
import subprocess
import sys

STACK = r"\(%[re]?(sp|bp)[^)]*\)"


def functions(executable):
    """(demangled name, [(address, instruction)]) of each sweep."""
    text = subprocess.run(
        ["objdump", "-d", "-C", "--no-show-raw-insn", executable], check=True, capture_output=True, text=True
    ).stdout
    name, body = None, []
    for line in text.splitlines():
        head = re.match(r"^[0-9a-f]+ <(.*)>:$", line)
        if head:
            if name:
                yield name, body
            name, body = (head[1], []) if "spate::sweep_cell<" in head[1] else (None, [])
        elif name:
            code = re.match(r"^\s+([0-9a-f]+):\s+(.*)$", line)
            if code:
                body.append((int(code[1], 16), code[2]))
    if name:
        yield name, body


def inner_loop(body):
    """The smallest stretch closed by a jump back that holds a square root."""
    best = None
    for at, instruction in body:
        jump = re.match(r"j\w+\s+([0-9a-f]+)\b", instruction)
        if not jump or not body[0][0] <= int(jump[1], 16) <= at:
            continue
        loop = [i for a, i in body if int(jump[1], 16) <= a <= at]
        if any("sqrt" in i for i in loop) and (best is None or len(loop) < len(best)):
            best = loop
    return best


def counts(loop):
    return {
        "instructions": len(loop),
        "divisions": sum("div" in i.split()[0] for i in loop),
        "stores to the stack": sum(bool(re.search(r",\s*-?(0x)?[0-9a-f]*" + STACK, i)) for i in loop),
        "loads from the stack": sum(bool(re.search(STACK + r"\s*(\{[^}]*\})*,", i)) for i in loop),
    }


def sweeps(executable):
    """One entry for each distinct sweep: the terms of its model, and its counts."""
    found = []
    for name, body in functions(executable):
        loop = inner_loop(body)
        model = re.search(r"std::tuple<([^()]*?)>, spate::Particles", name)
        if loop is None or model is None:
            continue
        terms = [re.sub(r"spate::|<[^<>]*>", "", t).strip() for t in re.split(r",(?![^<]*>)", model[1])]
        found.append({"terms": terms, "scalar": "xsimd::batch" not in name, **counts(loop)})
    return found


if __name__ == "__main__":
    for sweep in sweeps(sys.argv[1]):
        if not sweep["scalar"]:
            numbers = [f"{v} {k}," for k, v in sweep.items() if k not in ("terms", "scalar")]
            print(*numbers, " + ".join(sweep["terms"]))
