from .fitting.defaults import (
    CONSTANT_DAMPING as CONSTANT_DAMPING,
    DISPLACEMENT_DAMPING as DISPLACEMENT_DAMPING,
    POWER_LAW_DAMPING as POWER_LAW_DAMPING,
    RELEASE as RELEASE,
)
from .fitting.errors import FitError as FitError, FitInterruptedError as FitInterruptedError
from .fitting.figures import PROFILES as PROFILES, save_figures as save_figures
from .fitting.fit import OnProgress as OnProgress, fit as fit
from .fitting.joystick_values import with_values as with_values
from .fitting.json_report import as_json as as_json
from .fitting.measurement import Measurement as Measurement, read_table_record as read_table_record
from .fitting.result import Fit as Fit
from .fitting.settings import (
    RELEASE_TIME as RELEASE_TIME,
    FitSettings as FitSettings,
    Free as Free,
    Noise as Noise,
    Search as Search,
    Uncertainty as Uncertainty,
)
from .fitting.settings_file import read_fit_settings as read_fit_settings, reads_releases as reads_releases
from .fitting.text_report import report as report, summary as summary
from .joystick_of_fit import fitted_joystick as fitted_joystick, require_joystick_in as require_joystick_in
from .laboratory_errors import (
    FITTED as FITTED,
    Bench as Bench,
    combined as combined,
    contribution_table as contribution_table,
    fit_contributions as fit_contributions,
)
from .peak_method.bias import (
    Bias as Bias,
    bias_table as bias_table,
    constant_bias as constant_bias,
    line_bias as line_bias,
    preload_factors as preload_factors,
)
from .peak_method.estimate import (
    CONSTANTS as CONSTANTS,
    LINES as LINES,
    ConstantEstimate as ConstantEstimate,
    DampingEstimate as DampingEstimate,
    estimate_damping as estimate_damping,
)
from .peak_method.figures import plot_damping_estimate as plot_damping_estimate
from .peak_method.line import (
    DampingEstimateError as DampingEstimateError,
    PowerLine as PowerLine,
    fit_power_line as fit_power_line,
)
from .peak_method.points import (
    VelocityClock as VelocityClock,
    displacement_points as displacement_points,
    velocity_points as velocity_points,
)
from .peak_method.report import damping_report as damping_report, releases_report as releases_report
