// Period over amplitude: the model is released from twenty angles with the values of the page, in a worker of its
// own and once nothing changes, so that the other curves do not wait. Dots are the periods of the motion that is shown.

import { ExtraPlot } from "./extra-plot.js";
import { numberText } from "./format.js";
import { peaks, periods } from "./oscillation.js";
import { byName, workerSource } from "./page-data.js";
import { runRequest } from "./request.js";
import { columnOf, timesOf } from "./run.js";
import { Simulation } from "./simulation.js";
import { stopOf } from "./stop.js";

const DEGREES = 180 / Math.PI;
const RELEASES = 20;
const SMALLEST = 0.5 / DEGREES;
const STEP = 1e-3; // s
const ROWS = 2001; // time for a whole period of a heavy joystick
const TIMES = timesOf({ start: 0, step: STEP }, ROWS);
const FREE = { omega_start: 0, T: 0, grip: 0, a_base: 0 };

export class PeriodPlot {
  constructor() {
    const entries = { 0: "period over amplitude", 1: "of the motion shown" };
    this.plot = new ExtraPlot("periods", "periods", entries, () => this.app.draw());
    this.plot.element.hidden = false;
    this.points = [];
    this.kept = null;
  }

  get names() {
    return ["theta", "omega", "T", "grip"];
  }

  mount(app) {
    this.app = app;
    app.plots.element.append(this.plot.element);
  }

  // New values: all releases anew; those that are still to be made with the old ones are left out.
  rested() {
    const { app } = this;
    if (!app.simulation) return; // still loading
    const asked = runRequest(app.state, ["theta", "omega"]);
    Object.assign(asked, { step: STEP, rows: ROWS, stop: asked.start + STEP * (ROWS - 1) });
    asked.inputs = { references: [], rows: 0, values: [], slopes: [] };
    for (const [name, value] of Object.entries(FREE)) if (byName.has(name)) override(asked, name, value);
    override(asked, "theta_start", 0);
    const values = JSON.stringify(asked.reals);
    if (values === this.values) return;
    this.values = values;
    this.asked = asked;
    this.releases = anglesUpTo(stopOf(asked));
    this.found = [];
    this.simulation ??= new Simulation(app.simulation.module, workerSource(), (...result) => this.received(...result));
    this.release(0);
  }

  release(number) {
    const { references, values } = this.asked.reals;
    const released = { references, values: [...values.slice(0, -1), -this.releases[number]] };
    this.simulation.run({ ...this.asked, reals: released, number, of: this.values });
  }

  received(result, request) {
    if (!request || request.of !== this.values) return;
    if (result.rows === request.rows) {
      const [theta, omega] = [0, 1].map((column) => columnOf(result.table, 2, column));
      this.found.push(...periods(peaks(TIMES, theta, omega), 0).slice(0, 1));
    }
    if (request.number + 1 < RELEASES) {
      this.release(request.number + 1);
      return;
    }
    this.points = this.found.sort((one, other) => one.amplitude - other.amplitude);
    this.show(this.app.run, this.app.plots.theme, true);
  }

  // In view, or anyhow.
  show(run, theme, isWhole) {
    if (Boolean(this.app.kept) !== Boolean(this.kept)) this.kept = this.app.kept ? this.points : null;
    if (!isWhole && !this.plot.surface.isInView) return;
    const shown = periodsShown(run);
    const color = theme.colors[0];
    const curves = [
      { ...curve(this.kept ?? []), color, alpha: 0.75, dash: [5, 4], width: 1.25 },
      { ...curve(this.points), color },
      { ...curve(shown), color: theme.colors[1], dots: 5 },
      { x: [0, 1], y: [0, 1], color: "transparent" }, // both axes begin at zero, also without a period
    ];
    const rows = [
      ...this.points.map(({ amplitude, period }) => ["released", amplitude, period]),
      ...shown.map(({ amplitude, period }) => ["shown", amplitude, period]),
    ];
    const table = { heads: ["motion", "amplitude (rad)", "period (s)"], rows };
    this.plot.draw({ curves, xLabel: "amplitude (°), period in ms" }, theme, table, words(this.points));
  }
}

// Equal ratios between them.
function anglesUpTo(stop) {
  const ratio = (stop / SMALLEST) ** (1 / (RELEASES - 1));
  return Array.from({ length: RELEASES }, (_, i) => SMALLEST * ratio ** i);
}

// The last value of a variable that a request gives counts.
function override(request, name, value) {
  request.reals.references.push(byName.get(name).reference);
  request.reals.values.push(value);
}

function curve(points) {
  return {
    x: points.map((one) => one.amplitude * DEGREES),
    y: points.map((one) => one.period * 1000),
  };
}

// From where neither hand nor torque acts.
function periodsShown(run) {
  if (!["theta", "omega", "T", "grip"].every((name) => run.has(name))) return [];
  const [torque, grip] = [run.column("T"), run.column("grip")];
  let first = run.rows;
  while (first > 0 && torque[first - 1] === 0 && grip[first - 1] === 0) first--;
  const [times, theta, omega] = [run.times, run.column("theta"), run.column("omega")].map((all) => all.subarray(first));
  return periods(peaks(times, theta, omega), first === 0 && omega[0] === 0 ? times[0] : null);
}

function words(points) {
  if (points.length === 0) return "Period over amplitude: no release swings to and fro";
  const [least, most] = [points[0], points[points.length - 1]].map(
    ({ amplitude, period }) => `${numberText(period * 1000)} ms at ${numberText(amplitude * DEGREES, 3)}°`,
  );
  return `Period over amplitude: from ${least} to ${most}`;
}
