#!/usr/bin/env python3
"""Runs the program on small inputs. Usage: cli_test.py MORSEL [UNITTEST-ARGUMENT…]"""

import json
import os
import pty
import random
import re
import shutil
import signal
import subprocess
import time
import unittest
import xml.etree.ElementTree
import zipfile

import cli
import shapes
from cli import (DONE, INPUT, INTERRUPTED, LONG_OPTION, NO_SOLID, PROJECT, USAGE, CliTest,
                 obey_signals)


class Help(CliTest):
    def test_version_is_one_line(self):
        done = self.run_morsel("--version")
        self.assertEqual(done.returncode, DONE)
        self.assertRegex(done.stdout.decode(), r"\Amorsel \d+\.\d+\.\d+\n\Z")

    def commands(self):
        """Those that the help lists."""
        text = self.run_morsel("--help").stdout.decode()
        return re.findall(r"^  ([a-z]+) +[A-Z]", text.split("Examples:")[0], re.MULTILINE)

    def options(self):
        return set().union(*(LONG_OPTION.findall(self.run_morsel(c, "--help").stdout.decode())
                             for c in self.commands()))

    def test_help_lists_the_commands(self):
        self.assertEqual(sorted(self.commands()), [
            "check", "compare", "export", "import", "index", "list", "matrix", "remove", "rename",
            "search", "segment", "serve", "show"])

    def test_help_has_examples(self):
        for arguments in ([], *([command] for command in self.commands())):
            for flag in ("--help", "-h"):
                done = self.run_morsel(*arguments, flag)
                self.assertEqual((done.returncode, done.stderr), (DONE, b""))
                self.assertIn("Examples:\n  morsel " + (*arguments, "segment")[0] + " ",
                              done.stdout.decode())

    def test_help_fits_the_terminal(self):
        for arguments in ([], *([command] for command in self.commands())):
            for line in self.run_morsel(*arguments, "--help").stdout.decode().splitlines():
                self.assertLessEqual(len(line), 100, line)

    def test_man_page_and_completions_know_every_option(self):
        options = self.options()
        self.assertGreaterEqual(len(options), 20)
        man = (PROJECT / "docs/man/morsel.1").read_text().replace("\\-", "-")
        self.assertLessEqual(options, set(LONG_OPTION.findall(man)))
        for shell in ("morsel.bash", "_morsel"):
            known = set(LONG_OPTION.findall((PROJECT / "completions" / shell).read_text()))
            self.assertLessEqual(options, known, shell)
        fish = (PROJECT / "completions/morsel.fish").read_text()
        self.assertLessEqual(options, {"--" + name for name in re.findall(r" -l ([a-z-]+)", fish)})

    def test_man_page_describes_no_other_option(self):
        man = (PROJECT / "docs/man/morsel.1").read_text().replace("\\-", "-")
        self.assertLessEqual(set(LONG_OPTION.findall(man)), {*self.options(), "--version"})

    def test_man_page_and_completions_know_every_command(self):
        man = (PROJECT / "docs/man/morsel.1").read_text()
        for command in self.commands():
            self.assertIn(f"morsel {command}", man)
            for shell in ("morsel.bash", "_morsel", "morsel.fish"):
                self.assertIn(command, (PROJECT / "completions" / shell).read_text(), shell)

    @unittest.skipUnless(shutil.which("bash"), "needs bash")
    def test_bash_completes(self):
        def complete(*words):
            script = (f"source {PROJECT}/completions/morsel.bash; COMP_WORDS=({' '.join(words)}); "
                      f"COMP_CWORD={len(words) - 1}; _morsel; echo \"${{COMPREPLY[@]}}\"")
            done = subprocess.run(["bash", "-c", script], capture_output=True, cwd=self.folder,
                                  check=True, text=True)
            return done.stdout.split()
        self.put("scan.ply", "")
        self.put("notes.md", "")
        self.assertEqual(complete("morsel", "seg"), ["segment"])
        self.assertEqual(complete("morsel", "segment", "--lab"), ["--labels"])
        self.assertEqual(complete("morsel", "segment", "--method", "p"), ["paper"])
        self.assertEqual(complete("morsel", "segment", "''"), ["scan.ply"])
        self.put("shapes.db", "")
        self.assertEqual(complete("morsel", "search", "--database", "''"), ["shapes.db"])
        self.assertEqual(complete("morsel", "index", "--class", "fo"), ["folder"])
        self.assertEqual(complete("morsel", "matrix", "--no"), ["--no-mirror"])
        self.assertEqual(complete("morsel", "compare", "--mode", "a"), ["articulated"])


