from .archives import ARCHIVE_ERRORS as ARCHIVE_ERRORS, archive_problem as archive_problem
from .checks import (
    DEFAULT_DURATION as DEFAULT_DURATION,
    DEFAULT_OUTPUT_INTERVAL as DEFAULT_OUTPUT_INTERVAL,
    DEFAULT_TOLERANCE as DEFAULT_TOLERANCE,
    FloatArray as FloatArray,
    Torque as Torque,
    angle as angle,
    finite as finite,
    increasing_times as increasing_times,
    is_number_text as is_number_text,
    not_negative as not_negative,
    number_of_text as number_of_text,
    positive as positive,
    real_numbers as real_numbers,
    type_text as type_text,
    whole_number as whole_number,
    without_mask as without_mask,
)
from .errors import (
    InputFileError as InputFileError,
    MissingPackageError as MissingPackageError,
    OutputFileError as OutputFileError,
    ParameterError as ParameterError,
    PyJoystickError as PyJoystickError,
    SeriesError as SeriesError,
    SettingsError as SettingsError,
    SimulationError as SimulationError,
    UnknownInputError as UnknownInputError,
    UnknownNameError as UnknownNameError,
    UnknownParameterError as UnknownParameterError,
    UnknownVariableError as UnknownVariableError,
)
from .figure_style import (
    AMBER as AMBER,
    BACKWARD as BACKWARD,
    BAND as BAND,
    BLACK as BLACK,
    BLUE as BLUE,
    FITTED as FITTED,
    FORWARD as FORWARD,
    GRAY as GRAY,
    GREEN as GREEN,
    LAWS as LAWS,
    LONG_DASHES as LONG_DASHES,
    MEASURED as MEASURED,
    SERIES as SERIES,
    SKY as SKY,
    SOLID as SOLID,
    VERMILION as VERMILION,
    dress as dress,
    legend_above as legend_above,
    line_style as line_style,
)
from .notebook import (
    Drawn as Drawn,
    Shown as Shown,
    figure_as_html as figure_as_html,
    notebook_progress as notebook_progress,
)
from .output import (
    FIGURE_SUFFIXES as FIGURE_SUFFIXES,
    check_outputs as check_outputs,
    check_suffix as check_suffix,
    document_text as document_text,
    json_text as json_text,
    remove_unfinished as remove_unfinished,
    replacing as replacing,
    version_of as version_of,
    versions as versions,
    write_text as write_text,
)
from .plots import plot_motion as plot_motion, save_figure as save_figure, save_results as save_results
from .temporary_folders import remove_abandoned as remove_abandoned, temporary_folder as temporary_folder
from .text_table import TextTable as TextTable
from .toml_mistakes import mistakes as mistakes
from .toml_table import Table as Table, read_toml as read_toml
