"""What the tests of the command line share: running the program, and what it must do."""

import os
import pathlib
import pty
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest

import shapes

PROJECT = pathlib.Path(__file__).resolve().parents[2]
MORSEL = None
DONE, USAGE, INPUT, NO_SOLID, INTERRUPTED = 0, 2, 3, 4, 130
LONG_OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*")


def obey_signals():
    """Programs that a script starts in the background ignore SIGINT otherwise."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


class CliTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="morsel-cli-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.environment = {**os.environ, "LC_ALL": "C.UTF-8"}

    def put(self, name, content):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def dumbbell(self, count=4000):
        return self.put("dumbbell.xyz", shapes.xyz(shapes.dumbbell(count)))

    def run_morsel(self, *arguments, **options):
        return subprocess.run([MORSEL, *map(str, arguments)], capture_output=True, cwd=self.folder,
                              env=self.environment, timeout=300, check=False, **options)

    def segment(self, *arguments, **options):
        """Runs to success, in silence; returns standard output."""
        done = self.run_morsel("segment", *arguments, **options)
        self.assertEqual((done.returncode, done.stderr.decode()), (DONE, ""))
        return done.stdout.decode()

    def refuse(self, status, pattern, *arguments, **options):
        """Runs to failure with one line on standard error and no new file."""
        before = sorted(self.folder.rglob("*"))
        done = self.run_morsel(*arguments, **options)
        message = done.stderr.decode()
        self.assertEqual(done.returncode, status, message)
        self.assertRegex(message, r"\Amorsel: [^\n]+\n\Z")
        self.assertRegex(message, pattern)
        self.assertEqual(done.stdout, b"")
        self.assertEqual(sorted(self.folder.rglob("*")), before)

    def run_on_terminal(self, start, watch=lambda process, shown: None, status=DONE):
        """Runs what start(terminal) starts until it ends with the status; returns what the terminal
        was sent. watch(process, shown) is called whenever more has been."""
        outer, inner = pty.openpty()
        process = start(inner)
        os.close(inner)
        shown = b""
        try:
            while chunk := os.read(outer, 4096):
                shown += chunk
                watch(process, shown)
        except OSError:  # the end of a terminal on Linux
            pass
        os.close(outer)
        self.assertEqual(process.wait(timeout=60), status, shown)
        return shown

    def labels(self, name="labels.txt"):
        return [int(line) for line in (self.folder / name).read_text().splitlines()]


def main(usage):
    """Takes the program from the command line and runs the tests of the calling script."""
    global MORSEL
    if len(sys.argv) < 2:
        sys.exit(usage)
    MORSEL = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main(module="__main__")
