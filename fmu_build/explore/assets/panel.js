// A plot with its legend, in which the values at the cursor stand.

import { make, put, write } from "./elements.js";
import { extentOf } from "./extent.js";
import { numberText, shownUnit } from "./format.js";
import { byName } from "./page-data.js";
import { Surface } from "./surface.js";

const TIME = { name: "time", unit: "s", text: "Time" };

export class Panel {
  constructor(choice, onCursor, onChange) {
    this.choice = choice;
    this.x = choice.x ? byName.get(choice.x) : TIME;
    this.ys = choice.y.map((name) => byName.get(name));
    this.isOverTime = !choice.x;
    this.surface = new Surface(onChange);
    this.canvas = this.surface.canvas;
    this.values = this.ys.map(() => make("span", { class: "value" }));
    const entries = this.ys.map((one, i) =>
      make("span", { class: `entry c${i % 6}`, title: one.text ?? "" }, make("i"), one.name, " ", this.values[i]),
    );
    const over = this.isOverTime ? null : make("span", { class: "over" }, `over ${this.x.name}`);
    this.legend = make("figcaption", {}, ...entries, over);
    this.element = make("figure", { class: "panel plot" }, this.legend, this.canvas);
    if (this.isOverTime) this.canvas.addEventListener("pointermove", (event) => this.pointed(event, onCursor));
  }

  get names() {
    return [...(this.choice.x ? [this.choice.x] : []), ...this.choice.y];
  }

  pointed(event, onCursor) {
    if (!this.surface.scale) return;
    const { box, xEnds } = this.surface.scale;
    const part = (event.offsetX - box.left) / box.width;
    onCursor(xEnds[0] + Math.min(1, Math.max(0, part)) * (xEnds[1] - xEnds[0]));
  }

  // What is drawn: a run, the kept run behind it, and points at the row of the cursor.
  content(run, kept, row, theme, more) {
    const curves = [];
    for (const [source, look] of [
      [kept, { alpha: 0.75, dash: [5, 4], width: 1.25 }],
      [run, {}],
    ]) {
      if (!source || !this.names.every((name) => source.has(name))) continue;
      const x = source.shown(this.x);
      for (const [i, one] of this.ys.entries()) {
        curves.push({ x, y: source.shown(one), color: theme.colors[i % 6], ...look });
      }
    }
    const xRange = this.isOverTime && run.rows > 1 ? [run.times[0], run.times[0] + run.span] : undefined;
    const xLabel = this.isOverTime ? "s" : label(this.x);
    const at = run.rows ? run.shown(this.x)[row] : undefined;
    const points = run.rows
      ? this.ys.map((one, i) => ({ x: at, y: run.shown(one)[row], color: theme.colors[i % 6] }))
      : [];
    curves.push(...more);
    return { curves, xRange, xLabel, points, cursor: this.isOverTime ? at : undefined };
  }

  draw(run, kept, row, theme, more) {
    this.surface.draw(this.content(run, kept, row, theme, more), theme);
  }

  // The values at the cursor.
  tell(run, row) {
    this.ys.forEach((one, i) => {
      const text = run.rows ? numberText(run.shown(one)[row], 4) : "–";
      write(this.values[i], `${text} ${shownUnit(one)}`);
    });
  }

  labels(theme) {
    return this.ys.map((one, i) => ({
      text: this.isOverTime ? label(one) : `${label(one)} over ${label(this.x)}`,
      color: theme.colors[i % 6],
    }));
  }

  // In words, for those who do not see the curves.
  describe(run) {
    const parts = this.ys.map((one) => {
      const ends = extentOf(run.shown(one));
      return `${one.name} from ${numberText(ends[0])} to ${numberText(ends[1])} ${shownUnit(one)}`.trim();
    });
    put(this.canvas, "aria-label", `${parts.join("; ")}; over ${this.x.name}`);
  }
}

export function label(one) {
  const unit = shownUnit(one);
  return unit ? `${one.name} (${unit})` : one.name;
}
