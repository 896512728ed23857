#!/usr/bin/env python3
"""Writes engine/core/palpate/base/elementary_numbers.txt: what the elementary functions look up, from 60 digits.

  tools/fit_elementary.py            writes the table
  tools/fit_elementary.py --check    exit code 1 when the table is not what would be written

Needs mpmath (python3-mpmath)."""
import argparse
import pathlib
import sys

import mpmath
from mpmath import mpf

mpmath.mp.prec = 1400  # 2/pi is written to 1200 bits
TABLE = pathlib.Path(__file__).resolve().parent.parent / "engine/core/palpate/base/elementary_numbers.txt"


def double(value):
    """Rounded once."""
    with mpmath.workprec(53):
        return float(+value)


def words(value):
    return float.hex(value)


def pair(value):
    """Two doubles whose sum is the value to some 2^-107 of it."""
    high = double(value)
    return high, double(value - mpf(high))


def short(value, bits):
    """The leading bits of the value: products with whole numbers of the other 53 - bits are exact."""
    scale = mpf(2) ** (bits - 1 - int(mpmath.floor(mpmath.log(abs(value), 2))))
    return float(mpmath.nint(value * scale) / scale)


def table(kind, name, about, rows):
    """A table as cmake/PalpateNumbers.cmake reads it."""
    return f"\n# {about}\n{kind} {name}\n" + "".join(", ".join(row) + "\n" for row in rows)


def pair_table(name, about, values):
    return table("DoublePair[]", name, about, ([words(part) for part in pair(v)] for v in values))


def doubles(name, about, values):
    return table("double[]", name, about, ([words(double(v))] for v in values))


def pair_constant(name, about, value):
    return table("DoublePair", name, about, [[words(part) for part in pair(value)]])


def constant(name, about, value):
    return table("double", name, about, [[words(double(value))]])


def parts(name, about, value, bits, count):
    """count doubles; all but the last have few bits, the last is what is left."""
    found = []
    for _ in range(count - 1):
        found.append(short(value, bits))
        value -= mpf(found[-1])
    found.append(double(value))
    return table("double[]", name, about, [[words(n) for n in found]])


def text():
    ln2, pi = mpmath.log(2), mpmath.pi
    two_over_pi = mpmath.floor(2 / pi * mpf(2) ** 1216)
    limbs = [int(two_over_pi / mpf(2) ** (1216 - 32 * (i + 1))) & 0xFFFFFFFF for i in range(38)]
    out = "# Written by tools/fit_elementary.py; do not edit by hand. What base/elementary.cpp looks up.\n"
    out += parts("kLn2", "ln 2. The first has 32 bits: its product with an exponent is exact.", ln2, 32, 2)
    out += parts("kLn2Of128", "ln 2 / 128. The first has 32 bits: its product with a whole number below 2^18 is exact.", ln2 / 128, 32, 2)
    out += constant("k128OfLn2", "128 / ln 2.", 128 / ln2)
    out += pair_constant("kOneOfLn2", "1 / ln 2.", 1 / ln2)
    out += parts("kHalfPi", "pi / 2. Products of all but the last with a whole number below 2^20 are exact.", pi / 2, 33, 4)
    out += pair_constant("kHalfPiPair", "pi / 2.", pi / 2)
    out += pair_constant("kPiPair", "pi.", pi)
    out += constant("kTwoOfPi", "2 / pi.", 2 / pi)
    out += table("std::uint32_t[]", "kTwoOfPiBits", "2 / pi as a binary fraction, 32 bits each.",
                 ([f"0x{limb:08x}" for limb in limbs[i:i + 8]] for i in range(0, 38, 8)))
    out += pair_table("kExp2Of128ths", "2^(j / 128), j from 0.", (mpf(2) ** (mpf(j) / 128) for j in range(128)))
    out += pair_table("kLogOf128ths", "ln(j / 128), j from kFirstLog.", (mpmath.log(mpf(j) / 128) for j in range(90, 183)))
    out += "\nint kFirstLog\n90\n"
    out += doubles("kOneOf128ths", "128 / j, j from kFirstLog.", (mpf(128) / j for j in range(90, 183)))
    out += pair_table("kAtanOf64ths", "atan(j / 64), j from 0 to 64.", (mpmath.atan(mpf(j) / 64) for j in range(65)))
    out += pair_table("kErfOf16ths", "erf(j / 16), j from 0 to 96.", (mpmath.erf(mpf(j) / 16) for j in range(97)))
    slopes = (2 / mpmath.sqrt(pi) * mpmath.exp(-(mpf(j) / 16) ** 2) for j in range(97))
    out += doubles("kErfSlopeOf16ths", "2 / sqrt(pi) exp(-(j / 16)^2): the slope of erf, j from 0 to 96.", slopes)
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="write nothing")
    if parser.parse_args().check:
        if TABLE.read_text() != text():
            sys.exit(f"{TABLE}: not what tools/fit_elementary.py writes")
    else:
        TABLE.write_text(text())


if __name__ == "__main__":
    main()
