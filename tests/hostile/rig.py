# SPDX-License-Identifier: Apache-2.0
"""The pair under attack, in the network namespace that hostile.sh has made, seen through /metrics, exit codes and logs."""

import http.client
import os
import re
import signal
import subprocess
import sys
import tempfile
import time

SOAK = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "soak")
sys.path.insert(0, SOAK)
from services import Service  # noqa: E402

ADDRESS = ("127.0.0.1", 9477)
SAMPLES_AFTER = 100  # estimates that show that the flight goes on
STOP_LIMIT_S = 4.0  # the 2 s of resilience.md, and what a busy disk needs to let go of a process in fsync


class Broken(Exception):
    """What did not hold."""


def require(holds, what):
    if not holds:
        raise Broken(what)


def until(condition, what, limit_s=20.0):
    """The value of the condition once it is true."""
    end = time.monotonic() + limit_s
    while True:
        value = condition()
        if value:
            return value
        require(time.monotonic() < end, f"{what}: not within {limit_s:g} s")
        time.sleep(0.02)


def fetch(path, timeout_s=2.0):
    """(status, body), or None where no whole answer came."""
    try:
        connection = http.client.HTTPConnection(*ADDRESS, timeout=timeout_s)
        connection.request("GET", path)
        answer = connection.getresponse()
        return answer.status, answer.read().decode(errors="replace")
    except (OSError, http.client.HTTPException):
        return None
    finally:
        connection.close()


def is_ready():
    answer = fetch("/ready")
    return answer is not None and answer[0] == 200


def metric(name, **labels):
    """Sum of all series of that name with these labels, 0 if there are none."""
    answer, total = until(lambda: fetch("/metrics"), "/metrics"), 0.0
    for found, value in re.findall(rf"^{name}(?:{{(.*)}})? (\S+)$", answer[1], re.MULTILINE):
        if all(f'{key}="{wanted}"' in found for key, wanted in labels.items()):
            total += float(value)
    return total


def events(kind):
    return metric("ehm_events_total", kind=kind)


class Bench:
    """Where the programs are, and a folder for what an attack leaves behind."""

    def __init__(self, build, design, folder):
        self.build, self.design, self.folder = build, design, folder
        self.monitor = f"{build}/monitor/monitor"
        self.engine_sim = f"{build}/engine_sim/engine_sim"
        self.tuner_design = f"{build}/tuner_design/tuner_design"
        self.ehm_watch = f"{build}/deploy/ehm_watch"
        self.agent = f"{build}/tests/soak/soak_agent"
        self.hostile = f"{build}/tests/tools/ehm_hostile"

    def programs(self):
        return (self.monitor, self.engine_sim, self.tuner_design, self.ehm_watch, self.agent, self.hostile)

    def new_folder(self):
        return tempfile.mkdtemp(dir=self.folder)

    def run(self, arguments, limit_s=20.0, **popen):
        """A program to its end: (exit code, what it said). One that does not end is broken."""
        try:
            run = subprocess.run(arguments, stdout=popen.pop("stdout", subprocess.PIPE), stderr=subprocess.PIPE,
                                 timeout=limit_s, stdin=subprocess.DEVNULL, **popen)
        except subprocess.TimeoutExpired:
            raise Broken(f"{' '.join(arguments)}: has not ended within {limit_s:g} s") from None
        said = (run.stdout or b"") + run.stderr
        return run.returncode, said.decode(errors="replace")

    def flood(self, kinds="", rate_hz=400, seconds=5, *more):
        """ehm_hostile to its end."""
        chosen = ["--kinds", kinds] if kinds else []
        code, said = self.run([self.hostile, "--rate-hz", str(rate_hz), "--duration-s", str(seconds), *chosen, *more],
                              limit_s=seconds + 20.0)
        require(code == 0, f"ehm_hostile ended with {code}: {said}")
        return re.findall(r'"total":(\d+)', said)[0]


MONITOR_TOML = """[monitor]
design = "{design}"
status_period_s = 0.1
[checks]
source_id = 1  # the simulator, as a monitor that knows its source has it
{more}
"""


class Flight:
    """engine_sim and monitor from the first estimate on; both end with the block."""

    def __init__(self, bench, *flags, toml="", **popen):
        self.bench, self.folder = bench, bench.new_folder()
        self.toml = os.path.join(self.folder, "monitor.toml")
        self.configure(toml)
        self.monitor = Service("monitor", [bench.monitor, "--config", self.toml, *flags], self.log_path("monitor"), **popen)
        self.simulator = Service("engine_sim", [bench.engine_sim, "--config", os.path.join(SOAK, "engine.toml"),
                                                "--run-wait-for-monitors", "1"], self.log_path("engine_sim"))

    def log_path(self, name):
        return os.path.join(self.folder, name + ".log")

    def log(self, name="monitor"):
        with open(self.log_path(name), "rb") as f:
            return f.read().decode(errors="replace")

    def configure(self, more="", design=None):
        with open(self.toml, "w") as f:
            f.write(MONITOR_TOML.format(design=design or self.bench.design, more=more))

    def __enter__(self):
        try:
            self.monitor.start()
            self.simulator.start()
            self.await_estimates()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for service in (self.simulator, self.monitor):
            if service.process and service.process.poll() is None:
                service.kill()

    def await_estimates(self, limit_s=30.0):
        """From here on the flight is measured."""
        until(lambda: self.monitor.process.poll() is not None or is_ready(), "estimates", limit_s)
        require(self.monitor.process.poll() is None, f"the monitor ended: {self.log()[-400:]}")
        self.rss_mb = self.monitor.usage()["rss_mb"]
        self.lost, self.processed = metric("ehm_samples_lost_total"), metric("ehm_samples_processed_total")

    def unharmed(self, lost=0, rss_growth_mb=20.0):
        """What was held since the estimates began, as text."""
        for service in (self.monitor, self.simulator):
            code = service.process.poll()
            require(code is None, f"{service.name} ended with {code}: {self.log(service.name)[-400:]}")
        after = metric("ehm_samples_processed_total")
        until(lambda: metric("ehm_samples_processed_total") > after + SAMPLES_AFTER and is_ready(),
              "estimates after the attack", 40.0)
        now_lost = metric("ehm_samples_lost_total") - self.lost
        flown = metric("ehm_samples_processed_total") - self.processed
        rss_mb = self.monitor.usage()["rss_mb"]
        require(now_lost <= lost, f"{now_lost:.0f} samples lost")
        require(rss_mb - self.rss_mb < rss_growth_mb, f"memory grew from {self.rss_mb:.1f} to {rss_mb:.1f} MB")
        return f"{flown:.0f} estimates, {now_lost:.0f} samples lost, memory {self.rss_mb:.1f} to {rss_mb:.1f} MB"

    def reload(self):
        self.monitor.signal(signal.SIGHUP)

    def stop(self, limit_s=STOP_LIMIT_S):
        """An ordered stop of the monitor: seconds that it took."""
        began = time.monotonic()
        code = self.monitor.stop(limit_s=10)
        took_s = time.monotonic() - began
        require(code == 0, f"the monitor stopped with exit code {code}")
        require(took_s < limit_s, f"the stop took {took_s:.2f} s")
        return took_s
