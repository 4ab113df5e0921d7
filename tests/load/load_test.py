#!/usr/bin/env python3
"""`morsel serve` under many clients, of whom some mean no good.

wrk keeps 64 connections busy: 32 search, 24 look at shapes, 8 hand in files. Meanwhile others send
heads drop by drop, files too large, requests that are none, and uploads that they break off or cancel.
The answers must be those of the command line, the only failures those that docs/serve.md states, and
memory bounded. Times are told; a limit on them is the caller's (--most-ratio).

Usage: PYTHONPATH=tests/cli:tests/serve load_test.py MORSEL [--shapes 10000] [--seconds 120]
"""

import argparse
import hashlib
import json
import pathlib
import random
import subprocess
import sys
import tempfile
import threading
import time
import urllib.parse

import cli
import shapes
from client import Server

HERE = pathlib.Path(__file__).resolve().parent
# What a visitor may be told, by what is asked: docs/serve.md.
STATED = {"searches": {"200"}, "views": {"200"}, "uploads": {"202", "503"}}
CONNECTIONS = {"searches": 32, "views": 24, "uploads": 8}


def morsel(folder, *arguments, text=None):
    return subprocess.run([cli.MORSEL, *map(str, arguments)], cwd=folder, check=True, input=text,
                          capture_output=True, text=True).stdout


def stretched(points, x, y, z):
    return [(x * p[0], y * p[1], z * p[2]) for p in points]


def fill(folder, count):
    """A database of `count` shapes: some real ones, the others with slightly changed tables."""
    generator = random.Random(1)
    ball = shapes.octahedron_sphere((0, 0, 0), 4)[0]
    for i in range(8):
        form = shapes.dumbbell(1500, i) if i % 2 else ball
        points = stretched(form, 1 + i, 1 + i % 3, 1)
        (folder / f"real{i}.xyz").write_text(shapes.xyz(points))
    morsel(folder, "index", "--database", "s.db", *(f"real{i}.xyz" for i in range(8)))
    _, *lines = morsel(folder, "export", "--database", "s.db").splitlines()
    real = [json.loads(line) for line in lines]
    with open(folder / "more.jsonl", "w", encoding="utf-8") as more:
        more.write('{"morsel_shapes":2}\n')
        for i in range(count - len(real)):
            shape = json.loads(lines[i % len(lines)])
            shape["name"] = f"made{i}"
            shape["class"] = f"class {i % 40}"
            shape["content"] = hashlib.md5(str(i).encode()).hexdigest()
            tables = shape["signature"]["tables"]
            tables[:] = [min(255, max(0, v + generator.randint(-20, 20))) for v in tables]
            more.write(json.dumps(shape) + "\n")
    morsel(folder, "import", "--database", "s.db", "more.jsonl")
    return [shape["name"] for shape in real] + [f"made{i}" for i in range(count - len(real))]


def write_requests(folder, names):
    """One file of requests for each kind of visitor; returns their paths."""
    generator = random.Random(2)
    some = [urllib.parse.quote(name) for name in generator.sample(names, min(200, len(names)))]
    for i in range(4):
        (folder / f"upload{i}").write_text(shapes.xyz(shapes.dumbbell(1000 + 100 * i, i)))
    kinds = {
        "searches": [f"GET /api/search?name={name}&top=10" for name in some],
        "views": [f"GET {path}" for name, other in zip(some, reversed(some)) for path in (
            f"/api/shape?name={name}", f"/api/thumbnail?name={name}", "/api/shapes?text=class&limit=60",
            f"/api/picture?name={name}", f"/api/match?name={name}&with={other}", "/api/database", "/")],
        "uploads": [f"POST /api/uploads?name=upload{i}.xyz {folder}/upload{i}" for i in range(4)]}
    paths = {}
    for kind, requests in kinds.items():
        generator.shuffle(requests)
        paths[kind] = folder / kind
        paths[kind].write_text("\n".join(requests) + "\n")
    return paths


