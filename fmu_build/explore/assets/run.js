// The result of a run: rows of numbers by the names that were asked for.

// Loops, because Float64Array.from with a function takes many times as long, and a page draws while a slider moves.

export function timesOf({ start, step }, rows) {
  const times = new Float64Array(rows);
  for (let row = 0; row < rows; row++) times[row] = start + row * step;
  return times;
}

export function columnOf(table, width, column) {
  const values = new Float64Array(table.length / width);
  for (let row = 0, at = column; row < values.length; row++, at += width) values[row] = table[at];
  return values;
}

export class Run {
  constructor(request, result) {
    this.names = request?.names ?? [];
    this.rows = result.rows;
    this.table = result.table;
    this.span = request ? request.step * (request.rows - 1) : 1;
    this.times = timesOf(request, this.rows);
    this.isWhole = Boolean(request) && this.rows === request.rows;
    this.milliseconds = result.milliseconds;
    this.starts = request?.starts ?? new Map();
    this.cache = new Map();
  }

  has(name) {
    return name === "time" || this.names.includes(name);
  }

  // A column in the unit of the variable.
  column(name) {
    if (name === "time") return this.times;
    return columnOf(this.table, this.names.length, this.names.indexOf(name));
  }

  value(name, row) {
    return this.table[row * this.names.length + this.names.indexOf(name)];
  }

  // A column in the display unit.
  shown(one) {
    if (!this.cache.has(one.name)) {
      const values = one.name === "time" ? this.times.slice() : this.column(one.name);
      const { factor = 1, offset = 0 } = one;
      for (let row = 0; row < values.length; row++) values[row] = values[row] * factor + offset;
      this.cache.set(one.name, values);
    }
    return this.cache.get(one.name);
  }

  rowAt(time) {
    if (this.rows < 2) return 0;
    const part = (time - this.times[0]) / (this.times[1] - this.times[0]);
    return Math.min(this.rows - 1, Math.max(0, Math.round(part)));
  }
}
