#!/usr/bin/env python3
"""Coefficients of the elementary functions of runtime/math.

*A function, an interval and a scalar* -> *its minimax polynomial with coefficients of this scalar, as Rust writes them*.

    python3 tests/data/elementary.py             print every constant with the error of its polynomial
    python3 tests/data/elementary.py --check     look each of them up in runtime/math/src

Each polynomial is found by Remez's exchange algorithm for the relative error of the whole function, with 80 digits. Its
coefficients are then rounded one after the other, lowest power first, and those that follow are found again with the rounded
ones fixed, so that they make up for the rounding. The parts of pi/2 are its leading bits, cut off so that their products with
a number of quadrants are exact; see Cody & Waite, Software Manual for the Elementary Functions (1980), and Muller, Elementary
Functions. The bits of 2/pi are for the reduction of Payne & Hanek (1983).

Needs mpmath.
"""

import re
import struct
import sys
from pathlib import Path

from mpmath import atan, cos, floor, frexp, log, lu_solve, matrix, mp, mpf, nstr, pi, sin, sqrt, workprec

mp.dps = 80
SOURCES = Path(__file__).resolve().parents[2] / "runtime/math/src"


def rounded(value, bits):
    """The nearest number with so many bits; none of ours is subnormal, and no tie occurs."""
    if value == 0:
        return mpf(0)
    significand, exponent = frexp(value)
    return floor(significand * mpf(2) ** bits + mpf("0.5")) * mpf(2) ** (exponent - bits)


def cut(value, bits):
    """The leading bits of a positive number."""
    significand, exponent = frexp(value)
    return floor(significand * mpf(2) ** bits) * mpf(2) ** (exponent - bits)


def remez(target, weight, fixed, count, top):
    """The polynomial in z on [0, top] with these leading coefficients and `count` further ones, and its largest weighted error.

    The weighted error weight(z) * (p(z) - target(z)) then takes its largest magnitude count + 1 times, with alternating signs.
    """
    start = len(fixed)
    known = lambda z: sum(c * z**k for k, c in enumerate(fixed))
    # The points of Chebyshev's polynomial.
    points = [top * (1 - cos(pi * (k + mpf("0.5")) / (count + 1))) / 2 for k in range(count + 1)]
    steps = 400
    grid = [top * (1 - cos(pi * k / steps)) / 2 for k in range(1, steps + 1)]
    goals = {z: (target(z), weight(z)) for z in grid}
    for _ in range(30):
        rows = matrix(count + 1, count + 1)
        right = matrix(count + 1, 1)
        for row, z in enumerate(points):
            for k in range(count):
                rows[row, k] = z ** (start + k)
            rows[row, count] = (-1) ** row / weight(z)
            right[row] = target(z) - known(z)
        solution = lu_solve(rows, right)
        coefficients = list(fixed) + [solution[k] for k in range(count)]
        level = abs(solution[count])
        errors = [(goals[z][1] * (sum(c * z**k for k, c in enumerate(coefficients)) - goals[z][0]), z) for z in grid]
        # The largest of each run of one sign.
        extremes = []
        for error, z in errors:
            if extremes and (error > 0) == (extremes[-1][0] > 0):
                if abs(error) > abs(extremes[-1][0]):
                    extremes[-1] = (error, z)
            else:
                extremes.append((error, z))
        while len(extremes) > count + 1:
            extremes.pop(0 if abs(extremes[0][0]) < abs(extremes[-1][0]) else -1)
        if len(extremes) < count + 1:
            break
        largest = max(abs(error) for error, _ in extremes)
        points = [z for _, z in extremes]
        if largest < level * mpf("1.001"):
            break
    return coefficients, max(abs(error) for error, _ in errors)


def polynomial(target, weight, count, top, bits):
    """A polynomial whose coefficients have so many bits."""
    fixed = []
    for place in range(count):
        coefficients, error = remez(target, weight, fixed, count - place, top)
        fixed.append(rounded(coefficients[place], bits))
    steps = [top * k / 1000 for k in range(1, 1001)]
    return fixed, max(abs(weight(z) * (sum(c * z**k for k, c in enumerate(fixed)) - target(z))) for z in steps)


