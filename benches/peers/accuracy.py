"""What an error asked for costs on a free tumbling body and on a heavy top: bryla from Python beside MuJoCo, scipy,
heyoka and Drake.

Each contestant's steps are shortened, or its tolerance is lowered, until the orientation at the end is as
close to the truth as asked; then all of them are timed in turns, by whole calls from Python, on the
thread's processor clock, so that other programs do not count. Truth is bryla's closed form for the free
body, and for the top its Dop853 with 2000 steps a second; how far scipy at its tightest is from it is printed first.
"""

from __future__ import annotations

import functools
import statistics
import time
from collections.abc import Callable, Iterable
from typing import NamedTuple

import bryla
import heyoka
import mujoco
import numpy as np
from pydrake.math import RigidTransform
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import BallRpyJoint, FixedOffsetFrame, RotationalInertia, SpatialInertia, UnitInertia
from pydrake.systems.analysis import ResetIntegratorFromFlags, Simulator
from scipy.integrate import solve_ivp

END = 10.0  # end of the motion [s]
ERRORS = (1e-6, 1e-9, 1e-12)  # of the orientation at the end [rad]
REPEATS = 7  # measurements of each contestant
MEASURED = 0.02  # shortest measurement [s]; shorter calls are repeated

PEERS = ("MuJoCo, RK4", "scipy, DOP853", "heyoka, Taylor", "Drake, RK5")

STEPS = [round(END * 2 ** (k / 4)) for k in range(4, 61)]  # of a motion, from 2 to 32768 a second
TOLERANCES = [10 ** (-k / 4) for k in range(8, 55)]  # from 1e-2 to 3e-14, the least that scipy takes

Solver = Callable[[float], np.ndarray]


class Problem(NamedTuple):
    """A body at the origin, body and world axes the same; under gravity it turns about a point."""

    name: str
    moments: tuple[float, float, float]  # principal moments of inertia about the centre of mass [kg·m²]
    angular_velocity: tuple[float, float, float]  # at the start [rad/s]
    arm: tuple[float, float, float] | None  # from the pivot to the centre of mass [m]
    gravity: tuple[float, float, float]  # [m/s²]


FREE = Problem("free body", (0.8, 1.5, 2.1), (0.7, -0.4, 1.1), None, (0.0, 0.0, 0.0))
TOP = Problem("heavy top", (0.8, 1.5, 2.1), (1.0, -2.0, 8.0), (0.1, 0.05, 0.3), (0.0, 0.0, -9.81))


class Contestant(NamedTuple):
    name: str
    knob: str
    settings: Iterable[float] | None  # the coarsest first; None for one that takes the error asked as its tolerance
    orientation: Solver


def bryla_scene(problem: Problem) -> bryla.Scene:
    scene = bryla.Scene()
    freedom = "free" if problem.arm is None else bryla.Pivot(tuple(-a for a in problem.arm))
    inertia = np.diag(problem.moments)
    spin = problem.angular_velocity
    scene.add(bryla.Body("body", mass=1.0, inertia=inertia, angular_velocity=spin, freedom=freedom))
    if any(problem.gravity):
        scene.add_effect(bryla.UniformGravity(problem.gravity))
    return scene


def bryla_with(scene: bryla.Scene, method: str, **order: int) -> Solver:
    """A method of bryla with that many steps; the error is not estimated."""
    options = {"method": method, "estimate": False, "record": "end", **order}

    def orientation(steps: float) -> np.ndarray:
        return scene.run((0.0, END), step=END / steps, **options).orientation[-1, 0]

    return orientation


def bryla_to(scene: bryla.Scene, estimate: bool, method: str | None = None) -> Solver:
    """What bryla chooses itself for a tolerance, or a method that controls its error."""

    def orientation(tolerance: float) -> np.ndarray:
        run = scene.run((0.0, END), tolerance=tolerance, method=method, estimate=estimate, record="end")
        return run.orientation[-1, 0]

    return orientation


