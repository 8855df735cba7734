// The page's side of the worker: the newest request waits, older ones are dropped, and a run that takes too
// long is ended with its worker.

const LONGEST = 5000; // milliseconds

export class Simulation {
  constructor(module, source, onResult) {
    this.module = module;
    this.url = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
    this.onResult = onResult;
    this.waiting = null;
    this.running = null;
    this.id = 0;
    this.start();
  }

  start() {
    this.worker = new Worker(this.url);
    this.worker.onmessage = ({ data }) => this.received(data);
    this.worker.onerror = (event) => this.received({ id: this.running?.id, failed: event.message });
    this.running = { id: 0 };
    this.worker.postMessage({ module: this.module });
  }

  // Whether a run is under way or waits.
  get isBusy() {
    return Boolean(this.waiting || this.running?.request);
  }

  run(request) {
    this.waiting = { id: ++this.id, request };
    this.next();
  }

  next() {
    if (this.running || !this.waiting) return;
    this.running = this.waiting;
    this.waiting = null;
    this.timer = setTimeout(() => this.stop(), LONGEST);
    this.worker.postMessage({ id: this.running.id, run: this.running.request });
  }

  stop() {
    this.worker.terminate();
    const { request } = this.running;
    this.start();
    this.onResult(failed(`The run did not end within ${LONGEST / 1000} s and was stopped.`), request);
  }

  received(data) {
    clearTimeout(this.timer);
    const { request } = this.running ?? {};
    this.running = null;
    if (!data.ready && request) this.onResult(data.failed ? failed(data.failed) : data, request);
    else if (data.failed) this.onResult(failed(data.failed), null);
    this.next();
  }
}

function failed(message) {
  return { table: new Float64Array(0), rows: 0, status: "fatal", message, milliseconds: 0 };
}
