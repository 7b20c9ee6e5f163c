# SPDX-License-Identifier: Apache-2.0
"""Disks that are full, at the start and in flight: a tmpfs of 2 MB, in the mount namespace that hostile.sh has made."""

import errno
import glob
import os
import random
import subprocess
import time

from rig import Flight, events, metric, require, until


def small_disk(bench):
    folder = bench.new_folder()
    subprocess.run(["mount", "-t", "tmpfs", "-o", "size=2m", "tmpfs", folder], check=True)
    return folder


def fill(disk):
    """Not one page more fits. The file that does it is removed to make room."""
    path = os.path.join(disk, "filler")
    with open(path, "ab", buffering=0) as f:
        try:
            while True:
                f.write(bytes(4096))
        except OSError as e:
            require(e.errno == errno.ENOSPC, f"the disk cannot be filled: {e}")
    return path


def record_on(disk):
    return ("--record", os.path.join(disk, "flight.h5"), "--checkpoint-directory", disk, "--checkpoint-period-s", "0.5")


def await_both_events():
    until(lambda: events("recording"), "event recording")
    until(lambda: events("checkpoint"), "event checkpoint")


def full_at_start(bench):
    """The disk of recording and checkpoints is full before the start."""
    disk = small_disk(bench)
    fill(disk)
    with Flight(bench, *record_on(disk)) as flight:
        await_both_events()
        held = flight.unharmed()
        lost = metric("ehm_records_lost_total")
        require(lost > 0, "no sample counts as not recorded")
        return f"flies, events recording and checkpoint, {lost:.0f} samples not recorded and counted, {held}"


def full_in_flight(bench):
    """The disk fills in flight; somebody makes room again."""
    disk = small_disk(bench)
    with Flight(bench, *record_on(disk)) as flight:
        until(lambda: metric("ehm_checkpoints_written_total"), "a first checkpoint")
        filler = fill(disk)
        await_both_events()
        flown = metric("ehm_samples_processed_total")
        until(lambda: metric("ehm_samples_processed_total") > flown + 100, "estimates on a full disk")
        failed = metric("ehm_checkpoints_failed_total")
        os.remove(filler)
        written = metric("ehm_checkpoints_written_total")
        until(lambda: metric("ehm_checkpoints_written_total") > written, "checkpoints once there is room")
        until(lambda: "recording goes on in" in flight.log(), "the recording once there is room", 30.0)
        return f"{failed:.0f} checkpoints failed and counted, both go on once there is room, {flight.unharmed()}"


def kill_storm(bench):
    """kill -9 a dozen times, while checkpoints are written ten times a second."""
    folder, chance, kills = bench.new_folder(), random.Random(1), 12

    def leftovers():
        return glob.glob(os.path.join(folder, "*.tmp*"))

    with Flight(bench, "--checkpoint-directory", folder, "--checkpoint-period-s", "0.1") as flight:
        checkpoint = os.path.join(folder, "engine_1.json")
        for _ in range(kills):
            flight.monitor.kill()
            before = os.stat(checkpoint).st_mtime_ns if os.path.exists(checkpoint) else 0
            flight.monitor.start()
            until(lambda: os.path.exists(checkpoint) and os.stat(checkpoint).st_mtime_ns > before, "a checkpoint")
            time.sleep(chance.uniform(0.0, 0.2))  # the kill falls anywhere between two of them
        flight.monitor.kill()
        # As of a kill within a write; its maker is no more.
        dead = subprocess.Popen(["true"])
        dead.wait()
        with open(f"{checkpoint}.tmp{dead.pid}", "w") as f:
            f.write("{")
        found = len(leftovers())
        flight.monitor.start()
        flight.await_estimates()
        until(lambda: metric("ehm_checkpoints_written_total"), "a checkpoint after the storm")
        held = flight.unharmed()
        flight.stop()
        require(not leftovers(), f"left behind: {', '.join(os.path.basename(p) for p in leftovers())}")
        require(os.path.getsize(checkpoint) > 100, "the checkpoint is no whole file")
        return f"{kills + 1} kills, {found} half-written files with the planted one, none after the last start, {held}"