def families():
    """The name of each polynomial, its function of z = x^2, what its error is multiplied by, and where z ends."""
    quarter = pi / 4 * (1 + mpf(2) ** -10)
    sine = lambda z: (sin(sqrt(z)) - sqrt(z)) / sqrt(z) ** 3, lambda z: sqrt(z) ** 3 / sin(sqrt(z))
    cosine = lambda z: (cos(sqrt(z)) - 1 + z / 2) / z**2, lambda z: z**2 / cos(sqrt(z))
    bend = lambda z: (sqrt(z) - atan(sqrt(z))) / sqrt(z) ** 3, lambda z: sqrt(z) ** 3 / atan(sqrt(z))
    return [
        ("sine", *sine, quarter**2),
        ("cosine", *cosine, quarter**2),
        ("arctangent up to 1/2", *bend, (mpf(1) / 2) ** 2),
        ("arctangent up to 7/16", *bend, (mpf(7) / 16) ** 2),
    ]


def decimal(value, bits):
    """The fewest digits that give a float back."""
    if bits == 53:
        return repr(float(value))
    for digits in range(1, 12):
        text = nstr(value, digits)
        if struct.unpack("f", struct.pack("f", float(text)))[0] == float(value):
            return text
    raise ValueError(value)


def words(value, bits, count):
    """The leading bits of a number below one, in words."""
    whole = int(floor(value * mpf(2) ** (bits * count)))
    return [whole >> (bits * (count - 1 - place)) & (1 << bits) - 1 for place in range(count)]


def constants():
    """The name of each constant of each scalar, and how it is written."""
    found = []
    for scalar, bits, parts, counts in (("f64", 53, [36], [6, 6, 12, 11]), ("f32", 24, [11, 11], [3, 3, 5, 5])):
        rest = pi / 2
        for part in parts:
            found.append((f"{scalar} part of pi/2", decimal(cut(rest, part), bits)))
            rest -= cut(rest, part)
        found.append((f"{scalar} rest of pi/2", decimal(rounded(rest, bits), bits)))
        quarter = pi / 4 - rounded(pi / 4, bits)
        found.append((f"{scalar} rest of pi/4", decimal(rounded(quarter, bits), bits)))
        for (name, target, weight, top), count in zip(families(), counts):
            coefficients, error = polynomial(target, weight, count, top, bits)
            for place, coefficient in enumerate(coefficients):
                label = f"{scalar} {name} {place}, of a polynomial within 2^{nstr(log(error, 2), 4)}"
                found.append((label, decimal(coefficient, bits)))
    with workprec(1500):
        for scalar, bits, count in (("f64", 64, 19), ("f32", 32, 7)):
            half = int(floor(pi / 2 * mpf(2) ** (bits - 1) + mpf("0.5")))
            for name, word in [("pi/2", half)] + [("2/pi", word) for word in words(2 / pi, bits, count)]:
                found.append((f"{scalar} word of {name}", f"0x{word:0{bits // 4}x}"))
    return found


def plain(literal, scalar):
    """The magnitude of a literal as this scalar, whichever way it is written."""
    text = literal.replace("_", "")
    if text.startswith("0x"):
        return int(text, 16)
    value = abs(float(text))
    return struct.unpack("f", struct.pack("f", value))[0] if scalar == "f32" and value < 1e38 else value


def main():
    written = set()
    for path in sorted(SOURCES.glob("*.rs")):
        for literal in re.findall(r"0x[0-9a-f_]+|\d[\d_]*\.\d[\d_]*(?:e-?\d+)?", path.read_text()):
            written.update((scalar, plain(literal, scalar)) for scalar in ("f64", "f32"))
    missing = []
    for name, literal in constants():
        if "--check" not in sys.argv:
            print(f"{literal:26} {name}")
        elif (name[:3], plain(literal, name[:3])) not in written:
            missing.append(f"{name}: {literal} is not in {SOURCES.name}")
    if missing:
        sys.exit("\n".join(missing))


if __name__ == "__main__":
    main()
