from .bench import (
    OF_INSTRUMENTS as OF_INSTRUMENTS,
    UNCERTAIN as UNCERTAIN,
    Bench as Bench,
    stated_uncertainties as stated_uncertainties,
)
from .contradiction import (
    Contradiction as Contradiction,
    combined_uncertainties_apart as combined_uncertainties_apart,
    contradictions as contradictions,
)
from .design.choice import Design as Design, best_design as best_design
from .design.experiment import (
    HOLD as HOLD,
    Experiment as Experiment,
    Information as Information,
    PlannedFit as PlannedFit,
)
from .design.report import (
    chosen_experiments as chosen_experiments,
    design_json as design_json,
    design_table as design_table,
    plot_design as plot_design,
)
from .design.trial import Trial as Trial, trial_sentence as trial_sentence, try_design as try_design
from .documents import (
    BudgetDocument as BudgetDocument,
    FitDocument as FitDocument,
    FittedSeries as FittedSeries,
    FittedValue as FittedValue,
    read_budget as read_budget,
    read_fit as read_fit,
)
from .errors import (
    DampingEstimateError as DampingEstimateError,
    FitError as FitError,
    FitInterruptedError as FitInterruptedError,
)
from .fitting.figures import (
    PROFILES as PROFILES,
    plot_correlation as plot_correlation,
    plot_profiles as plot_profiles,
    plot_records as plot_records,
    plot_residuals as plot_residuals,
    save_figures as save_figures,
)
from .fitting.files import read_records as read_records, save_fit as save_fit
from .fitting.fit import OnProgress as OnProgress, fit as fit
from .fitting.json_report import as_json as as_json
from .fitting.problem.instrument import (
    ANGLE_SCALE as ANGLE_SCALE,
    DELAY as DELAY,
    RELEASE_TIME as RELEASE_TIME,
    TIME_BASE as TIME_BASE,
    ZERO_OFFSET as ZERO_OFFSET,
)
from .fitting.problem.joystick_settings import (
    CONSTANT_DAMPING as CONSTANT_DAMPING,
    DISPLACEMENT_DAMPING as DISPLACEMENT_DAMPING,
    PIVOT_FRICTION as PIVOT_FRICTION,
    PLUNGER_FRICTION as PLUNGER_FRICTION,
    POWER_LAW_DAMPING as POWER_LAW_DAMPING,
    RELEASE as RELEASE,
    driven as driven,
    scaled_forces as scaled_forces,
    with_force_scale as with_force_scale,
    with_friction as with_friction,
)
from .fitting.problem.known_values import with_known as with_known, with_values as with_values
from .fitting.problem.measurement import (
    Measurement as Measurement,
    Release as Release,
    guess_release as guess_release,
    read_table_record as read_table_record,
)
from .fitting.problem.settings import (
    FitSettings as FitSettings,
    Free as Free,
    Noise as Noise,
    Search as Search,
    Uncertainty as Uncertainty,
)
from .fitting.result import Fit as Fit
from .fitting.selection import (
    Candidate as Candidate,
    compare_models as compare_models,
    comparison_table as comparison_table,
)
from .fitting.settings_file import read_fit_settings as read_fit_settings, reads_releases as reads_releases
from .fitting.text_report import report as report, summary as summary
from .joystick_of_fit import (
    fitted_joystick as fitted_joystick,
    known_values as known_values,
    require_joystick_in as require_joystick_in,
)
from .laboratory_errors import (
    FITTED as FITTED,
    Contribution as Contribution,
    combined as combined,
    contribution_csv as contribution_csv,
    contribution_json as contribution_json,
    contribution_table as contribution_table,
    curve_axes as curve_axes,
    fit_contributions as fit_contributions,
)
from .peak_method.bias import (
    Bias as Bias,
    bias_table as bias_table,
    biases as biases,
    constant_bias as constant_bias,
    line_bias as line_bias,
)
from .peak_method.estimate import (
    ConstantEstimate as ConstantEstimate,
    DampingEstimate as DampingEstimate,
    VelocityClock as VelocityClock,
    displacement_points as displacement_points,
    estimate_damping as estimate_damping,
    velocity_points as velocity_points,
)
from .peak_method.figures import (
    plot_damping_estimate as plot_damping_estimate,
    plot_peak_errors as plot_peak_errors,
)
from .peak_method.line import PowerLine as PowerLine, fit_power_line as fit_power_line
from .peak_method.report import (
    bias_report as bias_report,
    damping_csv as damping_csv,
    damping_json as damping_json,
    damping_report as damping_report,
    peak_error_report as peak_error_report,
    releases_report as releases_report,
)
from .swing_estimate import (
    SwingEstimate as SwingEstimate,
    inertia_doubts as inertia_doubts,
    swing_estimate as swing_estimate,
    with_estimated_starts as with_estimated_starts,
)
