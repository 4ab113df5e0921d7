#!/usr/bin/env python3
"""The job of docs/scale-out.md on a Slurm of two nodes, one of which dies in the middle; all of it on
this machine. Usage: slurm_test.py MORSEL [UNITTEST-ARGUMENT…]"""

import getpass
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))

import cli
import database_test
import postgres
import shapes
from cli import DONE

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scancel", "unshare")
# A node: a process that takes all that it started with it when it is killed.
NODE = ["unshare", "--pid", "--fork", "--kill-child=KILL", "--mount-proc"]
TASKS = 4
SHAPES = 48
PATIENCE = 200  # seconds for anything to happen, on a busy machine

CONFIGURATION = """
ClusterName=morsel
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/%n.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SchedulerParameters=sched_interval=2,bf_interval=2,batch_sched_delay=0
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
NodeName=n1 NodeAddr=127.0.0.1 Port={ports[1]} CPUs=1 RealMemory=4000
NodeName=n2 NodeAddr=127.0.0.1 Port={ports[2]} CPUs=1 RealMemory=4000
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
"""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


def what_is_missing():
    """Why there can be no Slurm here; empty when there can."""
    for name in PROGRAMS:
        if shutil.which(name, path=os.environ["PATH"] + ":/usr/sbin:/sbin") is None:
            return f"{name} is not installed"
    if postgres.programs() is None:
        return "PostgreSQL is not installed"
    if subprocess.run([*NODE, "true"], capture_output=True, check=False).returncode != 0:
        return "processes cannot be separated into nodes here"
    return ""


def job_script():
    """The batch file of the documentation."""
    text = (cli.PROJECT / "docs/scale-out.md").read_text()
    return re.search(r"```bash\n(#!/bin/bash\n#SBATCH.*?)```", text, re.DOTALL).group(1)


@unittest.skipIf(what_is_missing(), what_is_missing())
class Slurm(database_test.DatabaseTest):
    def setUp(self):
        super().setUp()
        self.environment["PATH"] += ":/usr/sbin:/sbin"
        self.server = postgres.Server()
        self.addCleanup(self.server.close)
        self.place = self.server.create("shapes")
        self.cluster = self.folder / "cluster"
        for name in ("state", "n1", "n2"):
            (self.cluster / name).mkdir(parents=True)
        self.put("cluster/slurm.conf", CONFIGURATION.format(
            host=socket.gethostname(), user=getpass.getuser(), folder=self.cluster,
            ports=free_ports(3)))
        self.environment["SLURM_CONF"] = str(self.cluster / "slurm.conf")
        self.put("cluster/munge.key", os.urandom(1024)).chmod(0o600)
        self.daemon("munged", "--foreground", "--force", f"--key-file={self.cluster}/munge.key",
                    *(f"--{name}-file={self.cluster}/munge.{name}"
                      for name in ("pid", "log", "seed")),
                    f"--socket={self.cluster}/munge.socket")
        self.wait("munge", (self.cluster / "munge.socket").exists)
        self.daemon("slurmctld", "-D")
        self.nodes = {name: self.node(name) for name in ("n1", "n2")}
        self.wait("nodes", lambda: self.ask("sinfo", "--noheader", "--Node", "--format=%T")
                  .split() == ["idle", "idle"])

    def daemon(self, *command):
        with (self.cluster / f"{len(list(self.cluster.iterdir()))}.log").open("wb") as log:
            process = subprocess.Popen(command, env=self.environment, stdout=log, stderr=log,
                                       cwd=self.cluster, stdin=subprocess.DEVNULL)
        self.addCleanup(self.end, process)
        return process

    def node(self, name):
        return self.daemon(*NODE, "slurmd", "-D", "-N", name)

    @staticmethod
    def end(process):
        process.send_signal(signal.SIGKILL if process.args[0] == "unshare" else signal.SIGTERM)
        try:
            process.wait(timeout=20)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()

    def logs(self):
        return "\n".join(f"== {path.name}\n{path.read_text(errors='replace')[-2000:]}"
                         for path in sorted(self.cluster.glob("*.log")))

    def wait(self, what, is_so):
        give_up = time.monotonic() + PATIENCE
        while not is_so():
            self.assertLess(time.monotonic(), give_up, f"{what} did not come\n{self.logs()}")
            time.sleep(0.1)

    def ask(self, *command):
        return subprocess.run(command, env=self.environment, cwd=self.folder, timeout=PATIENCE,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              check=False).stdout.decode()

    def submit(self):
        out = self.ask("sbatch", "--parsable", f"--array=0-{TASKS - 1}", "--output=%a.out",
                       "--export=ALL", "job.sh")
        self.assertRegex(out, r"\A\d+\n\Z", self.logs())

    def count(self):
        try:
            return int(self.server.ask("shapes", "SELECT count(*) FROM morsel.shapes"))
        except subprocess.CalledProcessError:  # no tables yet
            return 0

    def running_on(self, node):
        return self.ask("squeue", "--noheader", "--states=RUNNING", f"--nodelist={node}")

    def test_a_node_dies(self):
        for i in range(SHAPES):
            kind = ("ball", "stick", "cross")[i % 3]
            self.put(f"models/{i}.xyz", shapes.xyz(database_test.solid(kind, i, 3000)))
        self.put("manifest.txt", "".join(f"models/{i}.xyz\n" for i in range(SHAPES)))
        self.put("job.sh", job_script())
        self.environment["MORSEL_DATABASE"] = self.place
        self.environment["MORSEL_MANIFEST"] = str(self.folder / "manifest.txt")
        self.environment["PATH"] = f"{pathlib.Path(cli.MORSEL).parent}:{self.environment['PATH']}"

        self.submit()
        self.wait("shapes", lambda: self.count() >= SHAPES // 8 and self.running_on("n2"))
        self.end(self.nodes["n2"])
        self.ask("scontrol", "update", "nodename=n2", "state=down", "reason=died")
        self.assertLess(self.count(), SHAPES)
        status = self.ask(cli.MORSEL, "index", "--database", self.place, "models", "--status")
        self.assertRegex(status, rf"of {SHAPES} files \d+ are done, 0 failed, \d+ are left")
        self.ask("scancel", "--full", "--user", getpass.getuser())
        self.wait("an empty queue", lambda: not self.ask("squeue", "--noheader"))
        self.assertLess(self.count(), SHAPES)

        self.node("n2")
        self.wait("nodes", lambda: self.ask("sinfo", "--noheader", "--Node", "--format=%T")
                  .split() == ["idle", "idle"])
        self.submit()
        self.wait("the end", lambda: not self.ask("squeue", "--noheader"))
        for i in range(TASKS):
            self.assertIn(f"shard {i} of {TASKS}: ", (self.folder / f"{i}.out").read_text())
        status = self.ask(cli.MORSEL, "index", "--database", self.place, "models", "--status")
        self.assertIn(f"{SHAPES} are done, 0 failed, 0 are left", status)
        self.assertIn("nothing wrong", self.ask(cli.MORSEL, "check", "--database", self.place))

        self.assertEqual(self.run_morsel("index", "--database", "one.db", "models").returncode,
                         DONE)
        self.assertEqual(self.ask(cli.MORSEL, "export", "--database", self.place),
                         self.ask(cli.MORSEL, "export", "--database", "one.db"))


if __name__ == "__main__":
    cli.main(__doc__)
