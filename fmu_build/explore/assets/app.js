// The page: state -> request -> worker -> run -> plots, table, files. What another package adds takes part by
// the functions of its `addition`: names(), mount(app), curves(panel, theme), plots(), shown(run, row, theme, isWhole)
// for each picture, and rested() where nothing has changed for a while, all optional.

import { Controls } from "./controls.js";
import { make, save, write } from "./elements.js";
import { csvText, pngOf } from "./files.js";
import { numberText } from "./format.js";
import { experimentBox, header, presetBox } from "./header.js";
import { Host } from "./host.js";
import { module, page, workerSource } from "./page-data.js";
import { Playback } from "./playback.js";
import { Plots } from "./plots.js";
import { runRequest } from "./request.js";
import { Run } from "./run.js";
import { Simulation } from "./simulation.js";
import { State } from "./state.js";
import { ValueTable } from "./value-table.js";

const REST = 150; // milliseconds
const BUSY = "The model is computing. What is shown is an earlier run.";
const UNSAVED = "Nothing was saved: what is shown is an earlier run.";

export async function start(addition = {}) {
  const app = new App(addition);
  addition.mount?.(app);
  try {
    app.simulation = new Simulation(await module(), workerSource(), (...result) => app.received(...result));
    app.changed(null);
  } catch (error) {
    app.alert(`This browser cannot run the model: ${error.message}`);
  }
}

class App {
  constructor(addition) {
    this.addition = addition;
    this.run = new Run({ names: [], start: 0, step: 1, rows: 1 }, { rows: 0, table: new Float64Array(0) });
    this.kept = null;
    this.state = new State((origin) => this.changed(origin));
    const place = (id) => document.getElementById(id);
    this.playback = new Playback((time) => this.moved(time));
    this.plots = new Plots(this);
    this.view = place("view");
    this.view.append(this.playback.element, this.plots.element);
    this.table = new ValueTable();
    place("more").append(this.plots.chooser, this.table.element);
    this.controlsPlace = place("controls");
    this.controlsPlace.append(presetBox(this.state), experimentBox(this.state));
    this.controls = new Controls(this.controlsPlace, this.state);
    this.footer = make("p", { id: "status" });
    place("foot").append(this.footer);
    place("head").append(...header(this.actions()));
    this.note = make("p", { id: "note", role: "status", hidden: true });
    document.getElementById("alert").after(this.note);
    this.noteIgnored();
    this.host = new Host(this);
  }

  actions() {
    this.keep = make(
      "button",
      { type: "button", "aria-pressed": "false", onclick: () => this.toggleKept() },
      "Keep curves",
    );
    const file = (end) => `${page.model.split(".").pop()}.${end}`;
    return [
      make("button", { type: "button", onclick: () => this.state.reset() }, "Reset all"),
      this.keep,
      make("button", { type: "button", onclick: () => this.saveCsv(file("csv")) }, "CSV"),
      make("button", { type: "button", onclick: () => this.savePng(file("png")) }, "PNG"),
    ];
  }

  // What a link has and this model has not; it may come from another version.
  noteIgnored() {
    const ignored = this.state.ignored;
    this.note.textContent = ignored.length
      ? `The link has values that this model does not take: ${ignored.join(", ")}`
      : "";
    this.note.hidden = ignored.length === 0;
  }

  // The variables of the plots, each once.
  get shownNames() {
    return [...new Set(this.plots.names)].filter((name) => this.run.has(name));
  }

  // The variables of plots and additions, which a run computes.
  get names() {
    return [...new Set([...this.plots.names, ...(this.addition.names?.() ?? [])])];
  }

  saveCsv(name) {
    if (this.isCurrent()) save(name, csvText(this.run, this.shownNames), "text/csv");
  }

  // Whether the run that is shown has the chosen values; a file would say nothing of it.
  isCurrent() {
    if (!document.body.classList.contains("stale")) return true;
    this.alert(`${UNSAVED} ${this.reason}`);
    return false;
  }

