#!/usr/bin/env python3
"""Times of a scene for several error budgets, beside everything exact, everything standard and everything in double.

    bench/budgets.py build/release/wrinkle data/scenes/noise.toml

They take turns, several times, so that whatever else the machine does disturbs all of them alike. Prints a Markdown
table: medians of the kernels' ns/pixel, and the spread between the quartiles.
"""
import argparse
import json
import statistics
import subprocess
import tempfile

WAYS = [("max_error = %s" % e, ["--max-error", e]) for e in ("1", "0.1", "0.01", "1e-4")] + [
    ("everything %s" % p, ["--precision", p]) for p in ("standard", "exact", "double")]

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("wrinkle", help="the program")
parser.add_argument("scene")
parser.add_argument("--rounds", type=int, default=5, help="runs of each way")
parser.add_argument("--repeat", type=int, default=9, help="times the kernels of a run are enqueued")
arguments = parser.parse_args()

reports = {name: [] for name, _ in WAYS}
with tempfile.TemporaryDirectory() as folder:
    for _ in range(arguments.rounds):
        for name, options in WAYS:
            command = [arguments.wrinkle, "run", arguments.scene, "-o", folder, "--json", "--repeat",
                       str(arguments.repeat)] + options
            reports[name].append(json.loads(subprocess.run(command, check=True, capture_output=True).stdout))

times = {name: sorted(r["kernel_ns_per_pixel"] for r in runs) for name, runs in reports.items()}
exact = statistics.median(times["everything exact"])
print("| %s | ns/pixel | against exact | largest error, degrees | computed |" % arguments.scene)
print("|---|---|---|---|---|")
for name, _ in WAYS:
    median = statistics.median(times[name])
    spread = (times[name][-len(times[name]) // 4] - times[name][len(times[name]) // 4]) / median
    budget = reports[name][-1]["budget"]
    error = "%.1e" % budget["measured"]["max"] if budget else ""
    print("| %s | %.2f (spread %.0f%%) | %.2f | %s | %s |" % (name, median, 100 * spread, exact / median, error,
                                                            budget["precision"] if budget else ""))
