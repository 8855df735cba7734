"""From load-deflection curves of a testing machine to the springs of an actuator (Fig. 7, Table 1)."""
