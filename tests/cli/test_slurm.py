# SPDX-License-Identifier: GPL-3.0-or-later
"""coagula dataset workflow on Slurm: a cluster of one node, with folder, keys and ports of its own."""

import getpass
import os
import secrets
import shutil
import signal
import socket
import subprocess
import time
import unittest

from support import PROGRAM, ProgramTest
from test_dataset import SWEEP, values

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "snakemake")
CONFIGURATION = """ClusterName=one
SlurmctldHost={host}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
SlurmctldPort={control_port}
SlurmdPort={node_port}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
MpiDefault=none
SwitchType=switch/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 RealMemory=8000 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def where(program):
    """Daemons lie where users do not look."""
    return shutil.which(program, path=os.environ["PATH"] + os.pathsep + "/usr/sbin" + os.pathsep + "/usr/local/sbin")


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    """Slurm with one node of two processors."""

    def __init__(self, folder):
        self.folder = folder
        self.environment = {**os.environ, "SLURM_CONF": str(folder / "slurm.conf")}
        for part in ("state", "spool"):
            (folder / part).mkdir(parents=True)
        folder.chmod(0o755)
        (folder / "munge.key").write_bytes(secrets.token_bytes(1024))
        (folder / "munge.key").chmod(0o400)
        control_port, node_port = free_ports(2)
        (folder / "slurm.conf").write_text(CONFIGURATION.format(host=socket.gethostname().split(".")[0], user=getpass.getuser(), folder=folder,
                                                                control_port=control_port, node_port=node_port))

    def __enter__(self):
        munge = [f"--{name}={self.folder}/{file}" for name, file in
                 (("key-file", "munge.key"), ("socket", "munge.socket"), ("pid-file", "munged.pid"), ("log-file", "munged.log"), ("seed-file", "munge.seed"))]
        try:
            self.start("munged", "--force", *munge)
            self.start("slurmctld", "-c")
            self.start("slurmd", "-c")
            self.wait_until_idle()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for name in ("slurmd", "slurmctld", "munged"):
            file = self.folder / f"{name}.pid"
            if file.exists():
                try:
                    os.kill(int(file.read_text()), signal.SIGTERM)
                except (ProcessLookupError, ValueError):
                    pass

    def start(self, program, *words):
        subprocess.run([where(program), *words], env=self.environment, check=True, timeout=60, stdout=subprocess.DEVNULL)

    def wait_until_idle(self):
        end = time.monotonic() + 60
        while time.monotonic() < end:
            state = subprocess.run(["sinfo", "--noheader", "--format=%t"], env=self.environment, capture_output=True, text=True, check=False).stdout
            if state.strip() == "idle":
                return
            time.sleep(0.2)
        raise AssertionError("the node does not become idle: " + (self.folder / "slurmctld.log").read_text()[-2000:])


@unittest.skipIf(missing := [name for name in PROGRAMS if where(name) is None],
                 f"Slurm is not complete here: {', '.join(missing)} of the packages slurmctld, slurmd, slurm-client, munge and snakemake are missing")
class Slurm(ProgramTest):
    def flow(self, cluster, programs):
        environment = {**cluster.environment, "PATH": str(programs) + os.pathsep + os.environ["PATH"], "HOME": str(self.folder)}
        return subprocess.run(["snakemake", "--profile", "slurm", "--quiet"], cwd=self.folder / "flow", env=environment, capture_output=True,
                              text=True, timeout=250, check=False)

    def test_the_set_of_a_cluster_is_that_of_one_machine(self):
        self.write("sweep.toml", SWEEP)
        self.succeed("dataset", "run", "sweep.toml", "-o", "whole.h5")
        self.succeed("dataset", "workflow", "sweep.toml", "-o", "flow", "--chunks", 3)
        with Cluster(self.folder / "slurm") as cluster:
            done = self.flow(cluster, os.path.dirname(PROGRAM))
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertGreaterEqual(len(list((self.folder / "flow" / "slurm").glob("job-*.log"))), 3)  # each chunk was a job
        self.assertEqual(values(self.folder / "flow" / "set.h5"), values(self.folder / "whole.h5"))

    def test_a_job_that_fails_ends_the_run(self):
        self.write("sweep.toml", SWEEP)
        self.succeed("dataset", "workflow", "sweep.toml", "-o", "flow", "--chunks", 2)
        (self.folder / "bin").mkdir()
        (self.folder / "bin" / "coagula").symlink_to("/bin/false")
        with Cluster(self.folder / "slurm") as cluster:
            self.assertNotEqual(self.flow(cluster, self.folder / "bin").returncode, 0)


if __name__ == "__main__":
    unittest.main()