class Usage(CliTest):
    def test_commands(self):
        self.refuse(USAGE, "name a command", )
        self.refuse(USAGE, "unknown command 'segmnt'; did you mean segment\\?", "segmnt", "a.xyz")
        self.refuse(USAGE, "FILE is required", "segment")
        self.refuse(USAGE, "FILE.*empty", "segment", "")
        self.refuse(USAGE, "unexpected 'b.xyz'", "segment", "a.xyz", "b.xyz")

    def test_unknown_options_get_a_suggestion(self):
        self.refuse(USAGE, "'--lables'; did you mean --labels\\?", "segment", "a", "--lables", "b")
        self.refuse(USAGE, "'--pic'; did you mean --picture\\?", "segment", "a", "--pic=b.png")
        self.refuse(USAGE, "'--verson'; did you mean --version\\?", "--verson")
        self.refuse(USAGE, "unknown option '--qqqqqqqqqq' \\(", "segment", "a", "--qqqqqqqqqq")
        self.refuse(USAGE, "'--sampel'; did you mean --sample\\?", "segment", "--sampel")

    def test_values_are_read_strictly(self):
        whole = ["", "abc", "12x", "1.5", "-1", "+5", " 5", "0x10", "1e3", "99999999999999999999"]
        for option in ("--sample", "--seed", "--parts", "--threads", "--denoise"):
            for value in whole:
                with self.subTest(option=option, value=value):
                    self.refuse(USAGE, f"{option}.*'{re.escape(value)}' is not .*", "segment", "a",
                                f"{option}={value}" if value else option,
                                *([] if value else [""]))
        for option in ("--noise", "--merge-ratio", "--deep-angle", "--big-ball-ratio"):
            for value in ("abc", "1,5", "nan", "inf", "1e999", "-1", "0.1.2"):
                with self.subTest(option=option, value=value):
                    self.refuse(USAGE, f"{option}.*'{re.escape(value)}' is not a number",
                                "segment", "a", "--method", "paper", option, value)

    def test_values_out_of_range_name_the_range(self):
        for option, value, allowed in (
                ("--sample", "0", "from 1 to 2147483648"), ("--noise", "1.01", "at most 1"),
                ("--parts", "0", "from 1"), ("--merge-ratio", "0.99", "at least 1"),
                ("--big-ball-ratio", "0", "above 0"), ("--deep-angle", "181", "at most 180"),
                ("--denoise", "21", "0 to 20"), ("--threads", "1025", "to 1024"),
                ("--method", "papers", "default or paper"),
                ("--ground", "off", "auto, keep or remove")):
            with self.subTest(option=option):
                self.refuse(USAGE, f"{option}.*{value}.*{allowed}", "segment", "a", option, value)

    def test_missing_and_repeated_values(self):
        self.refuse(USAGE, "--sample", "segment", "a", "--sample")
        self.refuse(USAGE, "--parts", "segment", "a", "--parts", "2", "--parts", "3")

    def test_options_that_exclude_each_other(self):
        self.refuse(USAGE, "--merge-ratio.*--parts|--parts.*--merge-ratio", "segment", "a",
                    "--parts", "2", "--merge-ratio", "1.5")
        self.refuse(USAGE, "--deep-angle.*--method paper", "segment", "a", "--deep-angle", "40")
        self.refuse(USAGE, "--big-ball-ratio.*--method paper", "segment", "a",
                    "--big-ball-ratio", "1")
        self.refuse(USAGE, "--denoise", "segment", "a", "--method", "paper", "--denoise", "2")
        self.refuse(USAGE, "--ground", "segment", "a", "--method", "paper", "--ground", "keep")


