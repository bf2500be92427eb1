"""Rigid-body motion in multi-precision arithmetic: Taylor series in fixed-point integers.

    L' = L × ω + M_body        ω_i = L_i / I_i        (principal axes, body frame)
    q' = ½ q [0, ω]            (body to world, lecture eq. 27)
    γ' = γ × ω                 (a vector fixed in the world, seen from the body)

The torques are sums of: c × γ (weight at the point c), a γ itself (constant torque in the world),
b sin(w t + φ) (body axes) and −d ω (linear drag). Every right side is a polynomial of the unknowns,
so the Taylor coefficients follow from convolutions; no formula of an exact solution is used.

Numbers are integers in units of 2^-BITS; time is scaled by the step, so coefficients decay and none
overflows its meaning. A step whose last two coefficients exceed `tail` stops the run, which then
starts again with half the step. Only the standard library of Python is needed.
"""

from fractions import Fraction
from math import ceil, isqrt
from operator import mul


class TooLong(Exception):
    """A step was too long for its order."""


class Body:
    """Initial values and torques; every number is read exactly (float, int, str or Fraction)."""

    def __init__(self, moments, momentum, orientation=(1, 0, 0, 0), weight=None, world_torque=None, sine=None, drag=0):
        self.moments = [Fraction(x) for x in moments]
        self.momentum = [Fraction(x) for x in momentum]
        self.orientation = [Fraction(x) for x in orientation]
        # weight: (m g c in body axes); gravity points along −z of the world
        self.weight = None if weight is None else [Fraction(x) for x in weight]
        self.world_torque = None if world_torque is None else [Fraction(x) for x in world_torque]
        # sine: (amplitude in body axes, angular frequency); phase 0
        self.sine = sine
        self.drag = Fraction(drag)


def solve(body, times, order=32, bits=144, tail_bits=96, refine=1):
    """States at `times`: a list of (q, L), lists of Fractions, and the radians turned up to each."""
    steps_per_radian = 4 * Fraction(refine)
    for _ in range(12):
        try:
            return _solve(body, times, order, bits, tail_bits, steps_per_radian)
        except TooLong:
            steps_per_radian *= 2
    raise RuntimeError("no step is short enough")


