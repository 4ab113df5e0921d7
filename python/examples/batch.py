#!/usr/bin/env python3
"""Labels of many scans, with a progress bar. SCAN.labels.npy appears beside each SCAN.

Usage: batch.py SCAN...
"""

import sys

import numpy as np

import morsel


def show(done: float, text: str) -> None:
    bar = "#" * round(40 * done)
    print(f"\r[{bar:40}] {done:4.0%} {text:30.30}", end="", file=sys.stderr, flush=True)


paths = sys.argv[1:]
for number, path in enumerate(paths):

    def report(stage: str, fraction: float) -> None:
        show((number + fraction) / len(paths), f"{path}: {stage}")

    try:
        shape = morsel.segment(morsel.read_points(path), progress=report)
    except (OSError, ValueError, morsel.Error) as error:
        print(f"\n{path}: {error}", file=sys.stderr)
        continue
    np.save(f"{path}.labels.npy", shape.labels)
    print(f"\r{path}: {shape.message}")
print(file=sys.stderr)