class Outputs(CliTest):
    """What is wrong with an output is said before the input is even read."""

    def test_extensions(self):
        for option, name in (("-o", "a.stl"), ("-o", "a"), ("--report", "a.txt"),
                             ("--picture", "a.jpg"), ("--picture", ".png")):
            with self.subTest(option=option, name=name):
                self.refuse(USAGE, "must end in \\.", "segment", "missing", option, name)

    def test_same_file_twice(self):
        self.refuse(USAGE, "too; name another", "segment", "missing", "--labels", "a.ply",
                    "-o", "./a.ply")
        self.refuse(USAGE, "too; name another", "segment", "missing", "--labels", "a.json",
                    "--report", self.folder / "a.json")

    def test_input_is_never_replaced(self):
        path = self.dumbbell(100)
        before = path.read_bytes()
        (self.folder / "link.xyz").symlink_to(path)
        for name in ("dumbbell.xyz", "./dumbbell.xyz", "link.xyz"):
            self.refuse(USAGE, "is the input", "segment", "dumbbell.xyz", "-o", name)
        self.assertEqual(path.read_bytes(), before)

    def test_places(self):
        (self.folder / "folder.ply").mkdir()
        self.put("file", "")
        self.refuse(INPUT, "nowhere does not exist", "segment", "missing", "-o", "nowhere/a.ply")
        self.refuse(INPUT, "is a directory", "segment", "missing", "-o", "folder.ply")
        self.refuse(INPUT, "not a folder|not exist", "segment", "missing", "-o", "file/a.ply")
        self.refuse(USAGE, "name a file", "segment", "missing", "--labels", "folder.ply/")
        self.refuse(INPUT, "not a regular file", "segment", "missing", "--labels", "/dev/null")
        (self.folder / "full.ply").symlink_to("/dev/full")
        self.refuse(INPUT, "not a regular file", "segment", "missing", "-o", "full.ply")
        self.refuse(INPUT, "longer than", "segment", "missing", "-o", "a" * 240 + ".ply")
        self.refuse(USAGE, "empty", "segment", "missing", "--labels", "")

    @unittest.skipIf(os.geteuid() == 0, "root may write everywhere")
    def test_permissions(self):
        folder = self.folder / "locked"
        folder.mkdir(mode=0o500)
        self.refuse(INPUT, "locked: Permission denied", "segment", "missing", "-o", "locked/a.ply")

    def test_standard_output_that_is_full(self):
        with open("/dev/full", "wb") as full:
            done = subprocess.run([cli.MORSEL, "segment", str(self.dumbbell())], stdout=full,
                                  stderr=subprocess.PIPE, check=False)
        self.assertEqual(done.returncode, INPUT)
        self.assertRegex(done.stderr.decode(), r"\Amorsel: standard output: [^\n]+\n\Z")

    def test_disk_full(self):
        path = self.dumbbell()
        small = self.folder / "small"
        small.mkdir()
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=16k", "tmpfs", small],
                                 capture_output=True, check=False)
        if mounted.returncode != 0:
            self.skipTest("cannot mount a small disk")
        try:
            done = self.run_morsel("segment", path, "-o", "small/a.ply", "--labels", "labels.txt")
            self.assertEqual(done.returncode, INPUT)
            self.assertRegex(done.stderr.decode(), r"\Amorsel: small/a.ply: [^\n]*(space|full)[^\n]*\n\Z")
            self.assertEqual(list(small.iterdir()), [])
            self.assertEqual(len(self.labels()), 4000)  # what fits elsewhere is written
        finally:
            subprocess.run(["umount", small], check=True)

    def test_file_size_limit_leaves_nothing(self):
        limited = f"ulimit -f 8; trap '' XFSZ; exec {cli.MORSEL} segment {self.dumbbell()} -o a.ply"
        done = subprocess.run(["bash", "-c", limited], capture_output=True, cwd=self.folder,
                              check=False)
        self.assertEqual(done.returncode, INPUT, done.stderr)
        self.assertRegex(done.stderr.decode(), r"\Amorsel: a.ply: [^\n]+\n\Z")
        self.assertEqual([p.name for p in self.folder.iterdir()], ["dumbbell.xyz"])


