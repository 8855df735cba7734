from .parameter_tables import (
    body_table as body_table,
    damping_table as damping_table,
    friction_table as friction_table,
    segment_table as segment_table,
    spring_table as spring_table,
    stops_table as stops_table,
)
from .parameters.file import (
    BACKWARD_TABLE as BACKWARD_TABLE,
    FORWARD_TABLE as FORWARD_TABLE,
    NOMINAL as NOMINAL,
    NOMINAL_POWER_LAW as NOMINAL_POWER_LAW,
    PAPER as PAPER,
    PIVOT_TO_TOP as PIVOT_TO_TOP,
    PLAIN_TABLES as PLAIN_TABLES,
    SIDES as SIDES,
    STOP_ANGLE as STOP_ANGLE,
    LawName as LawName,
    ParameterFile as ParameterFile,
    Side as Side,
    law_name as law_name,
    read_parameter_file as read_parameter_file,
    read_parameters as read_parameters,
)
from .parameters.file_writing import (
    rounded as rounded,
    rounded_error as rounded_error,
    updated_text as updated_text,
    write_parameters as write_parameters,
)
from .parameters.fmu_values import (
    FmuValue as FmuValue,
    fmu_value_table as fmu_value_table,
    fmu_values as fmu_values,
    parameter_list as parameter_list,
    values_json as values_json,
)
from .parameters.joystick import (
    FRICTION_NAMES as FRICTION_NAMES,
    ConstantDamping as ConstantDamping,
    Damping as Damping,
    Friction as Friction,
    JoystickParameters as JoystickParameters,
    PowerLawDamping as PowerLawDamping,
    values_for as values_for,
)
from .parameters.plausible import (
    ImplausibleError as ImplausibleError,
    require_plausible as require_plausible,
    units_of as units_of,
)
from .parameters.springs import (
    ActuatorAssembly as ActuatorAssembly,
    RestrainedSpring as RestrainedSpring,
    SegmentTable as SegmentTable,
)
from .parameters.stops import STOP_NAMES as STOP_NAMES, Stops as Stops
from .reference.integration import Event as Event, TurningPoint as TurningPoint
from .reference.inverse import (
    InverseTorque as InverseTorque,
    inverse_torque as inverse_torque,
    require_within_stops as require_within_stops,
)
from .reference.moments import (
    angle_of_travel as angle_of_travel,
    assembly_energy as assembly_energy,
    assembly_force as assembly_force,
    contact_force as contact_force,
    contact_moment as contact_moment,
    contact_travel as contact_travel,
    contact_travel_slope as contact_travel_slope,
    damping_coefficient as damping_coefficient,
    energy as energy,
    gravity_moment as gravity_moment,
    sliding_friction as sliding_friction,
    spring_energy as spring_energy,
    spring_force as spring_force,
    static_friction as static_friction,
    stop_moment as stop_moment,
    swing_frequency as swing_frequency,
    table_force as table_force,
)
from .reference.rk4 import PAPER_STEP as PAPER_STEP, simulate_rk4 as simulate_rk4
from .reference.simulation import DEFAULT_TOLERANCE as DEFAULT_TOLERANCE, simulate as simulate
from .reference.trajectory import Trajectory as Trajectory
from .undamped_period.closed_form import (
    LineOscillator as LineOscillator,
    LineSide as LineSide,
    linearized_joystick as linearized_joystick,
)
from .undamped_period.oscillation import (
    NoOscillationError as NoOscillationError,
    Span as Span,
    UndampedOscillation as UndampedOscillation,
)
from .undamped_period.quadrature import (
    CamGeometry as CamGeometry,
    Geometry as Geometry,
    undamped_oscillation as undamped_oscillation,
)
from .undamped_period.table import (
    decaying_periods as decaying_periods,
    exponent as exponent,
    period_table as period_table,
    plot_periods as plot_periods,
)
