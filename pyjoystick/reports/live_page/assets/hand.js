// The operator's hand: where pointer or keys draw the handle. Nothing here moves the handle; the model does, by the
// torque of hand and arm.

const DEGREE = Math.PI / 180;
const FARTHEST = 1.5; // of the stop's angle: the hand must pull beyond the angle that the springs hold
const POINTER_SPEED = 15; // rad/s, of a quick hand: a pointer may jump
const KEY_SPEED = 1.5; // rad/s
const KEYS = {
  ArrowRight: 1,
  ArrowUp: 1,
  ArrowLeft: -1,
  ArrowDown: -1,
  PageUp: 5,
  PageDown: -5,
}; // degrees
const LET_GO = ["Escape", "Enter", " "];

export class Hand {
  // `stop` and `angle` give those of the moment.
  constructor(drawing, { stop, onGrab, onLetGo, angle }) {
    Object.assign(this, { drawing, stop, onGrab, onLetGo, angle });
    this.drop();
    drawing.addEventListener("pointerdown", (event) => this.pressed(event));
    drawing.addEventListener("pointermove", (event) => this.moved(event));
    for (const end of ["pointerup", "pointercancel"]) drawing.addEventListener(end, () => this.lifted());
    drawing.addEventListener("keydown", (event) => this.typed(event));
    drawing.addEventListener("focusout", () => this.letGo());
  }

  pressed(event) {
    if (event.button !== 0 || !event.target.closest(".handle")) return;
    event.preventDefault(); // no selection of text; the focus is set here
    this.drawing.querySelector(".handle").focus({ preventScroll: true });
    this.drawing.setPointerCapture(event.pointerId);
    this.offset = this.angle() - this.pointed(event);
    this.isPointing = true;
    this.grab(POINTER_SPEED);
  }

  moved(event) {
    if (this.isPointing) this.aim(this.pointed(event) + this.offset);
  }

  lifted() {
    if (!this.isPointing) return;
    this.isPointing = false;
    this.letGo();
  }

  typed(event) {
    const isLettingGo = LET_GO.includes(event.key);
    const degrees = { ...KEYS, Home: -Infinity, End: Infinity }[event.key];
    if (!isLettingGo && degrees === undefined) return;
    event.preventDefault();
    if (isLettingGo) {
      this.letGo();
      return;
    }
    if (!this.isHolding) this.grab(KEY_SPEED);
    const end = Math.sign(degrees) * this.stop();
    this.aim(Number.isFinite(degrees) ? this.target + degrees * DEGREE : end);
  }

  // The angle of the pointer about the pivot, which is the origin of the drawing.
  pointed(event) {
    const { x, y } = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.drawing.getScreenCTM().inverse());
    return Math.atan2(x, -y);
  }

  aim(angle) {
    const most = FARTHEST * this.stop();
    this.target = Math.min(most, Math.max(-most, angle));
  }

  grab(speed) {
    this.speed = speed;
    this.isHolding = true;
    this.target = this.angle();
    this.wanted = this.target;
    this.onGrab();
  }

  letGo() {
    if (!this.isHolding) return;
    this.drop();
    this.onLetGo();
  }

  // The session has ended without it.
  drop() {
    this.isHolding = false;
    this.isPointing = false;
  }

  // The wanted angle after a time: toward the target, no faster than a hand. Returns [before, after].
  advance(seconds) {
    const before = this.wanted;
    const most = this.speed * seconds;
    this.wanted += Math.min(most, Math.max(-most, this.target - before));
    return [before, this.wanted];
  }
}
