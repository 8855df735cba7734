// The numbers behind the plots, as a table: every so many rows, all of them in the CSV file.

import { make } from "./elements.js";
import { numberText, shownUnit } from "./format.js";
import { byName } from "./page-data.js";

const MOST = 150;

export class ValueTable {
  constructor() {
    this.caption = make("caption");
    this.head = make("thead");
    this.body = make("tbody");
    const table = make("table", {}, this.caption, this.head, this.body);
    const frame = make("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Table of values" }, table);
    this.element = make("details", { class: "values" }, make("summary", {}, "Values as a table"), frame);
    this.element.addEventListener("toggle", () => this.fill());
  }

  show(run, names) {
    this.run = run;
    this.names = names;
    this.fill();
  }

  fill() {
    if (!this.element.open || !this.run) return;
    const { run } = this;
    const every = Math.ceil(run.rows / MOST);
    const columns = this.names.map((name) => byName.get(name));
    const heads = [{ name: "time", unit: "s" }, ...columns].map((one) =>
      make("th", { scope: "col" }, one.name, make("small", {}, shownUnit(one))),
    );
    this.head.replaceChildren(make("tr", {}, ...heads));
    const shown = columns.map((one) => run.shown(one));
    const rows = [];
    for (let row = 0; row < run.rows; row += every) {
      const cells = shown.map((values) => make("td", {}, numberText(values[row], 6)));
      rows.push(make("tr", {}, make("th", { scope: "row" }, numberText(run.times[row], 6)), ...cells));
    }
    this.body.replaceChildren(...rows);
    this.caption.textContent = every > 1 ? `Every ${every} rows of ${run.rows}; the CSV file has all.` : "";
  }
}
