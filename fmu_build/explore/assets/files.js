// What is shown, as files: CSV with all digits in SI units, PNG of the plots.

import { byName } from "./page-data.js";

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
  const [width, height] = [panels[0]?.canvas.clientWidth ?? 300, (panels[0]?.canvas.clientHeight ?? 200) + 30];
  const across = Math.min(panels.length, 2);
  const canvas = document.createElement("canvas");
  canvas.width = (across * width + 30) * ratio;
  canvas.height = (Math.ceil(panels.length / across) * height + 60) * ratio;
  const context = canvas.getContext("2d");
  context.scale(ratio, ratio);
  context.fillStyle = theme.ground;
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.fillStyle = theme.text;
  context.font = "600 16px system-ui, sans-serif";
  context.fillText(title, 15, 30);
  context.font = "12px system-ui, sans-serif";
  panels.forEach((panel, i) => {
    const [left, top] = [15 + (i % across) * width, 50 + Math.floor(i / across) * height];
    legend(context, panel, left + 12, top + 14, theme);
    context.drawImage(panel.canvas, left, top + 24, width, height - 30);
  });
  return new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
}

function legend(context, panel, left, top, theme) {
  let x = left;
  for (const { text, color } of panel.labels(theme)) {
    context.fillStyle = color;
    context.fillRect(x, top - 5, 12, 3);
    context.fillStyle = theme.text;
    context.fillText(text, x + 17, top);
    x += context.measureText(text).width + 34;
  }
}
