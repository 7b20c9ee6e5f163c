#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the seeds of the binary formats to tests/fuzz/corpus; the texts there are kept as they are.

    tests/fuzz/make_seeds.py        needs numpy and scipy

From corpus/model/small.json: a MATLAB file in each variant that is read, and a CSV folder. For the path of a sample:
flights in the code of samples_fuzz.cpp, and messages as they stand on the wire.
"""
import json
import pathlib
import struct

import numpy as np
import scipy.io

corpus = pathlib.Path(__file__).resolve().parent / "corpus"
model = json.loads((corpus / "model" / "small.json").read_text())
names = {"state": "states", "control": "controls", "health": "health", "sensor": "sensors", "auxiliary": "auxiliary"}
matrices = "ABCDFGLMN"


def matlab_variables():
    v = {k: np.array(model[k], float) for k in matrices}
    v.update(Ts=0.0, sample_time_s=model["sample_time_s"])
    for kind, key in names.items():
        v[f"{kind}_names"] = np.array([c["name"] for c in model[key]], dtype=object)
        v[f"{kind}_units"] = np.array([c["unit"] for c in model[key]], dtype=object)
        if kind != "health":
            v[f"{kind}_trim"] = np.array([c["trim"] for c in model[key]], float)
    v["sensor_noise_sigma"] = np.array([c["noise_sigma"] for c in model["sensors"]], float)
    return v


def csv_folder():
    text = ""
    for k in matrices:
        text += f"={k}\n" + "".join(",".join(f"{x:.9g}" for x in row) + "\n" for row in model[k])
    text += "=channels\nkind,name,unit,trim,sigma\n"
    for kind, key in names.items():
        for c in model[key]:
            text += f"{kind},{c['name']},{c['unit']},{c.get('trim', '')},{c.get('sigma', c.get('noise_sigma', ''))}\n"
    return text + f"=settings\nkey,value\nTs,0\nsample_time_s,{model['sample_time_s']}\nname,small\n"


def message(sequence, source=1, schema=1, time_ns=None, sensors=None, flight=None):
    point = model["operating_point"]
    flight = flight or (point["altitude_m"], point["mach"], point["delta_isa_k"])
    values = sensors or [c["trim"] * (1 + 1e-5 * (sequence % 7)) for c in model["sensors"]]
    actuators = [c["trim"] for c in model["controls"]]
    time_ns = 15_000_000 * sequence if time_ns is None else time_ns
    body = struct.pack("<IIQq3d4I", 1, schema, sequence, time_ns, *flight, source, 0xF, len(values), len(actuators))
    body += struct.pack("<8d", *(actuators + [0.0] * (8 - len(actuators))))
    body += struct.pack("<16d", *(values + [0.0] * (16 - len(values))))
    body = b"\x00\x01\x00\x00" + body
    return struct.pack("<H", len(body)) + body


def write(target, name, data):
    (corpus / target / name).write_bytes(data if isinstance(data, bytes) else data.encode())


scipy.io.savemat(corpus / "import_mat" / "plain.mat", matlab_variables())
scipy.io.savemat(corpus / "import_mat" / "compressed.mat", matlab_variables(), do_compression=True)
scipy.io.savemat(corpus / "import_mat" / "structure.mat", {"engine": matlab_variables()}, do_compression=True)
write("import_csv", "folder", csv_folder())

plain = bytes([0, 200])
nan, infinity = struct.pack("<d", float("nan")), struct.pack("<d", float("inf"))
write("samples", "plain", plain)
write("samples", "bias", plain + bytes([4, 2, 5]) + plain + bytes([4, 2, 0xFB]) + plain + plain)
write("samples", "two_faults", plain + bytes([4, 1, 50, 4, 3, 50]) + plain + bytes([4, 1, 0, 4, 3, 0]) + plain + plain)
write("samples", "not_finite", plain + (bytes([4, 129]) + nan + bytes([8, 129]) + infinity + bytes([16, 0]) + nan) * 4)
write("samples", "huge_actuator", plain + (bytes([8, 129]) + struct.pack("<d", 1e300)) * 3 + plain)
write("samples", "silence_and_reset", plain + bytes([64]) + struct.pack("<d", 1.0) + plain + bytes([128]) + plain)
write("samples", "ends_of_time", plain + b"".join(
    bytes([2]) + struct.pack("<qB", t, 0) + bytes([0, 9]) for t in (2**63 - 1, -(2**63), 2**62, -1)))
write("samples", "ends_of_sequence", plain + b"".join(
    bytes([1]) + struct.pack("<QB", n, 0) + bytes([0, 9]) for n in (2**64 - 1, 2**63, 500, 2)))
write("samples", "headers", plain + b"".join(bytes([32]) + struct.pack("<IB", 77, k) for k in range(6)) + plain)
write("wire_sample", "flight", b"".join(message(i) for i in range(20)))
write("wire_sample", "second_source", b"".join(message(i // 2, source=1 + i % 2) for i in range(12)))
write("wire_sample", "bad", message(0) + message(1, schema=7) + message(1) + message(1) + message(0) + message(
    2, time_ns=2**63 - 1) + message(3, time_ns=-(2**63)) + message(4, flight=(float("nan"), 0.8, 0.0)) + message(5)[:90])
