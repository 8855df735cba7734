from .driving import RoundTrip as RoundTrip, round_trip as round_trip, torque_rows as torque_rows
from .figures import plot_demands as plot_demands, plot_torque as plot_torque
from .measured import (
    MeasuredMotion as MeasuredMotion,
    read_motion as read_motion,
    seen_by_cameras as seen_by_cameras,
)
from .measures import (
    PARTS as PARTS,
    PartMeasures as PartMeasures,
    TorqueMeasures as TorqueMeasures,
    measure as measure,
)
from .motions import (
    SHAPES as SHAPES,
    ForwardAndReturn as ForwardAndReturn,
    Kinematics as Kinematics,
    Shape as Shape,
)
from .periodic.chaos import LargestExponent as LargestExponent, largest_exponent as largest_exponent
from .periodic.continuation import (
    Branch as Branch,
    Continuation as Continuation,
    End as End,
    SpecialPoint as SpecialPoint,
    Steps as Steps,
    Tests as Tests,
)
from .periodic.maps import (
    CentralDifferences as CentralDifferences,
    Images as Images,
    Linearization as Linearization,
    SmoothMap as SmoothMap,
)
from .periodic.solutions import (
    NoSolutionError as NoSolutionError,
    PeriodicSolution as PeriodicSolution,
    solve as solve,
)
from .predictability import trusted_until as trusted_until
from .reports import (
    demand_report as demand_report,
    measures_report as measures_report,
    torque_json as torque_json,
)
from .response.attractors import (
    Basins as Basins,
    PeriodicAttractor as PeriodicAttractor,
    UnsettledMotion as UnsettledMotion,
    basins as basins,
)
from .response.branches import (
    Response as Response,
    ResponseBranch as ResponseBranch,
    distinct_solutions as distinct_solutions,
)
from .response.figures import (
    backbone as backbone,
    plot_attractors as plot_attractors,
    plot_response as plot_response,
)
from .response.shaken import Orbit as Orbit, ShakenJoystick as ShakenJoystick, Shaking as Shaking
from .response.tables import (
    attractor_report as attractor_report,
    branch_report as branch_report,
    branch_table as branch_table,
    response_json as response_json,
    special_table as special_table,
)
from .samples import Samples as Samples, smooth_spans as smooth_spans
from .torque import (
    TORQUES as TORQUES,
    columns_of as columns_of,
    inverse_fmu as inverse_fmu,
    torque_by_fmu as torque_by_fmu,
    torque_by_reference as torque_by_reference,
)
from .vibration.direction import Direction as Direction
from .vibration.feedthrough import (
    Feedthrough as Feedthrough,
    feedthrough as feedthrough,
    feedthrough_json as feedthrough_json,
    feedthrough_report as feedthrough_report,
    feedthrough_table as feedthrough_table,
)
from .vibration.figures import plot_transmissibility as plot_transmissibility
from .vibration.mounted import Hand as Hand, MountedHandle as MountedHandle
from .work_cycle import (
    MOVES_PER_SHIFT as MOVES_PER_SHIFT,
    PRELOADS as PRELOADS,
    STIFFNESSES as STIFFNESSES,
    Demand as Demand,
    MoveDistribution as MoveDistribution,
    demands as demands,
    faster as faster,
    scaled as scaled,
)
