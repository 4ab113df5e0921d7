#!/usr/bin/env python3
"""The shapes of a folder that look most like a scan. The database is kept for the next time.

Usage: look_alikes.py FOLDER SCAN
"""

import pathlib
import sys

import morsel

folder, scan = map(pathlib.Path, sys.argv[1:])
files = sorted(path for path in folder.iterdir() if path.suffix in {".off", ".ply", ".stl", ".xyz"})

with morsel.Database(folder / "shapes.db") as database:
    report = database.add_files(files, sample=5000)
    print(f"{report.added} shapes are new, {report.unchanged} were known")
    for path, reason in report.failures:
        print(f"left out {path}: {reason}")
    for hit in database.search(morsel.read_points(scan, sample=5000), top=3):
        print(f"{hit.score:.2f} {hit.name}")
