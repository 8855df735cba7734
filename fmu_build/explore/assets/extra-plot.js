// A plot of what is no variable of the model, such as a difference: curves that another package computes from runs,
// with the numbers behind them as a file.

import { make, put, save } from "./elements.js";
import { csvOf } from "./files.js";
import { Surface } from "./surface.js";

export class ExtraPlot {
  // Entries of the legend by the number of their color.
  constructor(kind, file, entries, onChange) {
    this.entries = entries;
    this.surface = new Surface(onChange);
    this.canvas = this.surface.canvas;
    this.table = { heads: [], rows: [] };
    const names = Object.entries(entries).map(([color, text]) =>
      make("span", { class: `entry c${color}` }, make("i"), text),
    );
    const write = () => save(`${file}.csv`, csvOf(this.table.heads, this.table.rows), "text/csv");
    const label = `${Object.values(entries).join(", ")} as a CSV file`;
    const button = make(
      "button",
      { type: "button", class: "numbers", "aria-label": label, title: label, onclick: write },
      "CSV",
    );
    this.element = make("figure", { class: `panel ${kind}`, hidden: true }, make("figcaption", {}, ...names, button));
    this.element.append(this.canvas);
  }

  labels(theme) {
    return Object.entries(this.entries).map(([color, text]) => ({ text, color: theme.colors[color] }));
  }

  // Curves of plot.js, the numbers behind them, and what they say in words.
  draw(content, theme, table, words) {
    this.table = table;
    put(this.canvas, "aria-label", words);
    this.surface.draw(content, theme);
  }
}