def mujoco_rk4(problem: Problem) -> Solver:
    """MuJoCo's RK4 with that many steps, contacts and constraints switched off."""
    text = lambda v: " ".join(map(str, v))  # noqa: E731
    joint = "<freejoint/>" if problem.arm is None else f'<joint type="ball" pos="{text(-a for a in problem.arm)}"/>'
    model = mujoco.MjModel.from_xml_string(
        f"""<mujoco>
          <option gravity="{text(problem.gravity)}" integrator="RK4">
            <flag contact="disable" constraint="disable"/>
          </option>
          <worldbody><body>{joint}
            <inertial pos="0 0 0" mass="1" diaginertia="{text(problem.moments)}"/>
          </body></worldbody>
        </mujoco>"""
    )
    data = mujoco.MjData(model)

    def orientation(steps: float) -> np.ndarray:
        model.opt.timestep = END / steps
        mujoco.mj_resetData(model, data)
        data.qvel[-3:] = problem.angular_velocity
        mujoco.mj_step(model, data, int(steps))
        return data.qpos[-4:].copy()

    return orientation


def about_the_point(problem: Problem) -> tuple[np.ndarray, list[float]]:
    """Inverse of the inertia about the point that rests, and (q, L) at the start, body axes."""
    arm = np.array(problem.arm or (0.0, 0.0, 0.0))
    inertia = np.diag(problem.moments) + arm @ arm * np.eye(3) - np.outer(arm, arm)
    return np.linalg.inv(inertia), [1.0, 0.0, 0.0, 0.0, *(inertia @ np.array(problem.angular_velocity))]


def rates(problem: Problem, inverse: np.ndarray, state: Iterable) -> tuple:
    """q′ = ½ q ω and L′ = L × ω + r × Rᵀ m g in body axes, about the point that rests, written without arrays."""
    w, x, y, z, a, b, c = state
    (i, ij, ik), (_, j, jk), (_, _, k) = inverse.tolist()
    p, q, r = (
        (i * a + ij * b + ik * c, ij * a + j * b + jk * c, ik * a + jk * b + k * c)
        if ij or ik or jk
        else (
            i * a,
            j * b,
            k * c,
        )
    )
    turning = (
        -0.5 * (x * p + y * q + z * r),
        0.5 * (w * p + y * r - z * q),
        0.5 * (w * q + z * p - x * r),
        0.5 * (w * r + x * q - y * p),
    )
    if problem.arm is None:
        return (*turning, b * r - c * q, c * p - a * r, a * q - b * p)
    (rx, ry, rz), g = problem.arm, problem.gravity[2]
    fx, fy, fz = 2 * g * (x * z - w * y), 2 * g * (y * z + w * x), g * (1 - 2 * (x * x + y * y))
    return (
        *turning,
        b * r - c * q + ry * fz - rz * fy,
        c * p - a * r + rz * fx - rx * fz,
        a * q - b * p + rx * fy - ry * fx,
    )


def scipy_dop853(problem: Problem) -> Solver:
    """scipy's DOP853 on q and L in body axes."""
    inverse, start = about_the_point(problem)
    function = lambda _, y: rates(problem, inverse, y.tolist())  # noqa: E731

    def orientation(tolerance: float) -> np.ndarray:
        end = solve_ivp(function, (0.0, END), start, method="DOP853", rtol=tolerance, atol=tolerance, t_eval=[END])
        return end.y[:4, -1]

    return orientation


def heyoka_taylor(problem: Problem) -> Solver:
    """heyoka's Taylor series on the same equations, compiled before for each tolerance."""
    inverse, start = about_the_point(problem)
    state = heyoka.make_vars("w", "x", "y", "z", "a", "b", "c")
    system = list(zip(state, rates(problem, inverse, state), strict=True))
    compiled = functools.cache(lambda tolerance: heyoka.taylor_adaptive(system, start, tol=tolerance))

    def orientation(tolerance: float) -> np.ndarray:
        series = compiled(tolerance)
        series.time = 0.0
        series.state[:] = start
        series.propagate_until(END)
        return series.state[:4].copy()

    return orientation


