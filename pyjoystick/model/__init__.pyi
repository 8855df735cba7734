from .dissipation.figures import plot_damping_function as plot_damping_function, plot_energy as plot_energy
from .dissipation.jumps import (
    damping_jumps as damping_jumps,
    equivalent_damping as equivalent_damping,
    mean_damping as mean_damping,
)
from .dissipation.plateaus import plateaus as plateaus
from .parameter_tables import (
    TextTable as TextTable,
    body_table as body_table,
    damping_table as damping_table,
    segment_table as segment_table,
    spring_table as spring_table,
)
from .parameters.damping import (
    ConstantDamping as ConstantDamping,
    Damping as Damping,
    PowerLawDamping as PowerLawDamping,
)
from .parameters.file import (
    PLAIN_TABLES as PLAIN_TABLES,
    SIDES as SIDES,
    LawName as LawName,
    ParameterFile as ParameterFile,
    Side as Side,
    law_name as law_name,
    read_parameter_file as read_parameter_file,
    read_parameters as read_parameters,
)
from .parameters.file_writing import updated_text as updated_text, write_parameters as write_parameters
from .parameters.joystick import JoystickParameters as JoystickParameters
from .parameters.paper import (
    BACKWARD_TABLE as BACKWARD_TABLE,
    FORWARD_TABLE as FORWARD_TABLE,
    NOMINAL as NOMINAL,
    NOMINAL_POWER_LAW as NOMINAL_POWER_LAW,
    PAPER as PAPER,
    PIVOT_TO_TOP as PIVOT_TO_TOP,
    STOP_ANGLE as STOP_ANGLE,
)
from .parameters.rounding import rounded as rounded, rounded_error as rounded_error
from .parameters.springs import (
    ActuatorAssembly as ActuatorAssembly,
    RestrainedSpring as RestrainedSpring,
    SegmentTable as SegmentTable,
)
from .reference.cam import (
    angle_of_travel as angle_of_travel,
    contact_travel as contact_travel,
    contact_travel_slope as contact_travel_slope,
)
from .reference.integration import Event as Event, TurningPoint as TurningPoint
from .reference.inverse import InverseTorque as InverseTorque, inverse_torque as inverse_torque
from .reference.moments import (
    contact_force as contact_force,
    contact_moment as contact_moment,
    damping_coefficient as damping_coefficient,
    energy as energy,
    gravity_moment as gravity_moment,
    swing_frequency as swing_frequency,
)
from .reference.rk4 import (
    PAPER_REFINEMENT as PAPER_REFINEMENT,
    PAPER_STEP as PAPER_STEP,
    simulate_rk4 as simulate_rk4,
)
from .reference.simulation import DEFAULT_TOLERANCE as DEFAULT_TOLERANCE, simulate as simulate
from .reference.springs import (
    assembly_energy as assembly_energy,
    assembly_force as assembly_force,
    spring_energy as spring_energy,
    spring_force as spring_force,
    table_force as table_force,
)
from .reference.trajectory import Trajectory as Trajectory
from .undamped_period.closed_form import (
    LineOscillator as LineOscillator,
    LineSide as LineSide,
    linearized_joystick as linearized_joystick,
)
from .undamped_period.figure import plot_periods as plot_periods
from .undamped_period.geometry import (
    CamGeometry as CamGeometry,
    Geometry as Geometry,
    LinearGeometry as LinearGeometry,
)
from .undamped_period.oscillation import (
    NoOscillationError as NoOscillationError,
    Span as Span,
    UndampedOscillation as UndampedOscillation,
)
from .undamped_period.quadrature import undamped_oscillation as undamped_oscillation
from .undamped_period.table import (
    decaying_periods as decaying_periods,
    exponent as exponent,
    period_table as period_table,
)
