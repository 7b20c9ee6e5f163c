# SPDX-License-Identifier: Apache-2.0
"""Runs the pair for a long time while a seeded schedule disturbs it, and judges it by criteria. See soak.sh --help."""

import argparse
import http.client
import json
import os
import re
import signal
import subprocess
import sys
import time
import tomllib
import urllib.error
import urllib.request

import judge
import page
import schedule
import services

HEALTH_LIMIT_S = 2.0
SILENCE_LIMIT_S = 60.0  # wall time without a sample after which the soak gives up


def seconds(text):
    match = re.fullmatch(r"(\d+(?:\.\d+)?)(s|m|h)", text)
    if not match or float(match[1]) <= 0.0:
        raise argparse.ArgumentTypeError(f"'{text}', allowed is a positive number with s, m or h, such as 10m or 72h")
    return float(match[1]) * {"s": 1, "m": 60, "h": 3600}[match[2]]


def exit_usage(what):
    print(f"soak.sh: {what}", file=sys.stderr)
    sys.exit(2)


SHIPPED = os.path.join(os.path.dirname(os.path.abspath(__file__)), "criteria.toml")


def read_toml(path):
    try:
        with open(path, "rb") as f:
            return tomllib.load(f)
    except (OSError, tomllib.TOMLDecodeError) as e:
        exit_usage(f"{path}: {e}")


def read_criteria(path):
    """The shipped criteria, with those of the file in their place."""
    criteria, own = read_toml(SHIPPED), read_toml(path)
    for name, limit in own.items():
        if name not in criteria:
            exit_usage(f"{path}: '{name}' is no criterion; allowed are {', '.join(criteria)}")
        if not isinstance(limit, dict) or len(limit) != 1 or set(limit) - {"min", "max"} or \
                not isinstance(next(iter(limit.values())), (int, float)):
            exit_usage(f"{path}: '{name}' needs exactly one of min and max, a number")
    return criteria | own


def parse(arguments):
    here = os.path.dirname(os.path.abspath(__file__))
    parser = argparse.ArgumentParser(
        prog="soak.sh", description="Flies engine_sim and monitor while a seeded schedule of sensor faults, component "
        "steps, kills, pauses, network faults, reloads, bad samples, full disks, a log that nobody reads and HTTP floods "
        "disturbs them; judges what happened.",
        epilog="Exit codes: 0 every criterion held, 1 one did not or the soak broke off, 2 wrong usage. "
        "The report is DIR/soak.html, the raw record DIR/record.jsonl, the logs of all programs DIR/*.log.")
    parser.add_argument("--duration", type=seconds, default=600.0, metavar="10m|72h",
                        help="of flight, in source time (default 10m)")
    parser.add_argument("--accelerated", action="store_true",
                        help="as fast as the monitor answers; all clocks are source time; no network faults then")
    parser.add_argument("--criteria", default=SHIPPED, metavar="FILE",
                        help="TOML; what it does not name is judged as tests/soak/criteria.toml has it")
    parser.add_argument("--seed", type=int, default=1, help="of schedule, network and hostile peer (default 1)")
    parser.add_argument("--design", metavar="FILE", help="of the monitor (default: made for the demo's cruise point)")
    parser.add_argument("--build", default=os.path.join(here, "..", "..", "build"), metavar="DIR")
    parser.add_argument("--out", default="soak_out", metavar="DIR", help="for report, record and logs (default soak_out)")
    parser.add_argument("--fifo", action="store_true", help="the monitor runs its cycle under SCHED_FIFO")
    parser.add_argument("--json", action="store_true", help="print nothing but the result, as one JSON object")
    options = parser.parse_args(arguments)
    options.build, options.out = os.path.abspath(options.build), os.path.abspath(options.out)
    options.limits = read_criteria(options.criteria)
    if not os.path.exists(f"{options.build}/tests/soak/soak_agent"):
        exit_usage(f"{options.build}: no build with tests is there; run ./deploy/build.sh or give --build DIR")
    os.makedirs(options.out, exist_ok=True)
    return options


