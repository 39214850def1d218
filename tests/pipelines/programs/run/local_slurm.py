# SPDX-License-Identifier: LGPL-2.1-or-later
"""A Slurm cluster on this machine: munged, slurmctld and one slurmd for each node, without systemd.

All of it runs as the user of the test and in a folder of its own. Nothing of the system's Slurm is
used but its programs.
"""
import getpass
import os
import pathlib
import random
import shutil
import socket
import subprocess
import threading
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol", "sinfo", "scancel")
# Below those of connections; clusters of this process do not share any.
PORTS = (12000, 32000)
PORTS_LOCK = threading.Lock()
USED_PORTS = set()

CONFIGURATION = """
ClusterName=local
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=120
CredType=cred/munge
SlurmctldPort={port}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
JobCompType=jobcomp/none
SchedulerParameters=batch_sched_delay=0,sched_interval=2,sched_min_interval=0
ReturnToService=2
SlurmctldTimeout=30
SlurmdTimeout=30
KillWait=2
MessageTimeout=10
SlurmdParameters=config_overrides
{nodes}
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def missing_programs():
    """The programs that are needed and not installed."""
    return [name for name in PROGRAMS if find(name) is None]


def find(program):
    return shutil.which(program, path=os.environ.get("PATH", "") + ":/usr/sbin:/sbin")


def is_free(port):
    with socket.socket() as each:
        try:
            each.bind(("127.0.0.1", port))
        except OSError:
            return False
    return True


def free_ports(number):
    """Ports that nothing listens on, each of them once. Connections are not given such low ones."""
    ports = []
    with PORTS_LOCK:
        while len(ports) < number:
            port = random.randrange(*PORTS)
            if port not in USED_PORTS and is_free(port):
                USED_PORTS.add(port)
                ports.append(port)
    return ports


class NotRunning(Exception):
    """The cluster cannot be started on this machine; the text states why."""


class LocalSlurm:
    """A cluster with nodes n1, n2, ... of one processor each. stop() ends it."""

    def __init__(self, folder, nodes=4):
        self.folder = pathlib.Path(folder)
        self.processes = {}
        self.environment = {**os.environ, "SLURM_CONF": str(self.folder / "slurm.conf")}
        # A Slurm job that runs this test must not reach into the jobs of its own cluster.
        for name in list(self.environment):
            if name.startswith(("SLURM_", "SBATCH_")) and name != "SLURM_CONF":
                del self.environment[name]
        self.nodes = [f"n{i + 1}" for i in range(nodes)]
        self.folder.mkdir(parents=True, exist_ok=True)
        self.folder.chmod(0o755)
        (self.folder / "state").mkdir()
        port, *node_ports = free_ports(nodes + 1)
        host = socket.gethostname().split(".")[0]
        lines = "\n".join(f"NodeName={name} NodeHostname={host} NodeAddr=127.0.0.1 Port={at} CPUs=1"
                          for name, at in zip(self.nodes, node_ports))
        (self.folder / "slurm.conf").write_text(CONFIGURATION.format(
            folder=self.folder, host=host, user=getpass.getuser(), port=port, nodes=lines))

    def start(self):
        """Starts everything, and waits for all nodes. Throws NotRunning."""
        self.start_munge()
        self.start_controller()
        for node in self.nodes:
            self.start_node(node)
        self.wait(lambda: self.call("sinfo", "--noheader", "--format=%t %D").split() ==
                  ["idle", str(len(self.nodes))], "the nodes are not idle")

    def start_munge(self):
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        files = {"key-file": "key", "socket": "socket", "pid-file": "pid", "log-file": "log",
                 "seed-file": "seed"}
        self.spawn("munged", "--foreground", "--force", "--num-threads=2",
                   *(f"--{option}={self.folder}/munge.{end}" for option, end in files.items()))
        self.wait((self.folder / "munge.socket").exists, "munged has no socket")

    def start_controller(self):
        self.spawn("slurmctld", "-D", "-f", self.folder / "slurm.conf")
        self.wait(lambda: "UP" in self.call("scontrol", "ping"), "slurmctld does not answer")

    def start_node(self, node):
        (self.folder / f"spool-{node}").mkdir(exist_ok=True)
        self.spawn("slurmd", "-D", "-N", node, "-f", self.folder / "slurm.conf", name=node)

    def spawn(self, program, *arguments, name=None):
        with open(self.folder / f"{name or program}.output", "ab") as output:
            self.processes[name or program] = subprocess.Popen(
                [find(program), *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=output,
                stderr=output, env=self.environment, cwd=self.folder)

    def stop(self):
        if "slurmctld" in self.processes:
            self.call("scancel", "--me", "--signal=KILL", "--full")
            self.call("scancel", "--me")
        for process in reversed(self.processes.values()):
            process.terminate()
        for process in self.processes.values():
            try:
                process.wait(timeout=20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        self.processes.clear()

    def wait(self, condition, otherwise, timeout=60):
        """Waits until the condition holds."""
        deadline = time.monotonic() + timeout
        while not condition():
            ended = [name for name, process in self.processes.items() if process.poll() is not None]
            if ended or time.monotonic() > deadline:
                texts = "".join(f"\n== {name}\n" + self.tail(name) for name in
                                ended or self.processes)
                raise NotRunning(f"{otherwise}; ended: {', '.join(ended) or 'nothing'}{texts}")
            time.sleep(0.1)

    def tail(self, name):
        texts = [self.folder / f"{name}.output", self.folder / f"{name}.log",
                 self.folder / f"slurmd-{name}.log"]
        return "".join(file.read_text(errors="replace")[-1500:] for file in texts if file.exists())

    def run(self, program, *arguments):
        """Runs any program as a user of this cluster."""
        return subprocess.run([program, *map(str, arguments)], env=self.environment, timeout=60,
                              capture_output=True, text=True, check=False)

    def call(self, program, *arguments):
        """What a program of Slurm prints; empty if it fails."""
        done = self.run(find(program), *arguments)
        return done.stdout if done.returncode == 0 else ""

    def jobs(self):
        """Name and state of the jobs that did not end."""
        return [line.split() for line in
                self.call("squeue", "--array", "--noheader", "--format=%j %t").splitlines()]

    def wait_for_jobs(self, timeout=600):
        """Waits for the end of all jobs. Slurm may list one that was killed for minutes, and repeats
        a task whose end a killed slurmctld did not store after some five."""
        self.wait(lambda: not self.jobs(), "jobs do not end", timeout)

    def state_of(self, job):
        """The state and the exit status of a job that ended, such as 'COMPLETED 0:0'."""
        fields = dict(word.split("=", 1) for word in
                      self.call("scontrol", "--oneliner", "show", "job", str(job)).split()
                      if "=" in word)
        return f"{fields.get('JobState')} {fields.get('ExitCode')}"
