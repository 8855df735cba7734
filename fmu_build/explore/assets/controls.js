// A control for each value of the model: slider, field and reset; a box; a list of literals.

import { make, put, write } from "./elements.js";
import { fieldText, fromShown, parsed, rounded, shownUnit, toShown, valueText } from "./format.js";
import { inputTable } from "./input-table.js";
import { byName, page } from "./page-data.js";

const STEPS = 400; // of a slider: an arrow key moves it by a quarter of a percent

export class Controls {
  constructor(place, state) {
    this.state = state;
    this.controls = new Map();
    this.groups = [];
    const first = page.first.filter((name) => byName.has(name));
    const groups = new Map([["", first]]);
    for (const one of page.variables.filter((one) => one.settable && !first.includes(one.name))) {
      const group = one.name.includes(".") ? one.name.slice(0, one.name.lastIndexOf(".")) : "More values";
      groups.set(group, [...(groups.get(group) ?? []), one.name]);
    }
    for (const [group, names] of groups) place.append(this.group(group, names));
    this.refresh();
  }

  group(title, names) {
    const list = make("div", { class: "group" }, ...names.map((name) => this.control(byName.get(name), title)));
    if (title === "") return list;
    const count = make("span", { class: "changed-count" });
    const details = make("details", {}, make("summary", {}, title, count), list);
    for (const name of names) this.controls.get(name).details = details;
    this.groups.push({ count, names });
    return details;
  }

  control(one, group) {
    const id = `control-${one.reference}`;
    const short = group && one.name.startsWith(`${group}.`) ? one.name.slice(group.length + 1) : one.name;
    const isStart = one.causality !== "parameter" && one.causality !== "input";
    const suffix = isStart ? make("span", { class: "suffix" }, " at the start") : null;
    const label = make("label", { for: id, title: one.name }, short, suffix);
    const about = one.text ? make("span", { class: "about", id: `${id}-about` }, one.text) : null;
    const error = make("p", { class: "error", id: `${id}-error`, hidden: true });
    const reset = make(
      "button",
      { type: "button", class: "reset", title: `Reset ${one.name}`, "aria-label": `Reset ${one.name}` },
      "↺",
    );
    reset.addEventListener("click", () => this.state.reset([one.name]));
    const entry = one.kind === "b" ? this.box(one, id) : one.literals ? this.list(one, id) : this.number(one, id);
    const parts = [make("div", { class: "line" }, label, ...entry.line, reset), about, ...entry.below, error];
    const row = make("div", { class: "control", "data-name": one.name }, ...parts);
    if (one.causality === "input" && one.kind === "r") row.append(inputTable(one, this.state, row));
    entry.field.setAttribute("aria-describedby", [about?.id, error.id].filter(Boolean).join(" "));
    this.controls.set(one.name, { one, row, error, reset, ...entry });
    return row;
  }

  box(one, id) {
    const field = make("input", { type: "checkbox", id });
    field.addEventListener("change", () => this.state.set(one.name, Number(field.checked), field));
    return { line: [field], below: [], field, show: (value) => (field.checked = Boolean(value)) };
  }

  list(one, id) {
    const options = one.literals.map(([value, name]) => make("option", { value }, name));
    const field = make("select", { id }, ...options);
    field.addEventListener("change", () => this.state.set(one.name, Number(field.value), field));
    return { line: [field], below: [], field, show: (value) => (field.value = String(value)) };
  }

  number(one, id) {
    const field = make("input", { type: "text", inputmode: "decimal", id, autocomplete: "off", class: "number" });
    const unit = make("span", { class: "unit" }, shownUnit(one));
    const range = { type: "range", min: 0, max: STEPS, step: 1, "aria-label": one.name };
    const slider = make("input", range);
    slider.addEventListener("input", () => {
      const value = fromSlider(one, Number(slider.value));
      this.typed(one, null);
      this.state.set(one.name, value, slider);
    });
    field.addEventListener("input", () => {
      const value = parsed(field.value);
      this.typed(one, Number.isFinite(value) ? null : "Type a number, such as 0.5 or 1e-3.");
      if (Number.isFinite(value)) this.state.set(one.name, fromShown(one, value), field);
    });
    field.addEventListener("change", () => {
      this.typed(one, null); // the field shows the value again
      this.refresh();
    });
    const show = (value, origin) => {
      if (origin !== field) field.value = fieldText(toShown(one, value));
      if (origin !== slider) slider.value = String(toSlider(one, value));
      put(slider, "aria-valuetext", valueText(one, value));
    };
    return { line: [field, unit], below: [slider], field, slider, show };
  }

  // Shows the values of the state, except in the element in which the user is at work. Such an element changes the value
  // of its own control only: a large model has hundreds.
  refresh(origin = null) {
    for (const [name, control] of this.controls) {
      if (origin instanceof Element && !control.row.contains(origin)) continue;
      if (typeof origin === "string") this.typed(control.one, null); // all values are new
      control.show(this.state.value(name), origin);
      const changed = this.state.isChanged(name);
      control.row.classList.toggle("changed", changed);
      control.reset.disabled = !changed;
      control.row.dispatchEvent(new CustomEvent("refresh", { detail: origin }));
    }
    for (const { count, names } of this.groups) {
      const changed = names.filter((name) => this.state.isChanged(name)).length;
      write(count, changed ? `${changed} changed` : "");
    }
  }

  typed(one, message) {
    this.controls.get(one.name).mistake = message;
    this.showError(one.name, message);
  }

  // The messages of the model at the values that they name; returns whether there was one.
  showErrors(message) {
    let found = false;
    for (const [name, control] of this.controls) {
      const named = names(message, name);
      found ||= named;
      this.showError(name, control.mistake ?? (named ? message : null));
    }
    return found;
  }

  showError(name, message) {
    const { error, field, details } = this.controls.get(name);
    write(error, message ?? "");
    error.hidden = !message;
    put(field, "aria-invalid", Boolean(message));
    if (message && details) details.open = true;
  }
}

// "theta_start" in quotation marks, or as the subject: "Model.theta_start must be ...", "... must not be ...".
function names(message, name) {
  return (
    message.includes(`"${name}"`) ||
    ` ${message}`.split(" must ").some((part) => /[\s.]/.test(part.at(-name.length - 1) ?? "") && part.endsWith(name))
  );
}

function toSlider(one, value) {
  const { minimum, maximum, scale } = one.range;
  const part =
    scale === "log" ? Math.log(value / minimum) / Math.log(maximum / minimum) : (value - minimum) / (maximum - minimum);
  return Math.round(STEPS * Math.min(1, Math.max(0, Number.isFinite(part) ? part : 0)));
}

function fromSlider(one, position) {
  const { minimum, maximum, scale } = one.range;
  const part = position / STEPS;
  if (part === 0 || part === 1) return part ? maximum : minimum;
  const value = scale === "log" ? minimum * (maximum / minimum) ** part : minimum + part * (maximum - minimum);
  if (one.kind === "i") return Math.round(value);
  // Digits of what is shown, but no more than tell neighbors apart.
  const shown = toShown(one, value);
  const digits = scale === "log" ? 3 : Math.max(1, Math.ceil(Math.log10(Math.abs(shown / step(one))) + 1));
  return fromShown(one, rounded(shown, Math.min(6, Number.isFinite(digits) ? digits : 3)));
}

function step(one) {
  return Math.abs(toShown(one, one.range.maximum) - toShown(one, one.range.minimum)) / STEPS;
}
