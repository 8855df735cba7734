// A canvas for one plot. It knows its width, and whether it is in view, from observers: to ask while a picture is made
// would have the browser arrange the page twice.

import { make } from "./elements.js";
import { drawPlot, HEIGHT } from "./plot.js";

const NEAR = "200px"; // around the window: what is scrolled to is already drawn

export class Surface {
  // `onChange`: it has another width, or has come into view.
  constructor(onChange) {
    this.canvas = make("canvas", { role: "img" });
    this.width = 0;
    this.isInView = true;
    this.scale = null;
    new ResizeObserver(([{ contentRect }]) => {
      this.width = contentRect.width;
      onChange();
    }).observe(this.canvas);
    new IntersectionObserver(
      (entries) => {
        this.isInView = entries[entries.length - 1].isIntersecting;
        if (this.isInView) onChange();
      },
      { rootMargin: NEAR },
    ).observe(this.canvas);
  }

  // With the pixels of the screen.
  draw(content, theme) {
    const { canvas, width } = this;
    if (width === 0) return;
    const ratio = window.devicePixelRatio || 1;
    const [across, down] = [Math.round(width * ratio), Math.round(HEIGHT * ratio)];
    if (canvas.width !== across || canvas.height !== down) Object.assign(canvas, { width: across, height: down });
    const context = canvas.getContext("2d");
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, HEIGHT);
    this.scale = drawPlot(context, width, HEIGHT, content, theme);
  }
}
