"""A Slurm of one node, in a folder of its own: munged, slurmctld and slurmd as children of the caller, torn down with it."""

import ctypes
import os
import pwd
import secrets
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from pathlib import Path

PATIENCE = 300  # s until a wait is given up; it measures nothing
SLURM_CONF = """\
ClusterName=ursula
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket,cred_expire=5
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SlurmdParameters=config_overrides
SlurmdTimeout=5
MessageTimeout=4
SchedulerParameters=sched_interval=2,batch_sched_delay=0
KillWait=10
JobRequeue=0
ReturnToService=2
MinJobAge=600
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} State=UNKNOWN
PartitionName=main Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


class NoCluster(Exception):
    """It cannot be had here, and why."""


def wait_until(what, condition):
    """What the condition gives once it is true."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        found = condition()
        if found:
            return found
        time.sleep(0.1)
    raise AssertionError(f"in vain waited until {what}")


def die_with_parent():
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG


def free_ports(count):
    held = [socket.socket() for _ in range(count)]
    for one in held:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in held]
    for one in held:
        one.close()
    return ports


class Cluster:
    """`with Cluster(cpus) as cluster:`; `cluster.environment` is for whoever calls Slurm's commands."""

    def __init__(self, cpus):
        self.cpus, self.children = cpus, {}

    def __enter__(self):
        missing = [name for name in ("munged", "slurmctld", "slurmd", "sbatch") if not self.find(name)]
        if missing:
            raise NoCluster("there is no " + ", ".join(missing) + " here (Debian: slurm-wlm, munge)")
        if os.geteuid() != 0:
            raise NoCluster("only root can start it")
        self.folder = Path(tempfile.mkdtemp(prefix="ursula-slurm-"))
        try:
            self.start()
        except BaseException as error:
            logs = "".join(self.tail(log) for log in sorted(self.folder.glob("*.out.log")))
            self.stop()
            if isinstance(error, (AssertionError, OSError, subprocess.CalledProcessError)):
                raise NoCluster(f"it does not start: {error}\n{logs}") from error
            raise
        return self

    def __exit__(self, kind, value, traceback):
        if kind:
            print("".join(self.tail(log) for log in sorted(self.folder.glob("*.out.log"))))
        self.stop()

    @staticmethod
    def find(name):
        return shutil.which(name, path=os.environ.get("PATH", "") + ":/usr/sbin:/sbin")

    @staticmethod
    def tail(log):
        return f"--- {log.name}\n" + "".join(log.read_text(errors="replace").splitlines(True)[-15:])

    def start(self):
        self.folder.chmod(0o755)
        host, (controller_port, node_port) = socket.gethostname().split(".")[0], free_ports(2)
        for name in ("munge", "state", "spool"):
            (self.folder / name).mkdir(mode=0o755)
        (self.folder / "slurm.conf").write_text(SLURM_CONF.format(
            host=host, controller_port=controller_port, node_port=node_port, folder=self.folder, cpus=self.cpus,
            user=pwd.getpwuid(os.geteuid()).pw_name))
        self.environment = dict(os.environ, SLURM_CONF=str(self.folder / "slurm.conf"))
        key = self.folder / "munge" / "key"
        key.touch(mode=0o600)
        key.write_bytes(secrets.token_bytes(128))
        self.spawn("munged", "--foreground", f"--key-file={key}", f"--socket={self.folder}/munge/socket",
                   f"--pid-file={self.folder}/munge/pid", f"--log-file={self.folder}/munged.log",
                   f"--seed-file={self.folder}/munge/seed")
        wait_until("munged answers", (self.folder / "munge" / "socket").exists)
        self.spawn("slurmctld", "-D")
        self.start_node()

    def spawn(self, name, *arguments):
        with open(self.folder / f"{name}.out.log", "ab") as log:
            self.children[name] = subprocess.Popen([self.find(name), *arguments], stdin=subprocess.DEVNULL, stdout=log,
                                                   stderr=subprocess.STDOUT, env=self.environment,
                                                   preexec_fn=die_with_parent)

    def start_node(self):
        self.spawn("slurmd", "-D")
        wait_until("the node is up", lambda: self.node_state() in ("idle", "mixed", "allocated"))

    def node_state(self):
        for name, child in self.children.items():
            assert child.poll() is None, f"{name} ended with {child.returncode}"
        return self.call("sinfo", "--noheader", "--format=%T", check=False).strip()

    def fail_node(self):
        """As if its power had gone: daemon, steps and tasks end at once."""
        tasks = [int(line.split()[0]) for line in self.call("scontrol", "listpids").splitlines()[1:]]
        steps = {int(Path(f"/proc/{task}/stat").read_text().rsplit(")", 1)[1].split()[1]) for task in tasks
                 if Path(f"/proc/{task}").exists()} - set(tasks) - {1}
        slurmd = self.children.pop("slurmd")
        slurmd.kill()
        slurmd.wait()
        for process in [*steps, *tasks]:
            self.kill(process)
        wait_until("the node is seen to be down", lambda: self.node_state().startswith("down"))
        return len(tasks)

    @staticmethod
    def kill(process):
        try:
            os.kill(process, signal.SIGKILL)
        except ProcessLookupError:
            pass

    def call(self, *words, check=True):
        return subprocess.run(words, env=self.environment, check=check, text=True, stdout=subprocess.PIPE,
                              stderr=None if check else subprocess.DEVNULL).stdout

    def job(self, number):
        """What `scontrol show job` says: JobState, Restarts, ExitCode ..."""
        words = self.call("scontrol", "--oneliner", "show", "job", str(number)).split()
        return dict(word.split("=", 1) for word in words if "=" in word)

    def stop(self):
        if "slurmctld" in self.children and "slurmd" in self.children:
            self.call("scancel", "--signal=KILL", "--full", "--user=root", check=False)
            self.call("scancel", "--user=root", check=False)
            end = time.monotonic() + 20
            while self.call("squeue", "--noheader", check=False).strip() and time.monotonic() < end:
                time.sleep(0.2)
        for name in ("slurmd", "slurmctld", "munged"):
            child = self.children.pop(name, None)
            if child:
                child.terminate()
                try:
                    child.wait(timeout=20)
                except subprocess.TimeoutExpired:
                    child.kill()
                    child.wait()
        shutil.rmtree(self.folder, ignore_errors=True)
