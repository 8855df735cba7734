// Measured records over the simulated motion: samples as dots, and the difference between both.

import { make, write } from "./elements.js";
import { MOST_ROWS } from "./experiment.js";
import { ExtraPlot } from "./extra-plot.js";
import { numberText } from "./format.js";

const DEGREES = 180 / Math.PI;
const KEY = "@record"; // in the address

export class Records {
  constructor(records) {
    this.records = records;
    this.chosen = null;
  }

  get isEmpty() {
    return this.records.length === 0;
  }

  get plots() {
    return this.chosen ? [this.plot] : [];
  }

  mount(app) {
    this.app = app;
    const options = this.records.map((record, i) => make("option", { value: i }, record.name));
    this.select = make("select", { id: "record" }, make("option", { value: "" }, "none"), ...options);
    this.select.addEventListener("change", () => this.choose(this.select.value));
    this.text = make("span", { class: "difference" });
    const start = make("button", { type: "button", onclick: () => this.release() }, "Release from its angle");
    const box = make(
      "div",
      { class: "record" },
      make("label", { for: "record" }, "Record"),
      this.select,
      start,
      this.text,
    );
    app.controlsPlace.prepend(box);
    const entries = { 1: "simulated − measured theta" };
    this.plot = new ExtraPlot("difference", "difference", entries, () => app.draw());
    app.state.watch((origin) => origin === "address" && this.read());
    if (!app.state.hasLink) {
      this.choose("0");
      this.release();
    } else this.read();
  }

  // The record of the address: by its name, the first one where none is named, "" for none.
  read() {
    const name = this.app.state.extra(KEY);
    const index = this.records.findIndex((record) => record.name === name);
    this.choose(index >= 0 ? String(index) : name === "" ? "" : "0");
  }

  choose(index) {
    this.select.value = index;
    this.chosen = index === "" ? null : this.records[Number(index)];
    this.dots = this.chosen?.theta.map((angle) => angle * DEGREES);
    this.plot.element.hidden = !this.chosen;
    if (!this.chosen) this.text.textContent = "";
    this.app.state.setExtra(KEY, index === "0" ? null : (this.chosen?.name ?? ""));
    this.app.draw();
  }

  // The run starts where the record does and is as long.
  release() {
    if (!this.chosen) return;
    const { time, start } = this.chosen;
    const { experiment } = this.app.state;
    const length = time[time.length - 1];
    const step = Math.max(experiment.step, length / MOST_ROWS);
    const steps = Math.ceil(length / step - 1e-6); // to the last sample
    this.app.state.setExperiment({ stop: experiment.start + steps * step, step }, "record");
    this.app.state.set("theta_start", start, "record");
  }

  curves(panel, theme) {
    if (!this.chosen || !panel.isOverTime || panel.choice.y[0] !== "theta") return [];
    return [{ x: this.chosen.time, y: this.dots, color: theme.text, dots: 2 }];
  }

  // The difference as a number, and as a curve in view or anyhow.
  show(run, theme, isWhole) {
    if (!this.chosen || run.rows < 2 || !run.has("theta")) return;
    const [x, y] = this.difference(run);
    const squares = y.reduce((sum, one) => sum + one * one, 0);
    const rms = Math.sqrt(squares / y.length);
    const largest = y.reduce((most, one) => Math.max(most, Math.abs(one)), 0);
    const { element } = this.plot;
    const first = this.app.plots.element.querySelector(".plot");
    if (first?.nextSibling !== element) this.app.plots.element.insertBefore(element, first?.nextSibling ?? null);
    write(this.text, `difference ${numberText(rms, 3)}° rms, ${numberText(largest, 3)}° at most`);
    if (!isWhole && !this.plot.surface.isInView) return;
    const curves = [{ x, y, color: theme.colors[1] }];
    const rows = x.map((time, i) => [time, y[i] / DEGREES]);
    this.plot.draw(
      { curves, xRange: [run.times[0], run.times[0] + run.span], xLabel: "s" },
      theme,
      { heads: ["time (s)", "simulated - measured theta (rad)"], rows },
      `Simulated minus measured angle over time: ${this.text.textContent}`,
    );
  }

  // At the samples within the run, straight between its rows (deg).
  difference(run) {
    const [theta, first, step] = [run.column("theta"), run.times[0], run.times[1] - run.times[0]];
    const [x, y] = [[], []];
    this.chosen.time.forEach((time, i) => {
      const place = (time - first) / step;
      const row = Math.min(run.rows - 2, Math.floor(place));
      if (place < 0 || place > run.rows - 1 + 1e-9) return;
      const simulated = theta[row] + (place - row) * (theta[row + 1] - theta[row]);
      x.push(time);
      y.push((simulated - this.chosen.theta[i]) * DEGREES);
    });
    return [x, y];
  }
}