class Soak:
    def __init__(self, options):
        self.options = options
        self.rig = services.Rig(options)
        self.schedule = schedule.Schedule(self.rig, options.seed, options.accelerated)
        self.record = judge.Record()
        self.raw = open(os.path.join(options.out, "record.jsonl"), "w")
        self.pending, self.t, self.active = b"", 0.0, None
        self.start_wall = self.last_sample_wall = time.monotonic()
        self.next_draw_t = 12.0  # the filter has settled
        self.awaiting_restart = None  # wall time of a restart that has not been followed by estimates yet
        self.estimates = 0
        self.stop_wanted = False

    def wall(self):
        return time.monotonic() - self.start_wall

    def read_agent(self):
        chunk = self.rig.agent.process.stdout.read(1 << 16)
        if not chunk:
            time.sleep(0.01)
            return
        *lines, self.pending = (self.pending + chunk).split(b"\n")
        for text in lines:
            self.raw.write(text.decode() + "\n")
            self.hear(json.loads(text))

    def hear(self, line):
        self.t = max(self.t, line["t"])
        what = line["what"]
        if what == "second":
            self.last_sample_wall = time.monotonic()
            self.record.seconds.append(line)
            if line["estimates"] > self.estimates and self.awaiting_restart is not None:
                self.record.restarts_answered.append(self.wall() - self.awaiting_restart <= 15.0)
                self.awaiting_restart = None
            self.estimates = line["estimates"]
        elif what == "status":
            self.record.statuses.append(line)
        elif what == "gap":
            d = self.record.disturbance_at(line["t"])
            self.record.gaps.append(dict(line, during=d.kind if d else None))
        elif what == "double":
            self.record.doubles += 1
        elif what == "event":
            self.record.hear_event(line)
        elif what == "description" and not self.schedule.ready():
            self.schedule.describe(line)

    def disturb(self):
        if self.active:
            if not self.active.advance(self.t, self.wall()):
                self.say(f"{self.active.kind} over")
                self.next_draw_t = self.t + self.schedule.rng.uniform(0.2, 1.0) * self.longest_calm_s()
                self.active = None
            return
        left_s = self.options.duration - self.t
        if not self.schedule.ready() or self.t < self.next_draw_t or left_s < (10.0 if self.short() else 60.0):
            return
        d = self.schedule.draw(self.t, self.wall(), self.short(), lives_left=self.may_kill())
        if d is None:
            return
        self.active = d
        self.record.disturbances.append(d)
        if "restarts" in d.about:
            self.awaiting_restart = self.wall() + 1.5
        self.say(f"{d.kind} {d.about.get('name', '')} {d.about.get('size', '')}")

    def short(self):
        return self.options.duration < 300.0

    def longest_calm_s(self):
        return 2.0 if self.short() else 20.0 if not self.options.accelerated else 60.0

    def may_kill(self):
        """One life of a third of the soak at least stays whole, so that growth of memory can be seen."""
        share = self.t / self.options.duration
        return self.short() or not 0.33 < share < 0.67

    def watch_processes(self):
        for service in self.rig.services():
            if service is self.rig.agent and service.ended_by_itself():
                sys.exit(f"soak.sh: the agent ended, see {service.log_path}")
            if service.ended_by_itself():
                self.record.unexpected_exits.append((service.name, self.t, service.process.returncode))
                self.say(f"{service.name} ended by itself with {service.process.returncode}; started again")
                service.start()
            usage = service.usage()
            if usage:
                self.record.usage.setdefault(service.name, []).append((self.wall(), self.t, service.lives, usage))
                line = dict(usage, what="usage", t=self.t, service=service.name, life=service.lives)
                self.raw.write(json.dumps(line) + "\n")

    def ask_health(self):
        """How long the monitor's own word on its health takes, whoever floods it."""
        began = time.monotonic()
        try:
            with urllib.request.urlopen(f"http://127.0.0.1:{self.rig.port}/health", timeout=HEALTH_LIMIT_S) as answer:
                answer.read()
            wait_ms = 1e3 * (time.monotonic() - began)
        except urllib.error.HTTPError:  # 503 is an answer, too
            wait_ms = 1e3 * (time.monotonic() - began)
        except (OSError, http.client.HTTPException):
            wait_ms = judge.NO_ANSWER_MS
        self.record.health.append((self.active.kind if self.active else None, wait_ms))

    def say(self, what):
        if not self.options.json:
            print(f"{self.t:9.1f} s  {what}", flush=True)

    def run(self):
        """True when the whole duration was flown."""
        self.rig.start()
        next_watch = 0.0
        while self.t < self.options.duration and not self.stop_wanted:
            self.read_agent()
            self.disturb()
            if self.wall() >= next_watch:
                self.watch_processes()
                if self.estimates:
                    self.ask_health()
                next_watch = self.wall() + min(5.0, self.options.duration / 60.0)
            if time.monotonic() - self.last_sample_wall > SILENCE_LIMIT_S:
                self.say("no sample for a minute: the soak breaks off")
                return False
        return not self.stop_wanted

    def finish(self):
        codes = self.rig.stop()
        for name, code in codes.items():
            if code != 0:
                self.record.unexpected_exits.append((name, self.t, code))
        if self.awaiting_restart is not None and self.wall() - self.awaiting_restart > 15.0:
            self.record.restarts_answered.append(False)
        self.raw.close()


def main():
    options = parse(sys.argv[1:])
    options.design = os.path.abspath(options.design) if options.design else make_design(options)
    soak = Soak(options)

    def stop(*_):
        soak.stop_wanted = True

    signal.signal(signal.SIGINT, stop)
    signal.signal(signal.SIGTERM, stop)
    whole = False
    try:
        whole = soak.run()
    finally:
        soak.finish()
    warm_up_s = min(60.0, 0.3 * soak.wall())
    measured = judge.measure(soak.record, warm_up_s)
    rows = judge.verdicts(measured, options.limits)
    held = whole and all(row[3] for row in rows)
    summary = page.summary(options, soak, rows, whole, held)
    page.write(os.path.join(options.out, "soak.html"), soak, rows, summary)
    if options.json:
        print(json.dumps(dict(summary, criteria={r[0]: {"measured": r[1], "allowed": r[2], "held": r[3]} for r in rows})))
    else:
        print(page.text(summary, rows))
    sys.exit(0 if held else 1)


def make_design(options):
    """The demo's design, made once by the project's own commands."""
    model, design = (os.path.join(options.out, name) for name in ("model.json", "design.json"))
    if not os.path.exists(design):
        bench = f"{options.build}/tuner_design/tuner_design"
        quiet = {"stdout": subprocess.DEVNULL, "check": True}
        subprocess.run([bench, "linearise", "--method", "fleet", "--out", model], **quiet)
        subprocess.run([bench, "design", "--model", model, "--out", design], **quiet)
    return design


if __name__ == "__main__":
    main()
