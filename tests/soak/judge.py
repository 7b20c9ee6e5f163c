# SPDX-License-Identifier: Apache-2.0
"""What a soak has seen, against its criteria."""

SENSOR_FAULT, HEALTH_SHIFT, INPUT_LOST, AMBIGUOUS = 1, 2, 5, 11
HICCUP_S = 0.25  # a shared machine pauses simulator or monitor for so long by itself; more than that is an event
OUTCOMES = ("processed", "withheld", "duplicated", "reordered", "foreign", "malformed")
DOWN = ("kill ",)
AWAY = ("kill monitor", "pause monitor")
NO_ANSWER_MS = 1e6  # longer than any patience
FEW = 5  # readings at either end of a life


def percentile(values, share):
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))] if ordered else 0.0


class Record:
    """Everything that was seen, in order."""

    def __init__(self):
        self.seconds, self.statuses, self.gaps, self.events = [], [], [], []
        self.usage = {}  # service -> [(wall, t, life, usage)]
        self.disturbances, self.unexplained, self.unexpected_exits = [], [], []
        self.doubles, self.restarts_answered, self.hiccups = 0, [], 0
        self.health = []  # (kind of the disturbance or None, ms until /health was answered)

    def disturbance_at(self, t):
        for d in reversed(self.disturbances):
            if d.covers(t):
                return d
            if d.end_t is not None and d.end_t < t - 120.0:
                return None
        return None

    def hear_event(self, line):
        t = line["t"] - line["ago_s"]
        self.events.append(dict(line, at=t))
        d = self.disturbance_at(t)
        if d:
            d.events.append(dict(line, at=t))
        explained = d is not None and line["kind"] in d.allowed
        if line["raised"] and not explained and line["kind"] == INPUT_LOST and line["value"] < HICCUP_S:
            self.hiccups += 1
        elif line["raised"] and not explained:
            self.unexplained.append(dict(line, at=t, during=d.kind if d else "calm"))


def counted_losses(statuses):
    """Samples that the monitor counted as lost, over all of its lives."""
    total, last = 0, 0
    for s in statuses:
        total += s["lost"] - last if s["lost"] >= last else s["lost"]
        last = s["lost"]
    return total


def unaccounted(record):
    missing = sum(g["to"] - g["from"] + 1 for g in record.gaps
                  if not (g["during"] or "").startswith(DOWN))
    return max(0, missing - counted_losses(record.statuses))


def mismatches(record):
    return sum(1 for s in record.statuses if s["received"] != sum(s[k] for k in OUTCOMES))


def memory_growth(warm):
    return max(warm) - warm[0]


def descriptor_growth(warm):
    """The least of some readings: a checkpoint that is being written holds a file open for a moment."""
    return min(warm[-FEW:]) - min(warm[:FEW])


def growth(record, quantity, warm_up_s, of):
    """Worst over all lives of all services."""
    worst = 0.0
    for samples in record.usage.values():
        lives = {}
        for wall, _t, life, usage in samples:
            lives.setdefault(life, []).append((wall, usage[quantity]))
        for values in lives.values():
            warm = [v for wall, v in values if wall - values[0][0] >= warm_up_s]
            if warm:
                worst = max(worst, of(warm))
    return worst


def unpaused(record):
    """Statuses of lives of the monitor until it is paused: its histogram keeps what the soak itself did to it."""
    pauses = [d.start_t for d in record.disturbances if d.kind == "pause monitor"]
    life_t = received = 0
    clean = []
    for s in record.statuses:
        if s["received"] < received:
            life_t = s["t"]
        received = s["received"]
        if not any(life_t <= p <= s["t"] for p in pauses):
            clean.append(s)
    return clean


def first(d, kinds):
    return next((e for e in d.events if e["raised"] and e["kind"] in kinds), None)


def detection(record):
    """Of abrupt faults of 5 sigma and more: delays, found, rightly named."""
    delays, right, cases = [], 0, 0
    for d in record.disturbances:
        if not d.about.get("must_find") or d.end_t is None:
            continue
        cases += 1
        e = first(d, {SENSOR_FAULT, AMBIGUOUS, HEALTH_SHIFT})
        d.about["found"] = e
        if e is None:
            continue
        delays.append(e["at"] - d.start_t)
        right += e["kind"] == AMBIGUOUS or (e["kind"] == SENSOR_FAULT and e["channel"] == d.about["channel"])
    return cases, delays, right


def components_called_sensors(record):
    steps = [d for d in record.disturbances if d.kind == "component step" and d.end_t is not None]
    wrong = sum(1 for d in steps if (first(d, {SENSOR_FAULT, HEALTH_SHIFT, AMBIGUOUS}) or {}).get("kind") == SENSOR_FAULT)
    return wrong / len(steps) if steps else 0.0


def silent(record):
    """Events that a disturbance must raise, or clear, and that did not come."""
    return sum(1 for d in record.disturbances if d.end_t is not None for event in d.about.get("must_raise", ())
               if event not in [(e["kind"], e["raised"]) for e in d.events])


def health_waits_ms(record):
    """Of /health while the monitor was there to answer; one that stayed away has NO_ANSWER_MS."""
    return [wait_ms for during, wait_ms in record.health if not (during or "").startswith(AWAY)]


def within_3(record):
    values = inside = 0
    for s in record.seconds:
        if record.disturbance_at(s["t"]) is None:
            for block in (s["health"], s["auxiliary"]):
                values += block["values"]
                inside += block["within_3"]
    return inside / values if values else 1.0


def measure(record, warm_up_s):
    cases, delays, right = detection(record)
    found = sum(1 for delay in delays if delay <= 3.0)
    return {
        "unaccounted_samples": unaccounted(record),
        "double_estimates": record.doubles,
        "counter_mismatches": mismatches(record),
        "unexplained_events": len(record.unexplained),
        "input_hiccups_per_hour": 3600.0 * record.hiccups / max(1.0, record.seconds[-1]["t"] if record.seconds else 1.0),
        "missing_events": silent(record),
        "unexpected_exits": len(record.unexpected_exits),
        "rss_growth_mb": growth(record, "rss_mb", warm_up_s, memory_growth),
        "fd_growth": growth(record, "fds", warm_up_s, descriptor_growth),
        "latency_p999_ms": max((1e-3 * s["latency_p999_us"] for s in unpaused(record)), default=0.0),
        "health_answer_p99_ms": percentile(health_waits_ms(record), 0.99),
        "sensor_fault_delay_p95_s": percentile(delays, 0.95),
        "sensor_faults_found": found / cases if cases else 1.0,
        "sensor_faults_named_right": right / len(delays) if delays else 1.0,
        "component_steps_called_sensor_faults": components_called_sensors(record),
        "estimates_within_3_sigma": within_3(record),
        "restarts_answered": sum(record.restarts_answered) / len(record.restarts_answered)
        if record.restarts_answered else 1.0,
    }


def verdicts(measured, criteria):
    """(name, measured, limit as text, held) by criterion."""
    rows = []
    for name, value in measured.items():
        limit = criteria[name]
        held = value <= limit["max"] if "max" in limit else value >= limit["min"]
        text = f"at most {limit['max']}" if "max" in limit else f"at least {limit['min']}"
        rows.append((name, value, text, held))
    return rows
