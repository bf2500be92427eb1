"""Figures; matplotlib is imported when one is asked for."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from . import quaternion
from . import voronoi_regions as regions_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from ._bryla import ComparisonTable, ConvexPolygon, PlanarClosest, Trajectory, VoronoiRegion

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
    """Draws error against processor time, both logarithmic, one line a method, dashed where tolerances chose the steps.

    The grey band is where errors are not told apart from that of the reference.
    """
    figure = new_figure(figure, 8.0, 5.0)
    axes = figure.subplots()
    for method, chosen in dict.fromkeys((row.method, row.tolerance is not None) for row in table.rows):
        rows = [row for row in table.rows if (row.method, row.tolerance is not None) == (method, chosen) and row.error]
        style, label = ("s--", f"{method}, by tolerance") if chosen else ("o-", method)
        axes.loglog([row.error for row in rows], [row.seconds_min for row in rows], style, markersize=4, label=label)
    axes.axvspan(axes.get_xlim()[0], 10.0 * table.reference_error, color="0.9", zorder=0)
    axes.invert_xaxis()
    axes.set_xlabel("error of the end state")
    axes.set_ylabel("processor time [s]")
    axes.grid(alpha=0.3)
    axes.legend(fontsize="small")
    axes.set_title(f"against {table.reference}", fontsize="small")
    return figure


def voronoi_regions(polygon: ConvexPolygon, figure: Figure | None) -> Any:
    """Draws a polygon and the Voronoi regions of its features, the lecture's figure 10.

    Cones of vertices are orange, strips of edges blue; each is named by the number of its feature.
    """
    figure = new_figure(figure, 6.0, 6.0)
    axes = figure.subplots()
    vertices = polygon.vertices
    extent = max(float(np.ptp(vertices, axis=0).max()), 1e-300)
    draw_regions(axes, regions_of(polygon), extent)
    axes.fill(*vertices.T, facecolor="white", edgecolor="black", zorder=2)
    (low, high), margin = (vertices.min(axis=0), vertices.max(axis=0)), 0.6 * extent
    axes.set(xlim=(low[0] - margin, high[0] + margin), ylim=(low[1] - margin, high[1] + margin))
    axes.set(aspect="equal", xlabel="x [m]", ylabel="y [m]")
    return figure


def draw_regions(axes: Axes, regions: Iterable[VoronoiRegion], extent: float) -> None:
    """Fills regions as far as the figure sees, and names them."""
    for region in regions:
        if len(region.rays) == 0:
            continue
        kind, number = region.feature
        color = "C1" if kind == "vertex" else "C0"
        first, last = region.base[0], region.base[-1]
        middle = region.rays.sum(axis=0)
        # opposite rays, those of a segment's end, meet over the half turn between them
        if np.linalg.norm(middle) < 1e-9:
            middle = np.array([-region.rays[0][1], region.rays[0][0]])
        middle /= np.linalg.norm(middle)
        far = 10.0 * extent
        border = [first + far * region.rays[0], first, last, last + far * region.rays[1]]
        outline = np.array([*border, 0.5 * (first + last) + 2.0 * far * middle])
        axes.fill(*outline.T, facecolor=color, edgecolor=color, alpha=0.25, zorder=1)
        name = f"V({kind[0]}{number})"
        x, y = 0.5 * (first + last) + 0.3 * extent * middle
        axes.text(x, y, name, ha="center", va="center", color=color)


def walk(found: PlanarClosest, figure: Figure | None) -> Any:
    """Draws two polygons and the pairs of features that the walk visited, from pale to dark."""
    figure = new_figure(figure, 7.0, 5.0)
    axes = figure.subplots()
    for outline, name in zip(found.outlines, "AB", strict=True):
        axes.fill(*outline.T, facecolor="0.92", edgecolor="black", zorder=2)
        x, y = outline.mean(axis=0)
        axes.text(x, y, name, ha="center", va="center")
    for number, (kind_a, kind_b, a, b) in enumerate(found.path, start=1):
        shade = 0.25 + 0.75 * number / len(found.path)
        label = f"{number}: {kind_a[0]} {kind_a[1]} to {kind_b[0]} {kind_b[1]}"
        axes.plot([a[0], b[0]], [a[1], b[1]], "o-", color="C3", alpha=shade, markersize=3, zorder=3, label=label)
    axes.set(aspect="equal", xlabel="x [m]", ylabel="y [m]")
    axes.set_title(f"{found.state}, signed distance {found.signed_distance:.6g} m", fontsize="small")
    axes.legend(fontsize="small", title="walk")
    return figure
