# SPDX-License-Identifier: Apache-2.0
"""HTTP clients that mean harm: the same request again and again, as fast as it is answered.

As a program: http_flood.py PORT, with ranges, headers without end and garbage in turn, until it is ended.
"""

import itertools
import socket
import sys
import threading
import time

RANGES = b"GET /metrics HTTP/1.1\r\nRange: bytes=0-" + b",0-" * 1900 + b"\r\n\r\n"
HEADERS = b"GET /metrics HTTP/1.1\r\n" + b"X: y\r\n" * 10_000 + b"\r\n"
GARBAGE = b"\x16\x03\x01\x02\x00\xff" * 1000


def say(address, request, timeout_s=2.0):
    """Bytes of the answer and its first line; (0, "") where the server has dropped the connection."""
    answer = b""
    try:
        with socket.create_connection(address, timeout=timeout_s) as client:
            client.sendall(request)
            while chunk := client.recv(1 << 16):
                answer += chunk
    except OSError:  # it has heard enough; what came before counts
        pass
    return len(answer), answer.split(b"\r\n", 1)[0].decode(errors="replace")


def flood(address, requests, seconds, clients=8):
    """All answers to so many clients that ask in turn for each of the requests."""
    answers, end = [], time.monotonic() + seconds

    def ask():
        for request in itertools.cycle(requests):
            if time.monotonic() >= end:
                return
            answers.append(say(address, request))

    threads = [threading.Thread(target=ask) for _ in range(clients)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return answers


if __name__ == "__main__":
    while True:
        flood(("127.0.0.1", int(sys.argv[1])), (RANGES, HEADERS, GARBAGE), 1.0)
