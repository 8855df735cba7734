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
from .project.creating import EXAMPLE_LABORATORY as EXAMPLE_LABORATORY, new_project as new_project
from .project.editor_schemas.files import schemas as schemas, write_schemas as write_schemas
from .project.errors import (
    ProjectBusyError as ProjectBusyError,
    ProjectExistsError as ProjectExistsError,
    ProjectFileError as ProjectFileError,
)
from .project.laboratory import LABORATORY_FILE as LABORATORY_FILE, Laboratory as Laboratory
from .project.laboratory_file import (
    LABORATORY_TABLES as LABORATORY_TABLES,
    read_laboratory as read_laboratory,
)
from .project.planning import plan_project as plan_project
from .project.running import run_project as run_project
from .project.states import (
    OnChange as OnChange,
    PlannedStep as PlannedStep,
    ProjectRun as ProjectRun,
    StepState as StepState,
)
