// The model at work while a hand holds the handle: for each picture the model goes on by the time that has passed, with
// the wanted angle straight from where the hand was to where it is. A frame asks for few rows, and waits for those of
// the frame before: a slow machine falls behind the clock, and nothing piles up.

import { byName } from "./page-data.js";
import { Recording } from "./recording.js";
import { followed, runRequest, sampled } from "./request.js";

const SHORTEST_STEP = 1e-3; // s, between two rows
const LONGEST_FRAME = 0.05; // s
const KEPT = 4; // s
const FOREVER = 3600; // s
const STILL = matchMedia("(prefers-reduced-motion: reduce)"); // then the handle does not swing before one's eyes

export class Session {
  static count = 0;

  constructor(app, hand, names) {
    Object.assign(this, { app, hand, names });
    this.id = ++Session.count;
    this.step = Math.max(SHORTEST_STEP, app.state.experiment.step);
    this.time = app.state.experiment.start;
    this.rest = app.state.experiment.stop - this.time; // how long it goes on without the hand
    this.recording = new Recording(names, this.time, this.step, Math.ceil(KEPT / this.step));
    this.isWaiting = true;
    this.letGoAt = null;
  }

  // From rest at the angle that is shown.
  begin(angle) {
    const { app } = this;
    app.session = this;
    const request = runRequest(app.state, this.names);
    const given = { theta_start: angle, omega_start: 0, theta_ref: angle, omega_ref: 0, grip: 1 };
    for (const [name, value] of Object.entries(given)) {
      request.reals.references.push(byName.get(name).reference);
      request.reals.values.push(value);
    }
    const inputs = { references: [], rows: 0, values: [], slopes: [] };
    this.recording.starts = request.starts;
    Object.assign(request, { session: this.id, rows: 1, step: this.step, stop: this.time + FOREVER, inputs });
    app.simulation.run(request);
    this.last = performance.now();
    requestAnimationFrame((now) => this.frame(now));
  }

  frame(now) {
    if (this.app.session !== this) return;
    if (!this.isWaiting) this.advance(now);
    requestAnimationFrame((later) => this.frame(later));
  }

  // Whole rows; what is left of the time counts in the next frame.
  advance(now) {
    const { step } = this;
    if (this.letGoAt !== null && STILL.matches) {
      const left = Math.round((this.letGoAt + this.rest - this.time) / step);
      this.go(Math.max(1, Math.min(left, this.recording.most)));
      return;
    }
    const seconds = Math.min(LONGEST_FRAME, (now - this.last) / 1000);
    const rows = Math.floor(seconds / step);
    if (rows < 1) return;
    this.last = now - (seconds - rows * step) * 1000;
    this.go(rows);
  }

  go(rows) {
    const { app, hand, step, time } = this;
    const end = time + rows * step;
    const [from, to] = hand.isHolding ? hand.advance(rows * step) : [hand.wanted, hand.wanted];
    const path = {
      theta_ref: [
        [time, from],
        [end, to],
      ],
      omega_ref: [[time, (to - from) / (rows * step)]],
      grip: [[time, Number(hand.isHolding)]],
    };
    const tables = new Map([
      ...followed(app.state),
      ...Object.entries(path).map(([name, points]) => [name, [byName.get(name), points]]),
    ]);
    const columns = this.names.map((name) => byName.get(name));
    this.isWaiting = true;
    app.simulation.run({
      session: this.id,
      continues: true,
      names: this.names,
      references: columns.map((one) => one.reference),
      kinds: columns.map((one) => one.kind).join(""),
      start: time,
      step,
      rows: rows + 1,
      inputs: sampled([...tables.values()], time, step, rows + 1),
    });
  }

  // The first row of a frame is the last one of the frame before.
  received(result, request) {
    this.isWaiting = false;
    const width = this.names.length;
    this.recording.append(request.continues ? result.table.subarray(width) : result.table);
    this.time = request.start + Math.max(0, result.rows - 1) * this.step;
    const isWhole = result.rows === request.rows;
    const isOver = !isWhole || (this.letGoAt !== null && this.time >= this.letGoAt + this.rest - 1e-9);
    if (result.rows > 0) this.app.show(this.recording.run, this.time);
    this.app.draw();
    if (isOver) this.end();
    if (!isWhole) this.app.explain(result, request);
  }

  // Nothing draws on the handle any more: it swings as long as a run takes, or until it is taken again.
  letGo() {
    this.letGoAt = this.time;
  }

  takeAgain() {
    this.letGoAt = null;
  }

  end() {
    if (this.app.session !== this) return;
    this.app.session = null;
    this.hand.drop();
    const { rows } = this.recording;
    if (rows > 0)
      this.app.footer.textContent = `Moved by hand for ${this.time.toFixed(2)} s; the last ${rows} rows are shown`;
  }
}
