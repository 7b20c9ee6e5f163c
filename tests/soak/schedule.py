# SPDX-License-Identifier: Apache-2.0
"""What a soak does to the pair: one table of disturbances, drawn by a seed, one at a time, each with time to recover.

A disturbance says which events it may raise (anything else raised is unexplained), and which one it must raise.
"""

import os
import random
import signal

SENSOR_FAULT, HEALTH_SHIFT, INPUT_LOST, RESTART, NO_DESIGN, SECOND_SOURCE = 1, 2, 5, 6, 8, 10
OPERATING_POINT, SAMPLE_TIME, AMBIGUOUS, SLOW_BIAS, CHECKPOINT, CONFIGURATION = 7, 9, 11, 12, 13, 14
DEADLINE, LIVELINESS, QOS = 15, 16, 17
FOUND = {SENSOR_FAULT, AMBIGUOUS, HEALTH_SHIFT, SLOW_BIAS, NO_DESIGN}
SILENCE = {INPUT_LOST, RESTART, CHECKPOINT, SECOND_SOURCE, DEADLINE, LIVELINESS}


class Disturbance:
    """One entry of the schedule while it lasts.

    steps: (clock, after_s, action); clock "t" is source time, "wall" is ours, both since the start.
    """

    def __init__(self, kind, start_t, start_wall, steps, lasts_s, recovery_s, allowed, **about):
        self.kind, self.start_t, self.start_wall = kind, start_t, start_wall
        self.steps, self.lasts_s, self.recovery_s, self.allowed = steps, lasts_s, recovery_s, allowed
        self.about = about  # what the judge wants to know: channel, size_sigma, ...
        self.done_t = self.done_wall = None  # source time and ours when the last step was taken
        self.end_t = None  # source time when the recovery was over
        self.events = []

    def advance(self, t, wall):
        """Takes the steps that are due; True while it lasts."""
        while self.steps:
            clock, after_s, action = self.steps[0]
            now = t - self.start_t if clock == "t" else wall - self.start_wall
            if now < after_s:
                return True
            action()
            self.steps.pop(0)
        if self.done_t is None:
            self.done_t, self.done_wall = t, wall
        if t < max(self.done_t, self.start_t + self.lasts_s) + self.recovery_s:
            return True
        # However fast source time runs: a process starts, and a reload is read, in our own time.
        if wall < self.done_wall + min(self.recovery_s, 2.0):
            return True
        self.end_t = t
        return False

    def covers(self, t):
        return self.start_t - 0.1 <= t and (self.end_t is None or t <= self.end_t + 0.1)


def sensor_fault(rig, rng, t, wall, sensors, kind):
    channel = rng.randrange(len(sensors))
    sigma = sensors[channel]["sigma"]
    size = rng.choice([-10, -7, -5, 5, 7, 10]) if kind == "bias" else 10.0 / 60.0 if kind == "drift" else 4.0
    magnitude = size if kind == "noise" else size * sigma
    lasts_s = 30.0 if kind == "drift" else 10.0
    return Disturbance(
        "sensor " + kind, t, wall,
        [("t", 0.0, lambda: rig.tell(f"sensor {channel} {kind} {magnitude:.9g} {lasts_s}"))],
        lasts_s, 25.0, FOUND, channel=channel, name=sensors[channel]["name"], size=size,
        must_find=kind in ("bias", "stuck", "dropout"))


def component_step(rig, rng, t, wall, health):
    channel = rng.randrange(len(health))
    return Disturbance(
        "component step", t, wall,
        [("t", 0.0, lambda: rig.tell(f"health {channel} -0.02 0")),
         ("t", 20.0, lambda: rig.tell(f"health {channel} 0.02 0"))],
        20.0, 25.0, FOUND, channel=channel, name=health[channel])


def kill_and_restart(service, rng, t, wall, before_start=lambda: None):
    return Disturbance(
        "kill " + service.name, t, wall,
        [("wall", 0.0, service.kill),
         ("wall", rng.uniform(0.2, 1.5), lambda: (before_start(), service.start()))],
        0.0, 20.0, SILENCE | FOUND, restarts=service.name)


def pause(service, rng, t, wall):
    return Disturbance(
        "pause " + service.name, t, wall,
        [("wall", 0.0, lambda: service.signal(signal.SIGSTOP)),
         ("wall", rng.uniform(0.1, 1.5), lambda: service.signal(signal.SIGCONT))],
        0.0, 10.0, SILENCE | {SAMPLE_TIME})


def network(rig, rng, t, wall):
    loss, jitter_ms = rng.uniform(0.0, 0.2), rng.uniform(0.0, 50.0)
    lines = [f"loss {loss:.3f}", f"jitter_ms {jitter_ms:.1f}", "duplicate 0.05"]
    calm = ["loss 0", "jitter_ms 0", "duplicate 0"]
    return Disturbance(
        "network", t, wall,
        [("t", 0.0, lambda: [rig.tell_network(line) for line in lines]),
         ("t", 10.0, lambda: [rig.tell_network(line) for line in calm])],
        10.0, 10.0, SILENCE | {SAMPLE_TIME}, name=f"loss {loss:.2f}, jitter {jitter_ms:.0f} ms")


def reload(rig, rng, t, wall):
    level = rng.choice(["info", "debug"])
    return Disturbance(
        "reload", t, wall,
        [("wall", 0.0, lambda: (rig.write_config(log_level=level), rig.monitor.signal(signal.SIGHUP)))],
        3.0, 5.0, {CONFIGURATION}, must_raise=[(CONFIGURATION, False)])


