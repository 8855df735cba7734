from .comparison import Difference as Difference, compare as compare, within_limits as within_limits
from .extrema import (
    EXTREMA_FUNCTIONS as EXTREMA_FUNCTIONS,
    extrema_of_derivative as extrema_of_derivative,
    extrema_of_samples as extrema_of_samples,
    peaks_among as peaks_among,
)
from .peaks import find_peaks as find_peaks, periods as periods
from .record_peaks import MeasuredPeaks as MeasuredPeaks, measured_peaks as measured_peaks
from .records.columns import (
    find_column as find_column,
    finite_numbers as finite_numbers,
    unit_factor as unit_factor,
)
from .records.csv_file import (
    DELIMITERS as DELIMITERS,
    CsvFile as CsvFile,
    Heading as Heading,
    parse_heading as parse_heading,
    read_csv_file as read_csv_file,
    split_cells as split_cells,
)
from .records.errors import RecordError as RecordError, rows_in_words as rows_in_words
from .records.free_oscillation import Side as Side, check_free_oscillation as check_free_oscillation
from .records.reading import read_record as read_record, read_repeats as read_repeats
from .records.record import MISSING_ADVICE as MISSING_ADVICE, Record as Record
from .records.swings import find_swings as find_swings
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
from .tables import (
    DisplayUnit as DisplayUnit,
    Quantity as Quantity,
    make_table as make_table,
    write_csv as write_csv,
)
