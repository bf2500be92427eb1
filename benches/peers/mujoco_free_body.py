"""What an error asked for costs on a free tumbling body: bryla from Python beside MuJoCo and scipy.

Each contestant's steps are shortened, or its tolerance is lowered, until the orientation at the end is as
close to the closed form as asked; then all of them are timed in turns, by whole calls from Python, on the
thread's processor clock, so that other programs do not count.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Iterable
from typing import NamedTuple

import mujoco
import numpy as np
from scipy.integrate import solve_ivp

import bryla

MOMENTS = (0.8, 1.5, 2.1)  # principal moments of inertia [kg·m²]
ANGULAR_VELOCITY = (0.7, -0.4, 1.1)  # at the start [rad/s]; body and world axes coincide there
END = 10.0  # end of the motion [s]
ERRORS = (1e-6, 1e-9, 1e-12)  # of the orientation at the end [rad]
REPEATS = 7  # measurements of each contestant
MEASURED = 0.02  # shortest measurement [s]; shorter calls are repeated

STEPS = [round(END * 2 ** (k / 4)) for k in range(4, 61)]  # of a motion, from 2 to 32768 a second
TOLERANCES = [10 ** (-k / 4) for k in range(8, 55)]  # from 1e-2 to 3e-14, the least that scipy takes

Solver = Callable[[float], np.ndarray]


class Contestant(NamedTuple):
    name: str
    knob: str
    settings: Iterable[float] | None  # the coarsest first; None for one that takes the error asked as its tolerance
    orientation: Solver


def bryla_scene() -> bryla.Scene:
    scene = bryla.Scene()
    scene.add(bryla.Body("body", mass=1.0, inertia=np.diag(MOMENTS), angular_velocity=ANGULAR_VELOCITY))
    return scene


SCENE = bryla_scene()
EXACT = SCENE.run((0.0, END), method="exact", step=END, estimate=False, record="end").orientation[-1, 0]


def bryla_with(method: str) -> Solver:
    """A method of bryla with that many steps; the error is not estimated."""

    def orientation(steps: float) -> np.ndarray:
        return SCENE.run((0.0, END), method=method, step=END / steps, estimate=False, record="end").orientation[-1, 0]

    return orientation


def bryla_to(tolerance: float) -> np.ndarray:
    """What bryla chooses itself for a tolerance, its estimate of the error included."""
    return SCENE.run((0.0, END), tolerance=tolerance, record="end").orientation[-1, 0]


def mujoco_rk4() -> Solver:
    """MuJoCo's RK4 with that many steps, contacts and constraints switched off."""
    model = mujoco.MjModel.from_xml_string(
        f"""<mujoco>
          <option gravity="0 0 0" integrator="RK4"><flag contact="disable" constraint="disable"/></option>
          <worldbody><body><freejoint/>
            <inertial pos="0 0 0" mass="1" diaginertia="{" ".join(map(str, MOMENTS))}"/>
          </body></worldbody>
        </mujoco>"""
    )
    data = mujoco.MjData(model)

    def orientation(steps: float) -> np.ndarray:
        model.opt.timestep = END / steps
        mujoco.mj_resetData(model, data)
        data.qvel[3:] = ANGULAR_VELOCITY
        mujoco.mj_step(model, data, int(steps))
        return data.qpos[3:].copy()

    return orientation


def scipy_dop853(tolerance: float) -> np.ndarray:
    """scipy's DOP853 on q′ = ½ q ω and L′ = L × ω in body axes, written without arrays."""
    i, j, k = MOMENTS

    def rates(_: float, y: np.ndarray) -> tuple[float, ...]:
        w, x, y_, z, a, b, c = y.tolist()
        p, q, r = a / i, b / j, c / k
        return (
            -0.5 * (x * p + y_ * q + z * r),
            0.5 * (w * p + y_ * r - z * q),
            0.5 * (w * q + z * p - x * r),
            0.5 * (w * r + x * q - y_ * p),
            b * r - c * q,
            c * p - a * r,
            a * q - b * p,
        )

    start = [1.0, 0.0, 0.0, 0.0, *np.multiply(MOMENTS, ANGULAR_VELOCITY)]
    end = solve_ivp(rates, (0.0, END), start, method="DOP853", rtol=tolerance, atol=tolerance, t_eval=[END])
    return end.y[:4, -1]


def error(orientation: np.ndarray) -> float:
    """Angle to the closed form [rad]."""
    return float(bryla.quaternion.angle_between(orientation / np.linalg.norm(orientation), EXACT))


def first(contestant: Contestant, asked: float) -> tuple[float, float] | None:
    """The coarsest setting that is close enough, and its error."""
    for setting in contestant.settings or [asked]:
        reached = error(contestant.orientation(setting))
        if reached <= asked:
            return setting, reached
    return None


def seconds(call: Callable[[], object], calls: int) -> float:
    """Processor time of one call [s]."""
    began = time.thread_time()
    for _ in range(calls):
        call()
    return (time.thread_time() - began) / calls


def main() -> None:
    contestants = [
        Contestant("MuJoCo, RK4", "steps", STEPS, mujoco_rk4()),
        Contestant("scipy, DOP853", "tolerance", TOLERANCES, scipy_dop853),
        Contestant("bryla, rk4", "steps", STEPS, bryla_with("rk4")),
        Contestant("bryla, dop853", "steps", STEPS, bryla_with("dop853")),
        Contestant("bryla, split8", "steps", STEPS, bryla_with("split8")),
        Contestant("bryla, its own choice", "tolerance", None, bryla_to),
    ]
    print("| error asked [rad] | contestant | setting | error [rad] | min [µs] | median [µs] | ratio to MuJoCo |")
    print("|--:|---|---|--:|--:|--:|--:|")
    for asked in ERRORS:
        found = [(contestant, first(contestant, asked)) for contestant in contestants]
        calls = {}
        for contestant, setting in found:
            if setting:
                solve, value = contestant.orientation, setting[0]
                call = lambda solve=solve, value=value: solve(value)  # noqa: E731
                calls[contestant.name] = call, max(1, round(MEASURED / max(seconds(call, 3), 1e-6)))

        times: dict[str, list[float]] = {name: [] for name in calls}
        for _ in range(REPEATS):
            for name, (call, count) in calls.items():
                times[name].append(1e6 * seconds(call, count))
        median = {name: statistics.median(taken) for name, taken in times.items()}
        against = median.get("MuJoCo, RK4")

        for contestant, setting in found:
            if setting is None:
                print(f"| {asked:.0e} | {contestant.name} | not reached | | | | |")
                continue
            value, reached = setting
            said = f"{value:.0f} steps" if contestant.knob == "steps" else f"tolerance {value:.1e}"
            name = contestant.name
            ratio = f"{median[name] / against:.4f}" if against else ""
            print(
                f"| {asked:.0e} | {name} | {said} | {reached:.1e} "
                f"| {min(times[name]):.1f} | {median[name]:.1f} | {ratio} |"
            )


if __name__ == "__main__":
    main()
