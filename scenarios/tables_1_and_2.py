"""Tables 1 and 2 as used by the model, with the springs equivalent to Table 1, and the damping laws.

Prints them and saves them in results/tables_1_and_2/.
"""

import sys
from pathlib import Path

from pyjoystick import NOMINAL, NOMINAL_POWER_LAW, save_results
from pyjoystick.model import PIVOT_TO_TOP, body_table, damping_table, segment_table, spring_table

TABLES = {
    "Table 1: displacements and stiffnesses": segment_table(NOMINAL),
    "The restrained springs of Table 1, eqs. (6)-(8)": spring_table(NOMINAL),
    "Table 2: inertia and geometry": body_table(NOMINAL, PIVOT_TO_TOP),
    "Damping, section 3.3": damping_table(NOMINAL.damping, NOMINAL_POWER_LAW.damping),
}
RESULTS = Path(__file__).parents[1] / "results" / "tables_1_and_2"


def main(results: Path = RESULTS) -> int:
    """Run the scenario."""
    parts = [f"## {title}\n\n{table.markdown()}" for title, table in TABLES.items()]
    save_results(results, "\n\n".join(parts), {})
    return 0


if __name__ == "__main__":
    sys.exit(main())
