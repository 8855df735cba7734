// All plots, their colors, and the choice of what is plotted.

import { make } from "./elements.js";
import { page } from "./page-data.js";
import { Panel } from "./panel.js";

export class Plots {
  constructor(app) {
    this.app = app;
    this.element = make("div", { class: "panels", role: "region", "aria-label": "Plots", tabindex: 0 });
    this.chooser = this.makeChooser();
    this.choose(app.state.plots);
    this.readTheme();
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.readTheme());
    matchMedia("print").addEventListener("change", () => {
      this.readTheme();
      app.settle(); // at once: paper does not wait for the next picture
    });
  }

  get names() {
    return this.panels.flatMap((panel) => panel.names);
  }

  choose(choices) {
    const text = JSON.stringify(choices);
    if (text === this.chosen) return;
    this.chosen = text;
    for (const panel of this.panels ?? []) panel.element.remove();
    this.panels = choices.map(
      (choice) =>
        new Panel(
          choice,
          (time) => this.app.playback.goTo(time),
          () => this.app.draw(),
        ),
    );
    this.panels.forEach((panel, i) => {
      const remove = () => this.app.state.setPlots(choices.filter((_, other) => other !== i));
      const name = `Remove the plot of ${panel.choice.y.join(", ")}`;
      panel.legend.append(
        make("button", { type: "button", class: "remove", "aria-label": name, title: name, onclick: remove }, "×"),
      );
    });
    this.element.append(...this.panels.map((panel) => panel.element));
  }

  makeChooser() {
    const moving = page.variables.filter((one) => !one.causality.endsWith("arameter"));
    const options = () => moving.map((one) => make("option", { value: one.name }, one.name));
    const y = make("select", { id: "plot-y" }, ...options());
    const x = make("select", { id: "plot-x" }, make("option", { value: "" }, "time"), ...options());
    const add = () => {
      const choice = { y: [y.value], x: x.value || null };
      this.app.state.setPlots([...this.app.state.plots, choice]);
    };
    return make(
      "div",
      { class: "chooser" },
      make("label", { for: "plot-y" }, "Plot"),
      y,
      make("label", { for: "plot-x" }, "over"),
      x,
      make("button", { type: "button", onclick: add }, "Add plot"),
    );
  }

  readTheme() {
    const style = getComputedStyle(document.documentElement);
    const color = (name) => style.getPropertyValue(`--${name}`).trim();
    this.theme = {
      colors: [0, 1, 2, 3, 4, 5].map((i) => color(`c${i}`)),
      grid: color("grid"),
      axis: color("axis"),
      muted: color("muted"),
      ground: color("card"),
      text: color("text"),
      font: "11px system-ui, sans-serif",
    };
    this.app.draw();
  }

  // Those in view, or all.
  draw(run, kept, row, isWhole) {
    for (const panel of this.panelsOf(run)) {
      if (isWhole || panel.surface.isInView)
        panel.draw(run, kept, row, this.theme, this.app.addition.curves?.(panel, this.theme, run) ?? []);
    }
  }

  tell(run, row) {
    for (const panel of this.panelsOf(run)) panel.tell(run, row);
  }

  describe(run) {
    for (const panel of this.panelsOf(run)) panel.describe(run);
  }

  // A new plot waits for the run with its variables.
  panelsOf(run) {
    return this.panels.filter((panel) => panel.names.every((name) => run.has(name)));
  }
}
