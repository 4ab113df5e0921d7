#!/usr/bin/env python3
"""Checks the rules that the compiler does not: which folder may use which, and what must be there.

- src/<module> includes "module/…" only of modules named at or before it in MORSEL_MODULES.
- Only src/delaunay/triangulate.cpp includes CGAL's Delaunay triangulation, the test that compares it
  with exact numbers, and the benchmark that times CGAL alone beside it.
- python/src includes the standard library, <morsel/…>, pybind11 and its own headers alone.
- Public headers include the standard library and <morsel/…> alone, and each begins #pragma once.
- Every module has a test beside its sources.
- No committed file names the folder that the maintainers' own data lives in.

Usage: check_layers.py [PROJECT]
"""

import pathlib
import re
import subprocess
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
STANDARD = re.compile(r"[a-z_0-9]+$")  # <vector>, <cstdint>; never <x/y> or <x.h>
TRIANGULATION = re.compile(r"CGAL/(Delaunay_triangulation|Triangulation|Regular_triangulation)_3\.h")
TRIANGULATING = (
    pathlib.PurePath("src/delaunay/triangulate.cpp"),
    pathlib.PurePath("src/delaunay/exact_test.cpp"),
    pathlib.PurePath("apps/morsel-bench/scaling.cpp"),
)
OUTSIDE_DATA = re.compile("/work/" + r"shared|\bshared/" + "data")


def includes(path):
    text = path.read_text(encoding="utf-8")
    for match in INCLUDE.finditer(text):
        line = text.count("\n", 0, match.start(2)) + 1
        yield line, match.group(1) == '"', match.group(2)


def sources(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in (".cpp", ".hpp"))


def modules(root):
    text = (root / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"set\(MORSEL_MODULES\s+([^)]*)\)", text).group(1).split()


def check_module_order(root, order):
    """Yields what in src/ reaches forward or outside."""
    for number, module in enumerate(order):
        for path in sources(root / "src" / module):
            for line, quoted, name in includes(path):
                if not quoted:
                    continue
                used = name.split("/")[0]
                if used not in order:
                    yield f"{path.relative_to(root)}:{line}: \"{name}\" is of no module of src/"
                elif order.index(used) > number:
                    yield f"{path.relative_to(root)}:{line}: {module} must not use {used}"


def check_modules_are_listed(root, order):
    for folder in sorted(p for p in (root / "src").iterdir() if p.is_dir()):
        if folder.name not in order:
            yield f"src/{folder.name}: not in MORSEL_MODULES"


def check_triangulation(root):
    for folder in ("src", "apps", "fuzz", "tests"):
        for path in sources(root / folder):
            if path.relative_to(root) in TRIANGULATING:
                continue
            for line, _, name in includes(path):
                if TRIANGULATION.match(name):
                    yield (f"{path.relative_to(root)}:{line}: only {TRIANGULATING[0]} includes "
                           "CGAL's triangulation")


def check_public_headers(root):
    for path in sources(root / "include"):
        where = path.relative_to(root)
        if "#pragma once" not in path.read_text(encoding="utf-8"):
            yield f"{where}: lacks #pragma once"
        for line, quoted, name in includes(path):
            if quoted or not (name.startswith("morsel/") or STANDARD.match(name)):
                yield f"{where}:{line}: a public header must not include {name}"


def check_python_bindings(root):
    folder = root / "python" / "src"
    for path in sources(folder):
        for line, quoted, name in includes(path):
            own = quoted and (folder / name).exists()
            if not own and not name.startswith(("morsel/", "pybind11/")) and not STANDARD.match(name):
                yield f"{path.relative_to(root)}:{line}: python/src must not include {name}"


def check_tests_beside_sources(root, order):
    for module in order:
        folder = root / "src" / module
        if any(folder.glob("*.cpp")) and not any(folder.glob("*_test.cpp")):
            yield f"src/{module}: has no *_test.cpp"


def check_no_outside_data(root):
    listed = subprocess.run(["git", "-C", root, "ls-files", "-co", "--exclude-standard", "-z"],
                            capture_output=True, check=False)
    names = listed.stdout.decode().split("\0") if listed.returncode == 0 else []
    for path in (root / name for name in names if name):
        if path.is_file() and OUTSIDE_DATA.search(path.read_text(errors="replace")):
            yield f"{path.relative_to(root)}: names the maintainers' data folder"


def check(root):
    """All findings, a line each."""
    order = modules(root)
    return [*check_module_order(root, order), *check_modules_are_listed(root, order),
            *check_triangulation(root), *check_public_headers(root), *check_python_bindings(root),
            *check_tests_beside_sources(root, order), *check_no_outside_data(root)]


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else __file__).resolve()
    findings = check(root if root.is_dir() else root.parent.parent)
    for finding in findings:
        print(finding)
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
