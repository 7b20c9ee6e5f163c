# SPDX-License-Identifier: Apache-2.0
"""Reads a recording as a user of h5py does and checks that its tables fit together. Usage: read_recording.py FILE"""
import sys

import h5py
import numpy as np


def open_recording(path):
    try:
        return h5py.File(path, "r")
    except OSError:
        return h5py.File(path, "r", swmr=True)  # still being written, or cut off


with open_recording(sys.argv[1]) as recording:
    assert recording.attrs["format"] == b"ehm-recording", recording.attrs["format"]
    names = {group: [name.decode() for name in recording[group + "_var"]] for group in ("W", "X_s", "X_v", "T", "A")}
    rows = recording["A"].shape[0]
    for table in ("W", "X_s", "R", "X_v", "X_v_sigma", "X_v_sigma_filter", "T", "T_sigma", "T_sigma_filter"):
        group = {"R": "X_s"}.get(table, table.removesuffix("_filter").removesuffix("_sigma"))
        assert recording[table].dtype == np.float64
        assert recording[table].shape[0] >= rows and recording[table].shape[1] == len(names[group]), table
    identity = {name: recording["A"][:, i] for i, name in enumerate(names["A"])}
    estimates = recording["T"][:rows][identity["estimates"] == 1]
    assert len(estimates) > 0 and np.isfinite(estimates).all()
    assert (recording["T_sigma"][:rows][identity["estimates"] == 1] > 0).all()
    assert (np.diff(identity["received_ns"]) >= 0).all()
    print("sensors:", ", ".join(names["X_s"]), " engines:", sorted(set(identity["unit"].tolist())), " rows:", rows)
