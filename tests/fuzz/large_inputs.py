#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes inputs of a megabyte for a fuzz target: large_inputs.py TARGET FOLDER [COUNT].

Each is an input of the corpus with one part repeated: a line, or characters that mean something to a reader. A reader whose time or
memory grows with the square of the input does not pass them.
"""
import pathlib
import random
import sys

SIZE = 1_000_000
PARTS = [b",", b";", b"\t", b"\t1", b" ", b'"', b"\n", b"\r\n", b"1,", b"1.234.", b"1'", b"\xc2\xa0", b"\xff", b"\0", b"[", b"{a=",
         b"a.", b"((", b"m.", b"m-1 ", b"9", b"a=1 "]
FIRST_LINES = 12  # where parts are put; later lines are like these


def repeated(part, size=SIZE):
    return part * (size // len(part))


def recipes(seed):
    """Ways to enlarge an input, each a function without arguments."""
    lines = seed.splitlines(keepends=True)
    for number, line in enumerate(lines):
        before, after = b"".join(lines[:number]), b"".join(lines[number + 1:])
        bare = line.rstrip(b"\r\n")
        yield lambda b=before, l=line, a=after: b + repeated(l) + a
        for part in PARTS if number < FIRST_LINES else []:
            yield lambda b=before, p=part, l=line, a=after: b + repeated(p) + l + a
            yield lambda b=before, p=part, l=bare, a=after: b + l + repeated(p) + b"\n" + a
        for separator in (b",", b";", b"\t"):
            if separator in line and after:  # many columns, many rows that lack them
                yield lambda b=before, s=separator, l=bare, a=after, row=lines[-1]: (
                    b + l + repeated(s + b"strain", SIZE // 2) + b"\n" + a + repeated(row, SIZE // 2))


def main():
    target, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    count = int(sys.argv[3]) if len(sys.argv) > 3 else 40
    corpus = pathlib.Path(__file__).parent / "corpus" / target
    ways = [way for seed in sorted(corpus.iterdir()) for way in recipes(seed.read_bytes())]
    random.Random(target).shuffle(ways)
    for number, way in enumerate(ways[:count]):
        (folder / f"{number:04d}").write_bytes(way())


if __name__ == "__main__":
    main()
