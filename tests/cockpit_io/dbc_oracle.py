"""What cantools makes of a DBC file, for dbc_oracle_test.cpp to compare with.

dbc_oracle.py FILE.dbc: random frames of every message on stdout, one record a line:
  dropped LINE                          a line that cantools' grammar refuses, left out here
  message ID EXTENDED LENGTH            ID without the mark of a 29-bit id
  frame HEX                             random data, multiplexors set to values that exist
  signal NAME RAW_BITS_HEX VALUE        of the last frame: unsigned bits, and the physical value as C's %a
  encoded HEX                           the signals' raw values written by cantools into an empty frame
  scaled HEX                            the signals' physical values written by cantools into an empty frame
"""
import random
import re
import struct
import sys
import zlib

import cantools

FRAMES = 40


DIGIT = "BEGINS_WITH_DIGIT_"  # cantools refuses names such as 2017_5; Phare reports and keeps them


def load(path):
    """The file, less the lines that cantools cannot parse; ids and names it refuses are mended."""
    text = open(path, encoding="cp1252").read()
    text = re.sub(r"(?m)^(\s*(?:BO_ \d+|SG_|(?:CM_ SG_|VAL_) \d+) )(?=\d)", r"\g<1>" + DIGIT, text)
    lines, dropped = text.split("\n"), []
    while True:
        try:
            return cantools.database.load_string("\n".join(lines), "dbc", strict=False), dropped
        except Exception as problem:
            wide = re.search(r"more than 11 bits in message (\w+)", str(problem))
            found = re.search(r"at line (\d+)", str(problem))
            if wide:
                i = next(i for i, line in enumerate(lines) if re.match(rf"BO_ \d+ {wide.group(1)}\b", line))
                lines[i] = re.sub(r"\d+", lambda number: str(int(number.group()) | 1 << 31), lines[i], count=1)
            elif found and len(dropped) < 100:
                at = int(found.group(1)) - 1
                while at > 0 and not lines[at].strip():
                    at -= 1  # cantools may name the line after
                dropped.append(at + 1)
                lines[at] = ""
            else:
                raise


def positions(signal):
    """Bit numbers (byte * 8 + bit) of a signal, least significant first."""
    if signal.byte_order == "little_endian":
        return [signal.start + i for i in range(signal.length)]
    bits, bit = [], signal.start
    for _ in range(signal.length):
        bits.append(bit)
        bit = bit + 15 if bit % 8 == 0 else bit - 1
    return bits[::-1]


def put(data, signal, raw):
    for i, bit in enumerate(positions(signal)):
        data[bit // 8] = data[bit // 8] & ~(1 << bit % 8) | (raw >> i & 1) << bit % 8


def float_bits(signal, value):
    return struct.unpack("<I", struct.pack("<f", value))[0] if signal.length == 32 else \
        struct.unpack("<Q", struct.pack("<d", value))[0]


def choose(message, tree, data, rng):
    """Sets the multiplexors of a tree to values that exist, and floats to finite ones."""
    for node in tree:
        if isinstance(node, dict):
            (name, branches), = node.items()
            value = rng.choice(sorted(branches))
            put(data, message.get_signal_by_name(name), value)
            choose(message, branches[value], data, rng)
        else:
            signal = message.get_signal_by_name(node)
            if signal.is_float:
                put(data, signal, float_bits(signal, rng.uniform(-1e6, 1e6)))


class OneByOne:
    """A message whose signals overlap or do not fit, which cantools cannot take whole: a message for each that fits."""

    def __init__(self, message):
        parts = [cantools.database.can.Message(message.frame_id, message.name, message.length, [signal],
                                               is_extended_frame=message.is_extended_frame, strict=False)
                 for signal in message.signals]
        self.parts = [part for part in parts if decodes(part)]

    def decode(self, data, **flags):
        return {name: value for part in self.parts for name, value in part.decode(data, **flags).items()}

    def encode(self, values, **flags):
        whole = 0
        for part in self.parts:
            whole |= int.from_bytes(part.encode({s.name: values[s.name] for s in part.signals}, **flags), "big")
        return whole.to_bytes(self.parts[0].length, "big")


def decodes(message):
    try:
        message.decode(bytes(message.length))
        return True
    except Exception:
        return False


def main(path):
    database, dropped = load(path)
    for line in dropped:
        print("dropped", line)
    for message in database.messages:
        if message.length > 64 or message.name == "VECTOR__INDEPENDENT_SIG_MSG":
            continue
        print("message", message.frame_id, int(message.is_extended_frame), message.length)
        codec = message if message.is_multiplexed() or decodes(message) else OneByOne(message)
        rng = random.Random(zlib.crc32(message.name.encode()))
        for number in range(FRAMES):
            data = bytearray(rng.choices((0, 255), k=1) * message.length if number < 2 else rng.randbytes(message.length))
            choose(message, message.signal_tree, data, rng)
            try:
                raw = codec.decode(bytes(data), decode_choices=False, scaling=False)
                scaled = codec.decode(bytes(data), decode_choices=False, scaling=True)
            except Exception:
                continue  # multiplexors that overlap each other: this frame holds no value of one of them
            print("frame", data.hex() or "-")
            for name, value in raw.items():
                signal = message.get_signal_by_name(name)
                bits = float_bits(signal, value) if signal.is_float else value & (1 << signal.length) - 1
                print("signal", name.removeprefix(DIGIT), f"{bits:x}", float(scaled[name]).hex())
            try:
                print("encoded", codec.encode(raw, scaling=False, padding=False, strict=False).hex() or "-")
                print("scaled", codec.encode(scaled, scaling=True, padding=False, strict=False).hex() or "-")
            except Exception as problem:
                print("unencoded", str(problem).replace("\n", " "))


main(sys.argv[1])
