// The least and the largest finite number of a column, found once for each: columns do not change.

const known = new WeakMap();

// [low, high]; [Infinity, -Infinity] without a finite number.
export function extentOf(column) {
  if (!known.has(column)) known.set(column, found(column));
  return known.get(column);
}

function found(column) {
  let [low, high] = [Infinity, -Infinity];
  for (const value of column) {
    if (value < low && value > -Infinity) low = value;
    if (value > high && value < Infinity) high = value;
  }
  return [low, high];
}