def drake_rk5(problem: Problem) -> Solver:
    """Drake's fifth-order method with that many steps; it has no joint for a ball but roll, pitch and yaw."""
    plant = MultibodyPlant(0.0)
    body = plant.AddRigidBody(
        "body", SpatialInertia(1.0, np.zeros(3), UnitInertia(RotationalInertia(*problem.moments)))
    )
    if problem.arm is not None:
        pivot = plant.AddFrame(FixedOffsetFrame("pivot", body, RigidTransform(-np.array(problem.arm))))
        plant.AddJoint(BallRpyJoint("joint", plant.world_frame(), pivot))
    plant.mutable_gravity_field().set_gravity_vector(problem.gravity)
    plant.Finalize()
    simulator = Simulator(plant)
    integrator = ResetIntegratorFromFlags(simulator, "runge_kutta5", 1.0)
    integrator.set_fixed_step_mode(True)
    context = simulator.get_mutable_context()
    positions = plant.GetPositions(context).copy()
    velocities = np.zeros(plant.num_velocities())
    velocities[:3] = problem.angular_velocity

    def orientation(steps: float) -> np.ndarray:
        integrator.set_maximum_step_size(END / steps)
        integrator.request_initial_step_size_target(END / steps)
        context.SetTime(0.0)
        plant.SetPositions(context, positions)
        plant.SetVelocities(context, velocities)
        simulator.Initialize()
        simulator.AdvanceTo(END)
        return plant.EvalBodyPoseInWorld(context, body).rotation().ToQuaternion().wxyz()

    return orientation


def error(orientation: np.ndarray, truth: np.ndarray) -> float:
    """Angle to the truth [rad]."""
    return float(bryla.quaternion.angle_between(orientation / np.linalg.norm(orientation), truth))


def first(contestant: Contestant, asked: float, truth: np.ndarray) -> tuple[float, float] | None:
    """The coarsest setting that is close enough, and its error; bryla refuses a tolerance below rounding."""
    for setting in contestant.settings or [asked]:
        try:
            orientation = contestant.orientation(setting)
        except bryla.Error:
            return None
        reached = error(orientation, truth)
        if reached <= asked:
            return setting, reached
    return None


def seconds(call: Callable[[], object], calls: int) -> float:
    """Processor time of one call [s]."""
    began = time.thread_time()
    for _ in range(calls):
        call()
    return (time.thread_time() - began) / calls


def compare(problem: Problem) -> None:
    scene = bryla_scene(problem)
    exact = problem.arm is None
    truth = bryla_with(scene, "exact" if exact else "dop853")(1.0 if exact else 2000 * END)
    scipy = scipy_dop853(problem)
    solvers = (mujoco_rk4(problem), scipy, heyoka_taylor(problem), drake_rk5(problem))
    knobs = (("steps", STEPS), ("tolerance", TOLERANCES), ("tolerance", TOLERANCES), ("steps", STEPS))
    contestants = [
        *(Contestant(name, *knob, solver) for name, knob, solver in zip(PEERS, knobs, solvers, strict=True)),
        Contestant("bryla, rk4", "steps", STEPS, bryla_with(scene, "rk4")),
        Contestant("bryla, dop853", "steps", STEPS, bryla_with(scene, "dop853")),
        Contestant("bryla, taylor of order 20", "steps", STEPS, bryla_with(scene, "taylor", order=20)),
        Contestant("bryla, split8", "steps", STEPS, bryla_with(scene, "split8")),
        Contestant("bryla, taylor", "tolerance", TOLERANCES, bryla_to(scene, estimate=False, method="taylor")),
        Contestant("bryla, its own choice", "tolerance", None, bryla_to(scene, estimate=False)),
        Contestant("the same, error estimated", "tolerance", None, bryla_to(scene, estimate=True)),
    ]
    print(f"\n### {problem.name.capitalize()}\n")
    print(f"scipy at 3e-14 is {error(scipy(3e-14), truth):.1e} rad from the truth.\n")
    ratios = " | ".join(f"{peer.split(',')[0]} / it" for peer in PEERS)
    print(f"| error asked [rad] | contestant | setting | error [rad] | min [µs] | median [µs] | {ratios} |")
    print("|--:|---|---|" + "--:|" * (3 + len(PEERS)))
    for asked in ERRORS:
        found = [(contestant, first(contestant, asked, truth)) for contestant in contestants]
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

        for contestant, setting in found:
            name = contestant.name
            if setting is None:
                print(f"| {asked:.0e} | {name} | not reached |" + " |" * (3 + len(PEERS)))
                continue
            value, reached = setting
            said = f"{value:.0f} steps" if contestant.knob == "steps" else f"tolerance {value:.1e}"
            ratios = " | ".join(f"{median[peer] / median[name]:.4g}" if peer in median else "" for peer in PEERS)
            print(
                f"| {asked:.0e} | {name} | {said} | {reached:.1e} "
                f"| {min(times[name]):.1f} | {median[name]:.1f} | {ratios} |"
            )


if __name__ == "__main__":
    for each in (FREE, TOP):
        compare(each)
