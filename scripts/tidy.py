#!/usr/bin/env python3
"""Runs clang-tidy over the project's sources, two files at a time or as many as there are cores.

A file that passed is not looked at again until its preprocessed text, its compile command or
.clang-tidy changes: CGAL's headers make clang-tidy take a minute for some files.

Usage: scripts/tidy.py BUILD_FOLDER [FILE…]     (default: every file of ours that is compiled)
"""

import concurrent.futures
import hashlib
import json
import os
import pathlib
import shlex
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ("src", "apps", "fuzz", "tests", "python")
CACHE = ROOT / "build" / "tidy-passed"


def our_commands(build, only):
    """The compile commands of our own sources but the tests, each file once."""
    commands = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        path = (pathlib.Path(entry["directory"]) / entry["file"]).resolve()
        ours = path.is_relative_to(ROOT) and path.relative_to(ROOT).parts[0] in FOLDERS
        ours = ours and not path.stem.endswith("_test")
        if path.exists() and ours and (not only or path in only):
            commands.setdefault(path, entry)
    return commands


def fingerprint(entry, settings):
    """Changes when anything that clang-tidy reads for this file changes."""
    arguments = shlex.split(entry["command"])
    if "-o" in arguments:
        at = arguments.index("-o")
        del arguments[at : at + 2]
    # -C keeps comments, as NOLINT is one.
    text = subprocess.run(
        [a for a in arguments if a != "-c"] + ["-E", "-C"],
        cwd=entry["directory"], capture_output=True, check=False,
    )
    if text.returncode != 0:
        return None
    return hashlib.sha256(settings + shlex.join(arguments).encode() + text.stdout).hexdigest()


def check(path, entry, build, settings):
    """Returns what clang-tidy has to say, or nothing."""
    mark = fingerprint(entry, settings)
    if mark and (CACHE / mark).exists():
        return ""
    run = subprocess.run(
        ["clang-tidy-16", "--quiet", "-p", str(build), str(path)],
        capture_output=True, text=True, check=False,
    )
    if run.returncode != 0:
        return (run.stdout or run.stderr).strip()
    if mark:
        (CACHE / mark).touch()
    return ""


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    commands = our_commands(build, {pathlib.Path(name).resolve() for name in sys.argv[2:]})
    version = subprocess.run(["clang-tidy-16", "--version"], capture_output=True, check=True).stdout
    settings = version + (ROOT / ".clang-tidy").read_bytes()
    CACHE.mkdir(parents=True, exist_ok=True)
    failed = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        jobs = {pool.submit(check, p, e, build, settings): p for p, e in commands.items()}
        for job in concurrent.futures.as_completed(jobs):
            if job.result():
                failed += 1
                print(job.result(), flush=True)
    print(f"clang-tidy: {len(commands)} files, {failed} with findings")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
