#!/usr/bin/env python3
"""Runs the commands around the database. Usage: database_test.py MORSEL [UNITTEST-ARGUMENT…]"""

import contextlib
import csv
import json
import math
import pathlib
import random
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
import unittest

import cli
import shapes
from cli import DONE, INPUT, INTERRUPTED, USAGE

PNG = b"\x89PNG\r\n\x1a\n"


BARS = {"ball": [((0, 0, 0), (0, 0, 0), 1.0)],
        "stick": [((-2, 0, 0), (2, 0, 0), 0.5)],
        "cross": [((-2, 0, 0), (2, 0, 0), 0.5), ((0, -2, 0), (0, 2, 0), 0.5)]}


def depth(point, bar):
    """Distance of a point from the surface of a bar with round ends, negative inside."""
    a, b, radius = bar
    line = [q - p for p, q in zip(a, b)]
    length = sum(v * v for v in line)
    along = sum((x - p) * v for x, p, v in zip(point, a, line)) / length if length else 0.0
    along = min(1.0, max(0.0, along))
    return math.dist(point, [p + along * v for p, v in zip(a, line)]) - radius


def bar_point(bar, generator):
    """A point on the surface: an end's, or pushed out of the line between the ends."""
    a, b, radius = bar
    end = generator.random() < 0.25 or a == b
    along = generator.choice((0, 1)) if end else generator.random()
    x = sphere_or_ring(a, b, end, generator)
    return tuple(p + along * (q - p) + radius * v for p, q, v in zip(a, b, x))


def sphere_or_ring(a, b, sphere, generator):
    x = shapes.sphere_point(generator)
    if sphere:
        return x
    flat = [v if p == q else 0.0 for v, p, q in zip(x, a, b)]
    return [v / math.hypot(*flat) for v in flat]


def solid(kind, seed, count=1500):
    """Points on the surface of bars in a random pose and size: shapes that differ clearly."""
    generator = random.Random(seed)
    points = []
    while len(points) < count:
        point = bar_point(generator.choice(BARS[kind]), generator)
        if all(depth(point, bar) > -1e-9 for bar in BARS[kind]):
            points.append(point)
    angle = generator.uniform(0, 2 * math.pi)
    scale = generator.uniform(0.5, 2.0)
    cosine, sine = scale * math.cos(angle), scale * math.sin(angle)
    return [(cosine * x - sine * y + 3, scale * z, sine * x + cosine * y) for x, y, z in points]


class DatabaseTest(cli.CliTest):
    def setUp(self):
        super().setUp()
        self.database = self.folder / "shapes.db"

    def shape(self, name, kind="ball", seed=1):
        self.put(name, shapes.xyz(solid(kind, seed)))
        return name

    def shelf(self):
        """Two folders of shapes: models/ball/*.xyz, models/stick/*.xyz."""
        return [self.shape(f"models/{kind}/{i}.xyz", kind, 10 * i + len(kind))
                for kind in ("ball", "stick") for i in range(2)]

    def morsel(self, command, *arguments, **options):
        """Runs to success, in silence; returns standard output."""
        done = self.run_morsel(command, "--database", "shapes.db", *arguments, **options)
        self.assertEqual((done.returncode, done.stderr.decode()), (DONE, ""), arguments)
        return done.stdout.decode()

    def query(self, statement):
        """The first value that SQLite itself answers."""
        with contextlib.closing(sqlite3.connect(self.database)) as connection:
            row = connection.execute(statement).fetchone()
            connection.commit()
            return row[0] if row else None

    def mount(self, options):
        """A disk of the test's own; skips the test where none can be mounted."""
        place = self.folder / "disk"
        place.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", place],
                                 capture_output=True, check=False)
        if mounted.returncode != 0:
            self.skipTest("cannot mount a disk")
        self.addCleanup(subprocess.run, ["umount", place], check=True)
        return place

    def remove_database(self):
        for path in self.folder.glob("shapes.db*"):
            path.unlink()

    def names(self):
        return [entry["name"] for entry in json.loads(self.morsel("list", "--json"))]

    def exported(self):
        return self.morsel("export").splitlines()


