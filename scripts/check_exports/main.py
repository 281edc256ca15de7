"""Checks exports against other programs. Each check runs on its own, so that no renderer disturbs another."""

import argparse
import importlib
import sys
import time
from multiprocessing import get_context
from pathlib import Path

import lights
import looks
import presets
from softbox import Softbox

# Targets whose light is rendered, and those whose files are read, with their extensions; each has a module with_TARGET.
RENDERED = {"usda": "usda", "mitsuba": "xml", "radiance": "rad", "blender": "py"}
READ = {**RENDERED, "gltf": "gltf"}
CHECKS = [*RENDERED, "looks", *(f"{target}-presets" for target in READ)]

# A check that has not ended by then, in seconds, has failed.
LONGEST = 900


def run(check: str, program: Path, work: Path) -> tuple[list[lights.Row], list[str], float]:
    """What a check measured, what is wrong, and how long it took."""
    start = time.monotonic()
    softbox = Softbox(program, work / check)
    rows = []
    if check in RENDERED:
        illuminance = importlib.import_module(f"with_{check}").illuminance
        rows, wrong = lights.check(softbox, check, RENDERED[check], illuminance)
    elif check == "looks":
        wrong = looks.check(softbox)
    else:
        target = check.removesuffix("-presets")
        reader = importlib.import_module(f"with_{target}")
        wrong = presets.check(softbox, target, READ[target], reader.faults, reader.broken)
    return rows, wrong, time.monotonic() - start


def table(rows: list[lights.Row]) -> str:
    """Errors in per cent: a row a light, a column a target, without and with a box."""
    targets = sorted({row.target for row in rows}, key=CHECKS.index)
    found = {(row.target, row.case): row.error for row in rows}

    def cell(target: str, light: str) -> str:
        errors = [found[target, lights.Case(light, shadowed)] for shadowed in (False, True)]
        return " / ".join("lost" if error is None else f"{100 * error:.2f}" for error in errors)

    head = ["light", *targets]
    lines = [head, ["---"] * len(head)]
    for light in dict.fromkeys(row.case.light for row in rows):
        lines.append([light, *(cell(target, light) for target in targets)])
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--softbox", type=Path, required=True)
    parser.add_argument("--work", type=Path, required=True)
    parser.add_argument("checks", nargs="*", metavar="CHECK", help=", ".join(CHECKS))
    arguments = parser.parse_args()
    checks = arguments.checks or CHECKS
    if unknown := set(checks) - set(CHECKS):
        parser.error(f"{', '.join(sorted(unknown))}: no such check; there are {', '.join(CHECKS)}")
    rows, wrong = [], []
    with get_context("spawn").Pool(2, maxtasksperchild=1) as pool:
        jobs = {check: pool.apply_async(run, (check, arguments.softbox, arguments.work)) for check in checks}
        for check, job in jobs.items():
            measured, faults, seconds = job.get(LONGEST)
            rows += measured
            wrong += faults
            print(f"{check}: {len(faults)} wrong, {seconds:.0f} s", flush=True)
    if rows:
        print(f"\nRMS difference from softbox probe in %, without / with a box:\n{table(rows)}")
    for fault in wrong:
        print(f"check-exports: {fault}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
