# SPDX-License-Identifier: Apache-2.0
"""Peers on the wire that mean ill: samples, texts, orders."""

import os
import subprocess

from rig import Flight, Service, events, metric, require, until

CHANNELS = 10  # health parameters


def bad_samples(bench):
    """ehm_hostile: every kind of sample that no engine sends, unknown engines, counts beyond arrays."""
    with Flight(bench) as flight:
        sent = bench.flood(rate_hz=1000)
        dropped = {what: metric(f"ehm_samples_{what}_total") for what in ("foreign", "malformed")}
        dropped["unknown engine"] = metric("ehm_unknown_engine_samples_total")
        counts = ", ".join(f"{count:.0f} {what}" for what, count in dropped.items())
        require(all(dropped.values()), f"of {sent} sent samples: {counts}")
        require(events("filter_restart") == 0, "the filter was restarted")
        return f"{sent} sent: {counts}; {flight.unharmed()}"


def escapes(bench):
    """Names of channels that clear screens, set titles and end lines, under the name of the true source."""
    with Flight(bench, "--log-level", "trace") as flight:
        sent = bench.flood("text", 50, 4, "--source-id", "1")
        # Only who sends the samples describes them.
        require(events("source_channels") == 0, "a stranger's description was believed")
        held, log = flight.unharmed(), flight.log()
        bad = [c for c in log if (ord(c) < 32 and c != "\n") or 127 <= ord(c) < 160 or c == "\u202e"]
        require(not bad, f"the log has {sorted(set(map(repr, bad)))}")
        forged = [line for line in log.splitlines() if not line.startswith("[")]
        require(not forged, f"lines that the monitor has not begun: {forged[:2]}")
        return f"{sent} descriptions, {len(log.splitlines())} lines of log, none forged, no control character, no description believed; {held}"


def reset_flood(bench):
    """1000 resets a second for 5 s, each as an operator may order it."""
    with Flight(bench) as flight:
        size = os.path.getsize(flight.log_path("monitor"))
        sent = bench.flood("reset", 1000)
        restarts, held = metric("ehm_filter_restarts_total"), flight.unharmed()
        grown_kb = (os.path.getsize(flight.log_path("monitor")) - size) / 1000
        require(grown_kb < 100, f"the log grew by {grown_kb:.0f} kB")
        require(restarts <= 5, f"{restarts:.0f} restarts, one in two seconds is allowed")
        require(events("command_flood") > 0, "no event command_flood")
        return f"{sent} orders, {restarts:.0f} restarts, {grown_kb:.1f} kB of log, {held}"


def mortal_wear(bench):
    """SimCommand: health -0.3 of every parameter, at once and within 1 s."""
    with Flight(bench) as flight:
        agent = Service("soak_agent", [bench.agent, "--source-domain", "0", "--monitor-domain", "0"],
                        flight.log_path("agent"), stdin=subprocess.PIPE, stdout=subprocess.DEVNULL)
        agent.start()
        answered = lambda: flight.log("engine_sim").count("command ")  # noqa: E731
        try:
            # Orders from before the match are gone: the first one is said until it is answered.
            def first():
                agent.process.stdin.write(b"clear\n")
                agent.process.stdin.flush()
                return answered()

            said = until(first, "an answer of engine_sim")
            agent.process.stdin.write(b"".join(b"health %d -0.3 %d\n" % (channel, ramp_s)
                                               for ramp_s in (0, 1) for channel in range(CHANNELS)))
            agent.process.stdin.flush()
            until(lambda: answered() >= said + 2 * CHANNELS, "answers to all orders")
        finally:
            agent.kill()
        refused = flight.log("engine_sim").count("command refused")
        require(refused > 0, "none was refused")
        # Estimates of an engine so worn may be withheld; that samples flow is what counts.
        require(flight.simulator.process.poll() is None, "engine_sim ended")
        require(flight.monitor.process.poll() is None, "the monitor ended")
        received = metric("ehm_samples_received_total")
        until(lambda: metric("ehm_samples_received_total") > received + 200, "samples afterwards")
        return f"{2 * CHANNELS} orders, {refused} refused with the reason, samples go on, {metric('ehm_samples_lost_total'):.0f} lost"
