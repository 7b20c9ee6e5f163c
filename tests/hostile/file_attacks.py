# SPDX-License-Identifier: Apache-2.0
"""Paths that are no files, descriptors that are no more, an output that takes nothing."""

import os
import resource
import time

from rig import Flight, metric, require, until

END_LIMIT_S = 5.0


def pipe_in(bench):
    path = os.path.join(bench.new_folder(), "pipe")
    os.mkfifo(path)
    return path


def refused(bench, arguments, word, **popen):
    """Ends by itself with 2, and says why; seconds that it took."""
    began = time.monotonic()
    code, said = bench.run(arguments, **popen)
    took_s = time.monotonic() - began
    name = os.path.basename(arguments[0])
    require(code == 2, f"{name} {arguments[-1]}: exit code {code}: {said[-300:]}")
    require(word in said, f"{name} {arguments[-1]}: does not say '{word}': {said[-300:]}")
    require(took_s < END_LIMIT_S, f"{name} {arguments[-1]}: took {took_s:.1f} s")
    return took_s


def no_files_at_start(bench):
    """A pipe and /dev/zero as design, configuration and model."""
    cases = [(path, word, arguments) for path, word in ((pipe_in(bench), "is a pipe"), ("/dev/zero", "is a device"))
             for arguments in ([bench.monitor, "--monitor-design"], [bench.monitor, "--config"],
                               [bench.engine_sim, "--config"], [bench.tuner_design, "check"])]
    longest_s = max(refused(bench, arguments + [path], word) for path, word, arguments in cases)
    return f"{len(cases)} starts refused by name with exit code 2, the longest took {longest_s:.2f} s"


def no_files_at_reload(bench):
    """The same as design, and as the configuration itself, at reloads in flight."""
    pipe = pipe_in(bench)
    with Flight(bench) as flight:
        refusals, longest_s = 0, 0.0

        def reload_is_refused(word):
            nonlocal refusals, longest_s
            refusals += 1
            began = time.monotonic()
            flight.reload()
            until(lambda: metric("ehm_reloads_refused_total") == refusals, f"refusal of what {word}", END_LIMIT_S)
            longest_s = max(longest_s, time.monotonic() - began)
            until(lambda: flight.log().count(word) > 0, f"the log on what {word}")

        for path, word in ((pipe, "is a pipe"), ("/dev/zero", "is a device")):
            flight.configure(design=path)
            reload_is_refused(word)
        os.replace(pipe, flight.toml)
        reload_is_refused("monitor.toml: is a pipe")
        os.remove(flight.toml)
        flight.configure()
        flight.reload()
        until(lambda: metric("ehm_reloads_total") == 1, "a good reload afterwards")
        return f"{refusals} reloads refused by name, the longest took {longest_s:.2f} s, a good one taken, {flight.unharmed()}"


def few_descriptors(bench):
    """ulimit -n 8: not enough to fly."""
    def limit():
        resource.setrlimit(resource.RLIMIT_NOFILE, (8, 8))

    longest_s = max(refused(bench, arguments, "descriptors", preexec_fn=limit) for arguments in (
        [bench.monitor, "--monitor-design", bench.design], [bench.engine_sim, "--run-duration-s", "1"]))
    return f"monitor and engine_sim refuse to start, with the reason and exit code 2, within {longest_s:.2f} s"


def full_output(bench):
    """Standard output on /dev/full."""
    cases = [[bench.tuner_design, "--help"], [bench.tuner_design, "check", bench.design],
             [bench.tuner_design, "check", bench.design, "--json"], [bench.tuner_design, "--man"],
             [bench.engine_sim, "--print-config"], [bench.monitor, "--print-config"], [bench.ehm_watch, "--help"]]
    for arguments in cases:
        with open("/dev/full", "wb") as full:
            code, said = bench.run(arguments, stdout=full)
        shown = " ".join([os.path.basename(arguments[0])] + arguments[1:])
        require(code == 1, f"{shown}: exit code {code}")
        require("standard output cannot be written" in said, f"{shown}: says '{said[-200:]}'")
    return f"{len(cases)} outputs that nobody got, {len(cases)} times exit code 1 and the reason"
