// What the length and the step of a run may be.

import { page } from "./page-data.js";

export const MOST_ROWS = page.most_rows;

// A message; "" where a run like this can be made.
export function fault({ start, stop, step }) {
  if (!(stop > start && stop < Infinity)) return `The stop time must be a number above ${start} s.`;
  if (!(step > 0)) return "The step must be a number above 0.";
  if (!(step <= stop - start)) return `The step must be at most ${stop - start} s.`;
  // A step that was made from the number of rows may be a rounding error below it.
  if ((stop - start) / step > MOST_ROWS + 1e-6) return `The step must be at least ${(stop - start) / MOST_ROWS} s.`;
  return "";
}
