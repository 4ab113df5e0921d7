#!/usr/bin/env python3
"""A PostgreSQL server of a test's own: in a temporary folder, on a Unix socket there.

Usage: postgres.py COMMAND [ARGUMENT…] runs the command with the address of an empty database in
MORSEL_TEST_POSTGRES, and stops the server after it.
"""

import contextlib
import os
import pathlib
import pwd
import shutil
import subprocess
import sys
import tempfile


def programs():
    """The folder of initdb and postgres, which Debian does not have on the PATH; None without."""
    found = sorted(pathlib.Path("/usr/lib/postgresql").glob("*/bin/initdb"))
    return found[-1].parent if found else None


class Server:
    """PostgreSQL refuses to run as root: then it runs as the user `postgres`."""

    def __init__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="morsel-pg-"))
        self.account = pwd.getpwnam("postgres") if os.geteuid() == 0 else None
        self.user = []
        if self.account:
            self.user = ["setpriv", f"--reuid={self.account.pw_uid}",
                         f"--regid={self.account.pw_gid}", "--clear-groups"]
        self.give(self.folder)
        self.folder.chmod(0o755)  # others use the socket
        self.run("initdb", "--pgdata", self.folder / "data", "--username", "morsel", "--auth",
                 "trust", "--encoding", "UTF8", "--locale", "C", "--no-sync")
        self.start()

    def run(self, program, *arguments):
        command = [*self.user, programs() / program, *arguments]
        done = subprocess.run([str(word) for word in command], cwd=self.folder,
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False,
                              timeout=240)
        if done.returncode != 0:
            raise RuntimeError(f"{program}: {done.stderr.decode(errors='replace')}")

    def start(self):
        options = (f"-c listen_addresses='' -c unix_socket_directories={self.folder} "
                   "-c max_connections=40 -c shared_buffers=16MB")
        self.run("pg_ctl", "--pgdata", self.folder / "data", "--log", self.folder / "log",
                 "--options", options, "--wait", "--timeout", "200", "start")

    def stop(self, mode="fast"):
        self.run("pg_ctl", "--pgdata", self.folder / "data", "--mode", mode, "--wait", "--timeout",
                 "200", "stop")

    def address(self, database="postgres"):
        return f"postgresql://morsel@/{database}?host={self.folder}"

    def create(self, database, *options):
        """Makes an empty database, with the options of createdb, and returns its address."""
        self.run("createdb", "--host", self.folder, "--username", "morsel", *options, database)
        return self.address(database)

    def drop(self, database):
        self.run("dropdb", "--host", self.folder, "--username", "morsel", "--force", database)

    def give(self, folder):
        """Makes the folder the server's own, as one of a tablespace has to be."""
        if self.account:
            os.chown(folder, self.account.pw_uid, self.account.pw_gid)

    def ask(self, database, statement):
        """What psql prints for it."""
        return subprocess.run(
            [str(programs() / "psql"), "--no-psqlrc", "--quiet", "--tuples-only", "--no-align",
             "--set=ON_ERROR_STOP=1", "--command", statement, self.address(database)],
            cwd="/", stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL, check=True, timeout=120).stdout.decode().strip()

    def close(self):
        with contextlib.suppress(RuntimeError):  # stopped already
            self.stop("immediate")
        shutil.rmtree(self.folder, ignore_errors=True)


def main():
    if programs() is None:
        print("SKIPPED: PostgreSQL is not installed")
        return 77
    server = Server()
    try:
        environment = {**os.environ, "MORSEL_TEST_POSTGRES": server.address()}
        return subprocess.run(sys.argv[1:], env=environment, check=False).returncode
    finally:
        server.close()


if __name__ == "__main__":
    sys.exit(main())
