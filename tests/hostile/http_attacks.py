# SPDX-License-Identifier: Apache-2.0
"""Clients of the HTTP endpoint that mean harm. Everything is measured from a second client, and from the flight."""

import socket
import threading
import time

from rig import ADDRESS, Flight, fetch, require
from http_flood import HEADERS, RANGES, flood, say  # of the soak, in the folder that rig adds to the path

SLOW_CLIENTS = 200
HEALTH_P99_MS = 100.0


def health_p99_ms(asks):
    waits = []
    for _ in range(asks):
        began = time.monotonic()
        answer = fetch("/health")
        require(answer is not None and answer[0] == 200, f"/health answers {answer}")
        waits.append(1e3 * (time.monotonic() - began))
    waits.sort()
    return waits[int(0.99 * len(waits))]


def range_flood(bench):
    """Requests that ask for 1900 ranges each."""
    with Flight(bench) as flight:
        plain, _ = say(ADDRESS, b"GET /metrics HTTP/1.1\r\n\r\n")
        answers = flood(ADDRESS, (RANGES,), 5.0)
        largest = max(size for size, _ in answers)
        require(largest < 2 * plain + 4000, f"an answer of {largest} bytes, without ranges it has {plain}")
        require(any(line.endswith("200 OK") for _, line in answers), "no request was answered with 200")
        p99 = health_p99_ms(100)
        require(p99 < HEALTH_P99_MS, f"/health p99 {p99:.0f} ms")
        return f"{len(answers)} requests, largest answer {largest} bytes of {plain}, {flight.unharmed()}"


def header_flood(bench):
    """Requests with 60 kB of headers each."""
    with Flight(bench) as flight:
        answers = flood(ADDRESS, (HEADERS,), 5.0)
        served = sum(line.endswith("200 OK") for _, line in answers)
        require(served == 0, f"{served} of {len(answers)} requests were read to their end")
        p99 = health_p99_ms(100)
        require(p99 < HEALTH_P99_MS, f"/health p99 {p99:.0f} ms")
        return f"{len(answers)} requests, none answered with 200, {flight.unharmed()}"


def slow_clients(bench):
    """200 clients that say a byte at a time and never end, while /health is asked 200 times."""
    with Flight(bench) as flight:
        descriptors = flight.monitor.usage()["fds"]
        crowd = []
        for _ in range(SLOW_CLIENTS):
            client = socket.create_connection(ADDRESS, timeout=2.0)
            client.setblocking(False)
            crowd.append(client)
        over = threading.Event()

        def drip():
            while not over.wait(0.05):
                for client in crowd:
                    try:
                        client.send(b"G")
                    except OSError:  # dropped: exactly what is allowed
                        pass

        dripper = threading.Thread(target=drip)
        dripper.start()
        try:
            p99 = health_p99_ms(200)
        finally:
            over.set()
            dripper.join()
            for client in crowd:
                client.close()
        require(p99 < HEALTH_P99_MS, f"/health p99 {p99:.0f} ms")
        held = flight.unharmed()
        left = flight.monitor.usage()["fds"] - descriptors
        require(left <= 2, f"{left} descriptors stay open")
        return f"/health p99 {p99:.1f} ms of {HEALTH_P99_MS:.0f}, {held}"
