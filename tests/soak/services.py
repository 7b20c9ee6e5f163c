# SPDX-License-Identifier: Apache-2.0
"""The processes of a soak: started, killed, paused, watched."""

import fcntl
import os
import resource
import shutil
import signal
import socket
import subprocess
import sys
import time


class Service:
    """One program that is meant to run all the time, over several lives."""

    def __init__(self, name, arguments, log_path, **popen):
        self.name, self.arguments, self.log_path, self.popen = name, arguments, log_path, popen
        self.process, self.lives, self.meant_to_run = None, 0, False

    def start(self):
        with open(self.log_path, "ab") as log:
            self.process = subprocess.Popen(self.arguments, **{"stdout": log, "stderr": log, **self.popen})
        self.lives += 1
        self.meant_to_run = True

    def signal(self, number):
        self.process.send_signal(number)

    def kill(self):
        self.meant_to_run = False
        self.process.kill()
        self.process.wait()

    def stop(self, limit_s=10):
        """In order; the exit code, or None when it had to be killed."""
        self.meant_to_run = False
        if self.process is None:
            return None
        self.process.send_signal(signal.SIGCONT)
        self.process.terminate()
        try:
            return self.process.wait(limit_s)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
            return None

    def ended_by_itself(self):
        return self.meant_to_run and self.process.poll() is not None

    def usage(self):
        """Resident memory in MB, open file descriptors, CPU seconds; None while it does not run."""
        pid = self.process.pid if self.process else 0
        try:
            with open(f"/proc/{pid}/statm") as f:
                rss_mb = int(f.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6
            with open(f"/proc/{pid}/stat") as f:
                fields = f.read().rsplit(")", 1)[1].split()
            cpu_s = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
            return {"rss_mb": rss_mb, "fds": len(os.listdir(f"/proc/{pid}/fd")), "cpu_s": cpu_s}
        except (OSError, IndexError):
            return None


MONITOR_TOML = """# The soak's monitor; a reload changes how much is logged.
[monitor]
design = "{design}"
clock = "{clock}"
[checks]
source_id = 1  # the simulator: the hostile peer must not take its place while it is down or held up
[checkpoint]
directory = "{checkpoints}"
period_s = 2.0
[metrics]
listen = "127.0.0.1:{port}"
[log]
level = "{log_level}"
"""
LOG_PIPE_BYTES = 4096  # the least that a pipe has: a reader that hangs is felt at once


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


class Rig:
    """engine_sim -> (ehm_impair) -> monitor, and the agent that watches both ends."""

    def __init__(self, options):
        self.options = options
        self.out = options.out
        source_domain = 40 + os.getpid() % 90 * 2
        monitor_domain = source_domain if options.accelerated else source_domain + 1
        build = options.build
        self.checkpoints = os.path.join(self.out, "checkpoints")
        shutil.rmtree(self.checkpoints, ignore_errors=True)  # of an earlier soak
        os.makedirs(self.checkpoints)
        self.monitor_toml = os.path.join(self.out, "monitor.toml")
        self.port = free_port()
        self.write_config()
        self.pipe = os.path.join(self.out, "pipe")  # not among the checkpoints, which are damaged on purpose
        if not os.path.exists(self.pipe):  # of an earlier soak
            os.mkfifo(self.pipe)
        scenario = os.path.join(os.path.dirname(__file__), "engine.toml")

        def log(name):
            return os.path.join(self.out, name + ".log")

        log_end, self.log_pipe = os.pipe()
        fcntl.fcntl(self.log_pipe, fcntl.F_SETPIPE_SZ, LOG_PIPE_BYTES)
        self.log_reader = Service("log reader", ["cat"], log("monitor"), stdin=log_end)
        self.monitor = Service("monitor", [f"{build}/monitor/monitor", "--config", self.monitor_toml,
                                           "--dds-domain", str(monitor_domain)] + realtime(options), log("monitor"),
                               stdout=self.log_pipe, stderr=self.log_pipe)
        self.simulator = Service("engine_sim", [
            f"{build}/engine_sim/engine_sim", "--config", scenario, "--dds-domain", str(source_domain),
            "--run-rate", "max" if options.accelerated else "1", "--run-wait-for-monitors", "1",
            "--run-seed", str(options.seed)], log("engine_sim"))
        self.agent = Service("soak_agent", [
            f"{build}/tests/soak/soak_agent", "--source-domain", str(source_domain), "--monitor-domain",
            str(monitor_domain)], log("agent"), stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.impair = None if options.accelerated else Service("ehm_impair", [
            f"{build}/tests/tools/ehm_impair", "--from", str(source_domain), "--to",
            str(monitor_domain), "--seed", str(options.seed)], log("impair"), stdin=subprocess.PIPE)
        self.hostile = Service("ehm_hostile", [
            f"{build}/tests/tools/ehm_hostile", "--domain", str(monitor_domain), "--duration-s", "0", "--seed", str(options.seed)],
            log("hostile"))
        flood = os.path.join(os.path.dirname(__file__), "http_flood.py")
        self.http_flood = Service("http_flood", [sys.executable, "-B", flood, str(self.port)], log("http_flood"))

    def write_config(self, design=None, log_level="info"):
        with open(self.monitor_toml, "w") as f:
            f.write(MONITOR_TOML.format(design=design or self.options.design, log_level=log_level,
                                        clock="source" if self.options.accelerated else "monotonic",
                                        checkpoints=self.checkpoints, port=self.port))

    def fill_disk(self, full):
        """A limit on the size of files stands for it, as everywhere where nobody is root."""
        most = 0 if full else resource.RLIM_INFINITY
        resource.prlimit(self.monitor.process.pid, resource.RLIMIT_FSIZE, (most, resource.RLIM_INFINITY))

    def services(self):
        return [s for s in (self.agent, self.impair, self.monitor, self.simulator) if s]

    def start(self):
        self.log_reader.start()
        for service in self.services():
            service.start()
        os.set_blocking(self.agent.process.stdout.fileno(), False)

    def tell(self, line):
        self.agent.process.stdin.write((line + "\n").encode())
        self.agent.process.stdin.flush()

    def tell_network(self, line):
        self.impair.process.stdin.write((line + "\n").encode())
        self.impair.process.stdin.flush()

    def stop(self):
        """Exit codes of those that were to stop in order."""
        codes = {s.name: s.stop() for s in (self.simulator, self.monitor)}
        time.sleep(0.5)
        for service in (self.impair, self.agent, self.hostile, self.http_flood):
            if service:
                service.stop()
        os.close(self.log_pipe)  # the monitor's end is closed, too: the reader comes to the end of the log
        if self.log_reader.process:
            self.log_reader.signal(signal.SIGCONT)
            self.log_reader.process.wait(5)
        return codes


def realtime(options):
    return ["--realtime-policy", "fifo"] if options.fifo else []
