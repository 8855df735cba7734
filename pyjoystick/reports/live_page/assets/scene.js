// The joystick to scale: the whole of it, and its mechanism enlarged. Every position is one of the model or a
// parameter; only lengths that the model does not have (of springs, rods, the plate) are the drawing's own.

import { Actuator, SIDES, SPRINGS } from "./actuator.js";
import { make, makeSvg, put, write } from "./elements.js";
import { numberText } from "./format.js";
import { parameterOf } from "./request.js";
import { stopOf } from "./stop.js";

const MM = 1000;
const DEGREES = 180 / Math.PI;
const HINT = "Drag the handle and let it go. Keyboard: arrow keys move it, Enter lets it go.";

export class Scene {
  constructor({ top, stop }) {
    this.top = top * MM;
    this.stop = stop;
    this.released = stop; // by the presets, whatever the model's stops
    // Without tabindex it could be reached by Tab, because it listens to its handle losing the focus.
    const whole = { class: "whole", role: "group", "aria-label": "The joystick to scale", tabindex: -1 };
    this.whole = makeSvg("svg", whole);
    this.detail = makeSvg("svg", {
      class: "detail",
      role: "img",
      "aria-label": "Cam plate, plungers and springs to scale",
    });
    this.angle = make("span", { class: "angle" });
    this.torque = make("span", { class: "torque" });
    this.theta = 0;
    this.states = new Map(SPRINGS.map((name) => [name, make("span", { class: "state" })]));
    const list = [...this.states].map(([name, state]) => make("li", {}, words(name), state));
    const caption = make("figcaption", {}, make("strong", {}, "Mechanism"), this.angle, this.torque);
    const hint = make("p", { class: "hint", id: "handle-hint" }, HINT);
    const drawings = make("div", { class: "drawings" }, this.whole, this.detail);
    this.element = make(
      "figure",
      { class: "panel scene" },
      caption,
      drawings,
      make("ul", { class: "springs" }, ...list),
      hint,
    );
  }

  get names() {
    const ends = ["delta", "isEngaged", "isReleased"]; // by type: a run reads neighbors of one type by one call
    return [
      "theta",
      "x",
      "f_x",
      "theta_ref",
      "grip",
      "T_hand",
      ...ends.flatMap((end) => SPRINGS.map((name) => `${name}.${end}`)),
    ];
  }

  show(run, row) {
    if (run.rows === 0 || !run.has("x")) return;
    const value = (name) => run.value(name, row);
    const lengths = ["a", "b", "h", ...SPRINGS.map((name) => `${name}.x_0`)].map((name) => parameterOf(run, name));
    const sizes = JSON.stringify([stopOf(run), ...lengths]);
    if (sizes !== this.sizes) this.build(run);
    this.sizes = sizes;
    const theta = value("theta");
    this.theta = theta;
    const turned = `rotate(${(theta * DEGREES).toFixed(4)})`;
    put(this.handle, "transform", turned);
    put(this.plate, "transform", turned);
    for (const side of SIDES) {
      const isActive = side === "forward" ? theta > 0 : theta < 0;
      this.actuators[side].show(isActive ? value("x") * MM : 0, isActive ? value("f_x") : 0, value);
    }
    this.showHand(theta, value);
    for (const [name, place] of this.states) {
      const kind = value(`${name}.isReleased`) ? "released" : value(`${name}.isEngaged`) ? "held" : "free";
      if (kind === "released" && !place.classList.contains(kind)) this.onRelease?.();
      put(place, "class", `state ${kind}`);
      write(place, kind === "free" ? "lifted off" : kind === "held" ? "restrained" : "released");
    }
  }

  // Where the hand wants the handle, and its torque; the handle as a slider says the same.
  showHand(theta, value) {
    const isHeld = value("grip") > 0;
    const angle = `${numberText(theta * DEGREES, 4)}°`;
    const torque = isHeld ? `hand ${numberText(value("T_hand"), 3)} N m` : "";
    write(this.angle, angle);
    write(this.torque, torque);
    put(this.wanted, "transform", `rotate(${(value("theta_ref") * DEGREES).toFixed(4)})`);
    put(this.wanted, "visibility", isHeld ? "visible" : "hidden");
    put(this.handle, "aria-valuenow", (theta * DEGREES).toFixed(2));
    put(this.handle, "aria-valuetext", isHeld ? `${angle}, ${torque}` : angle);
  }

