"""A roadside unit (RSU) for Lukou in Python: inherit from RsuAlgorithm, give the class to run_rsu().

SI units. Lanes are named WL WC WR SL SC SR EL EC ER NL NC NR: the side that cars come from, then left, centre, right.
Distances are those of a car's front to its stop line. A view is valid during on_step only.
"""

from collections.abc import Callable, Mapping, Sequence
from enum import Enum
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import NDArray

class Binding(Enum):
    """How a car takes a commanded acceleration."""

    GUARD = 0
    """As commanded; only the limits and the guard may change it."""
    FOLLOWING = 1
    """The smaller of the command and the following law."""

class Aspect(Enum):
    RED = 1
    YELLOW = 2
    GREEN = 3

class MapView:
    @property
    def speed_limit_mps(self) -> float: ...
    @property
    def approach_length_m(self) -> float:
        """From the entrance to the stop line."""

class Actuation:
    """What the signal controller keeps whatever an RSU asks for."""

    def __init__(
        self, *, min_green_s: float = 8.0, yellow_s: float = 3.0, all_red_s: float = 1.0, max_wait_s: float = 120.0
    ) -> None: ...
    @property
    def min_green_s(self) -> float: ...
    @property
    def yellow_s(self) -> float: ...
    @property
    def all_red_s(self) -> float: ...
    @property
    def max_wait_s(self) -> float:
        """A lane that has been red for longer comes before every request."""

class RsuSetup:
    """What an RSU knows before its first step."""

    def __init__(
        self, *, index: int = 0, speed_limit_mps: float, approach_length_m: float, acceleration_max_mps2: float
    ) -> None: ...
    @property
    def index(self) -> int: ...
    @property
    def map(self) -> MapView: ...
    @property
    def acceleration_max_mps2(self) -> float:
        """Of every car, both signs: a car refuses what is beyond."""

class HeardCar:
    """A car on an approach, as its newest message tells and as the RSU's map matching places it."""

    def __init__(
        self, *, id: int, distance_m: float, speed_mps: float, acceleration_mps2: float = 0.0, age_s: float = 0.0
    ) -> None: ...
    @property
    def id(self) -> int: ...
    @property
    def lane(self) -> str: ...
    @property
    def distance_m(self) -> float: ...
    @property
    def speed_mps(self) -> float: ...
    @property
    def acceleration_mps2(self) -> float: ...
    @property
    def age_s(self) -> float:
        """Since the message was made, by the car's clock; 0 = it tells of now."""
    @property
    def accuracy_m(self) -> Optional[float]:
        """Of its position as its unit tells, one standard deviation."""

class SensedCar:
    """A car on an approach as a roadside sensor tells of it; the same car may stand among the heard ones, too."""

    def __init__(
        self, *, track: int, distance_m: float, speed_mps: float, age_s: float = 0.0, sensor: int = 0
    ) -> None: ...
    @property
    def sensor(self) -> int:
        """Index in this RSU's list of the scenario."""
    @property
    def track(self) -> int:
        """The same as long as this sensor follows this car; says nothing else."""
    @property
    def lane(self) -> str: ...
    @property
    def distance_m(self) -> float: ...
    @property
    def speed_mps(self) -> float: ...
    @property
    def age_s(self) -> float: ...

class GreenWindow:
    @property
    def begin_s(self) -> float: ...
    @property
    def end_s(self) -> float:
        """Infinite if it is not known."""

class QueueEstimate:
    @property
    def cars(self) -> int: ...
    @property
    def tail_m(self) -> float:
        """Distance of the last standing car's front; 0 without a queue."""