def _solve(body, times, order, bits, tail_bits, steps_per_radian):
    one = 1 << bits
    fix = lambda x: (x.numerator << bits) // x.denominator
    momentum = list(body.momentum)
    l = [fix(x) for x in momentum]
    q = [fix(x) for x in body.orientation]
    length = isqrt(sum(x * x for x in q))
    q = [(x << bits) // length for x in q]

    # vectors fixed in the world, seen from the body
    carried = []
    if body.weight is not None:
        carried.append(_to_body(q, [0, 0, one], bits))
    if body.world_torque is not None:
        carried.append(_to_body(q, [fix(x) for x in body.world_torque], bits))
    sine = [0, one]  # sin, cos of w t

    # the length of a step follows the greatest rate at hand
    rate = max(
        [abs(x / i) for x, i in zip(momentum, body.moments)] + ([Fraction(body.sine[1])] if body.sine else []) + [Fraction(1, 10)]
    )
    out, t, turned = [], Fraction(0), 0.0
    for end in times:
        end = Fraction(end)
        count = max(1, ceil(abs(end - t) * rate * steps_per_radian))
        h = (end - t) / count
        inverse = [fix(h / i) for i in body.moments]
        for _ in range(count):
            w = [float((x * a) >> bits) / one for x, a in zip(l, inverse)]
            l, q, carried, sine = _step(body, fix, h, inverse, l, q, carried, sine, order, bits, tail_bits)
            w2 = [float((x * a) >> bits) / one for x, a in zip(l, inverse)]
            turned += 0.5 * (sum(x * x for x in w) ** 0.5 + sum(x * x for x in w2) ** 0.5)
        t = end
        out.append(([Fraction(x, one) for x in q], [Fraction(x, one) for x in l], turned))
    return out


def _to_body(q, v, bits):
    s, u = q[0], q[1:]
    m = lambda a, b: (a * b) >> bits
    # Rᵀ v = v − 2 s (u × v) + 2 u × (u × v)
    c = [m(u[1], v[2]) - m(u[2], v[1]), m(u[2], v[0]) - m(u[0], v[2]), m(u[0], v[1]) - m(u[1], v[0])]
    d = [m(u[1], c[2]) - m(u[2], c[1]), m(u[2], c[0]) - m(u[0], c[2]), m(u[0], c[1]) - m(u[1], c[0])]
    return [v[i] - 2 * m(s, c[i]) + 2 * d[i] for i in range(3)]


def _step(body, fix, h, inverse, l0, q0, carried0, sine0, order, bits, tail_bits):
    l = [[x] for x in l0]
    q = [[x] for x in q0]
    carried = [[[x] for x in v] for v in carried0]
    sine = [[x] for x in sine0]
    w = [[], [], []]  # ω h
    weight = None if body.weight is None else [fix(h * x) for x in body.weight]
    step = fix(h)
    drag = fix(body.drag)
    if body.sine:
        amplitude, frequency = [fix(h * Fraction(x)) for x in body.sine[0]], fix(h * Fraction(body.sine[1]))
    for k in range(order):
        for i in range(3):
            w[i].append((l[i][k] * inverse[i]) >> bits)
        wr = [w[i][::-1] for i in range(3)]
        dot = lambda a, b: sum(map(mul, a, b))

        new_l = []
        for i in range(3):
            j, m = (i + 1) % 3, (i + 2) % 3
            rate = (dot(l[j], wr[m]) - dot(l[m], wr[j])) >> bits
            if weight:
                # c × (−γ) m g
                rate -= (weight[j] * carried[0][m][k] - weight[m] * carried[0][j][k]) >> bits
            if body.world_torque is not None:
                rate += (step * carried[-1][i][k]) >> bits
            if body.sine:
                rate += (amplitude[i] * sine[0][k]) >> bits
            if drag:
                rate -= (drag * w[i][k]) >> bits
            new_l.append(rate)
        new_q = [
            -dot(q[1], wr[0]) - dot(q[2], wr[1]) - dot(q[3], wr[2]),
            dot(q[0], wr[0]) + dot(q[2], wr[2]) - dot(q[3], wr[1]),
            dot(q[0], wr[1]) + dot(q[3], wr[0]) - dot(q[1], wr[2]),
            dot(q[0], wr[2]) + dot(q[1], wr[1]) - dot(q[2], wr[0]),
        ]
        new_carried = []
        for v in carried:
            new_carried.append(
                [(dot(v[(i + 1) % 3], wr[(i + 2) % 3]) - dot(v[(i + 2) % 3], wr[(i + 1) % 3])) >> bits for i in range(3)]
            )
        if body.sine:
            new_sine = [(frequency * sine[1][k]) >> bits, -((frequency * sine[0][k]) >> bits)]

        for i in range(3):
            l[i].append(new_l[i] // (k + 1))
        for i in range(4):
            q[i].append((new_q[i] >> (bits + 1)) // (k + 1))
        for v, new in zip(carried, new_carried):
            for i in range(3):
                v[i].append(new[i] // (k + 1))
        if body.sine:
            for i in range(2):
                sine[i].append(new_sine[i] // (k + 1))

    # the last coefficients tell whether the series has converged, relative to the momentum's size
    tail = 1 << (bits - tail_bits)
    size = max(abs(x) for x in l0)
    scale = max(size, 1) / (1 << bits)
    for v, unit in [(x, min(1.0, scale) if scale else 1.0) for x in l] + [(x, 1.0) for x in q]:
        if max(abs(v[order]), abs(v[order - 1])) > tail * unit:
            raise TooLong
    return [sum(x) for x in l], [sum(x) for x in q], [[sum(x) for x in v] for v in carried], [sum(x) for x in sine]


def digits(x, n=32):
    """A Fraction as a decimal of n significant digits."""
    from decimal import Context, Decimal

    context = Context(prec=n)
    return str(context.divide(Decimal(x.numerator), Decimal(x.denominator)))


def distance(a, b):
    """Largest difference of two states: of orientations (2 |q_a ∓ q_b|) and of momenta over |L|."""
    sign = 1 if sum(x * y for x, y in zip(a[0], b[0])) > 0 else -1
    dq = 2 * float(sum((x - sign * y) ** 2 for x, y in zip(a[0], b[0]))) ** 0.5
    size = float(sum(x * x for x in b[1])) or 1.0
    dl = (float(sum((x - y) ** 2 for x, y in zip(a[1], b[1]))) / size) ** 0.5
    return dq, dl