class Index(DatabaseTest):
    def test_folder_then_nothing_to_do(self):
        names = self.shelf()
        self.shape(".hidden/a.xyz")
        self.shape("models/.b.xyz")
        self.put("models/notes.txt", "not a shape")
        self.assertEqual(self.morsel("index", "models"),
                         "shapes.db: 4 added, 0 replaced, 0 unchanged; 4 shapes in all\n")
        self.assertEqual(self.names(), sorted(names))
        before = self.exported()
        self.assertIn("0 added, 0 replaced, 4 unchanged", self.morsel("index", "./models/"))
        self.assertEqual(self.exported(), before)
        self.assertEqual(sorted(p.name for p in self.folder.iterdir() if "block" not in p.name),
                         [".hidden", "models", "shapes.db"])

    def test_changed_file_is_replaced(self):
        self.shelf()
        self.morsel("index", "models")
        self.shape("models/ball/0.xyz", "cross")
        self.assertIn("0 added, 1 replaced, 3 unchanged", self.morsel("index", "models"))

    def test_same_content_is_stored_once(self):
        self.shape("a.xyz")
        shutil.copy(self.folder / "a.xyz", self.folder / "b.xyz")
        self.morsel("index", "a.xyz", "b.xyz")
        self.assertEqual(self.query("SELECT count(*) FROM signatures"), 1)

    def test_manifest_from_standard_input(self):
        names = self.shelf()
        text = "# shapes\n\n" + "\r\n".join(names[1:3]) + "\n"
        self.assertIn("2 added", self.morsel("index", "-", input=text.encode()))
        self.assertEqual(self.names(), sorted(names[1:3]))

    def test_meshes_are_sampled(self):
        self.put("ball.off", shapes.off(*shapes.octahedron_sphere((0, 0, 0))))
        self.morsel("index", "ball.off", "--sample", "1000")
        self.assertIn("points   1000\n", self.morsel("show", "ball.off"))
        self.assertIn("1 unchanged", self.morsel("index", "ball.off", "--sample", "1000"))
        self.assertIn("1 replaced", self.morsel("index", "ball.off", "--sample", "1000", "--seed", "2"))

    def test_bad_files_are_named_at_the_end(self):
        self.shelf()
        self.put("models/bad.ply", "ply\nrubbish")
        self.put("flat.xyz", shapes.xyz(shapes.plane()))
        done = self.run_morsel("index", "--database", "shapes.db", "models", "missing.off",
                               "flat.xyz")
        self.assertEqual(done.returncode, INPUT)
        self.assertIn(b"4 added", done.stdout)
        lines = done.stderr.decode().splitlines()
        self.assertEqual(len(lines), 4, lines)
        self.assertRegex(lines[0], r"\Amorsel: models/bad.ply:")
        self.assertRegex(lines[1], r"\Amorsel: missing.off: .*No such file")
        self.assertRegex(lines[2], r"\Amorsel: flat.xyz: .*plane")
        self.assertEqual(lines[3], "morsel: 3 of 7 files could not be stored")
        self.assertEqual(len(self.names()), 4)

    def test_classes_and_tags(self):
        names = self.shelf()
        self.morsel("index", "models", "--class", "folder", "--tag", "b", "--tag", "a")
        for entry in json.loads(self.morsel("list", "--json")):
            self.assertEqual(entry["class"], entry["name"].split("/")[1])
            self.assertEqual(entry["tags"], ["a", "b"])
        self.put("classes.csv", f'name,class\n{names[0]},round\n1.xyz,"other"\n')
        done = self.run_morsel("index", "--database", "shapes.db", "models", "--class",
                               "classes.csv", "--tag", "c")
        self.assertEqual(done.returncode, DONE)
        self.assertRegex(done.stderr.decode(), r"\Amorsel: note: 1 of 4 files have no class")
        classes = {e["name"]: e["class"] for e in json.loads(self.morsel("list", "--json"))}
        self.assertEqual(classes, {names[0]: "round", names[1]: "other", names[2]: "stick",
                                   names[3]: "other"})
        self.assertEqual(len(json.loads(self.morsel("list", "--json", "--tag", "c"))), 4)
        self.assertEqual(len(json.loads(self.morsel("list", "--json", "--class", "other"))), 2)

    def test_same_database_for_any_number_of_threads(self):
        self.shelf()
        exports = []
        for threads in ("1", "3"):
            self.remove_database()
            self.morsel("index", "models", "--threads", threads)
            exports.append(self.exported())
        self.assertEqual(exports[0], exports[1])

    def test_usage(self):
        self.refuse(USAGE, "--database is required", "index", "a.xyz")
        self.refuse(USAGE, "PATH is required", "index", "--database", "shapes.db")
        self.refuse(USAGE, "--tag", "index", "--database", "shapes.db", "a", "--tag")
        self.refuse(INPUT, "no file below it is a shape", "index", "--database", "d.db", ".")
        self.refuse(INPUT, "none.csv: cannot be read", "index", "--database", "d.db",
                    self.shape("a.xyz"), "--class", "none.csv")
        self.put("classes.csv", "a.xyz\n")
        self.refuse(INPUT, "classes.csv:1: has no comma", "index", "--database", "d.db", "a.xyz",
                    "--class", "classes.csv")

    def test_places(self):
        self.shape("a.xyz")
        self.refuse(INPUT, "nowhere does not exist", "index", "--database", "nowhere/s.db", "a.xyz")
        self.refuse(INPUT, "is not a database of morsel", "index", "--database", "a.xyz", "a.xyz")
        (self.folder / "folder").mkdir()
        self.refuse(INPUT, "is a directory", "index", "--database", "folder", "a.xyz")


