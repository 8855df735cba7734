// What the length and the step of a run may be.

export const MOST_ROWS = 50000;

// A message; "" where a run like this can be made.
export function fault({ start, stop, step }) {
  if (!(stop > start && stop < Infinity)) return `The stop time must be a number above ${start} s.`;
  if (!(step > 0)) return "The step must be a number above 0.";
  if (!(step <= stop - start)) return `The step must be at most ${stop - start} s.`;
  if ((stop - start) / step > MOST_ROWS) return `The step must be at least ${(stop - start) / MOST_ROWS} s.`;
  return "";
}
