// Curves on a canvas: any x, sorted or not, so that time plots and phase planes are one thing; PNG files are the
// same pixels.

import { extentOf } from "./extent.js";
import { trace } from "./polyline.js";

export const HEIGHT = 210;

const LEFT = 58;
const BOTTOM = 30;
const TOP = 8;
const RIGHT = 12;

// A plot's content: { x, y: [{ values, color, dash, width, dots }], xLabel, cursor, points }, values in display units.
export function drawPlot(context, width, height, content, theme) {
  const box = { left: LEFT, top: TOP, width: width - LEFT - RIGHT, height: height - TOP - BOTTOM };
  const ys = extent(content.curves.map((curve) => curve.y));
  const xTicks = ticks(...(content.xRange ?? extent(content.curves.map((curve) => curve.x))), box.width / 70);
  const yTicks = ticks(...padded(ys), box.height / 34);
  const xEnds = content.xRange ?? [xTicks[0], xTicks[xTicks.length - 1]];
  const yEnds = [yTicks[0], yTicks[yTicks.length - 1]];
  const scale = {
    x: (value) => box.left + ((value - xEnds[0]) / (xEnds[1] - xEnds[0])) * box.width,
    y: (value) => box.top + box.height - ((value - yEnds[0]) / (yEnds[1] - yEnds[0])) * box.height,
    box,
    xEnds,
    yEnds,
  };
  drawGrid(
    context,
    scale,
    xTicks.filter((x) => x >= xEnds[0] && x <= xEnds[1]),
    yTicks,
    content.xLabel,
    theme,
  );
  context.save();
  context.beginPath();
  context.rect(box.left, box.top - 2, box.width, box.height + 4);
  context.clip();
  for (const curve of content.curves) drawCurve(context, scale, curve);
  context.restore();
  drawCursor(context, scale, content, theme);
  return scale;
}

function drawGrid(context, { x, y, box }, xTicks, yTicks, label, theme) {
  context.lineWidth = 1;
  context.font = theme.font;
  context.fillStyle = theme.muted;
  context.textBaseline = "middle";
  context.textAlign = "right";
  for (const [i, text] of tickTexts(yTicks).entries()) {
    line(
      context,
      box.left,
      y(yTicks[i]),
      box.left + box.width,
      y(yTicks[i]),
      yTicks[i] === 0 ? theme.axis : theme.grid,
    );
    context.fillText(text, box.left - 7, y(yTicks[i]));
  }
  context.textBaseline = "top";
  context.textAlign = "center";
  const foot = box.top + box.height;
  for (const [i, text] of tickTexts(xTicks).entries()) {
    line(context, x(xTicks[i]), box.top, x(xTicks[i]), foot, theme.grid);
    const isNearLabel = x(xTicks[i]) > box.left + box.width - context.measureText(label).width - 24;
    if (!isNearLabel) context.fillText(text, x(xTicks[i]), foot + 7);
  }
  context.textAlign = "right";
  context.fillText(label, box.left + box.width + 6, foot + 7);
}

function line(context, x1, y1, x2, y2, color) {
  context.strokeStyle = color;
  context.beginPath();
  context.moveTo(Math.round(x1) + 0.5, Math.round(y1) + 0.5);
  context.lineTo(Math.round(x2) + 0.5, Math.round(y2) + 0.5);
  context.stroke();
}

function drawCurve(context, scale, curve) {
  context.strokeStyle = curve.color;
  context.fillStyle = curve.color;
  context.lineWidth = curve.width ?? 1.75;
  context.lineJoin = "round";
  context.setLineDash(curve.dash ?? []);
  context.globalAlpha = curve.alpha ?? 1;
  if (curve.dots) {
    const size = curve.dots; // pixels
    for (let i = 0; i < curve.x.length; i++)
      context.fillRect(scale.x(curve.x[i]) - size / 2, scale.y(curve.y[i]) - size / 2, size, size);
  } else {
    context.beginPath();
    trace(
      context,
      curve.x.length,
      (i) => scale.x(curve.x[i]),
      (i) => scale.y(curve.y[i]),
    );
    context.stroke();
  }
  context.setLineDash([]);
  context.globalAlpha = 1;
}

function drawCursor(context, scale, content, theme) {
  const { box } = scale;
  if (content.cursor !== undefined && content.cursor >= scale.xEnds[0] && content.cursor <= scale.xEnds[1]) {
    line(context, scale.x(content.cursor), box.top, scale.x(content.cursor), box.top + box.height, theme.muted);
  }
  for (const { x, y, color } of content.points ?? []) {
    if (!Number.isFinite(x) || !Number.isFinite(y)) continue;
    context.beginPath();
    context.arc(scale.x(x), scale.y(y), 4, 0, 2 * Math.PI);
    context.fillStyle = color;
    context.strokeStyle = theme.ground;
    context.lineWidth = 1.5;
    context.fill();
    context.stroke();
  }
}

function extent(columns) {
  const ends = columns.map(extentOf);
  const [low, high] = [Math.min(...ends.map(([end]) => end)), Math.max(...ends.map(([, end]) => end))];
  return low <= high ? [low, high] : [0, 1];
}

// Noise must not fill a plot: what differs by no more than the solver's errors is shown as a straight line.
function padded([low, high]) {
  const size = Math.max(Math.abs(low), Math.abs(high));
  if (high - low > 1e-6 * size) return [low, high];
  return size === 0 ? [-1, 1] : [low - 0.5 * size, high + 0.5 * size];
}

// Multiples of 1, 2 or 5 times a power of ten that enclose the values.
function ticks(low, high, count) {
  if (!(high > low)) return [low - 1, low, low + 1];
  const rough = (high - low) / Math.max(2, count);
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((one) => one * power).find((one) => one >= rough * 0.999);
  const first = Math.floor(low / step + 1e-6);
  const last = Math.ceil(high / step - 1e-6);
  return Array.from({ length: last - first + 1 }, (_, i) => (first + i) * step);
}

function tickTexts(values) {
  const step = Math.abs(values[1] - values[0]);
  const largest = Math.max(...values.map(Math.abs));
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const telling = Math.max(4, Math.ceil(Math.log10(largest / step)) + 1); // digits that tell neighbors apart
  const isPlain = largest < 1e6 && (digits <= 4 || telling > digits);
  const power = (value) => Number(value.toPrecision(telling)).toExponential();
  const texts = values.map((value) => (isPlain ? value.toFixed(digits) : power(value)));
  return texts.map((text) =>
    text
      .replace(/^-0(\.0*)?$/, "0")
      .replace("e+", "e")
      .replaceAll("-", "−"),
  );
}
