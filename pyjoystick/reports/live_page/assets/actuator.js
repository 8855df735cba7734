// A plunger with two fingers over its restrained springs, below the cam plate. Lengths in millimeters; y points
// down. Clearances and displacements are to scale, too small to see though some of them are.

import { makeSvg, put } from "./elements.js";
import { parameterOf } from "./request.js";

export const SIDES = ["backward", "forward"];
export const SPRINGS = SIDES.flatMap((side) => ["return", "balance"].map((kind) => `${side}.${kind}Spring`));

const MM = 1000;
const FINGER = 13; // from the crossbar to the tip, in the drawing's unit; more than the largest travel
const LENGTH = 21; // of a spring at rest
const FORCE = 0.09; // length of the arrow for one newton

export class Actuator {
  constructor(side, a, b, unit, run) {
    this.x = side === "forward" ? a : -a;
    this.b = b;
    this.unit = unit;
    const rest = -b + 11 * unit; // of the crossbar's lower side
    this.springs = ["return", "balance"].map((kind, i) => {
      const name = `${side}.${kind}Spring`;
      const x = this.x + (i ? 1 : -1) * Math.sign(this.x) * -5 * unit;
      const top = rest + FINGER * unit + parameterOf(run, `${name}.x_0`) * MM;
      return new Spring(name, x, top, unit);
    });
    this.plunger = makeSvg("g", {}, makeSvg("path", { class: "part", d: this.outline(rest) }));
    this.element = makeSvg("g", {}, ...this.springs.map((spring) => spring.element), this.plunger);
    this.force = makeSvg("path", { class: "force" });
  }

  // Rounded tip, rod, crossbar, and the two fingers.
  outline(rest) {
    const { x, b, unit } = this;
    const [rod, finger, length] = [2 * unit, 1.6 * unit, FINGER * unit];
    const bar = rest - 2 * unit;
    const fingers = this.springs.map((spring) => spring.x).sort((one, other) => one - other);
    const lower = fingers
      .reverse()
      .map(
        (at) =>
          `V ${rest + length} H ${at - finger} V ${rest} H ${at === fingers[0] ? fingers[1] + finger : at - finger}`,
      )
      .join(" ");
    const right = fingers[0] + finger;
    return (
      `M ${x - rod} ${-b + rod} A ${rod} ${rod} 0 0 1 ${x + rod} ${-b + rod} V ${bar} H ${right} ${lower} ` +
      `V ${bar} H ${x - rod} Z`
    );
  }

  show(travel, force, value) {
    put(this.plunger, "transform", `translate(0 ${travel})`);
    for (const spring of this.springs) spring.show(value);
    const [tip, length, head] = [-this.b + travel, FORCE * force * this.unit, 1.3 * this.unit];
    const arrow = `M ${this.x} ${tip - length} V ${tip} M ${this.x - head} ${tip - head} L ${this.x} ${tip} l ${head} ${-head}`;
    put(this.force, "d", length > head ? arrow : "");
  }
}

class Spring {
  constructor(name, x, top, unit) {
    Object.assign(this, { name, x, top, unit, foot: top + LENGTH * unit });
    const wall = 4.3 * unit;
    const lip = 2.3 * unit;
    const ends = [-1, 1].map((s) => `M ${x + s * lip} ${top} H ${x + s * wall} V ${this.foot}`);
    const base = `M ${x - 5 * unit} ${this.foot} H ${x + 5 * unit}`;
    this.plate = makeSvg("rect", { class: "plate", x: x - 3.6 * unit, width: 7.2 * unit, height: 1.3 * unit });
    this.coil = makeSvg("path", { class: "coil" });
    const housing = makeSvg("path", { class: "housing", d: [...ends, base].join(" ") });
    this.element = makeSvg("g", {}, housing, this.coil, this.plate);
  }

  show(value) {
    const { x, unit, top, foot, name } = this;
    const kind = value(`${name}.isReleased`) ? "released" : value(`${name}.isEngaged`) ? "held" : "free";
    const y = top + Math.max(0, value(`${name}.delta`)) * MM;
    put(this.element, "class", `spring ${kind}`);
    put(this.plate, "y", y);
    const start = y + 1.3 * unit;
    const turns = 7;
    const points = Array.from({ length: 2 * turns }, (_, i) => {
      const part = (i + 0.5) / (2 * turns);
      return `L ${x + (i % 2 ? 3 : -3) * unit} ${(start + part * (foot - start)).toFixed(3)}`;
    });
    put(this.coil, "d", `M ${x} ${start} ${points.join(" ")} L ${x} ${foot}`);
  }
}
