#!/usr/bin/env python3
"""What may go wrong while shapes are stored: the program is killed, the server goes away. Nothing
that was acknowledged is lost. Usage: faults_test.py MORSEL [UNITTEST-ARGUMENT…]"""

import contextlib
import pathlib
import random
import re
import signal
import sqlite3
import subprocess
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

import cli
import database_test
import postgres
import shapes
from cli import DONE, INPUT

KILLS = 110
SHAPES = 12


class Faults(database_test.DatabaseTest):
    def setUp(self):
        super().setUp()
        for i in range(SHAPES):  # small: the program is to be killed at every point of its work
            kind = ("ball", "stick", "cross")[i % 3]
            self.put(f"models/{i}.xyz", shapes.xyz(
                database_test.solid(kind, i, 800)))

    def start(self, place="shapes.db", *arguments):
        return subprocess.Popen([cli.MORSEL, "index", "--database", place, "models", "--threads",
                                 "1", *arguments], cwd=self.folder, env=self.environment,
                                preexec_fn=cli.obey_signals, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE)

    def at(self, place, command, *arguments):
        done = self.run_morsel(command, "--database", place, *arguments)
        self.assertEqual((done.returncode, done.stderr.decode()), (DONE, ""))
        return done.stdout.decode()

    def whole(self):
        """What a run that nothing disturbed stores."""
        self.at("whole.db", "index", "models")
        return self.at("whole.db", "export")


class Kills(Faults):
    def stored(self):
        """The names that the database shows to others at this moment."""
        with contextlib.closing(sqlite3.connect(self.database, timeout=60)) as connection:
            try:
                return {row[0] for row in connection.execute("SELECT name FROM shapes")}
            except sqlite3.OperationalError:  # no tables yet
                return set()

    def test_killed_at_random_moments(self):
        whole = self.whole()
        began = time.monotonic()
        self.at("timed.db", "index", "models", "--threads", "1")
        takes = time.monotonic() - began
        generator = random.Random(8)
        killed = 0
        seen = set()  # was acknowledged: others could read it
        for _ in range(10 * KILLS):
            if killed == KILLS:
                break
            process = self.start()
            give_up = time.monotonic() + generator.uniform(0.0, 1.2) * takes
            while time.monotonic() < give_up and process.poll() is None:
                if self.database.exists():
                    seen |= self.stored()
                time.sleep(0.002)
            process.kill()
            process.communicate(timeout=60)
            killed += process.returncode == -signal.SIGKILL
            if self.database.exists():
                checked = self.run_morsel("check", "--database", "shapes.db")
                if b"is empty" not in checked.stderr:  # killed before there were tables
                    self.assertEqual(checked.returncode, DONE, checked.stderr)
                self.assertLessEqual(seen, self.stored())
            if len(seen) == SHAPES or generator.random() < 0.1:
                self.morsel("index", "models")
                self.assertEqual(self.morsel("export"), whole)
                self.remove_database()
                seen = set()
        self.assertEqual(killed, KILLS)