  // Anew where a length or the stop has changed.
  build(run) {
    const [a, b, h] = ["a", "b", "h"].map((name) => parameterOf(run, name) * MM);
    this.stop = stopOf(run);
    this.buildWhole(a, b, h);
    this.buildDetail(a, b, run);
  }

  buildWhole(a, b, h) {
    const top = Math.max(this.top, 1.2 * h);
    const reach = top * Math.sin(Math.max(this.stop, this.released)) + 0.12 * top;
    this.whole.setAttribute("viewBox", `${-reach} ${-1.08 * top} ${2 * reach} ${1.2 * top}`);
    const grip = 0.045 * top;
    const outline = [
      [-0.4 * grip, -b],
      [-0.4 * grip, -0.45 * top],
      [-grip, -0.55 * top],
      [-grip, -0.96 * top],
      [-0.5 * grip, -top],
      [0.5 * grip, -top],
      [grip, -0.96 * top],
      [grip, -0.55 * top],
      [0.4 * grip, -0.45 * top],
      [0.4 * grip, -b],
    ]; // prettier-ignore
    const limits = [-1, 1].map((side) =>
      makeSvg("line", { class: "guide", x2: side * top * Math.sin(this.stop), y2: -top * Math.cos(this.stop) }),
    );
    this.handle = makeSvg(
      "g",
      this.asSlider(),
      makeSvg("line", { class: "reach", y1: -0.2 * top, y2: -top }),
      makeSvg("rect", { class: "part", x: -1.35 * a, y: -b - 0.13 * a, width: 2.7 * a, height: 0.13 * a }),
      makeSvg("polygon", { class: "part", points: outline.join(" ") }),
      makeSvg("circle", { class: "mass", cy: -h, r: 0.018 * top }),
    );
    const middle = makeSvg("line", { class: "guide", y2: -top });
    this.wanted = makeSvg(
      "g",
      { class: "wanted" },
      makeSvg("line", { y1: -0.5 * top, y2: -0.8 * top }),
      makeSvg("circle", { cy: -0.8 * top, r: 0.03 * top }),
    );
    const pivot = makeSvg("circle", { class: "pivot", r: 0.014 * top });
    this.whole.replaceChildren(middle, ...limits, this.handle, this.wanted, pivot);
  }

  asSlider() {
    const end = (this.stop * DEGREES).toFixed(1);
    return {
      class: "handle",
      role: "slider",
      tabindex: 0,
      "aria-label": "Handle",
      "aria-describedby": "handle-hint",
      "aria-valuemin": -end,
      "aria-valuemax": end,
    };
  }

  buildDetail(a, b, run) {
    const unit = a / 24; // the drawing's own lengths, in proportion to the paper's joystick
    const plate = 3 * unit;
    const half = a + 15 * unit;
    this.detail.setAttribute("viewBox", `${-half} ${-b - 20 * unit} ${2 * half} ${76 * unit}`);
    this.plate = makeSvg(
      "g",
      {},
      makeSvg("rect", { class: "part", x: -3 * unit, y: -b - 40 * unit, width: 6 * unit, height: 38 * unit }),
      makeSvg("rect", { class: "part", x: -1.35 * a, y: -b - plate, width: 2.7 * a, height: plate }),
      makeSvg("line", { class: "guide", y1: 0, y2: -b }),
    );
    this.actuators = Object.fromEntries(SIDES.map((side) => [side, new Actuator(side, a, b, unit, run)]));
    const parts = SIDES.map((side) => this.actuators[side].element);
    const pivot = makeSvg("circle", { class: "pivot", r: 1.1 * unit });
    const support = makeSvg("path", { class: "guide", d: `M 0 0 L ${-4 * unit} ${9 * unit} H ${4 * unit} Z` });
    this.detail.replaceChildren(
      support,
      ...parts,
      this.plate,
      pivot,
      ...SIDES.map((side) => this.actuators[side].force),
    );
  }
}

function words(name) {
  const [side, spring] = name.split(".");
  return `${side} ${spring.replace("Spring", "")} `;
}
