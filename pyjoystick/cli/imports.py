"""``pyjoystick import``: measurements from a laboratory's own files."""

from __future__ import annotations

import typer

from pyjoystick.cli import import_accelerometer, import_inertia, import_load_curve, import_markers

app = typer.Typer(
    add_completion=False,
    no_args_is_help=True,
    rich_markup_mode="markdown",
    help="Make records and parameters from a laboratory's own files.",
)
app.command("markers", epilog=import_markers.EXAMPLES)(import_markers.run)
app.command("accelerometer", epilog=import_accelerometer.EXAMPLES)(import_accelerometer.run)
app.command("load-curve", epilog=import_load_curve.EXAMPLES)(import_load_curve.run)
app.command("swing", epilog=import_inertia.SWING_EXAMPLES)(import_inertia.swing)
app.command("parts", epilog=import_inertia.PARTS_EXAMPLES)(import_inertia.parts)
