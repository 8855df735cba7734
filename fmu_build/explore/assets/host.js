// Who shows the page in a frame, such as a notebook: a message with a port opens a way for values and results.
// Without it the page tells nobody anything.

import { page } from "./page-data.js";

const GREETING = "explore";
const PAUSE = 200; // milliseconds between two messages: a run has some 100 kB

export class Host {
  constructor(app) {
    this.app = app;
    window.addEventListener("message", ({ data, origin, source, ports }) => {
      const isOurs = source === window.parent && origin === window.origin;
      if (isOurs && data === GREETING && ports.length === 1) this.connect(ports[0]);
    });
  }

  connect(port) {
    this.port = port;
    port.onmessage = ({ data }) => this.app.state.take(data);
    this.tell();
  }

  tellSoon() {
    if (this.port) this.timer ??= setTimeout(() => this.tell(), PAUSE);
  }

  // All real values of the model by name, and the run that is shown, column by column.
  tell() {
    this.timer = null;
    const { run, state, shownNames } = this.app;
    const settable = page.variables.filter((one) => one.settable && one.kind === "r");
    const names = ["time", ...shownNames];
    this.port.postMessage({
      values: Object.fromEntries(settable.map(({ name }) => [name, state.value(name)])),
      names,
      columns: names.map((name) => run.column(name)),
      message: document.getElementById("alert").textContent,
    });
  }
}
