# SPDX-License-Identifier: Apache-2.0
"""Signals at bad moments, a reader of the log that hangs, a monitor that is stopped."""

import fcntl
import os
import signal
import subprocess
import time

from rig import STOP_LIMIT_S, Flight, Service, events, fetch, is_ready, metric, require, until


def catches(pid, number):
    """Whether the process has a handler for the signal: before, it is the loader's, and dies as any program does."""
    try:
        with open(f"/proc/{pid}/status") as f:
            caught = next(line for line in f if line.startswith("SigCgt"))
        return int(caught.split()[1], 16) >> (number - 1) & 1
    except (OSError, StopIteration):
        return False


def early_signals(bench):
    """SIGHUP thrice as soon as it is caught; SIGTERM after 0 to 500 ms."""
    path = os.path.join(bench.new_folder(), "monitor.log")
    monitor = Service("monitor", [bench.monitor, "--monitor-design", bench.design], path)

    def log():
        with open(path) as f:
            return f.read()

    monitor.start()
    until(lambda: catches(monitor.process.pid, signal.SIGHUP), "a handler of SIGHUP")
    for _ in range(3):
        monitor.signal(signal.SIGHUP)
    until(lambda: monitor.process.poll() is not None or fetch("/health"), "/health after SIGHUP")
    code = monitor.process.poll()
    require(code is None, f"SIGHUP at the start ended the monitor with {code}")
    until(lambda: "designs reloaded" in log(), "the reload that was asked for at the start")
    monitor.stop()
    longest_s, delays_ms = 0.0, (0, 2, 5, 10, 20, 35, 50, 75, 100, 150, 200, 300, 400, 500)
    for delay_ms in delays_ms:
        monitor.start()
        time.sleep(1e-3 * delay_ms)  # the moment is the attack
        began = time.monotonic()
        code = monitor.stop()
        longest_s = max(longest_s, time.monotonic() - began)
        require(code in (0, -signal.SIGTERM), f"SIGTERM after {delay_ms} ms: exit code {code}")
    require(longest_s < STOP_LIMIT_S, f"a stop took {longest_s:.2f} s")
    return f"SIGHUP is remembered; {len(delays_ms)} early stops, the longest took {longest_s:.2f} s"


def deaf_log_reader(bench):
    """SIGSTOP of who reads the log, behind a pipe of one page, at level trace."""
    reading, writing = os.pipe()
    fcntl.fcntl(writing, fcntl.F_SETPIPE_SZ, 4096)
    reader = subprocess.Popen(["cat"], stdin=reading, stdout=subprocess.DEVNULL)
    os.close(reading)
    try:
        with Flight(bench, "--log-level", "trace", stderr=writing) as flight:
            reader.send_signal(signal.SIGSTOP)
            before = events("filter_restart")
            bench.flood("reset", 200, 2)
            until(lambda: events("filter_restart") > before, "the event of a reset")
            age_s = metric("ehm_status_age_seconds", engine="1")
            require(age_s < 1.0, f"the status is {age_s:.1f} s old")
            held = flight.unharmed()
            lost_lines = metric("ehm_log_lines_lost_total")
            took_s = flight.stop()
            return f"events and status go on, {lost_lines:.0f} lines lost and counted, stop in {took_s:.2f} s, {held}"
    finally:
        os.close(writing)
        reader.kill()
        reader.wait()


def held_up(bench):
    """SIGSTOP of the monitor for 6 s, longer than its lease of 5 s."""
    with Flight(bench) as flight:
        flight.monitor.signal(signal.SIGSTOP)
        time.sleep(6.0)  # the hold is the attack
        flight.monitor.signal(signal.SIGCONT)
        began = time.monotonic()
        until(lambda: events("held_up") == 1, "event held_up")
        until(lambda: metric("ehm_condition_active", kind="held_up") == 0, "the end of held_up")
        flown = metric("ehm_samples_processed_total")
        until(lambda: metric("ehm_samples_processed_total") > flown + 100 and is_ready(), "estimates after the hold")
        back_s = time.monotonic() - began
        require("held up for" in flight.log(), "the log does not say it")
        return f"event held_up, 100 estimates {back_s:.1f} s after the hold, stop in {flight.stop():.2f} s"
