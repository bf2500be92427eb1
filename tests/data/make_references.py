"""Writes references.json: driven rotations to 28 digits, the truth of tests of order and of accuracy.

    python3 tests/data/make_references.py

Integrated with taylor.py twice, with steps of h and of 0.8 h; the larger difference of the two is recorded
in each case as `accuracy`. Torques, body axes along the principal axes:

    weight         m g c: a heavy top about its fixed point; c from there to the centre of mass in
                   body axes, gravity along −z of the world; moments and L are about the fixed point
    world_torque   constant in world axes
    sine           amplitude sin(angular_frequency t), amplitude in body axes
    drag           −d ω
"""

import json
import math
import platform
from multiprocessing import Pool
from pathlib import Path

from make_free_rotation import HALF, ONE, text
from taylor import Body, digits, distance, solve

DIGITS = 28


def tilted(angle):
    """A tilt about the x axis [rad], as the doubles that the case records."""
    return (math.cos(angle / 2), math.sin(angle / 2), 0.0, 0.0)


def cases():
    def case(name, moments, momentum, orientation, times, **torques):
        return {"name": name, "moments": moments, "orientation": orientation, "angular_momentum_body": momentum, **torques}, times

    yield case("heavy top", (0.8, 1.1, 0.5), (0.6, -0.4, 1.5), tilted(0.7), (1.0, 2.5, 5.0), weight=(0.7, -0.4, 1.9))
    yield case("heavy top, tumbling over", (0.8, 1.1, 0.5), (0.1, 0.3, 0.2), tilted(2.0), (1.0, 2.5, 5.0), weight=(0.0, 0.3, 2.5))
    yield case("kovalevskaya", (2.0, 2.0, 1.0), (1.0, 0.4, 1.2), tilted(0.5), (1.0, 5.0, 10.0), weight=(1.0, 0.0, 0.0))
    # momentum about the vertical is zero: in these axes L and the vertical (0, ·, ·) are at right angles
    yield case("goryachev-chaplygin", (4.0, 4.0, 1.0), (1.5, 0.0, 0.0), tilted(0.5), (1.0, 5.0, 10.0), weight=(1.0, 0.0, 0.0))
    yield case("lagrange, fast", (0.002, 0.002, 0.001), (0.0, 0.0, 0.3), tilted(0.4), (0.1, 0.5, 2.0), weight=(0.0, 0.0, 0.15))
    yield case("lagrange, slow", (0.3, 0.3, 0.1), (0.02, 0.0, 0.4), tilted(0.4), (1.0, 2.5, 5.0), weight=(0.0, 0.0, 1.0))

    # upright, tipped by 1e-3: stable above L₃² = 4 I₁ m g c = 1
    yield case("sleeping top, above its limit", (0.25, 0.25, 0.1), (0.0, 0.0, 1.01), tilted(1e-3), (1.0, 10.0, 30.0), weight=(0.0, 0.0, 1.0))
    yield case("sleeping top, below its limit", (0.25, 0.25, 0.1), (0.0, 0.0, 0.99), tilted(1e-3), (1.0, 10.0, 30.0), weight=(0.0, 0.0, 1.0))

    sine = {"amplitude": (0.4, -0.3, 0.5), "angular_frequency": 1.7}
    yield case("sine in body axes", (0.8, 1.5, 2.1), (0.5, -1.3, 0.7), HALF, (1.0, 5.0, 10.0), sine=sine)
    yield case("constant torque in the world", (0.8, 1.5, 2.1), (0.5, -1.3, 0.7), HALF, (1.0, 5.0, 10.0), world_torque=(0.2, 0.1, -0.3))
    yield case("spin-up from rest", (0.8, 1.5, 2.1), (0.0, 0.0, 0.0), ONE, (1.0, 5.0, 10.0), world_torque=(0.2, 0.1, -0.3))
    yield case("dzhanibekov with drag", (1.0, 2.0, 3.0), (1e-3, 2.0, 1e-3), ONE, (1.0, 10.0, 30.0), drag=0.02)
    yield case("damped tumble", (0.8, 1.5, 2.1), (0.5, -1.3, 0.7), HALF, (1.0, 5.0, 10.0), drag=0.3)
    yield case("everything", (0.8, 1.5, 2.1), (0.5, -1.3, 0.7), HALF, (1.0, 5.0, 10.0), weight=(0.3, 0.2, -0.4),
               world_torque=(0.2, 0.1, -0.3), sine=sine, drag=0.1)


def run(item):
    case, times = item
    sine = case.get("sine")
    body = Body(case["moments"], case["angular_momentum_body"], case["orientation"], case.get("weight"), case.get("world_torque"),
                sine and (sine["amplitude"], sine["angular_frequency"]), case.get("drag", 0))
    options = dict(order=40, bits=192, tail_bits=128)
    coarse, fine = solve(body, times, **options), solve(body, times, refine=1.25, **options)
    accuracy = max(max(distance(a, b)) for a, b in zip(coarse, fine))
    rows = [{"t": t, "turned": float(f"{turned:.4g}"), "orientation": [digits(x, DIGITS) for x in q],
             "angular_momentum_body": [digits(x, DIGITS) for x in l]} for t, (q, l, turned) in zip(times, fine)]
    return {**case, "accuracy": float(f"{accuracy:.1g}"), "states": rows}


def main():
    with Pool(2) as pool:
        results = pool.map(run, list(cases()), chunksize=1)
    header = {
        "about": "Driven rotation: principal moments [kg m²], orientation (w, x, y, z) body to world, momentum in body axes [kg m²/s]; weight [N m], "
        "torques [N m], drag [N m s]. Orientations are of q/|q| and given up to sign. The inputs are exact doubles.",
        "made_by": f"python3 tests/data/make_references.py (Python {platform.python_version()}, integers of 192 bits, Taylor order 40)",
        "accuracy": max(r["accuracy"] for r in results),
    }
    Path(__file__).with_name("references.json").write_text(text(header, results), encoding="utf-8")


if __name__ == "__main__":
    main()
