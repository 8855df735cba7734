// Title, actions, presets, and the length of the run.

import { make } from "./elements.js";
import { fault } from "./experiment.js";
import { fieldText, parsed } from "./format.js";
import { page } from "./page-data.js";

export function header(actions) {
  const titles = make(
    "div",
    { class: "titles" },
    make("h1", {}, page.title),
    page.text ? make("p", {}, page.text) : null,
  );
  return [titles, make("div", { class: "actions", role: "group", "aria-label": "Actions" }, ...actions)];
}

export function presetBox(state) {
  if (page.presets.length === 0) return "";
  const buttons = page.presets.map(({ name, values }) =>
    make("button", { type: "button", onclick: () => state.apply(values) }, name),
  );
  return make("div", { class: "presets", role: "group", "aria-label": "Presets" }, ...buttons);
}

export function experimentBox(state) {
  const error = make("p", { class: "error", hidden: true, role: "alert" });
  const fields = { stop: field("stop", "Stop time"), step: field("step", "Step") };
  const say = (message) => {
    error.textContent = message;
    error.hidden = !message;
    for (const { input } of Object.values(fields)) input.setAttribute("aria-invalid", String(Boolean(message)));
  };
  // Both are judged together: a longer run may need the longer step that is typed next.
  const take = (input) => {
    const typed = { stop: parsed(fields.stop.input.value), step: parsed(fields.step.input.value) };
    const message = fault({ ...state.experiment, ...typed });
    say(message);
    if (!message) state.setExperiment(typed, input);
  };
  for (const [key, { input }] of Object.entries(fields)) {
    input.addEventListener("input", () => take(input));
    const show = () => (input.value = fieldText(state.experiment[key]));
    state.watch((origin) => {
      if (Object.values(fields).some((one) => one.input === origin)) return;
      if (typeof origin === "string") say("");
      if (error.hidden) show();
    });
    show();
  }
  return make("div", { class: "experiment" }, ...Object.values(fields).map((one) => one.element), error);
}

function field(key, text) {
  const id = `experiment-${key}`;
  const input = make("input", { type: "text", inputmode: "decimal", id, class: "number", autocomplete: "off" });
  const element = make("span", {}, make("label", { for: id }, text), input, make("span", { class: "unit" }, "s"));
  return { input, element };
}
