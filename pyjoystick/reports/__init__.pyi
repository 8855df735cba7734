from .claims.claim import Claim as Claim, Finding as Finding, Verdict as Verdict, Workbench as Workbench
from .claims.document import (
    CHAPTERS as CHAPTERS,
    Findings as Findings,
    claims_page as claims_page,
    findings as findings,
    text_of as text_of,
)
from .claims.torque import MOTION as MOTION, Section5 as Section5, section_5 as section_5
from .dissipation import (
    damping_jumps as damping_jumps,
    equivalent_damping as equivalent_damping,
    mean_damping as mean_damping,
    plateaus as plateaus,
    plot_damping_function as plot_damping_function,
    plot_energy as plot_energy,
    sampled_closely as sampled_closely,
)
from .export.fit_page import fit_page as fit_page
from .export.fmus import (
    FmuExportError as FmuExportError,
    default_name as default_name,
    export_fmus as export_fmus,
)
from .export.modelica_class import (
    Direction as Direction,
    check_name as check_name,
    modelica_class as modelica_class,
)
from .export.system import export_ssp as export_ssp
from .html_report.measurements import (
    Measurements as Measurements,
    SwingTest as SwingTest,
    read_measurements as read_measurements,
)
from .html_report.page import Section as Section, figure as figure, page as page, paragraph as paragraph
from .html_report.report import joystick_report as joystick_report
from .html_report.study import Study as Study
from .live_page.joystick_page import held_fmu as held_fmu, joystick_page as joystick_page
from .live_page.notebook import explore as explore
