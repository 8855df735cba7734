from .coupling.figures import (
    plot_operated_joystick as plot_operated_joystick,
    plot_step_errors as plot_step_errors,
)
from .coupling.joystick import operator_and_joystick as operator_and_joystick
from .coupling.master import run_coupled as run_coupled
from .coupling.parameter_sets import ParameterNote as ParameterNote
from .coupling.schemes import SCHEMES as SCHEMES
from .coupling.ssp import read_ssp as read_ssp, write_ssp as write_ssp
from .coupling.step_errors import coupling_errors as coupling_errors, orders as orders
from .coupling.system import Component as Component, Connection as Connection, CoupledSystem as CoupledSystem
from .errors import (
    ChangedSweepError as ChangedSweepError,
    ClusterError as ClusterError,
    CouplingError as CouplingError,
    SensitivityError as SensitivityError,
    SweepFileError as SweepFileError,
)
from .experiments import (
    free_oscillation as free_oscillation,
    joystick_of_fmu as joystick_of_fmu,
    reference_free_oscillation as reference_free_oscillation,
    time_grid as time_grid,
)
from .fmu_comparison.compare import (
    FmuComparison as FmuComparison,
    Limits as Limits,
    RunComparison as RunComparison,
    compare_fmus as compare_fmus,
)
from .fmu_comparison.declarations import (
    AttributeDifference as AttributeDifference,
    Declarations as Declarations,
    compare_declarations as compare_declarations,
)
from .fmu_comparison.experiments import (
    Experiment as Experiment,
    Tolerances as Tolerances,
    experiments_for as experiments_for,
)
from .fmu_comparison.reference import compare_with_reference as compare_with_reference
from .fmu_comparison.report import as_json as as_json
from .fmu_settings import (
    amount_for as amount_for,
    difference_of as difference_of,
    fmu_of as fmu_of,
    joystick_values as joystick_values,
    number_of as number_of,
    value_of as value_of,
)
from .joystick_fmus import (
    FMU_OF_LAW as FMU_OF_LAW,
    FMU_WITH_FRICTION as FMU_WITH_FRICTION,
    fmu_of_joystick as fmu_of_joystick,
    fmu_with_parts as fmu_with_parts,
    has_si_unit as has_si_unit,
    law_of_fmu as law_of_fmu,
    mounted_fmu as mounted_fmu,
    require_si_units as require_si_units,
)
from .release_report import (
    ReleasePeak as ReleasePeak,
    release_json as release_json,
    release_peak_rows as release_peak_rows,
)
from .simulated_releases import SimulatedReleases as SimulatedReleases
from .sweeps.files import read_sweep as read_sweep
from .sweeps.plots import (
    MOST_RESULTS as MOST_RESULTS,
    plot_scatter as plot_scatter,
    plot_sensitivity as plot_sensitivity,
)
from .sweeps.results import coarse_peaks as coarse_peaks
from .sweeps.runner import Outcome as Outcome, run_sweep as run_sweep
from .sweeps.sampling import Sampling as Sampling, design as design
from .sweeps.settings import Settings as Settings, read_settings as read_settings
from .sweeps.sobol import sensitivity as sensitivity
from .sweeps.sweep import Sweep as Sweep
