"""Writes free_rotation.json: torque-free motions to 30 digits, the truth for the closed form.

    python3 tests/data/make_free_rotation.py

Integrated with taylor.py twice, with steps of h and of 0.8 h; the larger difference of the two is
recorded in each case as `accuracy`. `turned` is the angle turned since t = 0, the integral of |ω|.
"""

import json
import math
import platform
import random
from fractions import Fraction
from multiprocessing import Pool
from pathlib import Path

from taylor import Body, digits, distance, solve

HALF = (0.5, -0.5, 0.5, 0.5)
ONE = (1.0, 0.0, 0.0, 0.0)


def cases():
    rng = random.Random(20)
    for i in range(40):
        # a body that exists: moments from three positive sums Σ m x²
        x = [10 ** rng.uniform(-2, 1) for _ in range(3)]
        moments = (x[1] + x[2], x[2] + x[0], x[0] + x[1])
        omega = [rng.gauss(0, 1) for _ in range(3)]
        size = math.sqrt(sum(w * w for w in omega))
        yield f"random {i}", moments, tuple(a * w / size for a, w in zip(moments, omega)), HALF if i % 2 else ONE, (1.0, 10.0, 100.0)

    yield "generic", (0.8, 1.5, 2.1), (0.5, -1.3, 0.7), HALF, (-7.0, 0.1, 10.0, 100.0, 1000.0)
    yield "fast spin", (0.8, 1.5, 2.1), (8000.0, 300.0, -1000.0), ONE, (0.01, 0.5)
    yield "fast tumble", (0.8, 1.5, 2.1), (3000.0, 9000.0, -10000.0), ONE, (0.01, 0.5)
    yield "disc", (1.0, 1.0, 2.0), (0.3, -0.4, 1.7), HALF, (1.0, 100.0, 1000.0)
    yield "nearly a disc", (1.0, 1.0 + 1e-9, 2.0 + 1e-9), (0.3, -0.4, 1.7), HALF, (1.0, 100.0, 1000.0)
    yield "sphere", (0.4, 0.4, 0.4), (0.3, -0.4, 1.7), HALF, (1.0, 100.0)
    yield "symmetric", (2.0, 0.7, 2.0), (-0.3, -0.9, 0.2), ONE, (1.0, 100.0, 1000.0)
    yield "near-spherical", (1.0, 1.0 + 1e-9, 1.0 + 2e-9), (0.6, -0.7, 0.5), HALF, (1.0, 100.0, 1000.0)
    yield "near-spherical to an ulp", (1.0, 1.0 + 2.0**-52, 1.0 + 2.0**-51), (0.6, -0.7, 0.5), HALF, (1.0, 100.0, 1000.0)
    yield "near-spherical 1e-5", (1.0, 1.0 + 1e-5, 1.0 + 1.7e-5), (0.6, 0.7, -0.5), HALF, (1.0, 100.0, 1000.0)

    # the middle axis, tipped by 1e-6 and 1e-12: flips, and the instants inside a flip
    flips = (1.0, 10.0, 20.0, 22.0, 24.0, 25.0, 26.0, 27.0, 28.0, 29.0, 30.0, 50.0, 200.0)
    yield "dzhanibekov", (1.0, 2.0, 3.0), (1e-6, 2.0, 1e-6), ONE, flips
    yield "dzhanibekov from the other side", (3.0, 1.0, 2.0), (-1e-6, 0.0, -2.0), HALF, flips
    yield "dzhanibekov 1e-12", (1.0, 2.0, 3.0), (1e-12, 2.0, -1e-12), ONE, (10.0, 40.0, 47.0, 48.0, 49.0, 50.0, 51.0, 60.0, 100.0)

    # L₃ = 3 L₁ is the separatrix of these moments without any rounding; one side leads into the
    # middle axis, the other away from it
    yield "separatrix", (1.0, 2.0, 2.25), (0.5, 0.25, 1.5), ONE, (-16.0, 1.0, 4.0, 16.0, 64.0)
    yield "separatrix outward", (1.0, 2.0, 2.25), (0.5, 1.25, -1.5), ONE, (1.0, 4.0, 16.0)
    yield "near separatrix, inside", (1.0, 2.0, 2.25), (0.5, 0.25, 1.5 + 1e-13), HALF, (16.0, 64.0, 200.0)
    yield "near separatrix, outside", (1.0, 2.0, 2.25), (0.5, 0.25, 1.5 - 1e-13), HALF, (16.0, 64.0, 200.0)
    yield "near separatrix, rounded", (1.0, 2.0, 3.0), (1.0, 0.3, 1.7320508075688772), ONE, (1.0, 4.0, 16.0)

    # a rod, 1e6 to 1, end over end with a slow and a fast spin
    yield "needle", (1e-6, 1.0, 1.0 + 5e-7), (5e-6, 0.8, 0.6), ONE, (1.0, 100.0, 1000.0)
    yield "needle, symmetric", (1e-6, 1.0, 1.0), (5e-6, 0.8, 0.6), HALF, (1.0, 100.0, 1000.0)
    yield "needle, hardly spinning", (1e-6, 1.0, 1.0 + 5e-7), (1e-10, 0.1, 1.0), ONE, (1.0, 100.0, 1000.0)
    yield "needle, tumbling", (1.0, 1e-6, 1.0 + 9e-7), (1e-3, 1e-13, 1.0), ONE, (1.0, 100.0, 1000.0)

    yield "steady on the middle axis", (1.0, 2.0, 3.0), (0.0, 2.0, 0.0), ONE, (1.0, 100.0)
    yield "steady on the minor axis", (1.0, 2.0, 3.0), (-2.0, 0.0, 0.0), HALF, (1.0, 100.0)
    yield "steady on the major axis", (1.0, 2.0, 3.0), (0.0, 0.0, 2.0), HALF, (1.0, 100.0)
    yield "small wobble, major", (1.0, 2.0, 3.0), (1e-9, -2e-9, 2.0), HALF, (1.0, 100.0)
    yield "small wobble, minor", (1.0, 2.0, 3.0), (1.5, 1e-7, 0.0), HALF, (1.0, 100.0)
    # MuJoCo issue 3553: a thin plate's moments
    yield "mujoco 3553", (1.7231e-4, 6.58e-6, 1.7243e-4), (1e-4, 3e-5, -2e-4), ONE, (1.0, 10.0, 100.0)
    yield "tiny numbers", (1e-30, 2e-30, 2.5e-30), (1e-30, -1e-30, 2e-30), ONE, (1.0, 100.0)

    # the way to a symmetric body, from the pair of larger and from the pair of smaller moments
    for exponent in range(-16, -1):
        d = 10.0**exponent
        yield f"sweep larger pair 1e{exponent}", (1.0, 2.0, 2.0 * (1.0 + d)), (0.7, 1.1, -0.4), ONE, (100.0,)
        yield f"sweep smaller pair 1e{exponent}", (1.0 * (1.0 + d), 1.0, 1.8), (0.7, 1.1, -0.4), ONE, (100.0,)
        # turning across the pair's axis, where the separatrix of a nearly symmetric body lies
        yield f"sweep across 1e{exponent}", (1.0, 2.0, 2.0 * (1.0 + d)), (d**0.5, 1.1, -0.4), ONE, (100.0,)

    # half way between the two sets of series: K′/K about ½
    for i, tip in enumerate((0.098, 0.1, 0.102, 0.104, 0.106, 0.108, 0.11, 0.112, 0.114, 0.116, 0.118, 0.12, 0.13, 0.14, 0.15)):
        yield f"series switch {i}", (1.0, 2.0, 3.0), (tip, 1.0, 0.1), ONE, (10.0, 100.0)


