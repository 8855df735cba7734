// A curve of fewer points: a browser takes longer to draw a line through all rows than the model to compute them.

const TOLERANCE = 0.1; // pixels

// Moves and lines of a path (a canvas, say) through some of the points (x(i), y(i)), of which none is further away from
// the lines than the tolerance. A point that is no number interrupts the curve.
export function trace(path, count, x, y) {
  const wedge = new Wedge();
  let isDown = false;
  for (let i = 0; i < count; i++) {
    const px = x(i); // an array of both would take longer than the rest of the loop
    const py = y(i);
    if (!Number.isFinite(px) || !Number.isFinite(py)) {
      if (isDown) path.lineTo(wedge.lastX, wedge.lastY);
      isDown = false;
    } else if (!isDown) {
      path.moveTo(px, py);
      wedge.begin(px, py);
      isDown = true;
    } else if (!wedge.takes(px, py)) {
      path.lineTo(wedge.lastX, wedge.lastY);
      wedge.begin(wedge.lastX, wedge.lastY);
      wedge.takes(px, py);
    }
  }
  if (isDown) path.lineTo(wedge.lastX, wedge.lastY);
}

// The directions in which a line from one point passes all points that follow within the tolerance (Williams, Computer
// Graphics and Image Processing 8 (1978) 286).
class Wedge {
  begin(x, y) {
    this.x = this.lastX = x;
    this.y = this.lastY = y;
    this.reach = 0; // distance of the last point
    this.leftX = this.leftY = this.rightX = this.rightY = 0; // two directions; zero: any
  }

  // Whether a line to this point passes those before it; they must not turn back either.
  takes(x, y) {
    const dx = x - this.x;
    const dy = y - this.y;
    const distance = Math.sqrt(dx * dx + dy * dy);
    const isBetween = this.rightX * dy - this.rightY * dx >= 0 && dx * this.leftY - dy * this.leftX >= 0;
    if (this.reach > TOLERANCE && !(distance >= this.reach && isBetween)) return false;
    this.lastX = x;
    this.lastY = y;
    this.reach = Math.max(this.reach, distance);
    if (distance > TOLERANCE) this.narrow(dx, dy, distance);
    return true;
  }

  // To the tangents of the circle around a point.
  narrow(dx, dy, distance) {
    const sine = TOLERANCE / distance;
    const cosine = Math.sqrt(1 - sine * sine);
    const leftX = dx * cosine - dy * sine;
    const leftY = dy * cosine + dx * sine;
    if (!(this.leftX * leftY - this.leftY * leftX > 0)) {
      this.leftX = leftX;
      this.leftY = leftY;
    }
    const rightX = dx * cosine + dy * sine;
    const rightY = dy * cosine - dx * sine;
    if (!(this.rightX * rightY - this.rightY * rightX < 0)) {
      this.rightX = rightX;
      this.rightY = rightY;
    }
  }
}
