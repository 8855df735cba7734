// Numbers and units as people read them.

const SUPERSCRIPTS = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

// "N.m.s/rad" -> "N m s/rad", "kg.m2" -> "kg m²", "deg" -> "°", "degC" -> "°C".
export function unitText(unit = "") {
  if (unit === "1") return "";
  return unit
    .replace(/([A-Za-z])(-?\d+)/g, (_, letter, power) => letter + [...power].map((c) => SUPERSCRIPTS[c]).join(""))
    .replace(/\bdeg(?=[CF]?\b)/g, "°")
    .replaceAll(".", " ");
}

// A number with at most `digits` significant ones, and a proper minus.
export function numberText(value, digits = 4) {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "–" : value > 0 ? "∞" : "−∞";
  const size = Math.abs(value);
  const rounded = Number(value.toPrecision(digits));
  const text = size !== 0 && (size < 1e-4 || size >= 1e7) ? rounded.toExponential() : String(rounded);
  return text.replace("e+", "e").replaceAll("-", "−");
}

export function rounded(value, digits) {
  return Number(value.toPrecision(digits));
}

// A number in a field: shortest text that shows it to seven digits, as it would be typed.
export function fieldText(value) {
  return String(rounded(value, 7));
}

export function parsed(text) {
  const plain = text
    .trim()
    .replaceAll("−", "-")
    .replace(/^([^.,]*),([^.,]*)$/, "$1.$2");
  return plain === "" ? Number.NaN : Number(plain);
}

export const shownUnit = (one) => unitText(one.display_unit ?? one.unit ?? "");

export const toShown = (one, value) => value * (one.factor ?? 1) + (one.offset ?? 0);

export const fromShown = (one, value) => (value - (one.offset ?? 0)) / (one.factor ?? 1);

// "0.045 N m s/rad", "true", the name of a literal.
export function valueText(one, value) {
  if (one.kind === "b") return value ? "true" : "false";
  const literal = one.literals?.find(([number]) => number === value);
  if (literal) return literal[1];
  return `${numberText(toShown(one, value), 5)} ${shownUnit(one)}`.trim();
}
