// The cursor: a time of the run, moved by hand or played at a chosen speed.

import { make, put, write } from "./elements.js";
import { numberText } from "./format.js";

const SPEEDS = [0.01, 0.05, 0.1, 0.25, 0.5, 1];

export class Playback {
  constructor(onMove) {
    this.onMove = onMove;
    this.time = 0;
    this.run = null;
    this.button = make("button", { type: "button", class: "play", "aria-label": "Play" }, "▶");
    this.slider = make("input", {
      type: "range",
      min: 0,
      max: 1000,
      value: 0,
      id: "cursor",
      "aria-label": "Time of the cursor",
    });
    this.text = make("span", { class: "time" });
    const options = SPEEDS.map((speed) => make("option", { value: speed, selected: speed === 0.25 }, `${speed}×`));
    this.speed = make("select", { "aria-label": "Speed" }, ...options);
    this.element = make("div", { class: "playback" }, this.button, this.slider, this.text, this.speed);
    this.button.addEventListener("click", () => (this.isPlaying ? this.pause() : this.play()));
    this.slider.addEventListener("input", () => this.goTo(this.start + (this.slider.value / 1000) * this.span));
  }

  get start() {
    return this.run?.times[0] ?? 0;
  }

  get span() {
    return this.run?.span ?? 1;
  }

  over(run, time) {
    this.run = run;
    this.goTo(Math.min(this.start + this.span, Math.max(this.start, time)));
  }

  goTo(time) {
    this.time = time;
    this.slider.value = String(Math.round((1000 * (time - this.start)) / this.span));
    const text = `${numberText(time, 4)} s`;
    put(this.slider, "aria-valuetext", text);
    write(this.text, `${time.toFixed(this.span < 10 ? 3 : 2)} s`);
    this.onMove(time);
  }

  play() {
    this.isPlaying = true;
    this.show("❚❚", "Pause");
    if (this.time >= this.start + this.span * 0.999) this.goTo(this.start);
    let last = performance.now();
    const frame = (now) => {
      if (!this.isPlaying) return;
      const time = this.time + (Math.max(0, now - last) / 1000) * Number(this.speed.value);
      last = now;
      this.goTo(Math.min(time, this.start + this.span));
      if (time >= this.start + this.span) this.pause();
      else requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
  }

  pause() {
    this.isPlaying = false;
    this.show("▶", "Play");
  }

  show(sign, label) {
    this.button.textContent = sign;
    this.button.setAttribute("aria-label", label);
  }
}
