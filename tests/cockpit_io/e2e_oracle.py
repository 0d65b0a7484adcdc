"""Frames protected by the package autosar-e2e, for message_check_test.cpp: "p1|p2 MODE DATA_ID FRAME_HEX" a line.

Profile 2 takes the sixteen data ids (DATA_ID + 37 i) mod 256.
"""
import random

import e2e.p01
import e2e.p02

MODES = {"both": e2e.p01.E2E_P01_DATAID_BOTH, "alternating": e2e.p01.E2E_P01_DATAID_ALT,
         "low": e2e.p01.E2E_P01_DATAID_LOW}
rng = random.Random(1)
for _ in range(40):
    number = rng.randrange(0x10000)
    for name, mode in MODES.items():
        for counter in (0, 7, 14):
            data = bytearray(rng.randbytes(8))
            data[1] = data[1] & 0xF0 | counter
            e2e.p01.e2e_p01_protect(data, number, data_id_mode=mode, increment_counter=False)
            print("p1", name, number, data.hex())
    for counter in (0, 8, 15):
        data = bytearray(rng.randbytes(8))
        data[1] = data[1] & 0xF0 | counter
        ids = bytes((number + i * 37) & 0xFF for i in range(16))
        e2e.p02.e2e_p02_protect(data, ids, increment_counter=False)
        print("p2", "-", number, data.hex())
