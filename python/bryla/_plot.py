"""Figures; matplotlib is imported when one is asked for."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from . import quaternion

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from ._bryla import ComparisonTable, Trajectory

COMPONENTS = (("x", "-"), ("y", "--"), ("z", ":"))


def new_figure(figure: Figure | None, width: float, height: float) -> Any:
    """The figure to draw in: the one given, or a new one."""
    if figure is not None:
        return figure
    try:
        import matplotlib.pyplot as plt
    except ImportError as error:
        raise ImportError("figures need matplotlib: pip install 'bryla[plot]'") from error
    return plt.figure(figsize=(width, height), layout="constrained")


def trajectory(run: Trajectory, bodies: Iterable[str] | None, figure: Figure | None) -> Any:
    """Draws a run: positions, rotation vectors since the start, and the balance of energy.

    Rotation vectors lie within a half turn; the lines are cut where they jump. Impacts are marked by
    grey lines.
    """
    names = [body.name for body in run.plan.bodies if not body.fixed] if bodies is None else list(bodies)
    figure = new_figure(figure, 8.0, 8.0)
    above, middle, below = figure.subplots(3, 1, sharex=True)
    for number, name in enumerate(names):
        body, color = run[name], f"C{number}"
        turned = quaternion.product(body.orientation, quaternion.conjugate(body.orientation[0]))
        draw_vector(above, run.t, body.position, name, color)
        draw_vector(middle, run.t, cut_at_jumps(quaternion.log(turned)), name, color)
    above.set_ylabel("position [m]")
    middle.set_ylabel("rotation since the start [rad]")
    if names:
        above.legend(ncols=len(names), fontsize="small")

    energy = run.energy
    for label, series in (
        ("kinetic", energy.kinetic),
        ("potential", energy.potential),
        ("dissipated", energy.dissipated),
        ("work", energy.work),
    ):
        if np.any(series != 0.0):
            below.plot(run.t, series, label=label)
    below.plot(run.t, energy.balance, "k-", linewidth=1, label=f"balance, stays to {energy.drift:.1e} J")
    below.set_ylabel("energy [J]")
    below.set_xlabel("time [s]")
    below.legend(fontsize="small")

    for axes in (above, middle, below):
        for event in run.events:
            axes.axvline(event.time, color="0.8", linewidth=0.8, zorder=0)
    report = run.report
    error = "" if report.error_estimate is None else f", error {report.error_estimate:.1e}"
    figure.suptitle(f"{report.method}, step {report.step:.3g} s{error}")
    return figure


def draw_vector(axes: Axes, t: Any, values: Any, name: str, color: str) -> None:
    """Draws the three components of a vector over time."""
    for component, (letter, style) in enumerate(COMPONENTS):
        axes.plot(t, values[:, component], style, color=color, label=f"{name} {letter}")


def cut_at_jumps(phi: Any) -> Any:
    """Rotation vectors without the lines that join both sides of a jump by a whole turn."""
    phi = phi.copy()
    jumps = np.linalg.norm(np.diff(phi, axis=0), axis=1) > np.pi
    phi[1:][jumps] = np.nan
    return phi


def comparison(table: ComparisonTable, figure: Figure | None) -> Any:
    """Draws error against processor time, both logarithmic, one line a method.

    The grey band is where errors are not told apart from that of the reference.
    """
    figure = new_figure(figure, 8.0, 5.0)
    axes = figure.subplots()
    for method in dict.fromkeys(row.method for row in table.rows):
        rows = [row for row in table.rows if row.method == method and row.error]
        axes.loglog([row.error for row in rows], [row.seconds_min for row in rows], "o-", markersize=4, label=method)
    axes.axvspan(axes.get_xlim()[0], 10.0 * table.reference_error, color="0.9", zorder=0)
    axes.invert_xaxis()
    axes.set_xlabel("error of the end state")
    axes.set_ylabel("processor time [s]")
    axes.grid(alpha=0.3)
    axes.legend(fontsize="small")
    axes.set_title(f"against {table.reference}", fontsize="small")
    return figure