def run(case):
    name, moments, momentum, orientation, times = case
    before = sorted((t for t in times if t < 0), reverse=True)
    after = sorted(t for t in times if t > 0)
    rows, accuracy = [], 0.0
    for group in (before, after):
        if not group:
            continue
        body = Body(moments, momentum, orientation)
        # the unit of momentum makes no difference to the motion but keeps fixed point accurate
        size = Fraction(max(abs(x) for x in momentum))
        unit = Body([Fraction(i) / size for i in moments], [Fraction(x) / size for x in momentum], orientation)
        coarse, fine = solve(unit, group), solve(unit, group, refine=1.25)
        accuracy = max([accuracy] + [max(distance(a, b)) for a, b in zip(coarse, fine)])

        for t, (q, l, turned) in zip(group, fine):
            rows.append({
                "t": t,
                "turned": float(f"{abs(turned):.4g}"),
                "orientation": [digits(x) for x in q],
                "angular_momentum_body": [digits(x * size) for x in l],
            })
    return {"name": name, "moments": moments, "orientation": orientation, "angular_momentum_body": momentum,
            "accuracy": float(f"{accuracy:.1g}"), "states": rows}


def text(header, results):
    """One line a state, numbers of the truth with all their digits."""
    lines = ["{", *(f' {json.dumps(k)}: {json.dumps(v)},' for k, v in header.items()), ' "cases": [']
    for i, case in enumerate(results):
        states = case.pop("states")
        head = json.dumps(case)[:-1]
        lines.append(f'  {head}, "states": [')
        rows = []
        for state in states:
            parts = []
            for key, value in state.items():
                parts.append(f'"{key}": [{", ".join(value)}]' if isinstance(value, list) else f'"{key}": {json.dumps(value)}')
            rows.append("   {" + ", ".join(parts) + "}")
        lines.append(",\n".join(rows))
        lines.append("  ]}" + ("," if i + 1 < len(results) else ""))
    return "\n".join([*lines, " ]", "}", ""])


def main():
    # the long ones first
    todo = sorted(cases(), key=lambda case: -case[4][-1] * max(abs(l / i) for l, i in zip(case[2], case[1])))
    with Pool(2) as pool:
        done = {result["name"]: result for result in pool.imap_unordered(run, todo)}
    results = [done[case[0]] for case in cases()]
    header = {
        "about": "Torque-free rotation: principal moments [kg m²], orientation (w, x, y, z) body to world, momentum in body axes [kg m²/s]. "
        "Orientations are of q/|q| and given up to sign. The inputs are exact doubles.",
        "made_by": f"python3 tests/data/make_free_rotation.py (Python {platform.python_version()}, integers of 144 bits, Taylor order 32)",
        "accuracy": max(r["accuracy"] for r in results),
    }
    Path(__file__).with_name("free_rotation.json").write_text(text(header, results), encoding="utf-8")


if __name__ == "__main__":
    main()
