from .driving import RoundTrip as RoundTrip, round_trip as round_trip, torque_rows as torque_rows
from .figures import plot_demands as plot_demands, plot_torque as plot_torque
from .measured import (
    MeasuredMotion as MeasuredMotion,
    read_motion as read_motion,
    seen_by_cameras as seen_by_cameras,
    through_chain as through_chain,
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
from .predictability import trusted_until as trusted_until
from .reports import demand_report as demand_report, measures_report as measures_report
from .samples import Samples as Samples, smooth_spans as smooth_spans
from .torque import (
    FRICTION_TORQUES as FRICTION_TORQUES,
    TORQUES as TORQUES,
    columns_of as columns_of,
    inverse_fmu as inverse_fmu,
    torque_by_fmu as torque_by_fmu,
    torque_by_reference as torque_by_reference,
)
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