  async savePng(name) {
    if (!this.isCurrent()) return;
    this.settle();
    const panels = [...this.plots.panels, ...(this.addition.plots?.() ?? [])].filter(
      (one) => one.canvas.clientWidth > 0,
    );
    if (panels.length > 0) save(name, await pngOf(page.title, panels, this.plots.theme));
  }

  // A changed value: shown at once, run as soon as the model is free. It ends a session.
  changed(origin) {
    this.session?.end();
    this.settleSoon();
    this.controls.refresh(origin);
    if (origin === "address") this.noteIgnored();
    if (origin === "plots" || origin === "address" || origin === "reset") this.plots.choose(this.state.plots);
    this.isBusy = Boolean(this.simulation);
    this.simulation?.run(runRequest(this.state, this.names));
  }

  // What stays of a session that has ended is of no use.
  received(result, request) {
    this.host.tellSoon();
    if (request?.session) {
      if (request.session === this.session?.id) this.session.received(result, request);
      return;
    }
    this.isBusy = this.simulation.isBusy;
    if (result.rows > 0) this.show(new Run(request, result));
    document.body.classList.toggle("stale", result.rows === 0);
    this.explain(result, request);
    this.drawResult();
  }

  show(run, time = this.playback.time) {
    this.run = run;
    this.playback.over(run, time);
  }

  explain(result, request) {
    const isWhole = request && result.rows === request.rows;
    const message = isWhole ? "" : result.message || "The model failed without a message.";
    this.controls.showErrors(message);
    const time =
      request && result.rows > 0 ? ` at ${numberText(request.start + (result.rows - 1) * request.step)} s` : "";
    this.reason = isWhole ? "" : `The run stopped${time} (${result.status}). ${message}`;
    this.alert(this.reason);
    if (result.rows > 0) write(this.footer, `${result.rows} rows in ${result.milliseconds.toFixed(1)} ms`);
    document.body.dataset.runs = Number(document.body.dataset.runs ?? 0) + 1;
  }

  // A run that takes long must not stand under the message of the one before.
  tellBusy() {
    if (!this.isBusy || this.run.rows === 0) return;
    document.body.classList.add("stale");
    this.controls.showErrors("");
    this.reason = "";
    this.alert(BUSY);
  }

  alert(message) {
    const place = document.getElementById("alert");
    write(place, message);
    place.hidden = message === "";
  }

  toggleKept() {
    this.session?.end(); // a session would go on to write into the rows that are kept
    this.kept = this.kept ? null : this.run;
    this.keep.setAttribute("aria-pressed", String(Boolean(this.kept)));
    this.draw();
  }

  moved() {
    this.draw();
  }

  // Once for everything that changes before the next picture.
  draw() {
    this.settleSoon();
    if (this.isDrawing) return;
    this.isDrawing = true;
    requestAnimationFrame(() => {
      this.isDrawing = false;
      this.drawNow(false);
    });
  }

  // At once, in the time that is left until the next picture; a second result before it waits for it.
  drawResult() {
    if (this.isDrawing) return;
    if (this.isDrawn) {
      this.draw();
      return;
    }
    this.isDrawn = true;
    requestAnimationFrame(() => {
      this.isDrawn = false;
    });
    this.settleSoon();
    this.drawNow(false);
  }

  // What is in view, or the whole page.
  drawNow(isWhole) {
    const row = this.run.rowAt(this.playback.time);
    this.plots.draw(this.run, this.kept, row, isWhole);
    this.addition.shown?.(this.run, row, this.plots.theme, isWhole);
    this.plots.tell(this.run, row);
  }

  settleSoon() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.settle(), REST);
  }

  // What would only hold up the pictures while a slider moves: plots out of view, words and tables.
  settle() {
    clearTimeout(this.timer);
    this.tellBusy();
    this.drawNow(true);
    this.plots.describe(this.run);
    this.table.show(this.run, this.shownNames);
    this.addition.rested?.();
    document.body.dataset.settled = document.body.dataset.runs ?? 0;
  }
}
