from .conclusions import (
    measured_friction as measured_friction,
    measured_parts as measured_parts,
    measured_springs as measured_springs,
    measured_swing as measured_swing,
)
from .inertia.budget import Estimate as Estimate, Measured as Measured, combined as combined
from .inertia.decay import Decay as Decay
from .inertia.parts import (
    Part as Part,
    PartsResult as PartsResult,
    from_parts as from_parts,
    read_parts as read_parts,
)
from .inertia.report import (
    estimates_report as estimates_report,
    parts_json as parts_json,
    swing_json as swing_json,
    swing_report as swing_report,
)
from .inertia.swing import (
    REACTION_TIME as REACTION_TIME,
    SwingPeriod as SwingPeriod,
    friction_of_swing as friction_of_swing,
    inertia_of_swing as inertia_of_swing,
    period_of_readings as period_of_readings,
)
from .inertia.swing_record import period_of_record as period_of_record
from .load_curve.curve import Branch as Branch, LoadCurve as LoadCurve, read_load_curve as read_load_curve
from .load_curve.figures import (
    CubicFit as CubicFit,
    cubic_fits as cubic_fits,
    plot_load_curve as plot_load_curve,
    plot_load_deflection as plot_load_deflection,
)
from .load_curve.fit import LoadCurveFit as LoadCurveFit, fit_load_curve as fit_load_curve
from .load_curve.report import load_curve_json as load_curve_json, load_curve_report as load_curve_report
from .measured_values import PLACES as PLACES, MeasuredValues as MeasuredValues
from .measurement_errors import (
    ChainEffect as ChainEffect,
    StageError as StageError,
    chain_effect as chain_effect,
    error_budget as error_budget,
    error_budget_report as error_budget_report,
    mean_period as mean_period,
)
from .measurement_plots import plot_chain_effect as plot_chain_effect, plot_instruments as plot_instruments
from .measurements.accelerometer import (
    angular_acceleration as angular_acceleration,
    read_accelerometer as read_accelerometer,
)
from .measurements.angle import (
    AngleMeasurement as AngleMeasurement,
    measure_angle as measure_angle,
    rest_angle as rest_angle,
)
from .measurements.angle_notes import REST_TIME as REST_TIME
from .measurements.chain import Chain as Chain, Motion as Motion, derivative as derivative
from .measurements.comparison import (
    AccelerometerComparison as AccelerometerComparison,
    compare_accelerometer as compare_accelerometer,
)
from .measurements.documents import (
    comparison_json as comparison_json,
    log_json as log_json,
    trial_json as trial_json,
)
from .measurements.low_pass import LowPass as LowPass
from .measurements.marker_files import read_markers as read_markers
from .measurements.markers import Markers as Markers
from .measurements.results import (
    log_report as log_report,
    plot_log as plot_log,
    write_log as write_log,
    write_motion as write_motion,
)
from .measurements.setups import AccelerometerSetup as AccelerometerSetup, MarkerSetup as MarkerSetup
from .measurements.trial import Trial as Trial, read_trial as read_trial
from .synthetic_laboratory.cameras import (
    ANGLE_NOISE as ANGLE_NOISE,
    BASE as BASE,
    CAMERA_RATE as CAMERA_RATE,
    TOP as TOP,
    MarkerLayout as MarkerLayout,
    synthetic_acceleration as synthetic_acceleration,
    synthetic_markers as synthetic_markers,
    synthetic_record as synthetic_record,
    synthetic_swing as synthetic_swing,
)
from .synthetic_laboratory.files import (
    true_joystick as true_joystick,
    write_synthetic_laboratory as write_synthetic_laboratory,
)
from .synthetic_laboratory.testing_machine import (
    MachineErrors as MachineErrors,
    synthetic_load_cycle as synthetic_load_cycle,
)
