#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Dependencies point one way: compares the includes of every folder with the table in edges.txt. Two folders do not include
each other, unless one holds the other. Every source opens with its licence."""

import pathlib
import re
import sys

root = pathlib.Path(__file__).resolve().parents[2]
tops = ("idl", "engine_sim", "monitor", "tuner_design", "deploy")
wire = {"idl/wire_values.h", "idl/wire_names.h", "idl/fault_names.h"}
tag = "SPDX-License-Identifier: Apache-2.0"
# What every folder may include, as it may the standard library.
everywhere = "deploy/runtime/numbers"
# What a folder marked PURE must not see, besides DDS.
impure = re.compile(r"(spdlog|fmt/|chrono|thread|mutex|fstream|iostream|cstdio|ctime|time\.h|filesystem|fastdds|fastrtps)")
include = re.compile(r'#\s*include\s*([<"])([^>"]+)[>"]')


def read_table():
    allowed, pure = {}, set()
    for line in (root / "tests/layers/edges.txt").read_text().splitlines():
        line = line.split("#")[0].strip()
        if not line:
            continue
        folder, _, edges = line.partition(":")
        folder, edges = folder.strip(), edges.split()
        if folder in allowed:
            raise SystemExit(f"layers: edges.txt has {folder} twice")
        if "PURE" in edges:
            pure.add(folder)
        allowed[folder] = set(edges) - {"PURE"}
    return allowed, pure


def target_of(path, bracket, name):
    """The folder that an include is of; None for what is not the project's."""
    if name in wire:
        return "idl" if path.is_relative_to(root / "idl") else "wire"
    if name.startswith("engine_health") and "/" not in name:
        return "idl/generated"
    if name.split("/")[0] in tops or name.startswith("tests/"):
        return str(pathlib.PurePosixPath(name).parent)
    return str(path.parent.relative_to(root)) if bracket == '"' else None


def sources_and_scripts():
    kinds = {".h", ".cpp", ".c", ".idl", ".py", ".sh", ".cmake"}
    return [root / "CMakeLists.txt"] + sorted(
        path for top in (*tops, "tests") for path in (root / top).rglob("*")
        if path.suffix in kinds or path.name == "CMakeLists.txt")


def main():
    allowed, pure = read_table()
    defects, used, folders = [], {}, set()
    for path in sorted(p for top in tops for p in (root / top).rglob("*") if p.suffix in (".h", ".cpp", ".c")):
        folder = str(path.parent.relative_to(root))
        folders.add(folder)
        if folder not in allowed:
            continue
        for number, line in enumerate(path.read_text().splitlines(), 1):
            match = include.match(line)
            if not match:
                continue
            where = f"{path.relative_to(root)}:{number}: {line}"
            target = target_of(path, *match.groups())
            if folder in pure and target is None and impure.search(match.group(2)):
                defects.append(f"{folder} is pure, and knows no DDS, clock, thread, log or file: {where}")
            if target is None or target in (folder, everywhere):
                continue
            used.setdefault(folder, set()).add(target)
            if target not in allowed[folder]:
                defects.append(f"{folder} may not include {target}: {where}")
    defects += [f"{folder} is not in edges.txt: say what it may include" for folder in sorted(folders - set(allowed))]
    for folder, edges in allowed.items():
        for edge in sorted(edge for edge in edges if folder < edge and folder in allowed.get(edge, ())):
            if not edge.startswith(folder + "/"):
                defects.append(f"{folder} and {edge} include each other: one of them stands on the other")
    for path in sources_and_scripts():
        if tag not in "".join(path.open(errors="replace").readlines()[:2]):
            defects.append(f"{path.relative_to(root)} does not open with '{tag}'")
    defects += [f"edges.txt has {folder}, which has no sources" for folder in sorted(set(allowed) - folders)]
    for folder in sorted(folders & set(allowed)):
        for edge in sorted(allowed[folder] - used.get(folder, set())):
            defects.append(f"edges.txt lets {folder} include {edge}, which it does not: take the word out")
    for defect in defects:
        print(f"layers: {defect}")
    if not defects:
        print(f"layers: {len(folders)} folders, every include is one that edges.txt allows")
    return 1 if defects else 0


if __name__ == "__main__":
    sys.exit(main())
