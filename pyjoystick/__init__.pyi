from .fmu import (
    Fmu as Fmu,
    FmuFileError as FmuFileError,
    FmuNotFoundError as FmuNotFoundError,
    FmuRunError as FmuRunError,
)
from .identification import (
    Fit as Fit,
    FitError as FitError,
    FitSettings as FitSettings,
    Free as Free,
    estimate_damping as estimate_damping,
    fit as fit,
    fitted_joystick as fitted_joystick,
)
from .laboratory import Chain as Chain, measure_angle as measure_angle, read_markers as read_markers
from .model import (
    NOMINAL as NOMINAL,
    NOMINAL_POWER_LAW as NOMINAL_POWER_LAW,
    PAPER as PAPER,
    PIVOT_TO_TOP as PIVOT_TO_TOP,
    STOP_ANGLE as STOP_ANGLE,
    ActuatorAssembly as ActuatorAssembly,
    ConstantDamping as ConstantDamping,
    Friction as Friction,
    JoystickParameters as JoystickParameters,
    PowerLawDamping as PowerLawDamping,
    RestrainedSpring as RestrainedSpring,
    SegmentTable as SegmentTable,
    read_parameter_file as read_parameter_file,
    read_parameters as read_parameters,
    simulate as simulate,
    write_parameters as write_parameters,
)
from .motion import (
    Record as Record,
    RecordError as RecordError,
    compare as compare,
    find_peaks as find_peaks,
    measured_peaks as measured_peaks,
    periods as periods,
    read_record as read_record,
    read_repeats as read_repeats,
    write_csv as write_csv,
)
from .reports import explore as explore, joystick_report as joystick_report
from .runs import (
    SimulatedReleases as SimulatedReleases,
    Sweep as Sweep,
    compare_fmus as compare_fmus,
    free_oscillation as free_oscillation,
    read_sweep as read_sweep,
    reference_free_oscillation as reference_free_oscillation,
    run_sweep as run_sweep,
    sensitivity as sensitivity,
)
from .support import (
    ParameterError as ParameterError,
    PyJoystickError as PyJoystickError,
    SeriesError as SeriesError,
    SettingsError as SettingsError,
    SimulationError as SimulationError,
    TextTable as TextTable,
    UnknownParameterError as UnknownParameterError,
    dress as dress,
    legend_above as legend_above,
    line_style as line_style,
    plot_motion as plot_motion,
    save_figure as save_figure,
    save_results as save_results,
)
