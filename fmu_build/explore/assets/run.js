// The result of a run: rows of numbers by the names that were asked for.

import { toShown } from "./format.js";

export class Run {
  constructor(request, result) {
    this.names = request?.names ?? [];
    this.rows = result.rows;
    this.table = result.table;
    this.span = request ? request.step * (request.rows - 1) : 1;
    this.times = Float64Array.from({ length: this.rows }, (_, i) => request.start + i * request.step);
    this.isWhole = Boolean(request) && this.rows === request.rows;
    this.milliseconds = result.milliseconds;
    this.cache = new Map();
  }

  has(name) {
    return name === "time" || this.names.includes(name);
  }

  // A column in the unit of the variable.
  column(name) {
    if (name === "time") return this.times;
    const [width, column] = [this.names.length, this.names.indexOf(name)];
    return Float64Array.from({ length: this.rows }, (_, row) => this.table[row * width + column]);
  }

  value(name, row) {
    return this.table[row * this.names.length + this.names.indexOf(name)];
  }

  // A column in the display unit.
  shown(one) {
    if (!this.cache.has(one.name))
      this.cache.set(
        one.name,
        this.column(one.name).map((value) => toShown(one, value)),
      );
    return this.cache.get(one.name);
  }

  rowAt(time) {
    if (this.rows < 2) return 0;
    const part = (time - this.times[0]) / (this.times[1] - this.times[0]);
    return Math.min(this.rows - 1, Math.max(0, Math.round(part)));
  }
}
