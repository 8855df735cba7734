// The last seconds of a session as a run, which plots and files take as any other.

import { Run } from "./run.js";

export class Recording {
  constructor(names, start, step, rows) {
    Object.assign(this, { names, start, step, most: rows });
    this.table = new Float64Array(2 * rows * names.length);
    this.first = 0; // row of the table where the recording begins
    this.rows = 0;
    this.starts = new Map();
    this.dropped = 0;
  }

  // Rows at the end; the oldest go where there are more than asked for.
  append(table) {
    const width = this.names.length;
    const added = table.length / width;
    const end = this.first + this.rows;
    if (end + added > 2 * this.most) {
      this.table.copyWithin(0, this.first * width, end * width);
      this.first = 0;
    }
    this.table.set(table, (this.first + this.rows) * width);
    this.rows += added;
    const excess = Math.max(0, this.rows - this.most);
    this.first += excess;
    this.rows -= excess;
    this.dropped += excess;
  }

  get run() {
    const { names, step, rows, first, starts } = this;
    const width = names.length;
    const request = { names, step, rows, starts, start: this.start + this.dropped * step };
    return new Run(request, { rows, table: this.table.subarray(first * width, (first + rows) * width) });
  }
}
