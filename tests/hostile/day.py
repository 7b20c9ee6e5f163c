# SPDX-License-Identifier: Apache-2.0
"""All attacks, one after another, a line each. See ../hostile.sh, which gives it a network and mounts of its own."""

import argparse
import os
import shutil
import sys
import tempfile
import time
import types

import disk_attacks
import file_attacks
import http_attacks
import process_attacks
import rig
import wire_attacks

LIMIT_S = 560.0  # hostile.sh ends it after 600

ATTACKS = {
    "http-ranges": http_attacks.range_flood,
    "http-headers": http_attacks.header_flood,
    "http-slow": http_attacks.slow_clients,
    "disk-full-start": disk_attacks.full_at_start,
    "disk-full-flight": disk_attacks.full_in_flight,
    "pipe-start": file_attacks.no_files_at_start,
    "pipe-reload": file_attacks.no_files_at_reload,
    "kill-storm": disk_attacks.kill_storm,
    "early-signals": process_attacks.early_signals,
    "log-reader": process_attacks.deaf_log_reader,
    "bad-samples": wire_attacks.bad_samples,
    "escapes": wire_attacks.escapes,
    "resets": wire_attacks.reset_flood,
    "wear": wire_attacks.mortal_wear,
    "held-up": process_attacks.held_up,
    "descriptors": file_attacks.few_descriptors,
    "output-full": file_attacks.full_output,
}


def parse():
    parser = argparse.ArgumentParser(
        prog="hostile.sh", formatter_class=argparse.RawDescriptionHelpFormatter,
        description="The pair under attack, in namespaces of its own.\n\n" +
        "\n".join(f"  {name:18}{attack.__doc__.splitlines()[0]}" for name, attack in ATTACKS.items()),
        epilog="Exit codes: 0 all held, 1 one is broken, 2 wrong usage, 77 no namespaces here.")
    parser.add_argument("build", metavar="BUILD_DIR", help="with the tests built")
    parser.add_argument("attacks", metavar="ATTACK", nargs="*", help="of the list above; all by default")
    options = parser.parse_args()
    for name in options.attacks:
        if name not in ATTACKS:
            parser.error(f"'{name}' is no attack; allowed are {', '.join(ATTACKS)}")
    return options, parser


def design_of(build, folder):
    """That of the integration tests, or one made here."""
    made = os.path.join(build, "tests", "integration", "design.json")
    if os.path.exists(made):
        return made
    import soak  # in the folder that rig adds to the path
    return soak.make_design(types.SimpleNamespace(build=build, out=folder))


def main():
    options, parser = parse()
    folder = tempfile.mkdtemp(prefix="ehm-hostile.")
    began, broken = time.monotonic(), 0
    try:
        build = os.path.abspath(options.build)
        bench = rig.Bench(build, None, folder)
        for program in bench.programs():
            if not os.path.exists(program):
                parser.error(f"{program} is not built")
        bench.design = design_of(build, folder)
        for name in options.attacks or ATTACKS:
            start = time.monotonic()
            try:
                rig.require(start - began < LIMIT_S, "not tried, the time is over")
                outcome, text = "held", ATTACKS[name](bench)
            except rig.Broken as e:
                outcome, text = "BROKEN", str(e)
            except Exception as e:  # the attack itself did not come about; the others are tried all the same
                outcome, text = "BROKEN", f"{type(e).__name__}: {e}"
            broken += outcome != "held"
            tried = ATTACKS[name].__doc__.splitlines()[0]
            print(f"{outcome:7}{name:18}{tried} {text} [{time.monotonic() - start:.0f} s]", flush=True)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    print(f"hostile: {broken} broken")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