class BadInput(CliTest):
    def check(self, pattern, path, status=INPUT, *more):
        self.refuse(status, pattern, "segment", path, "-o", "a.ply", "--labels", "a.txt", *more)

    def test_files(self):
        (self.folder / "folder").mkdir()
        self.check("missing.xyz: .*No such file", "missing.xyz")
        self.check("folder: is a directory", "folder")
        self.check("empty.xyz", self.put("empty.xyz", ""))
        self.check("nan.xyz:3", self.put("nan.xyz", "0 0 0\n1 0 0\n0 nan 0\n0 0 1\n"))
        self.check("text.xyz", self.put("text.xyz", "x y z\nthis is not\na point cloud\n"))
        self.check("cut.ply", self.put(
            "cut.ply", "ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\n"
            "property float y\nproperty float z\nend_header\n0 0 0\n1 1"))
        self.check("huge.ply", self.put(
            "huge.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\n"
            "property float x\nproperty float y\nproperty float z\nend_header\nabc"))

    def test_names_do_not_break_the_line(self):
        self.check("No such file", "two\nlines\x1b[31m.xyz")

    def test_standard_input(self):
        self.refuse(INPUT, "standard input", "segment", "-", "--labels", "a.txt", input=b"")
        self.refuse(INPUT, "standard input", "segment", "-", "--labels", "a.txt", input=b"1 2\n")

    def test_no_solid(self):
        for name, points, pattern in (("three.xyz", shapes.dumbbell(3), "at least four"),
                                      ("flat.xyz", shapes.plane(), "plane")):
            path = self.put(name, shapes.xyz(points))
            self.check(pattern, path, NO_SOLID)
            done = self.run_morsel("segment", path, "-o", "a.ply", "--picture", "a.png",
                                   "--report", "a.json")
            self.assertEqual(done.returncode, NO_SOLID)
            self.assertRegex(done.stderr.decode(), r"\Amorsel: [^\n]+\n\Z")
            self.assertIn("message", json.loads((self.folder / "a.json").read_text()))
            self.assertFalse((self.folder / "a.ply").exists())
            self.assertFalse((self.folder / "a.png").exists())
            (self.folder / "a.json").unlink()
            path.unlink()


