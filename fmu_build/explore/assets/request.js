// A run as the model takes it: numbers by value reference, and inputs at the start of every step.

import { byName, page } from "./page-data.js";

const TYPES = { r: "reals", i: "integers", b: "booleans" };

export function runRequest(state, names) {
  const { start, stop, step, tolerance } = state.experiment;
  const rows = Math.floor((stop - start) / step + 1e-6) + 1;
  const end = Math.max(stop, start + (rows - 1) * step); // a rounding error later than the stop time
  const request = { start, stop: end, tolerance, step, rows, names };
  for (const type of Object.values(TYPES)) request[type] = { references: [], values: [] };
  const columns = names.map((name) => byName.get(name));
  request.references = columns.map((one) => one.reference);
  request.kinds = columns.map((one) => one.kind).join("");
  const tables = followed(state);
  const starts = new Map([...state.values, ...pageStarts(state)]);
  for (const [name, [, points]] of tables) starts.set(name, at(points, start).value);
  for (const [name, value] of starts) {
    const one = byName.get(name);
    request[TYPES[one.kind]].references.push(one.reference);
    request[TYPES[one.kind]].values.push(value);
  }
  request.starts = starts;
  request.inputs = sampled([...tables.values()], start, step, rows);
  return request;
}

// A parameter with which a run was asked for; the page may show another since, and the model refuse that one.
export function parameterOf({ starts }, name) {
  return starts.get(name) ?? byName.get(name)?.start;
}

// Start values that the page has set itself: the model has others.
function pageStarts(state) {
  const given = page.variables.filter((one) => one.given && !state.values.has(one.name));
  return given.map((one) => [one.name, one.start]);
}

// The inputs that follow a table, by name: [variable, points].
export function followed(state) {
  const inputs = page.variables.filter((one) => one.causality === "input" && one.kind === "r");
  return new Map(
    inputs.filter((one) => state.tables.get(one.name)).map((one) => [one.name, [one, state.tables.get(one.name)]]),
  );
}

// Values and slopes of inputs, given as [variable, points], at the rows of a run.
export function sampled(inputs, start, step, rows) {
  const values = new Float64Array(rows * inputs.length);
  const slopes = new Float64Array(rows * inputs.length);
  inputs.forEach(([, points], column) => {
    for (let row = 0; row < rows; row++) {
      // A point within rounding of a row belongs to it: a jump there takes effect in the step that begins.
      const { value, slope } = at(points, start + row * step, 1e-9 * step);
      values[row * inputs.length + column] = value;
      slopes[row * inputs.length + column] = slope;
    }
  });
  return { references: inputs.map(([one]) => one.reference), rows, values, slopes };
}

// Value and slope of a table just after a time: straight between points, held before the first and after the last.
export function at(points, time, tolerance = 0) {
  const next = points.findIndex(([t]) => t > time + tolerance);
  if (next === 0) return { value: points[0][1], slope: 0 };
  if (next < 0) return { value: points[points.length - 1][1], slope: 0 };
  const [[t0, v0], [t1, v1]] = [points[next - 1], points[next]];
  const slope = (v1 - v0) / (t1 - t0);
  return { value: v0 + slope * (time - t0), slope };
}
