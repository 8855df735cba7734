// The parameter file with the values of the page. What has not changed stays to the letter; a table in which
// something has loses the source of its numbers, and a number its uncertainty.

const SOURCE = "set by hand in the page of `pyjoystick explore`";

export function changedToml({ toml, places }, state) {
  const changed = changedValues(places, state);
  const written = new Set();
  const tables = new Set([...changed.keys()].map((place) => place.slice(0, place.lastIndexOf("."))));
  let table = "";
  const lines = [];
  for (const line of toml.split("\n")) {
    table = line.match(/^\[([^\]]+)\]/)?.[1] ?? table;
    const [, key, gap, rest] = line.match(/^(\w+)(\s*=\s*)(.*)$/) ?? [];
    const place = `${table}.${key}`;
    if (key === "source" && tables.has(table)) lines.push(`source = "${SOURCE}"`);
    else if (changed.has(place)) {
      lines.push(`${key}${gap}${changed.get(place)}${comment(rest)}`);
      written.add(place);
    } else if (!(key?.startsWith("u_") && changed.has(`${table}.${key.slice(2)}`))) lines.push(line);
  }
  for (const [place, value] of changed) if (!written.has(place)) add(lines, place, value);
  return lines.join("\n");
}

// A value that the file leaves to its default.
function add(lines, place, value) {
  const end = place.lastIndexOf(".");
  const head = `[${place.slice(0, end)}]`;
  const at = lines.findIndex((line) => line.startsWith(head));
  const line = `${place.slice(end + 1)} = ${value}`;
  if (at < 0) lines.push(head, line, "");
  else lines.splice(at + 1, 0, line);
}

// Why a file cannot hold the springs as they are; "" if it can.
export function springFault(state) {
  for (const side of ["forward", "backward"]) {
    const { x } = segments(side, state);
    const at = x.findIndex((one, i) => i > 0 && !(one > x[i - 1]));
    if (at > 0) return `${side}: the ends of the segments must rise, and ${x[at]} m follows ${x[at - 1]} m`;
  }
  return "";
}

function comment(rest) {
  const start = rest.indexOf("#");
  return start < 0 ? "" : `  ${rest.slice(start)}`;
}

// Numbers by place in the file.
function changedValues(places, state) {
  const changed = new Map();
  for (const [place, name] of Object.entries(places)) {
    if (state.values.has(name)) changed.set(place, number(state.value(name)));
  }
  for (const side of ["forward", "backward"]) {
    const names = [...state.values.keys()].filter((name) => name.startsWith(`${side}.`));
    if (names.length === 0) continue;
    const { x, k } = segments(side, state);
    changed.set(`${side}.x`, `[${x.map(number).join(", ")}]`);
    changed.set(`${side}.k`, `[${k.map(number).join(", ")}]`);
  }
  return changed;
}

// The load-deflection curve of two restrained springs side by side, as the file writes it (Table 1).
function segments(side, state) {
  const value = (name) => state.value(`${side}.${name}`);
  const [k1, kh, f, x0] = ["k_s", "k_h", "F_0", "x_0"].map((end) => value(`returnSpring.${end}`));
  const [ks, kb, fb, x2] = ["k_s", "k_h", "F_0", "x_0"].map((end) => value(`balanceSpring.${end}`));
  return { x: [x0, x0 + f / kh, x2, x2 + fb / kb], k: [k1 + kh, k1, k1 + ks + kb, k1 + ks] };
}

function number(value) {
  const text = String(Number(value.toPrecision(15)));
  return /[.e]/.test(text) ? text.replace("e+", "e") : `${text}.0`;
}
