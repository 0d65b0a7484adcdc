"""A law of Python as a law program: LawInput on standard input, LawAnswer on standard output (the other end of `Program`)."""

from __future__ import annotations

import os
import struct
import sys

from google.protobuf.message import DecodeError

from .. import phare_pb2 as pb
from ..errors import BadInput
from .controller import Controller
from .messages import Given, LampOfLaw


def serve(law: Controller) -> None:
    """Answers until the input ends. What the law prints goes to standard error. Raises BadInput when the input is no LawInput."""
    source = sys.stdin.buffer
    with os.fdopen(os.dup(1), "wb", buffering=0) as answers:
        os.dup2(2, 1)
        lamps: list[LampOfLaw] | None = None
        try:
            while head := source.read(4):
                body = source.read(struct.unpack("<I", head)[0]) if len(head) == 4 else b""
                message = pb.LawInput()
                try:
                    message.ParseFromString(body)
                except DecodeError as wrong:
                    raise BadInput(f"standard input: no LawInput: {wrong}") from wrong
                if len(head) < 4 or lamps is None and not message.lamps:
                    raise BadInput("standard input: no LawInput with the lamps, after four bytes of its length, little-endian")
                given = Given.of_proto(message, lamps)
                if message.lamps:
                    lamps = given.lamps
                    law.begin(lamps)
                answer = law.step(given).to_proto(given.lamps).SerializeToString()
                answers.write(struct.pack("<I", len(answer)) + answer)
        finally:
            law.end()
