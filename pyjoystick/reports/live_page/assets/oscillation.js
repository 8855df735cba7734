// What is read off a motion: its peaks, between the rows, and the period around each. As pyjoystick.find_peaks and
// pyjoystick.periods do it, of which this is a part.

// Maxima above and minima below zero of the cubic that has values and slopes of two neighboring rows: { time, value }.
export function peaks(times, values, slopes) {
  const found = [];
  for (let i = 1; i < times.length; i++) {
    if (slopes[i - 1] === 0 || slopes[i] === 0 || slopes[i - 1] > 0 === slopes[i] > 0) continue;
    const peak = extremum(times, values, slopes, i - 1);
    if (peak.value > 0 === slopes[i - 1] > 0) found.push(peak);
  }
  return found;
}

function extremum(times, values, slopes, i) {
  const span = times[i + 1] - times[i];
  const [d0, d1] = [slopes[i] * span, slopes[i + 1] * span];
  const rise = values[i + 1] - values[i];
  // value = values[i] + d0*s + b*s^2 + a*s^3, and its derivative d0 + 2*b*s + 3*a*s^2 is zero at s.
  const a = d0 + d1 - 2 * rise;
  const b = 3 * rise - 2 * d0 - d1;
  const root = Math.sqrt(Math.max(0, b * b - 3 * a * d0));
  const s = d0 / (-b - Math.sign(b || 1) * root);
  const other = (-b - Math.sign(b || 1) * root) / (3 * a);
  const at = s >= 0 && s <= 1 ? s : other;
  return { time: times[i] + at * span, value: values[i] + at * (d0 + at * (b + at * a)) };
}

// The period around each peak, from the peak before it to the peak after it: { amplitude, period }. A release from
// rest stands for the peak before the first one.
export function periods(found, releaseTime = null) {
  const list = releaseTime === null ? found : [{ time: releaseTime }, ...found];
  return list.slice(1, -1).map((peak, i) => ({
    amplitude: Math.abs(peak.value),
    period: list[i + 2].time - list[i].time,
  }));
}