class LaneView:
    @property
    def name(self) -> str: ...
    @property
    def cars(self) -> list[HeardCar]:
        """Front to back; cars without an on-board unit are never among them."""
    @property
    def sensed(self) -> list[SensedCar]:
        """Front to back; what sensors delivered for this step, nothing is kept."""
    @property
    def last_crossing_s(self) -> Optional[float]: ...
    @property
    def aspect(self) -> Aspect: ...
    @property
    def aspect_since_s(self) -> float: ...
    @property
    def changes(self) -> list[tuple[Aspect, float]]:
        """Changes of the head to come and their times [s]."""
    def green_windows(self) -> list[GreenWindow]: ...
    def green_at_or_after(self, time_s: float, tail_s: float = 0.0) -> Optional[GreenWindow]: ...
    def standing_queue(self, standing_mps: float = ...) -> QueueEstimate: ...
    def seen_cars(self) -> list[SeenCar]:
        """The cars that were heard or sensed, front to back, each once: reports less than 3 m apart are of one car."""

class SeenCar:
    @property
    def distance_m(self) -> float: ...
    @property
    def speed_mps(self) -> float: ...

class CarTable:
    """The heard cars of all lanes as arrays of equal length, lane after lane, front to back."""

    @property
    def id(self) -> NDArray[np.uint64]: ...
    @property
    def lane(self) -> NDArray[np.uint8]:
        """0 ... 11 for WL ... NR."""
    @property
    def distance_m(self) -> NDArray[np.float64]: ...
    @property
    def speed_mps(self) -> NDArray[np.float64]: ...
    @property
    def acceleration_mps2(self) -> NDArray[np.float64]: ...
    @property
    def age_s(self) -> NDArray[np.float64]: ...

class RsuView:
    """All that an RSU knows at the instant of a step."""

    @property
    def step(self) -> int: ...
    @property
    def time_s(self) -> float: ...
    @property
    def map(self) -> MapView: ...
    @property
    def lanes(self) -> list[LaneView]: ...
    @property
    def actuation(self) -> Optional[Actuation]:
        """None: the controller runs a fixed plan and refuses every request."""
    @property
    def promised_to_s(self) -> float:
        """Up to this time the RSU knows the heads for certain; a request acts later."""
    @property
    def request_acts_s(self) -> float:
        """From then on a request of this step can change the heads."""
    def promised_green(self) -> list[str]:
        """The lanes whose heads show green then."""
    @property
    def cars(self) -> CarTable: ...

class Advice:
    @property
    def car(self) -> int: ...
    @property
    def release(self) -> bool: ...
    @property
    def acceleration_mps2(self) -> Optional[float]: ...
    @property
    def segments(self) -> Optional[list[tuple[float, float]]]:
        """Of a profile: (seconds, m/s2) one after the other."""
    @property
    def speed_mps(self) -> Optional[float]:
        """Of an advised speed."""
    @property
    def lifetime_s(self) -> Optional[float]: ...
    @property
    def binding(self) -> Optional[Binding]: ...

class SignalRequest:
    @property
    def lanes(self) -> list[str]: ...
    @property
    def lifetime_s(self) -> float: ...

class RsuAnswer:
    """What an algorithm asks for in one step. Advice that no message can carry is refused and counted, never bent."""

    def advise(
        self, car: int, acceleration_mps2: float, lifetime_s: float = 0.5, binding: Binding = Binding.GUARD
    ) -> None: ...
    def advise_all(
        self,
        cars: NDArray[np.uint64],
        accelerations_mps2: NDArray[np.float64],
        lifetime_s: float = 0.5,
        binding: Binding = Binding.GUARD,
    ) -> None: ...
    def advise_profile(
        self, car: int, segments: Sequence[tuple[float, float]], binding: Binding = Binding.GUARD
    ) -> None:
        """Accelerations one after the other, from now on: (seconds, m/s2). At most 32."""
    def advise_speed(
        self, car: int, speed_mps: float, lifetime_s: float = 0.5, binding: Binding = Binding.GUARD
    ) -> None:
        """The car's own unit makes for this speed."""
    def lane_speed(self, lane: str, speed_mps: float, lifetime_s: float = 0.5) -> None:
        """Cars on this lane that hear it do not wish to drive faster, as long as they drive on their own."""
    def release(self, car: int) -> None: ...
    def request_green(self, lanes: Sequence[str], lifetime_s: float) -> None:
        """Wants exactly these lanes green from now on until the lifetime ends or a newer request comes."""

