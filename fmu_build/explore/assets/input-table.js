// An input over time: constant, or a table of times and values, straight between its rows.

import { make } from "./elements.js";
import { fieldText, fromShown, shownUnit, toShown } from "./format.js";
import { page } from "./page-data.js";

export function inputTable(one, state, row) {
  const id = `table-${one.reference}`;
  const follow = make("input", { type: "checkbox", id: `${id}-on` });
  const unit = shownUnit(one);
  const text = make("textarea", {
    id,
    rows: 4,
    spellcheck: "false",
    "aria-label": `${one.name} over time: in each line a time in seconds and a value${unit ? ` in ${unit}` : ""}`,
  });
  const error = make("p", { class: "error", hidden: true, id: `${id}-error` });
  const hint = make(
    "p",
    { class: "about" },
    `Each line: time (s), value${unit ? ` (${unit})` : ""}. Equal times make a jump.`,
  );
  text.setAttribute("aria-describedby", error.id);
  const say = (message) => {
    error.textContent = message;
    error.hidden = !message;
  };
  let last = null; // what was typed, for the next time that the box is ticked
  follow.addEventListener("change", () => {
    if (!follow.checked) last = state.tables.get(one.name) ?? last;
    const usual = last ?? page.tables[one.name] ?? ramp(state);
    state.setTable(one.name, follow.checked ? usual : null, follow);
  });
  text.addEventListener("input", () => {
    try {
      state.setTable(one.name, read(one, text.value), text);
      say("");
    } catch (mistake) {
      say(mistake.message);
    }
  });
  const body = make("div", { class: "table", hidden: true }, text, hint, error);
  row.addEventListener("refresh", ({ detail: origin }) => {
    const table = state.tables.get(one.name);
    follow.checked = Boolean(table);
    body.hidden = !table;
    row.classList.toggle("follows", Boolean(table));
    if (!table || origin === text) return;
    text.value = table.map(([t, v]) => `${fieldText(t)}, ${fieldText(toShown(one, v))}`).join("\n");
    say("");
  });
  return make("div", {}, make("label", { class: "follow" }, follow, " over time"), body);
}

function ramp(state) {
  const { start, stop } = state.experiment;
  return [
    [start, 0],
    [start + 0.1 * (stop - start), 1],
  ];
}

function read(one, text) {
  const rows = text.split("\n").filter((line) => line.trim() !== "");
  if (rows.length === 0) throw new Error("Type at least one line: a time and a value.");
  const table = rows.map((line, i) => {
    const cells = line
      .trim()
      .split(/[\s,;]+/)
      .map(Number);
    if (cells.length !== 2 || !cells.every(Number.isFinite)) {
      throw new Error(`Line ${i + 1}, “${line.trim()}”, must be a time and a value.`);
    }
    return [cells[0], fromShown(one, cells[1])];
  });
  const back = table.findIndex(([time], i) => i > 0 && time < table[i - 1][0]);
  if (back > 0) throw new Error(`Line ${back + 1}: the time ${table[back][0]} is before that of the line above.`);
  return table;
}