@unittest.skipIf(postgres.programs() is None, "PostgreSQL is not installed")
class Server(Faults):
    @classmethod
    def setUpClass(cls):
        cls.server = postgres.Server()
        cls.addClassCleanup(cls.server.close)

    def setUp(self):
        super().setUp()
        name = f"t{time.monotonic_ns()}"
        self.place = self.server.create(name)
        self.count = lambda: int(self.server.ask(name, "SELECT count(*) FROM morsel.shapes"))
        self.environment["XDG_CACHE_HOME"] = str(self.folder / "cache")

    def wait_for(self, count, process):
        while process.poll() is None:
            with contextlib.suppress(subprocess.CalledProcessError):  # no tables yet
                if self.count() >= count:
                    return
            time.sleep(0.02)

    def test_same_content_as_a_file(self):
        self.assertEqual(self.at(self.place, "index", "models"),
                         f"{self.place}: {SHAPES} added, 0 replaced, 0 unchanged; {SHAPES} "
                         "shapes in all\n")
        self.assertEqual(self.at(self.place, "export"), self.whole())
        self.assertIn("nothing wrong", self.at(self.place, "check"))
        query = ["search", "models/0.xyz", "--top", "5"]
        self.assertEqual(self.at(self.place, *query), self.at("whole.db", *query))
        block, = (self.folder / "cache/morsel").iterdir()
        self.assertEqual(self.at(self.place, *query), self.at("whole.db", *query))
        self.assertEqual(list((self.folder / "cache/morsel").iterdir()), [block])
        self.at(self.place, "rename", "models/0.xyz", "zero")
        self.assertIn(" 1.000 ", self.at(self.place, "search", "zero"))
        self.assertIn(f"{SHAPES - 1} are done", self.at(self.place, "index", "models", "--status"))

    def test_password_is_not_shown(self):
        secret = self.place.replace("morsel@", "morsel:hidden@")
        self.at(self.place, "index", "models")
        self.assertNotIn("hidden", self.at(secret, "check"))
        self.assertNotIn("hidden", self.at(secret, "search", "models/0.xyz", "--json"))
        done = self.run_morsel("list", "--database", secret + "nowhere")
        self.assertEqual(done.returncode, INPUT)
        self.assertRegex(done.stderr.decode(), r"\Amorsel: postgresql://morsel@/[^\n]*cannot "
                         r"connect[^\n]*\n\Z")
        self.assertNotIn(b"hidden", done.stderr)

    def test_writers_killed_at_once(self):
        whole = self.whole()
        writers = [self.start(self.place) for _ in range(4)]
        self.wait_for(3, writers[0])
        for writer in writers[:2]:
            writer.kill()
        for writer in writers[2:]:
            self.assertEqual(writer.communicate(timeout=200)[1], b"")
        for writer in writers[:2]:
            writer.communicate(timeout=60)
        self.assertEqual(self.at(self.place, "export"), whole)
        self.assertIn("nothing wrong", self.at(self.place, "check"))

    def test_server_restarts_in_the_middle(self):
        process = self.start(self.place)
        self.wait_for(3, process)
        self.server.stop("immediate")  # as a crash would
        time.sleep(1.0)
        self.server.start()
        out, message = process.communicate(timeout=200)
        self.assertEqual((process.returncode, message), (DONE, b""), out)
        self.assertEqual(self.at(self.place, "export"), self.whole())
        self.assertIn("nothing wrong", self.at(self.place, "check"))

    def test_server_goes_away(self):
        process = self.start(self.place)
        self.wait_for(3, process)
        before = self.count()
        self.server.stop("immediate")
        try:
            message = process.communicate(timeout=200)[1].decode()
        finally:
            self.server.start()
        self.assertEqual(process.returncode, INPUT, message)
        self.assertRegex(message, r"\Amorsel: postgresql://[^\n]*connect[^\n]*; tried again for 30 "
                         r"s\n\Z")
        self.assertGreaterEqual(self.count(), before)
        self.at(self.place, "index", "models")
        self.assertEqual(self.at(self.place, "export"), self.whole())

    def test_disk_of_the_server_is_full(self):
        disk = self.mount("size=64m")
        self.folder.chmod(0o755)  # the server is another user
        self.server.give(disk)
        self.server.ask("postgres", f"CREATE TABLESPACE small LOCATION '{disk}'")
        self.addCleanup(self.server.ask, "postgres", "DROP TABLESPACE small")
        place = self.server.create("small", "--tablespace", "small")
        self.addCleanup(self.server.drop, "small")
        self.at(place, "index", "models/0.xyz")
        with contextlib.suppress(OSError), (disk / "other").open("wb", buffering=0) as other:
            while True:
                other.write(bytes(4096))
        done = self.run_morsel("index", "--database", place, "models")
        self.assertEqual(done.returncode, INPUT)
        self.assertRegex(done.stderr.decode(),
                         r"\Amorsel: postgresql://[^\n]*: the server's disk is full[^\n]*\n\Z")
        self.assertIn("nothing wrong", self.at(place, "check"))
        (disk / "other").unlink()
        self.assertIn(f"{SHAPES} shapes in all", self.at(place, "index", "models"))
        self.assertEqual(self.at(place, "export"), self.whole())

    def test_newer_and_foreign_tables(self):
        self.at(self.place, "index", "models/0.xyz")
        name = re.search(r"/(t\d+)\?", self.place).group(1)
        self.server.ask(name, "UPDATE morsel.version SET version = 9")
        for command in (["list"], ["index", "models/1.xyz"], ["check"]):
            self.refuse(INPUT, "newer morsel", command[0], "--database", self.place, *command[1:])
        self.server.ask(name, "DROP TABLE morsel.version")
        self.refuse(INPUT, "is not of morsel", "list", "--database", self.place)