class Nuisance:
    """Clients that misbehave until they are told to stop; `problems` says what they met in return."""

    def __init__(self, server, small):
        self.server, self.small = server, small
        self.stop = threading.Event()
        self.problems, self.acts = [], {}
        acts = [self.drip] * 16 + [self.too_large, self.nonsense, self.break_off, self.cancel]
        self.threads = [threading.Thread(target=self.repeat, args=(act,)) for act in acts]

    def __enter__(self):
        for thread in self.threads:
            thread.start()
        return self

    def __exit__(self, *_):
        self.stop.set()
        for thread in self.threads:
            thread.join()

    def repeat(self, act):
        while not self.stop.is_set():
            try:
                problem = act()
            except OSError:  # the server has had enough of it, as it may
                problem = None
            if problem:
                self.problems.append(f"{act.__name__}: {problem}")
            self.acts[act.__name__] = self.acts.get(act.__name__, 0) + 1
            self.stop.wait(0.2)

    def drip(self):
        with self.server.connect() as connection:
            for byte in b"GET /api/database HTTP/1.1\r\nHost: x\r\n" * 100:
                connection.send(bytes([byte]))
                if self.stop.wait(0.5):
                    return

    def expect(self, status, answer):
        line = answer.split(b"\r\n")[0].decode(errors="replace")
        # Nothing at all: the connection was taken away while we were still talking.
        return None if not line or line.split()[1] in (status, "503") else f"{status}, not: {line}"

    def post(self, length, body=b"", **more):
        head = (f"POST /api/uploads?name=a.xyz HTTP/1.1\r\nHost: {self.server.host}\r\n"
                "Content-Type: application/octet-stream\r\n"
                f"Content-Length: {length}\r\n\r\n")
        return head.encode() + body

    def too_large(self):
        return self.expect("413", self.server.raw(self.post(10 ** 10, b"1 2 3\n" * 1000)))

    def nonsense(self):
        noise = random.randbytes(200).replace(b"\n", b" ")
        return self.expect("400", self.server.raw(b"GET " + noise + b"\r\n\r\n"))

    def break_off(self):
        return self.expect("400", self.server.raw(self.post(100000, self.small[:5000])))

    def cancel(self):
        status, _, body = self.server.send("b.xyz", self.small)
        if status == 503:
            return None
        upload = json.loads(body)["id"]
        # Others may have pushed it out of the last twelve meanwhile.
        status = self.server.ask("DELETE", "/api/upload", id=upload)[0]
        return None if status in (204, 404) else f"cancelled with {status}"


def memory(process):
    """Present and greatest resident megabytes."""
    text = pathlib.Path(f"/proc/{process.pid}/status").read_text(encoding="ascii")
    sizes = dict(line.split(":", 1) for line in text.splitlines())
    return [int(sizes[name].split()[0]) // 1024 for name in ("VmRSS", "VmHWM")]


def start_wrk(kind, server, path, seconds):
    connections = CONNECTIONS[kind]
    return subprocess.Popen(
        ["wrk", "--threads", "1", "--connections", str(connections), "--duration", f"{seconds}s",
         "--timeout", "60s", "--script", HERE / "requests.lua", f"http://{server.host}", "--", path],
        stdout=subprocess.PIPE, text=True)


def compare_answers(server, said, until):
    """The server's answers are the command line's, all the time; returns how many were compared."""
    count = 0
    while time.monotonic() < until:
        for name, hits in said.items():
            found = server.get("/api/search", name=name, top=10)["hits"]
            assert found == [{key: hit[key] for key in found[0]} for hit in hits], name
            count += 1
    return count


def run(folder, options):
    names = fill(folder, options.shapes)
    asked = random.Random(3).sample(names, 8)
    said = {name: json.loads(morsel(folder, "search", "--database", "s.db", name, "--json"))["hits"]
            for name in asked}
    paths = write_requests(folder, names)
    server = Server(folder, "s.db")
    small = (folder / "upload0").read_bytes()
    before, _ = memory(server.process)
    until = time.monotonic() + options.seconds
    with Nuisance(server, small) as nuisance:
        visitors = {kind: start_wrk(kind, server, path, options.seconds)
                    for kind, path in paths.items()}
        compared = compare_answers(server, said, until)
        half, _ = memory(server.process)
        results = {kind: json.loads(wrk.communicate()[0].splitlines()[-1])
                   for kind, wrk in visitors.items()}
    _, peak = memory(server.process)
    status, errors = server.stop()
    print(json.dumps({"shapes": options.shapes, "seconds": options.seconds, **results,
                      "megabytes": {"before": before, "late": half, "peak": peak},
                      "compared": compared, "misdeeds": nuisance.acts}, indent=1))
    problems = nuisance.problems + ([errors] if status or errors else [])
    for kind, result in results.items():
        unstated = set(result["statuses"]) - STATED[kind]
        if unstated or result["broken"] or result["timeouts"] or not result["statuses"]:
            problems.append(f"{kind}: {result}")
    if peak > options.most_megabytes:
        problems.append(f"{peak} MB of memory")
    ratio = results["searches"]["p99"] / results["searches"]["median"]
    print(f"searches: p99 is {ratio:.1f} times the median")
    if options.most_ratio and ratio > options.most_ratio:
        problems.append("some searches wait too long")
    return problems


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("morsel", type=pathlib.Path)
    parser.add_argument("--shapes", type=int, default=10000)
    parser.add_argument("--seconds", type=int, default=120)
    parser.add_argument("--most-megabytes", type=int, default=1500)
    parser.add_argument("--most-ratio", type=float, help="of the 99th percentile to the median")
    options = parser.parse_args()
    cli.MORSEL = str(options.morsel.resolve())
    with tempfile.TemporaryDirectory(prefix="morsel-load-") as folder:
        problems = run(pathlib.Path(folder), options)
    for problem in problems[:20]:
        print(problem, file=sys.stderr)
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
