# SPDX-License-Identifier: Apache-2.0
"""The judge must be able to say no: each criterion broken by a record made for it."""

import os
import subprocess
import sys
import tempfile
import tomllib
import unittest

import judge
from schedule import Disturbance

HERE = os.path.dirname(os.path.abspath(__file__))
BLOCK = {"values": 10, "within_3": 10, "worst": 1.0, "channel": 0}


def status(**counts):
    zero = dict.fromkeys(("t", "received", "lost", "latency_p999_us") + judge.OUTCOMES, 0)
    return dict(zero, **counts)


def fault(start_t, channel=3, kind="sensor bias", **about):
    about.setdefault("must_find", True)
    d = Disturbance(kind, start_t, start_t, [], 10.0, 20.0, {1, 2, 11}, channel=channel, **about)
    d.end_t = start_t + 30.0
    return d


def event(t, kind, channel=3, raised=True):
    return {"t": t, "ago_s": 0.0, "kind": kind, "channel": channel, "raised": raised, "value": 1.0,
            "message": "m"}


class JudgeTest(unittest.TestCase):
    def setUp(self):
        self.record = judge.Record()

    def measured(self):
        return judge.measure(self.record, warm_up_s=10.0)

    def test_a_record_without_trouble_holds_the_shipped_criteria(self):
        with open(os.path.join(HERE, "criteria.toml"), "rb") as f:
            criteria = tomllib.load(f)
        self.record.seconds = [{"t": 1.0, "health": BLOCK, "auxiliary": BLOCK}]
        self.record.statuses = [status(received=7, processed=4, malformed=2, foreign=1)]
        rows = judge.verdicts(self.measured(), criteria)
        self.assertEqual(len(rows), len(criteria))
        self.assertTrue(all(row[3] for row in rows))

    def test_samples_that_vanish_are_unaccounted(self):
        self.record.gaps = [{"from": 10, "to": 14, "during": None}]
        self.assertEqual(self.measured()["unaccounted_samples"], 5)
        self.record.statuses = [status(lost=3)]
        self.assertEqual(self.measured()["unaccounted_samples"], 2)
        self.record.gaps[0]["during"] = "kill monitor"
        self.assertEqual(self.measured()["unaccounted_samples"], 0)

    def test_losses_are_counted_over_lives(self):
        self.record.statuses = [status(lost=3), status(lost=5), status(lost=0), status(lost=2)]
        self.assertEqual(judge.counted_losses(self.record.statuses), 7)

    def test_counters_that_do_not_add_up(self):
        self.record.statuses = [status(received=8, processed=7)]
        self.assertEqual(self.measured()["counter_mismatches"], 1)

    def test_an_event_in_calm_or_of_another_kind_is_unexplained(self):
        self.record.disturbances = [fault(100.0)]
        self.record.hear_event(event(50.0, 1))
        self.record.hear_event(event(101.0, 5))
        self.record.hear_event(event(102.0, 1))
        self.record.hear_event(event(60.0, 1, raised=False))
        self.assertEqual([(e["at"], e["during"]) for e in self.record.unexplained],
                         [(50.0, "calm"), (101.0, "sensor bias")])

    def test_a_hiccup_of_the_machine_is_counted_apart(self):
        self.record.seconds = [{"t": 3600.0, "health": BLOCK, "auxiliary": BLOCK}]
        for value in (0.05, 0.2, 0.3):
            self.record.hear_event(dict(event(50.0, judge.INPUT_LOST), value=value))
        self.assertEqual(self.measured()["input_hiccups_per_hour"], 2.0)
        self.assertEqual(len(self.record.unexplained), 1)

    def test_a_reload_of_which_no_event_tells(self):
        self.record.disturbances = [fault(100.0, kind="reload", must_find=False, must_raise=[(14, False)])]
        self.record.disturbances[0].allowed = {14}
        self.assertEqual(self.measured()["missing_events"], 1)
        self.record.hear_event(event(101.0, 14, raised=True))   # refused
        self.assertEqual(self.measured()["missing_events"], 1)
        self.record.hear_event(event(102.0, 14, raised=False))
        self.assertEqual(self.measured()["missing_events"], 0)

    def test_a_full_disk_must_be_told_when_it_comes_and_when_it_is_over(self):
        self.record.disturbances = [fault(100.0, kind="full disk", must_find=False, must_raise=[(13, True), (13, False)])]
        self.record.disturbances[0].allowed = {13}
        self.assertEqual(self.measured()["missing_events"], 2)
        self.record.hear_event(event(101.0, 13, raised=True))
        self.assertEqual(self.measured()["missing_events"], 1)
        self.record.hear_event(event(109.0, 13, raised=False))
        self.assertEqual(self.measured()["missing_events"], 0)
        self.assertEqual(self.measured()["unexplained_events"], 0)

    def test_health_that_is_not_answered_counts_unless_the_monitor_is_away(self):
        self.record.health = [(None, 3.0)] * 98 + [("kill monitor", judge.NO_ANSWER_MS), ("pause monitor", judge.NO_ANSWER_MS)]
        self.assertEqual(self.measured()["health_answer_p99_ms"], 3.0)
        self.record.health += [("HTTP flood", 250.0), ("hung log reader", 7.0)]
        self.assertEqual(self.measured()["health_answer_p99_ms"], 250.0)
        self.record.health += [("HTTP flood", judge.NO_ANSWER_MS)] * 2
        self.assertEqual(self.measured()["health_answer_p99_ms"], judge.NO_ANSWER_MS)

    def test_detection_wants_the_right_sensor_in_time(self):
        self.record.disturbances = [fault(100.0), fault(200.0), fault(300.0), fault(400.0)]
        self.record.hear_event(event(101.0, 1))             # right
        self.record.hear_event(event(202.0, 1, channel=4))  # wrong sensor
        self.record.hear_event(event(304.0, 11))            # ambiguous, late
        m = self.measured()                                 # the fourth is never found
        self.assertEqual(m["sensor_faults_found"], 0.5)
        self.assertAlmostEqual(m["sensor_faults_named_right"], 2.0 / 3.0)
        self.assertAlmostEqual(m["sensor_fault_delay_p95_s"], 4.0)

    def test_a_component_step_called_a_sensor_fault(self):
        self.record.disturbances = [fault(100.0, kind="component step", must_find=False),
                                    fault(200.0, kind="component step", must_find=False)]
        self.record.hear_event(event(101.0, 2))
        self.record.hear_event(event(201.0, 1))
        self.assertEqual(self.measured()["component_steps_called_sensor_faults"], 0.5)

    def test_growth_is_that_of_one_life_after_its_warm_up(self):
        use = [(0, 1, 20.0), (5, 1, 30.0), (20, 1, 31.0), (30, 1, 31.5), (40, 2, 10.0), (60, 2, 12.5), (70, 2, 14.5)]
        self.record.usage = {"monitor": [(wall, wall, life, {"rss_mb": mb, "fds": 7}) for wall, life, mb in use]}
        self.assertAlmostEqual(self.measured()["rss_growth_mb"], 2.0)
        self.assertEqual(self.measured()["fd_growth"], 0)

    def test_descriptors_that_stay_open_are_growth_and_a_file_that_is_being_written_is_none(self):
        counts = [7, 7, 8, 7, 7, 7, 7, 8, 7, 8, 8, 7]
        self.record.usage = {"monitor": [(20 + k, k, 1, {"rss_mb": 1.0, "fds": n}) for k, n in enumerate(counts)]}
        self.assertEqual(self.measured()["fd_growth"], 0)
        self.record.usage["monitor"] += [(50 + k, k, 1, {"rss_mb": 1.0, "fds": 8}) for k in range(5)]
        self.assertEqual(self.measured()["fd_growth"], 1)

    def test_a_life_of_the_monitor_is_timed_until_it_is_paused(self):
        self.record.disturbances = [fault(100.0, kind="pause monitor", must_find=False)]
        self.record.statuses = [status(t=90.0, received=5, latency_p999_us=2000.0),
                                status(t=110.0, received=6, latency_p999_us=90000.0)]
        self.assertAlmostEqual(self.measured()["latency_p999_ms"], 2.0)
        self.record.statuses.append(status(t=120.0, received=1, latency_p999_us=3000.0))  # started anew
        self.assertAlmostEqual(self.measured()["latency_p999_ms"], 3.0)

    def test_errors_count_only_while_nothing_is_disturbed(self):
        bad = dict(BLOCK, within_3=0)
        self.record.disturbances = [fault(100.0)]
        self.record.seconds = [{"t": 50.0, "health": BLOCK, "auxiliary": BLOCK},
                               {"t": 110.0, "health": bad, "auxiliary": bad}]
        self.assertEqual(self.measured()["estimates_within_3_sigma"], 1.0)
        self.record.seconds.append({"t": 150.0, "health": bad, "auxiliary": BLOCK})
        self.assertEqual(self.measured()["estimates_within_3_sigma"], 0.75)

    def test_a_criteria_file_with_a_mistake_is_named(self):
        for text, said in (("[rss]\nmax = 1\n", "'rss' is no criterion"),
                           ("[rss_growth_mb]\nmaximum = 1\n", "'rss_growth_mb' needs exactly one of min and max"),
                           ("rss_growth_mb = [", "criteria.toml: ")):
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "criteria.toml")
                with open(path, "w") as f:
                    f.write(text)
                run = subprocess.run([sys.executable, os.path.join(HERE, "soak.py"), "--criteria", path],
                                     capture_output=True, text=True)
                self.assertEqual(run.returncode, 2)
                self.assertIn(said, run.stderr)


if __name__ == "__main__":
    unittest.main()
