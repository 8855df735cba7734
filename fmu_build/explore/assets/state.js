// The values that the user has chosen. Only what differs from the start is kept, sent to the model and written
// to the address, so that a link is a state.

import { fault } from "./experiment.js";
import { byName, page } from "./page-data.js";

const EXPERIMENT = ["stop", "step"];

export class State {
  constructor(onChange) {
    this.watchers = [onChange];
    this.hasLink = location.hash !== "";
    this.read(location.hash);
    window.addEventListener("hashchange", () => {
      if (location.hash === this.written) return;
      this.read(location.hash);
      this.tell("address");
    });
  }

  clear() {
    this.values = new Map();
    this.tables = new Map(Object.entries(page.tables));
    this.experiment = { ...page.experiment };
    this.plots = page.plots;
  }

  value(name) {
    return this.values.get(name) ?? byName.get(name).start;
  }

  isChanged(name) {
    return this.values.has(name) || !sameTable(this.tables.get(name), page.tables[name]);
  }

  // A constant takes the place of a table.
  set(name, value, origin) {
    this.store(name, value);
    this.tables.delete(name);
    this.changed(origin);
  }

  // `null` for an input that is constant.
  setTable(name, table, origin) {
    if (table) this.tables.set(name, table);
    else this.tables.delete(name);
    this.changed(origin);
  }

  setExperiment(values, origin) {
    Object.assign(this.experiment, values);
    this.changed(origin);
  }

  // What an addition keeps in the address, under a key that begins with "@"; null: nothing.
  setExtra(key, text) {
    if (text === null) this.extras.delete(key);
    else this.extras.set(key, text);
    this.writeSoon();
  }

  extra(key) {
    return this.extras.get(key) ?? null;
  }

  setPlots(plots) {
    this.plots = plots;
    this.changed("plots");
  }

  reset(names = null) {
    if (!names) this.clear();
    for (const name of names ?? []) {
      this.values.delete(name);
      if (page.tables[name]) this.tables.set(name, page.tables[name]);
      else this.tables.delete(name);
    }
    this.changed("reset");
  }

  // The values of a preset; what is shown, and for how long, stays.
  apply(values) {
    const { experiment, plots } = this;
    this.clear();
    Object.assign(this, { experiment, plots });
    for (const [name, value] of Object.entries(values)) this.store(name, value);
    this.changed("preset");
  }

  // Values from outside the page; what they do not name stays.
  take(values) {
    const changed = Object.entries(values).filter(([name, value]) => this.value(name) !== value);
    if (changed.length === 0) return;
    for (const [name, value] of changed) {
      this.store(name, value);
      this.tables.delete(name);
    }
    this.changed("host");
  }

  store(name, value) {
    if (value === byName.get(name).start) this.values.delete(name);
    else this.values.set(name, value);
  }

  changed(origin) {
    this.writeSoon();
    this.tell(origin);
  }

  writeSoon() {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.write(), 200); // browsers refuse to be written to at every move
    document.body.dataset.address = "due";
  }

  watch(watcher) {
    this.watchers.push(watcher);
  }

  tell(origin) {
    for (const watcher of this.watchers) watcher(origin);
  }

  // #damping.C=0.05&T=table:0,0;0.1,1&stop=2: SI units, names as in the model, stop and step of the run.
  text() {
    const parts = new URLSearchParams();
    for (const [name, value] of this.values) parts.set(name, value);
    for (const one of page.variables.filter((one) => one.causality === "input")) {
      const table = this.tables.get(one.name);
      if (sameTable(table, page.tables[one.name])) continue;
      parts.set(`${one.name}:table`, table ? table.map((row) => row.join(",")).join(";") : "");
    }
    for (const key of EXPERIMENT) {
      if (this.experiment[key] !== page.experiment[key]) parts.set(`:${key}`, this.experiment[key]);
    }
    if (this.plots !== page.plots) parts.set(":plots", JSON.stringify(this.plots.map(({ y, x }) => [x, ...y])));
    for (const [key, text] of this.extras) parts.set(key, text);
    return parts.toString();
  }

  write() {
    clearTimeout(this.timer);
    const text = this.text();
    this.written = text ? `#${text}` : "";
    history.replaceState(null, "", text ? `#${text}` : location.pathname + location.search);
    this.written = location.hash;
    document.body.dataset.address = "written";
  }

  // What does not fit the model is left out: a link may come from another version.
  read(hash) {
    this.clear();
    this.extras = new Map();
    this.ignored = [];
    for (const [key, text] of new URLSearchParams(hash.slice(1))) {
      if (!this.readOne(key, text)) this.ignored.push(key);
    }
    if (fault(this.experiment)) {
      this.ignored.push(...EXPERIMENT.map((key) => `:${key}`));
      this.experiment = { ...page.experiment };
    }
    this.written = hash;
  }

  readOne(key, text) {
    const value = Number(text);
    if (byName.get(key)?.settable && text !== "" && Number.isFinite(value)) this.store(key, value);
    else if (EXPERIMENT.some((one) => key === `:${one}`) && value > 0) this.experiment[key.slice(1)] = value;
    else if (key.endsWith(":table") && byName.get(key.slice(0, -6))?.causality === "input") {
      const table = text === "" ? null : text.split(";").map((row) => row.split(",").map(Number));
      if (table && !table.every((row) => row.length === 2 && row.every(Number.isFinite))) return false;
      if (table?.some(([time], i) => i > 0 && time < table[i - 1][0])) return false;
      if (table) this.tables.set(key.slice(0, -6), table);
      else this.tables.delete(key.slice(0, -6));
    } else if (key === ":plots") return this.readPlots(text);
    else if (key.startsWith("@") && page.addition) this.extras.set(key, text);
    else return false;
    return true;
  }

  readPlots(text) {
    let lists = null;
    try {
      lists = JSON.parse(text);
    } catch {
      return false;
    }
    const isName = (name) => typeof name === "string" && byName.has(name);
    const isPlot = (list) => Array.isArray(list) && list.length > 1 && (list[0] === null || isName(list[0]));
    if (!Array.isArray(lists) || !lists.every((list) => isPlot(list) && list.slice(1).every(isName))) return false;
    this.plots = lists.map(([x, ...y]) => ({ x, y }));
    return true;
  }
}

function sameTable(one, other) {
  return JSON.stringify(one ?? null) === JSON.stringify(other ?? null);
}