class Shards(Faults):
    def share(self, variables, *arguments):
        self.environment.update(variables)
        try:
            return self.at("shapes.db", "index", "models", *arguments)
        finally:
            for name in variables:
                del self.environment[name]

    def test_shards_have_each_file_once(self):
        for count in (1, 3, 5, 20):
            shares = [self.share({}, "--shard", f"{i}/{count}") for i in range(count)]
            added = [int(re.search(r"(\d+) added", share).group(1)) for share in shares]
            self.assertEqual(sum(added), SHAPES)
            self.assertLessEqual(max(added), -(-SHAPES // count))
            self.assertIn("0 added, 0 replaced", self.share({}, "--shard", f"0/{count}"))
            self.assertEqual(self.at("shapes.db", "export"), self.whole())
            self.remove_database()
            (self.folder / "whole.db").unlink()

    def test_shard_of_the_engine(self):
        pod = {"JOB_COMPLETION_INDEX": "1", "JOB_COMPLETIONS": "3"}
        mpi = {"OMPI_COMM_WORLD_RANK": "2", "OMPI_COMM_WORLD_SIZE": "4"}
        step = {"SLURM_PROCID": "1", "SLURM_NTASKS": "2", "SLURM_STEP_ID": "0"}
        array = {"SLURM_ARRAY_TASK_ID": "5", "SLURM_ARRAY_TASK_MIN": "1",
                 "SLURM_ARRAY_TASK_MAX": "7", "SLURM_ARRAY_TASK_STEP": "2",
                 "SLURM_ARRAY_TASK_COUNT": "4"}
        for variables, shard in (
                (pod, "1 of 3"), (mpi, "2 of 4"), (step, "1 of 2"), (array, "2 of 4"),
                ({**array, **step}, "5 of 8"), ({**array, **step, **mpi}, "10 of 16"),
                ({**array, **step, **mpi, **pod}, "1 of 3")):
            self.assertTrue(self.share(variables).startswith(f"shard {shard}: "), shard)
            out = self.share(variables, "--shard", "0/7")
            self.assertTrue(out.startswith("shard 0 of 7: "))
        batch = {name: step[name] for name in ("SLURM_PROCID", "SLURM_NTASKS")}
        self.assertTrue(self.share(batch).startswith("shapes.db: "))

    def test_shards_that_cannot_be(self):
        for text in ("3/3", "1", "/", "-1/3", "1/3/5", "a/b", "1/0"):
            self.refuse(cli.USAGE, "--shard: .*is not I/N", "index", "--database", "d.db", "models",
                        "--shard", text)
        for variables, reason in (
                ({"JOB_COMPLETION_INDEX": "1"}, "JOB_COMPLETIONS is not set"),
                ({"OMPI_COMM_WORLD_RANK": "4", "OMPI_COMM_WORLD_SIZE": "4"}, "SIZE is 4"),
                ({"SLURM_ARRAY_TASK_ID": "3", "SLURM_ARRAY_TASK_MIN": "1",
                  "SLURM_ARRAY_TASK_MAX": "7", "SLURM_ARRAY_TASK_COUNT": "3"}, "have gaps")):
            self.environment.update(variables)
            self.refuse(cli.USAGE, reason, "index", "--database", "d.db", "models")
            for name in variables:
                del self.environment[name]

    def test_status(self):
        self.put("models/bad.ply", "ply\nrubbish")
        self.run_morsel("index", "--database", "shapes.db", "models", "--shard", "1/2")
        lines = self.morsel("index", "models", "--status").splitlines()
        first = re.fullmatch(r"shapes.db: of 13 files (\d+) are done, (\d+) failed, (\d+) are left",
                             lines[0])
        done, failed, left = map(int, first.groups())
        self.assertEqual(done + failed + left, 13)
        self.assertEqual(sum(line.startswith("failed  models/bad.ply: models/bad.ply:")
                             for line in lines), failed)
        self.assertEqual(sum(line.startswith("left    models/") for line in lines), left)
        self.run_morsel("index", "--database", "shapes.db", "models")
        self.assertIn("12 are done, 1 failed, 0 are left",
                      self.morsel("index", "models", "--status"))
        self.refuse(INPUT, "there is no such database", "index", "--database", "no.db", "models",
                    "--status")


class Repair(Faults):
    def test_repair(self):
        self.morsel("index", "models")
        self.query("UPDATE shapes SET class = 'x' WHERE name = 'models/3.xyz'")
        self.assertEqual(self.run_morsel("check", "--database", "shapes.db").returncode, INPUT)
        done = self.run_morsel("check", "--database", "shapes.db", "--repair")
        self.assertEqual((done.returncode, done.stdout),
                         (DONE, b"shapes.db: 11 shapes, nothing wrong\n"))
        self.assertRegex(done.stderr.decode(),
                         r"\Amorsel: dropped: shapes.db: shape 'models/3.xyz': [^\n]*\n\Z")
        self.assertIn("1 added, 0 replaced, 11 unchanged", self.morsel("index", "models"))
        self.assertEqual(self.morsel("export"), self.whole())


if __name__ == "__main__":
    cli.main(__doc__)