def bad_reload(rig, _rng, t, wall, kind, design):
    return Disturbance(
        kind, t, wall,
        [("wall", 0.0, lambda: (rig.write_config(design=design), rig.monitor.signal(signal.SIGHUP))),
         ("wall", 3.0, rig.write_config)],
        3.0, 5.0, {CONFIGURATION}, must_raise=[(CONFIGURATION, True)])


def hostile(rig, rng, t, wall):
    lasts_s = rng.uniform(3.0, 8.0)
    return Disturbance(
        "hostile peer", t, wall,
        [("wall", 0.0, rig.hostile.start), ("wall", lasts_s, rig.hostile.stop)],
        0.0, 15.0, {SECOND_SOURCE, RESTART, QOS, INPUT_LOST, CONFIGURATION})


def hung_log_reader(rig, rng, t, wall):
    """What happens meanwhile must be told all the same, by events."""
    lasts_s = rng.uniform(4.0, 10.0)
    return Disturbance(
        "hung log reader", t, wall,
        [("wall", 0.0, lambda: rig.log_reader.signal(signal.SIGSTOP)),
         ("wall", 1.0, lambda: rig.tell("reset")),
         ("wall", lasts_s, lambda: rig.log_reader.signal(signal.SIGCONT))],
        0.0, 15.0, {RESTART}, must_raise=[(RESTART, True)])


def full_disk(rig, rng, t, wall):
    lasts_s = rng.uniform(5.0, 10.0)  # two checkpoints at least
    return Disturbance(
        "full disk", t, wall,
        [("wall", 0.0, lambda: rig.fill_disk(True)), ("wall", lasts_s, lambda: rig.fill_disk(False))],
        0.0, 10.0, {CHECKPOINT}, must_raise=[(CHECKPOINT, True), (CHECKPOINT, False)])


def http_flood(rig, rng, t, wall):
    lasts_s = rng.uniform(3.0, 8.0)
    return Disturbance(
        "HTTP flood", t, wall,
        [("wall", 0.0, rig.http_flood.start), ("wall", lasts_s, rig.http_flood.stop)],
        0.0, 5.0, set())


def reset(rig, _rng, t, wall):
    return Disturbance("filter reset", t, wall, [("t", 0.0, lambda: rig.tell("reset"))], 0.0, 15.0, {RESTART})


def corrupt_checkpoint(rig):
    for name in os.listdir(rig.checkpoints):
        with open(os.path.join(rig.checkpoints, name), "r+b") as f:
            f.seek(20)
            f.write(b"\xff\x00\xff")


# What a soak of a minute tries.
SHORT = ("bias", "kill monitor", "hostile", "bad reload", "network")


class Schedule:
    """Draws disturbances from a bag that holds each kind once, so that a short soak sees many kinds."""

    def __init__(self, rig, seed, accelerated):
        self.rig, self.rng = rig, random.Random(seed)
        self.sensors, self.health = [], []
        makers = {
            "bias": lambda *a: sensor_fault(*a, self.sensors, "bias"),
            "component": lambda *a: component_step(*a, self.health),
            "stuck": lambda *a: sensor_fault(*a, self.sensors, "stuck"),
            "dropout": lambda *a: sensor_fault(*a, self.sensors, "dropout"),
            "noise": lambda *a: sensor_fault(*a, self.sensors, "noise"),
            "drift": lambda *a: sensor_fault(*a, self.sensors, "drift"),
            "bias again": lambda *a: sensor_fault(*a, self.sensors, "bias"),
            "component again": lambda *a: component_step(*a, self.health),
            "kill monitor": lambda r, g, t, w: kill_and_restart(r.monitor, g, t, w),
            "corrupt checkpoint": lambda r, g, t, w: kill_and_restart(r.monitor, g, t, w,
                                                                      lambda: corrupt_checkpoint(r)),
            "kill simulator": lambda r, g, t, w: kill_and_restart(r.simulator, g, t, w),
            "pause simulator": lambda r, g, t, w: pause(r.simulator, g, t, w),
            "pause monitor": lambda r, g, t, w: pause(r.monitor, g, t, w),
            "network": network, "reload": reload,
            "bad reload": lambda *a: bad_reload(*a, "invalid reload", "nowhere.json"),
            "pipe reload": lambda *a: bad_reload(*a, "reload of a pipe", self.rig.pipe),
            "hostile": hostile, "reset": reset, "hung log reader": hung_log_reader, "full disk": full_disk,
            "HTTP flood": http_flood,
        }
        if accelerated:  # the simulator must hear the answers, so nothing can stand between it and the monitor
            del makers["network"]
        self.makers, self.bag = makers, []

    def describe(self, description):
        self.sensors, self.health = description["sensors"], description["health"]

    def ready(self):
        return bool(self.sensors)

    def draw(self, t, wall, short, lives_left):
        """The next disturbance, or None. `short`: the telling ones first, little time to recover; `lives_left` false
        spares the services."""
        if not self.bag:
            self.bag = list(self.makers)
            self.rng.shuffle(self.bag)
            if short:
                self.bag.sort(key=lambda name: SHORT.index(name) if name in SHORT else len(SHORT))
        spared = set() if lives_left else {"kill monitor", "kill simulator", "corrupt checkpoint"}
        choice = next((name for name in self.bag if name not in spared), None)
        if choice is None:
            self.bag = []
            return None
        self.bag.remove(choice)
        disturbance = self.makers[choice](self.rig, self.rng, t, wall)
        if short:
            disturbance.recovery_s = min(disturbance.recovery_s, 6.0)
        return disturbance
