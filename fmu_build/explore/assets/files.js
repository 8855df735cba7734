// What is shown, as files: CSV with all digits in SI units, PNG of the plots.

import { byName } from "./page-data.js";

const TITLE = "600 16px system-ui, sans-serif";
const LEGEND = "12px system-ui, sans-serif";
const LINE = 20; // pixels, of the PNG file

export function csvText(run, names) {
  const unit = (name) => (byName.get(name).unit ? ` (${byName.get(name).unit})` : "");
  const heads = ["time (s)", ...names.map((name) => `${name}${unit(name)}`)];
  const columns = ["time", ...names].map((name) => run.column(name));
  return csvOf(
    heads,
    Array.from({ length: run.rows }, (_, row) => columns.map((column) => column[row])),
  );
}

export function csvOf(heads, rows) {
  return `${[heads.map(quoted), ...rows].map((row) => row.join(",")).join("\n")}\n`;
}

function quoted(text) {
  return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

// The plots as they are on the page, two in a row, with title and legends.
export async function pngOf(title, panels, theme) {
  const ratio = window.devicePixelRatio || 1;
  const { clientWidth: width, clientHeight: height } = panels[0].canvas;
  const across = Math.min(panels.length, 2);
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d");
  const widthOf = (text) => context.measureText(text).width;
  context.font = TITLE;
  const heading = rows(title.split(" "), (word) => widthOf(`${word} `), across * width);
  context.font = LEGEND;
  const legends = panels.map((panel) => rows(panel.labels(theme), ({ text }) => widthOf(text) + 34, width - 12));
  const above = 8 + LINE * Math.max(...legends.map((lines) => lines.length)); // a plot, for its legend
  const head = 30 + LINE * heading.length;
  canvas.width = (across * width + 30) * ratio;
  canvas.height = (Math.ceil(panels.length / across) * (above + height) + head + 10) * ratio;
  context.scale(ratio, ratio);
  context.fillStyle = theme.ground;
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.fillStyle = theme.text;
  context.font = TITLE;
  heading.forEach((words, line) => {
    context.fillText(words.map(({ item }) => item).join(" "), 15, 30 + LINE * line);
  });
  context.font = LEGEND;
  panels.forEach((panel, i) => {
    const [left, top] = [15 + (i % across) * width, head + Math.floor(i / across) * (above + height)];
    drawLegend(context, legends[i], left + 12, top + 14, theme);
    context.drawImage(panel.canvas, left, top + above, width, height);
  });
  return new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
}

// Items in rows that are at most so wide, each with its place in the row.
function rows(items, widthOf, most) {
  const found = [[]];
  let x = 0;
  for (const item of items) {
    const width = widthOf(item);
    if (x > 0 && x + width > most) {
      found.push([]);
      x = 0;
    }
    found[found.length - 1].push({ item, x });
    x += width;
  }
  return found;
}

function drawLegend(context, lines, left, top, theme) {
  lines.forEach((line, i) => {
    for (const { item, x } of line) {
      const y = top + LINE * i;
      context.fillStyle = item.color;
      context.fillRect(left + x, y - 5, 12, 3);
      context.fillStyle = theme.text;
      context.fillText(item.text, left + x + 17, y);
    }
  });
}
