// One instance of the WebAssembly module: values in, one call for the whole run, a table out.

const STATUS = ["OK", "warning", "discard", "error", "fatal", "pending"];

export class Model {
  static async load(bytes) {
    const model = new Model();
    model.module = await WebAssembly.compile(bytes);
    model.renew();
    return model;
  }

  renew() {
    this.c = new WebAssembly.Instance(this.module, {}).exports;
    this.c._initialize();
    this.blocks = [];
  }

  // The rows of a run: { table, rows, status, message, milliseconds }; fewer rows than asked for: it failed.
  // A run that `continues` begins with the state in which the one before ended.
  run(asked) {
    const begun = performance.now();
    const columns = asked.kinds.length;
    let rows = 0;
    let table = new Float64Array(0);
    let failure = { status: "", message: "" };
    try {
      const address = this.allocate(8 * asked.rows * columns);
      const status = asked.continues ? this.follow(asked.inputs) : this.prepare(asked);
      if (status === 0) {
        const names = this.place(Uint32Array, asked.references);
        const kinds = this.place(
          Uint8Array,
          [...asked.kinds].map((kind) => kind.charCodeAt(0)),
        );
        rows = this.c.explore_run(columns, names, kinds, asked.rows, asked.start, asked.step, address);
        table = new Float64Array(this.c.memory.buffer, address, rows * columns).slice();
      }
      if (rows < asked.rows) {
        const code = status || this.c.explore_status();
        failure = { status: STATUS[code] ?? String(code), message: this.message() };
        if (code === 4) this.renew();
      }
    } catch (error) {
      failure = { status: "fatal", message: `the model stopped: ${error.message}` };
      this.renew();
    }
    this.release();
    return { table, rows, ...failure, milliseconds: performance.now() - begun };
  }

  prepare({ start, stop, tolerance, reals, integers, booleans, inputs }) {
    const { c } = this;
    return (
      c.explore_begin(start, stop, tolerance) ||
      this.set(c.explore_set_real, Float64Array, reals) ||
      this.set(c.explore_set_integer, Int32Array, integers) ||
      this.set(c.explore_set_boolean, Int32Array, booleans) ||
      c.explore_initialize() ||
      this.follow(inputs)
    );
  }

  set(call, type, { references, values }) {
    if (references.length === 0) return 0;
    return call(references.length, this.place(Uint32Array, references), this.place(type, values));
  }

  follow({ references, rows, values, slopes }) {
    this.c.explore_inputs(
      references.length,
      this.place(Uint32Array, references),
      rows,
      this.place(Float64Array, values),
      this.place(Float64Array, slopes),
    );
    return 0;
  }

  place(type, values) {
    const address = this.allocate(type.BYTES_PER_ELEMENT * values.length);
    new type(this.c.memory.buffer, address, values.length).set(values);
    return address;
  }

  allocate(bytes) {
    const address = this.c.malloc(bytes || 8);
    if (address === 0) throw new Error("there is not enough memory for so many rows");
    this.blocks.push(address);
    return address;
  }

  release() {
    for (const address of this.blocks.splice(0)) this.c.free(address);
  }

  message() {
    const bytes = new Uint8Array(this.c.memory.buffer);
    const start = this.c.explore_message();
    return new TextDecoder().decode(bytes.subarray(start, bytes.indexOf(0, start)));
  }
}