class Segment(CliTest):
    def test_table_and_hint(self):
        out = self.segment(self.dumbbell(), "--parts", "2")
        self.assertRegex(out, r"\Adumbbell.xyz: 2 parts")
        self.assertIn("part  volume %  points %  thickness  neighbours\n", out)
        rows = re.findall(r"^ +(\d+) +([\d.]+) +([\d.]+) +([\d.]+)  (\d)$", out, re.MULTILINE)
        self.assertEqual([(row[0], row[4]) for row in rows], [("0", "1"), ("1", "0")])
        self.assertAlmostEqual(sum(float(row[1]) for row in rows), 100.0, delta=0.11)
        self.assertAlmostEqual(sum(float(row[2]) for row in rows), 100.0, delta=0.11)
        for row in rows:
            self.assertAlmostEqual(float(row[3]), 2.0, delta=0.2)
        self.assertIn("--labels", out)

    def test_two_parts_of_a_dumbbell(self):
        points = shapes.dumbbell()
        self.segment(self.dumbbell(), "--parts", "2", "--labels", "labels.txt")
        labels = self.labels()
        self.assertEqual(len(labels), len(points))
        self.assertEqual(set(labels), {0, 1})
        left = [label for (x, _, _), label in zip(points, labels) if x < -0.2]
        right = [label for (x, _, _), label in zip(points, labels) if x > 0.2]
        for side in (left, right):
            main = max((0, 1), key=side.count)
            self.assertGreater(side.count(main), 0.98 * len(side))
        self.assertNotEqual(max((0, 1), key=left.count), max((0, 1), key=right.count))

    def test_one_part_and_merge_ratio(self):
        self.assertIn("1 part", self.segment(self.dumbbell(), "--parts", "1"))
        self.assertIn("1 part", self.segment(self.dumbbell(), "--merge-ratio", "1000"))

    def test_other_count_than_asked_for_is_noted(self):
        done = self.run_morsel("segment", self.dumbbell(), "--parts", "3000")
        self.assertEqual(done.returncode, DONE)
        self.assertRegex(done.stderr.decode(), r"\Amorsel: note: --parts 3000: [^\n]*at most \d+")

    def test_all_outputs(self):
        out = self.segment(self.dumbbell(), "--parts", "2", "--labels", "l.txt", "--report",
                           "r.json", "--picture", "p.png", "--output", "o.ply")
        self.assertEqual(re.findall(r"^wrote (\S+) \(", out, re.MULTILINE),
                         ["r.json", "l.txt", "o.ply", "p.png"])
        self.assertNotIn("thickness", out)
        report = json.loads((self.folder / "r.json").read_text())
        self.assertLessEqual({"morsel", "options", "counts", "parts", "levels", "stages"},
                             set(report))
        self.assertEqual(len(report["parts"]), 2)
        self.assertTrue((self.folder / "p.png").read_bytes().startswith(b"\x89PNG\r\n\x1a\n"))
        header = (self.folder / "o.ply").read_bytes().split(b"end_header\n")[0].decode()
        self.assertTrue(header.startswith("ply\nformat "))
        self.assertIn("element vertex 4000\n", header)
        self.assertRegex(header, r"property \w+ part\n")
        self.assertRegex(header, r"property (uchar|uint8) red\n")
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()),
                         ["dumbbell.xyz", "l.txt", "o.ply", "p.png", "r.json"])

    def test_other_formats(self):
        path = self.dumbbell()
        for name in ("o.pcd", "o.xyz", "o.npz", "O.PLY"):
            self.segment(path, "-o", name)
        self.segment(path, "--picture", "p.svg")
        self.assertIn(b"\nPOINTS 4000\n", (self.folder / "o.pcd").read_bytes())
        rows = [row for row in (self.folder / "o.xyz").read_text().splitlines() if row[0] != "#"]
        self.assertEqual(len(rows), 4000)
        with zipfile.ZipFile(self.folder / "o.npz") as archive:
            self.assertIsNone(archive.testzip())
            for name in archive.namelist():
                self.assertTrue(archive.read(name).startswith(b"\x93NUMPY"))
        root = xml.etree.ElementTree.parse(self.folder / "p.svg").getroot()
        self.assertTrue(root.tag.endswith("svg"))

    def test_page(self):
        name = "<script>alert(1)<!--&\"'.xyz"
        self.dumbbell().rename(self.folder / name)
        done = self.run_morsel("segment", name, "--parts", "2", "--html", "p.html")
        if done.returncode == USAGE:
            self.assertRegex(done.stderr.decode(), r"\Amorsel: --html: [^\n]*no viewer[^\n]*\n\Z")
            self.skipTest("built without the viewer")
        self.assertEqual((done.returncode, done.stderr.decode()), (DONE, ""))
        page = (self.folder / "p.html").read_text(encoding="utf-8")
        self.assertNotIn("alert(1)<", page)
        shape = json.loads(re.search(r'id="shape">([^<]*)<', page).group(1))
        self.assertEqual((shape["name"], shape["points_of_input"]), (name, 4000))
        self.assertGreaterEqual(shape["merge_ratio"], 1.0)
        self.refuse(USAGE, "must end in \\.html", "segment", name, "--html", "p.txt")

    def test_input_properties_stay(self):
        rows = [f"{x:.9g} {y:.9g} {z:.9g} {i}"
                for i, (x, y, z) in enumerate(shapes.dumbbell(2000))]
        path = self.put("in.ply", "ply\nformat ascii 1.0\nelement vertex 2000\nproperty double x\n"
                        "property double y\nproperty double z\nproperty int serial\nend_header\n"
                        + "\n".join(rows) + "\n")
        self.segment(path, "-o", "out.ply")
        self.assertIn(b" serial\n", (self.folder / "out.ply").read_bytes())

    def test_standard_input(self):
        text = self.dumbbell().read_bytes()
        self.segment("dumbbell.xyz", "--labels", "file.txt")
        self.segment("-", "--labels", "pipe.txt", input=text)
        self.assertEqual(self.labels("file.txt"), self.labels("pipe.txt"))
        self.assertTrue(self.segment("-", input=text).startswith("standard input: "))

    def test_meshes_are_sampled(self):
        left = shapes.octahedron_sphere((-0.85, 0, 0))
        right = shapes.octahedron_sphere((4, 0, 0))
        shift = len(left[0])
        triangles = left[1] + [(a + shift, b + shift, c + shift) for a, b, c in right[1]]
        path = self.put("balls.off", shapes.off(left[0] + right[0], triangles))
        for name, seed in (("a.txt", "7"), ("b.txt", "7")):
            self.segment(path, "--sample", "3000", "--noise", "0.002", "--seed", seed, "--labels",
                         name)
        self.assertEqual(len(self.labels("a.txt")), 3000)
        self.assertEqual(self.labels("a.txt"), self.labels("b.txt"))
        self.assertGreaterEqual(len(set(self.labels("a.txt"))), 2)

    def test_mesh_options_on_points_are_noted(self):
        for arguments, text in ((["dumbbell.xyz"], None), (["-"], self.dumbbell().read_bytes())):
            done = self.run_morsel("segment", *arguments, "--noise", "0.1", input=text)
            self.assertEqual(done.returncode, DONE)
            self.assertRegex(done.stderr.decode(), r"\Amorsel: note: --noise of no effect[^\n]+\n\Z")

    def test_method_paper(self):
        done = self.run_morsel("segment", self.dumbbell(), "--method", "paper", "--big-ball-ratio",
                               "0.6", "--deep-angle", "50", "--report", "r.json")
        # Whether those numbers find an inside is the method's matter, not the program's.
        self.assertIn(done.returncode, (DONE, NO_SOLID), done.stderr)
        options = json.loads((self.folder / "r.json").read_text())["options"]
        self.assertEqual((options["method"], options["big_ball_ratio"],
                          options["deep_angle_degrees"]), ("paper", 0.6, 50))

    def test_same_bytes_for_any_number_of_threads(self):
        path = self.dumbbell()
        for threads in ("1", "2"):
            self.segment(path, "--threads", threads, "--labels", f"{threads}.txt", "-o",
                         f"{threads}.ply", "--picture", f"{threads}.png")
        for kind in ("txt", "ply", "png"):
            self.assertEqual((self.folder / f"1.{kind}").read_bytes(),
                             (self.folder / f"2.{kind}").read_bytes(), kind)

    def test_labels_follow_shuffled_points(self):
        points = shapes.dumbbell()
        order = list(range(len(points)))
        random.Random(5).shuffle(order)
        self.segment(self.dumbbell(), "--labels", "labels.txt")
        self.segment(self.put("shuffled.xyz", shapes.xyz([points[i] for i in order])), "--labels",
                     "shuffled.txt")
        labels = self.labels()
        self.assertEqual([labels[i] for i in order], self.labels("shuffled.txt"))

    def test_files_are_replaced(self):
        self.put("labels.txt", "old")
        self.segment(self.dumbbell(), "--labels", "labels.txt")
        self.assertEqual(len(self.labels()), 4000)


