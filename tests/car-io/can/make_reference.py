#!/usr/bin/env python3
"""Writes reference.txt: frames of reference.dbc as cantools (PyPI, 45.1.0) encodes and decodes them.

    python3 -m venv v && v/bin/pip install cantools==45.1.0 && v/bin/python make_reference.py > reference.txt

Each line is MESSAGE DATA SIGNAL=VALUE…, data in hexadecimal, values physical.
"""
import pathlib
import random
import struct

import cantools

database = cantools.database.load_file(pathlib.Path(__file__).parent / "reference.dbc")
chance = random.Random(17)


def raw(signal):
    if signal.is_float:
        number = chance.choice([0.0, -1.5, chance.uniform(-1e6, 1e6), chance.uniform(-1e-6, 1e-6)])
        return struct.unpack("f", struct.pack("f", number))[0] if signal.length == 32 else number
    low = -(1 << signal.length - 1) if signal.is_signed else 0
    high = low + (1 << signal.length) - 1
    if signal.length == 64:  # What a double holds.
        low, high = -(1 << 52), 1 << 52
    return chance.choice([low, high, 0, chance.randint(low, high), chance.randint(low, high)])


for message in database.messages:
    if message.name.startswith("VECTOR"):
        continue
    selecting = [signal for signal in message.signals if signal.is_multiplexer]
    for count in range(12):
        chosen = chance.choice([0, 3])
        values = {
            signal.name: raw(signal)
            for signal in message.signals
            if not signal.multiplexer_ids or chosen in signal.multiplexer_ids
        }
        for signal in selecting:
            values[signal.name] = chosen
        data = message.encode(values, scaling=False, strict=False)
        decoded = message.decode(data, decode_choices=False)
        print(message.name, data.hex(), *(f"{name}={float(value)!r}" for name, value in decoded.items()))
