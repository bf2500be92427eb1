"""What can go wrong."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._bryla import Trajectory


class Error(ValueError):
    """Bad input: the message names the place, the field, the value and what is allowed."""


class SimulationError(RuntimeError):
    """A run that cannot go on. Nothing computed is lost: its trajectory ends where the run did.

    Where a function of yours raised, that exception is the cause (``__cause__``).
    """

    time: float
    """Where the run ended [s]."""
    bodies: list[str]
    """Names of the bodies concerned."""
    trajectory: Trajectory | None
    """The run up to there; None where a simulation was advanced by hand."""

    def __init__(self, message: str, time: float, bodies: list[str], trajectory: Trajectory | None) -> None:
        super().__init__(message, time, bodies, trajectory)
        self.time = time
        self.bodies = bodies
        self.trajectory = trajectory

    def __str__(self) -> str:
        return str(self.args[0])


class AccuracyWarning(UserWarning):
    """A run whose tolerance is not met over its whole span; ``report.horizon`` says up to when it is."""


for _public in (Error, SimulationError, AccuracyWarning):
    _public.__module__ = "bryla"