class Interrupts(CliTest):
    def start(self, *arguments, **options):
        return subprocess.Popen([cli.MORSEL, "segment", *map(str, arguments)], cwd=self.folder,
                                stdout=subprocess.DEVNULL, preexec_fn=obey_signals, **options)

    def test_signals_leave_nothing(self):
        path = self.put("large.xyz", shapes.xyz(shapes.dumbbell(60000)))
        for which, percent in ((signal.SIGINT, 1), (signal.SIGINT, 20), (signal.SIGTERM, 50)):
            with self.subTest(which=which, percent=percent):
                sent = []

                def send(process, shown):
                    reached = re.findall(rb"(\d+)% \w", shown)
                    if not sent and reached and int(reached[-1]) >= percent:
                        process.send_signal(which)
                        sent.append(reached[-1])

                shown = self.run_on_terminal(
                    lambda terminal: self.start(path, "--denoise", "off", "-o", "a.ply", "--labels",
                                                "a.txt", "--picture", "a.png", stderr=terminal),
                    send, INTERRUPTED)
                self.assertEqual(len(sent), 1)
                self.assertRegex(shown.decode(), r"\x1b\[K(morsel: [^\n]*cancel[^\n]*\n)?\Z")
                self.assertEqual([p.name for p in self.folder.iterdir()], ["large.xyz"])

    def test_signals_before_any_work(self):
        path = self.put("large.xyz", shapes.xyz(shapes.dumbbell(60000)))
        process = self.start(path, "--denoise", "off", "-o", "a.ply", stderr=subprocess.PIPE)
        time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=120)
        # It may come before the handler is there: the default is as clean.
        self.assertIn(process.returncode, (INTERRUPTED, -signal.SIGINT))
        self.assertEqual([p.name for p in self.folder.iterdir()], ["large.xyz"])

    def test_while_waiting_for_standard_input(self):
        process = self.start("-", "--labels", "a.txt", stdin=subprocess.PIPE)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=20), INTERRUPTED)
        process.stdin.close()

    def test_bar_on_a_terminal_only(self):
        shown = self.run_on_terminal(lambda terminal: self.start(self.dumbbell(), stderr=terminal))
        self.assertRegex(shown.decode(), r"\r\[[#.]{30}\] +\d+% \w+")
        self.assertTrue(shown.endswith(b"\r\x1b[K"), shown[-40:])


if __name__ == "__main__":
    cli.main(__doc__)