class RsuAlgorithm:
    def __init__(self) -> None: ...
    def on_step(self, heard: RsuView, answer: RsuAnswer) -> None:
        """Called once per step with what this RSU has heard by now. An exception ends the process."""

def time_to_line_s(distance_m: float, speed_mps: float, acceleration_mps2: float, cruise_mps: float) -> float:
    """Time to the line of a car with nobody ahead, which speeds up to cruise_mps; infinite if it never gets there."""

def arrival_acceleration_mps2(distance_m: float, speed_mps: float, time_s: float) -> Optional[float]:
    """The constant acceleration that brings a car to the line in exactly time_s; None if it would have to roll back."""

def smoothest_arrival(
    distance_m: float, speed_mps: float, time_s: float, end_speed_mps: Optional[float] = None
) -> tuple[float, float]:
    """The arrival with the least integral of a^2: (acceleration now [m/s2], its change [m/s3]). ValueError: time_s <= 0."""

def cruise_after_braking_mps(
    distance_m: float, speed_mps: float, time_s: float, braking_mps2: float
) -> Optional[float]:
    """The speed to brake to, then hold, to arrive in time; None if it would be late without braking, or have to stand."""

def cruise_after_speeding_up_mps(
    distance_m: float, speed_mps: float, time_s: float, acceleration_mps2: float
) -> Optional[float]:
    """The speed to speed up to, then hold, to arrive in time; None if it would be early without, or late even so."""

def has_hard_conflict(lanes: Sequence[str]) -> bool:
    """Whether two of the lanes cross: they can never be green together."""

def carriable_mps2(wanted_mps2: float, limit_mps2: float) -> float:
    """The nearest value that every car takes and a message carries: within the limit, towards zero to 0.01 m/s2."""

class LaneScript:
    """A lane as a test writes it."""

    def __init__(
        self,
        *,
        cars: Sequence[HeardCar] = ...,
        sensed: Sequence[SensedCar] = ...,
        aspect: Aspect = Aspect.RED,
        aspect_since_s: float = 0.0,
        changes: Sequence[tuple[Aspect, float]] = ...,
    ) -> None: ...

def answer_of(
    algorithm: RsuAlgorithm,
    setup: RsuSetup,
    *,
    time_s: float = 0.0,
    lanes: Mapping[str, LaneScript],
    actuation: Optional[Actuation] = None,
) -> list[Advice]:
    """What the algorithm says to scripted lanes: for tests, without a run."""

def request_of(
    algorithm: RsuAlgorithm,
    setup: RsuSetup,
    *,
    time_s: float = 0.0,
    lanes: Mapping[str, LaneScript],
    actuation: Optional[Actuation] = None,
) -> Optional[SignalRequest]:
    """What the algorithm asks of the signals; the heads are promised as far as time_s."""

def run_rsu(make: Callable[[RsuSetup], RsuAlgorithm]) -> int:
    """Takes part in the run that `lukou run --rsu` started this program for; returns the exit code."""

class RunResult:
    """What became of a run in this process."""

    @property
    def folder(self) -> str: ...
    @property
    def ended(self) -> str:
        """"done", or what ended it."""
    @property
    def exit_code(self) -> int:
        """As that of `lukou run`."""
    @property
    def summary(self) -> dict[str, Any]:
        """summary.json."""

def run(
    scenario: str,
    algorithm: Union[None, Callable[[RsuSetup], RsuAlgorithm], Mapping[int, Callable[[RsuSetup], RsuAlgorithm]]] = None,
    *,
    set: Sequence[str] = ...,
    seed: Optional[int] = None,
    duration: Optional[float] = None,
    out: str = "",
) -> RunResult:
    """Runs a scenario in this process, with this algorithm as every RSU, or a dict of them by RSU.

    The result files are those of `lukou run SCENARIO --set ... --rsu PROGRAM`. A wrong scenario raises ValueError; what
    an algorithm raises leaves as it is.
    """