class Interrupts(DatabaseTest):
    def start(self, *arguments, **options):
        return subprocess.Popen([cli.MORSEL, "index", "--database", "shapes.db", *arguments],
                                cwd=self.folder, preexec_fn=cli.obey_signals, **options)

    def many(self, count=12):
        return [self.shape(f"models/{i}.xyz", ("ball", "stick", "cross")[i % 3], i)
                for i in range(count)]

    def whole(self):
        """The export of an index that was not interrupted."""
        self.morsel("index", "models")
        lines = self.exported()
        self.remove_database()
        return lines

    def stored(self):
        return self.query("SELECT count(*) FROM shapes")

    def wait_for(self, count, process):
        while process.poll() is None:
            try:
                if self.stored() >= count:
                    return
            except sqlite3.OperationalError:  # not there yet
                pass
            time.sleep(0.005)

    def test_interrupted_and_run_again(self):
        self.many()
        whole = self.whole()
        for which in (signal.SIGINT, signal.SIGTERM, signal.SIGKILL):
            with self.subTest(which=which):
                process = self.start("models", "--threads", "1", stdout=subprocess.DEVNULL,
                                     stderr=subprocess.PIPE)
                self.wait_for(2, process)
                process.send_signal(which)
                message = process.communicate(timeout=60)[1].decode()
                if which == signal.SIGKILL:
                    self.assertEqual(process.returncode, -signal.SIGKILL)
                else:
                    self.assertEqual(process.returncode, INTERRUPTED, message)
                    self.assertRegex(message, r"\d+ of 12 files done; run it again")
                self.assertIn("nothing wrong", self.morsel("check"))
                self.assertGreaterEqual(self.stored(), 2)
                self.assertLess(self.stored(), 12)
                self.morsel("index", "models")
                self.assertEqual(self.exported(), whole)
                self.remove_database()

    def test_two_writers_at_once(self):
        self.many()
        whole = self.whole()
        writers = [self.start("models", stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                   for _ in range(2)]
        for writer in writers:
            message = writer.communicate(timeout=120)[1].decode()
            self.assertEqual((writer.returncode, message), (DONE, ""))
        self.assertEqual(self.exported(), whole)
        self.assertIn("nothing wrong", self.morsel("check"))

    def test_bar_with_rate_on_a_terminal_only(self):
        self.many(3)
        shown = self.run_on_terminal(
            lambda terminal: self.start("models", stdout=subprocess.DEVNULL, stderr=terminal))
        self.assertRegex(shown.decode(), r"\r\[[#.]{30}\] +\d+% \d of 3, [\d.]+/s, \d+:\d\d left")
        self.assertTrue(shown.endswith(b"\r\x1b[K"), shown[-40:])


class Search(DatabaseTest):
    def setUp(self):
        super().setUp()
        self.shelf()
        self.shape("models/cross/0.xyz", "cross", 5)
        self.morsel("index", "models", "--class", "folder")

    def hits(self, *arguments):
        return json.loads(self.morsel("search", *arguments, "--json"))["hits"]

    def test_table(self):
        out = self.morsel("search", "models/ball/0.xyz", "--top", "3").splitlines()
        self.assertEqual(len(out), 4)
        self.assertRegex(out[0], r"^ +# +score +name +class$")
        self.assertRegex(out[1], r"^ +1  1\.000  #{20}  models/ball/0.xyz +ball$")

    def test_look_alikes_come_first(self):
        for kind in ("ball", "stick"):
            query = self.shape("query.xyz", kind, 77)
            self.assertEqual([hit["class"] for hit in self.hits(query, "--top", "2")], [kind] * 2)

    def test_equals_the_scores_of_all_pairs(self):
        self.morsel("matrix", "--output", "m.csv")
        rows = list(csv.reader((self.folder / "m.csv").read_text().splitlines()))
        for query in self.names():
            hits = self.hits(query, "--top", "99")
            column = rows[0].index(query)
            scores = sorted(((-float(row[column]), row[0]) for row in rows[1:]))
            self.assertEqual([f"{hit['score']:.6f}" for hit in hits],
                             [f"{-score:.6f}" for score, _ in scores])
            self.assertEqual(hits[0]["score"], 1.0)

    def test_json_has_the_alignment(self):
        for hit in self.hits("models/ball/0.xyz", "--top", "2"):
            self.assertEqual(len(hit["target_from_source"]), 16)
            self.assertLessEqual({"rank", "name", "class", "tags", "source", "score", "mirrored",
                                  "matched", "unmatched_target", "unmatched_source"}, set(hit))

    def test_methods(self):
        for arguments in (["--method", "paper"], ["--no-mirror"], ["--mode", "articulated"]):
            self.assertEqual(len(self.hits("models/ball/0.xyz", *arguments)), 5)
        self.refuse(USAGE, "'best' is not default or paper", "search", "--database", "shapes.db",
                    "a", "--method", "best")
        self.refuse(USAGE, "'bent' is none of rigid|articulated|partial", "search", "--database",
                    "shapes.db", "a", "--mode", "bent")
        self.refuse(USAGE, "no articulated mode", "search", "--database", "shapes.db", "a",
                    "--mode", "articulated", "--method", "paper")

    def test_a_piece_finds_its_whole(self):
        points = (self.folder / "models/ball/0.xyz").read_text().splitlines()
        points.sort(key=lambda line: float(line.split()[0]))
        (self.folder / "piece.xyz").write_text("\n".join(points[:len(points) // 2]))
        hits = self.hits("piece.xyz", "--mode", "partial", "--top", "3", "--picture", "piece.png")
        self.assertEqual(hits[0]["class"], "ball")
        self.assertGreater(hits[0]["score"], 0.8)
        self.assertTrue((self.folder / "piece.png").read_bytes().startswith(PNG))
        found = json.loads(self.morsel("compare", "models/ball/0.xyz", "piece.xyz", "--mode",
                                       "partial", "--same-scale", "--json"))
        self.assertGreater(found["score"], 0.8)
        self.refuse(USAGE, "same_scale", "search", "--database", "shapes.db", "a", "--same-scale")
        self.refuse(USAGE, "no partial mode", "search", "--database", "shapes.db", "a",
                    "--mode", "partial", "--method", "paper")
        self.refuse(USAGE, "'partial' is none of rigid|articulated", "matrix", "--database",
                    "shapes.db", "--mode", "partial")

    def test_picture(self):
        self.morsel("search", "models/ball/0.xyz", "--picture", "hits.png")
        self.assertTrue((self.folder / "hits.png").read_bytes().startswith(PNG))
        self.refuse(USAGE, "must end in .png", "search", "--database", "shapes.db", "a",
                    "--picture", "hits.svg")

    def test_standard_input(self):
        text = (self.folder / "models/stick/1.xyz").read_bytes()
        out = self.morsel("search", "-", "--top", "1", input=text)
        self.assertIn("1.000", out)
        self.assertIn("models/stick/1.xyz", out)

    def test_unknown_query(self):
        self.refuse(INPUT, "neither a shape of shapes.db nor a file; did you mean "
                    "models/ball/0.xyz\\?", "search", "--database", "shapes.db",
                    "model/ball/0.xyz")
        self.refuse(INPUT, "there is no such database", "search", "--database", "no.db", "a")
        self.refuse(USAGE, "--top.*'0'", "search", "--database", "shapes.db", "a", "--top", "0")

    def test_compare(self):
        out = self.run_morsel("compare", "models/ball/0.xyz", "models/ball/0.xyz").stdout.decode()
        self.assertRegex(out, r"\A1\.000  #{20}  ")
        self.assertIn("part of A  part of B  share %\n", out)
        found = json.loads(self.morsel("compare", "models/ball/0.xyz", "models/stick/0.xyz",
                                       "--json", "--picture", "both.png"))
        other = json.loads(self.morsel("compare", "models/stick/0.xyz", "models/ball/0.xyz",
                                       "--json"))
        self.assertEqual(found["score"], other["score"])
        self.assertLess(found["score"], 1.0)
        self.assertTrue((self.folder / "both.png").read_bytes().startswith(PNG))
        self.refuse(INPUT, "there is no such file; for a stored name give --database", "compare",
                    "models/ball/0.xyz", "tom")

    def test_matrix(self):
        self.morsel("rename", "models/ball/0.xyz", 'a "round", thing')
        self.morsel("matrix", "-o", "m.csv", "--picture", "m.png", "--threads", "2")
        rows = list(csv.reader((self.folder / "m.csv").read_text().splitlines()))
        names = [row[0] for row in rows[1:]]
        self.assertEqual(rows[0], ["", *names])
        self.assertEqual(sorted(names), sorted(self.names()))
        self.assertIn('a "round", thing', names)
        classes = {e["name"]: e["class"] for e in json.loads(self.morsel("list", "--json"))}
        self.assertEqual(names, sorted(names, key=lambda name: (classes[name], name)))
        for i, row in enumerate(rows[1:], 1):
            self.assertEqual(float(row[i]), 1.0)
            for j in range(1, len(rows)):
                self.assertEqual(row[j], rows[j][i])
        self.assertTrue((self.folder / "m.png").read_bytes().startswith(PNG))
        self.refuse(USAGE, "--output is required", "matrix", "--database", "shapes.db")

    def test_damaged_block_is_made_anew(self):
        expected = self.hits("models/ball/0.xyz")
        block, = self.folder.glob("shapes.db-*.block")
        good = block.read_bytes()
        for bad in (b"", good[:100], good[:60] + b"\xff" + good[61:], b"x" * len(good)):
            block.write_bytes(bad)
            self.assertEqual(self.hits("models/ball/0.xyz"), expected)


class Rows(DatabaseTest):
    def setUp(self):
        super().setUp()
        self.shape("a.xyz", "ball")
        self.shape("b.xyz", "cross")
        self.morsel("index", "a.xyz", "b.xyz", "--tag", "t")

    def test_list(self):
        self.assertEqual(self.morsel("list"), "name   class  tags\na.xyz  -      t\nb.xyz  -      t\n")

    def test_show(self):
        out = self.morsel("show", "b.xyz", "--picture", "b.svg", "--thumbnail", "b.png")
        self.assertRegex(out, r"\Aname     b.xyz\nclass    -\ntags     t\nsource   b.xyz\n")
        self.assertTrue((self.folder / "b.png").read_bytes().startswith(PNG))
        self.assertIn("<svg", (self.folder / "b.svg").read_text())
        shape = json.loads(self.morsel("show", "b.xyz", "--json"))
        self.assertEqual((shape["name"], shape["tags"]), ("b.xyz", ["t"]))
        self.assertRegex(shape["content"], r"\A[0-9a-f]{32}\Z")
        self.refuse(INPUT, "'c' is not in the database", "show", "--database", "shapes.db", "c")

    def test_remove(self):
        self.refuse(INPUT, "'c' is not in the database", "remove", "--database", "shapes.db",
                    "a.xyz", "c")
        self.assertEqual(self.names(), ["a.xyz", "b.xyz"])
        self.assertEqual(self.morsel("remove", "a.xyz"), "removed 1; 1 shapes are left\n")
        self.assertEqual(self.names(), ["b.xyz"])

    def test_rename(self):
        self.morsel("rename", "a.xyz", "z")
        self.assertEqual(self.names(), ["b.xyz", "z"])
        self.refuse(INPUT, "another shape's name", "rename", "--database", "shapes.db", "z",
                    "b.xyz")

    def test_export_and_import(self):
        lines = self.exported()
        self.assertEqual(len(lines), 3)
        self.assertEqual(self.morsel("export", "-o", "out.jsonl"), "wrote out.jsonl (2 shapes)\n")
        self.assertEqual((self.folder / "out.jsonl").read_text().splitlines(), lines)
        self.remove_database()
        self.assertEqual(self.morsel("import", "out.jsonl"), "stored 2; 2 shapes in all\n")
        self.assertEqual(self.exported(), lines)
        self.remove_database()
        text = (self.folder / "out.jsonl").read_bytes()
        self.morsel("import", "-", input=text)
        self.assertEqual(self.exported(), lines)
        self.assertIn("nothing wrong", self.morsel("check"))
        self.put("bad.jsonl", text + b"{}\n")
        self.refuse(INPUT, "bad.jsonl:4: lacks the field", "import", "--database", "shapes.db",
                    "bad.jsonl")
        self.refuse(INPUT, "none: cannot read", "import", "--database", "shapes.db", "none")

    def test_export_to_a_full_disk(self):
        with open("/dev/full", "wb") as full:
            done = subprocess.run([cli.MORSEL, "export", "--database", str(self.database)],
                                  stdout=full, stderr=subprocess.PIPE, check=False)
        self.assertEqual(done.returncode, INPUT)
        self.assertRegex(done.stderr.decode(), r"\Amorsel: [^\n]+\n\Z")

    def test_check(self):
        self.assertEqual(self.morsel("check"), "shapes.db: 2 shapes, nothing wrong\n")
        self.query("UPDATE shapes SET class = 'x' WHERE name = 'a.xyz'")
        self.refuse(INPUT, "shape 'a.xyz': the row does not have its checksum", "check",
                    "--database", "shapes.db")
        self.refuse(INPUT, "shape 'a.xyz'", "list", "--database", "shapes.db")

    def flip(self, good, at, bit):
        """Flips a bit of the file; True if `check` names the file, else what it exports must stand."""
        bad = bytearray(good)
        bad[at] ^= 1 << bit
        self.remove_database()
        self.database.write_bytes(bad)
        done = self.run_morsel("check", "--database", "shapes.db")
        if done.returncode == DONE:
            return False
        self.assertEqual(done.returncode, INPUT, done.stderr)
        self.assertRegex(done.stderr.decode(errors="replace"), r"\A(morsel: [^\n]+\n)+\Z")
        self.assertIn(b"shapes.db", done.stderr)
        return True

    def test_flipped_bits_are_named_or_harmless(self):
        good = self.database.read_bytes()
        lines = self.exported()
        generator = random.Random(3)
        for _ in range(20):
            if not self.flip(good, generator.randrange(len(good)), generator.randrange(8)):
                self.assertEqual(self.exported(), lines)

    def test_flipped_bits_of_what_is_stored_are_named(self):
        stored = [bytes.fromhex(self.query(f"SELECT hex({column}) FROM signatures ORDER BY id"))
                  for column in ("signature", "sketch", "content")]
        good = self.database.read_bytes()
        generator = random.Random(4)
        for value in stored:
            # A long value is spread over pages; all places of a short piece are plain, and a piece
            # of zeros may be empty space.
            pieces = [value[i:i + 16] for i in range(0, len(value) - 15, 16)]
            known = [piece for piece in pieces if piece in good and any(piece)]
            self.assertGreaterEqual(len(known), len(pieces) / 3)
            for piece in generator.sample(known, min(6, len(known))):
                at = good.find(piece) + generator.randrange(16)
                self.assertTrue(self.flip(good, at, generator.randrange(8)))

    def test_newer_tables(self):
        self.query("PRAGMA user_version = 9")
        for command in (["list"], ["index", "a.xyz"], ["check"], ["remove", "a.xyz"]):
            self.refuse(INPUT, "newer morsel", command[0], "--database", "shapes.db", *command[1:])


class Disks(DatabaseTest):
    def test_full_disk(self):
        place = self.mount("size=96k")
        names = [self.shape(f"{i}.xyz", "cross", i) for i in range(12)]
        done = self.run_morsel("index", "--database", "disk/s.db", "--threads", "1", *names)
        self.assertEqual(done.returncode, INPUT)
        self.assertRegex(done.stderr.decode(), r"\Amorsel: disk/s.db: [^\n]*full[^\n]*\n\Z")
        subprocess.run(["mount", "-o", "remount,size=10m", place], check=True)
        checked = self.run_morsel("check", "--database", "disk/s.db")
        self.assertEqual(checked.returncode, DONE, checked.stderr)
        again = self.run_morsel("index", "--database", "disk/s.db", *names)
        self.assertEqual(again.returncode, DONE, again.stderr)
        self.assertIn(b"12 shapes in all", again.stdout)

    def test_read_only_folder(self):
        place = self.mount("size=10m")
        self.shape("a.xyz")
        self.shape("b.xyz", "cross")
        self.run_morsel("index", "--database", "disk/s.db", "a.xyz", "b.xyz")
        subprocess.run(["mount", "-o", "remount,ro", place], check=True)
        for command in (["list"], ["show", "a.xyz"], ["check"], ["search", "b.xyz"], ["export"]):
            done = self.run_morsel(command[0], "--database", "disk/s.db", *command[1:])
            self.assertEqual((done.returncode, done.stderr), (DONE, b""), command)
        for command in (["remove", "a.xyz"], ["index", "a.xyz"], ["rename", "a.xyz", "c"]):
            done = self.run_morsel(command[0], "--database", "disk/s.db", *command[1:])
            self.assertEqual(done.returncode, INPUT, command)
            self.assertRegex(done.stderr.decode(), r"\Amorsel: disk/s.db: [^\n]+\n\Z")


if __name__ == "__main__":
    cli.main(__doc__)
