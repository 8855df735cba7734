from .columns import (
    TIME as TIME,
    Column as Column,
    Heading as Heading,
    Match as Match,
    TableHead as TableHead,
)
from .comparison import Difference as Difference, compare as compare, within_limits as within_limits
from .extrema import (
    EXTREMA_FUNCTIONS as EXTREMA_FUNCTIONS,
    extrema_of_derivative as extrema_of_derivative,
    extrema_of_samples as extrema_of_samples,
    peaks_among as peaks_among,
)
from .labelled import to_xarray as to_xarray
from .logs.headings import time_heading as time_heading, understood as understood
from .logs.layout import Layout as Layout, Scale as Scale, scale_of as scale_of
from .logs.log_table import LogTable as LogTable, read_log_table as read_log_table
from .logs.reading import (
    Log as Log,
    read_log as read_log,
    record_of as record_of,
    require_plausible_load as require_plausible_load,
)
from .peaks import find_peaks as find_peaks, periods as periods
from .record_peaks import MeasuredPeaks as MeasuredPeaks, measured_peaks as measured_peaks
from .records.derivatives import ratio_to_rate as ratio_to_rate
from .records.errors import RecordError as RecordError, rows_in_words as rows_in_words
from .records.free_oscillation import (
    Side as Side,
    check_free_oscillation as check_free_oscillation,
    require_no_growth as require_no_growth,
)
from .records.glitches import (
    glitch_notes as glitch_notes,
    lone_notes as lone_notes,
    require_no_glitch as require_no_glitch,
)
from .records.instrument import uneven_notes as uneven_notes
from .records.reading import read_record as read_record, read_repeats as read_repeats
from .records.record import (
    GAP as GAP,
    HIDING as HIDING,
    MISSING_ADVICE as MISSING_ADVICE,
    Record as Record,
    require_sampling as require_sampling,
)
from .records.swings import Swing as Swing, find_swings as find_swings
from .release_peaks import (
    DISPLACEMENT_PEAKS as DISPLACEMENT_PEAKS,
    VELOCITY_PEAKS as VELOCITY_PEAKS,
    ReleasePeaks as ReleasePeaks,
    average_peaks as average_peaks,
    minima as minima,
    peak_errors as peak_errors,
    peaks_of_run as peaks_of_run,
    sweep_peak_errors as sweep_peak_errors,
)
from .report import Case as Case, free_oscillation_report as free_oscillation_report, peak_table as peak_table
from .stumps import cut_short as cut_short, is_cut_short as is_cut_short
from .table_files import (
    DELIMITERS as DELIMITERS,
    LARGEST as LARGEST,
    TableFile as TableFile,
    cells_of_line as cells_of_line,
    misfit as misfit,
    no_number as no_number,
    open_text as open_text,
    read_table_file as read_table_file,
    read_table_head as read_table_head,
    require_whole_end as require_whole_end,
)
from .tables import (
    DisplayUnit as DisplayUnit,
    Quantity as Quantity,
    make_table as make_table,
    write_csv as write_csv,
)
from .units import (
    GRAVITY as GRAVITY,
    UNITS as UNITS,
    amount as amount,
    amount_of as amount_of,
    plain_unit as plain_unit,
)
