from .creating import EXAMPLE as EXAMPLE, new_project as new_project
from .editor_schemas.files import schemas as schemas, write_schemas as write_schemas
from .errors import (
    ProjectBusyError as ProjectBusyError,
    ProjectExistsError as ProjectExistsError,
    ProjectFileError as ProjectFileError,
)
from .laboratory import FILE as FILE, Laboratory as Laboratory
from .laboratory_file import TABLES as TABLES, read_laboratory as read_laboratory
from .planning import plan_project as plan_project
from .running import run_project as run_project
from .states import (
    OnChange as OnChange,
    PlannedStep as PlannedStep,
    ProjectRun as ProjectRun,
    StepState as StepState,
)
