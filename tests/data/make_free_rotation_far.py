"""Writes free_rotation_far.json: torque-free motions after up to 1e9 s, to 30 digits.

    python3 tests/data/make_free_rotation_far.py

No formula of an exact solution is used: the period T of the momentum in body axes and the rotation that
the body has made after it, a turn about L, are found by integrating one period with taylor.py (Newton's
method on the return of L); n periods are the n-th power of that turn, and what remains is integrated.
"""

import json
import math
import platform
from fractions import Fraction
from pathlib import Path

from make_free_rotation import HALF, ONE, text
from taylor import Body, digits, distance, solve

BITS = 260
CASES = [
    ("generic", (0.8, 1.5, 2.1), (0.5, -1.3, 0.7), HALF, (1e4, 1e6, -1e6, 1e9)),
    ("generic, about the minor axis", (2.5, 0.75, 1.5), (0.25, -1.0, 0.5), ONE, (1e4, 1e6, 1e9)),
    ("nearly symmetric", (1.0, 1.0 + 1e-3, 1.75), (0.3, -0.4, 1.7), HALF, (1e4, 1e6, 1e9)),
    ("flipping", (1.0, 2.0, 3.0), (1e-2, 2.0, 1e-2), ONE, (1e4, 1e6, 1e9)),
]


def rounded(x):
    return Fraction((x.numerator << BITS) // x.denominator, 1 << BITS)


def product(a, b):
    (s, x, y, z), (w, i, j, k) = a, b
    return [rounded(v) for v in (s * w - x * i - y * j - z * k, s * i + x * w + y * k - z * j,
                                 s * j - x * k + y * w + z * i, s * k + x * j - y * i + z * w)]


def conjugate(q):
    return [q[0], -q[1], -q[2], -q[3]]


def power(q, n):
    result = [Fraction(1), Fraction(0), Fraction(0), Fraction(0)]
    while n:
        if n & 1:
            result = product(result, q)
        q, n = product(q, q), n >> 1
    return result


def at(body, t, **options):
    return solve(body, [t], **options)[0]


def period(body, options):
    """Time of the first return of L, to all digits."""
    start = [float(x) for x in body.momentum]
    size = math.sqrt(sum(x * x for x in start))
    step = 0.05 / max(abs(float(l / i)) for l, i in zip(body.momentum, body.moments))
    times = [Fraction(step * k) for k in range(1, 4001)]
    path = solve(body, times, order=16, bits=80, tail_bits=34)
    # the first local minimum of the distance that is a return (the step is short against the path)
    gap = [math.sqrt(sum((float(a) - b) ** 2 for a, b in zip(s[1], start))) / size for s in path]
    k = next(k for k in range(1, len(gap) - 1) if gap[k] < 0.05 and gap[k] <= gap[k - 1] and gap[k] < gap[k + 1])
    t = times[k]

    # Newton on the component that moves fastest, L' = L × ω
    rate = lambda l: [l[(i + 1) % 3] * l[(i + 2) % 3] * (1 / body.moments[(i + 2) % 3] - 1 / body.moments[(i + 1) % 3]) for i in range(3)]
    fast = max(range(3), key=lambda i: abs(rate(body.momentum)[i]))
    for _ in range(8):
        l = at(body, t, **options)[1]
        correction = (l[fast] - body.momentum[fast]) / rate(l)[fast]
        t = rounded(t - correction)
        if abs(correction) < Fraction(1, 10**40):
            return t
    raise RuntimeError("no period found")


def far(body, times, options):
    t_return = period(body, options)
    q0 = at(body, Fraction(1, 10**60), **options)[0]
    q_return, _, turned = at(body, t_return, **options)
    turn = product(q_return, conjugate(q0))
    states = []
    for t in times:
        n = int(Fraction(t) // t_return)
        q, l, rest = at(body, Fraction(t) - n * t_return, **options)
        whole = power(turn, n) if n >= 0 else conjugate(power(turn, -n))
        states.append((product(whole, q), l, abs(n) * turned + rest))
    return states


def main():
    results = []
    for name, moments, momentum, orientation, times in CASES:
        body = Body(moments, momentum, orientation)
        best = dict(order=48, bits=BITS, tail_bits=160)
        coarse, fine = far(body, times, best), far(body, times, best | {"refine": 1.25})
        accuracy = max(max(distance(a, b)) for a, b in zip(coarse, fine))
        rows = [{"t": t, "turned": float(f"{turned:.4g}"), "orientation": [digits(x) for x in q],
                 "angular_momentum_body": [digits(x) for x in l]} for t, (q, l, turned) in zip(times, fine)]
        results.append({"name": name, "moments": moments, "orientation": orientation, "angular_momentum_body": momentum,
                        "accuracy": float(f"{accuracy:.1g}"), "states": rows})
    header = {
        "about": "Torque-free rotation after long times; the fields are those of free_rotation.json.",
        "made_by": f"python3 tests/data/make_free_rotation_far.py (Python {platform.python_version()}, integers of {BITS} bits, Taylor order 48)",
        "accuracy": max(r["accuracy"] for r in results),
    }
    Path(__file__).with_name("free_rotation_far.json").write_text(text(header, results), encoding="utf-8")


if __name__ == "__main__":
    main()
