// The page in the output of a notebook's cell, for anywidget: traits go to the page and come from it by a port.

function render({ model, el }) {
  const address = URL.createObjectURL(new Blob([model.get("_page")], { type: "text/html" }));
  const frame = document.createElement("iframe");
  frame.title = "Live page";
  frame.style.cssText = `width: 100%; height: ${model.get("height")}px; border: 0`;
  frame.style.colorScheme = { true: "light", false: "dark" }[document.body.dataset.jpThemeLight] ?? ""; // of JupyterLab
  let port = null;
  const tell = (values) => port?.postMessage(values);
  const changed = () => tell(model.get("values"));
  // Anew where a notebook moves the frame, which loads it again.
  frame.addEventListener("load", () => {
    const channel = new MessageChannel();
    port = channel.port1;
    port.onmessage = ({ data }) => receive(model, data);
    frame.contentWindow.postMessage("explore", "*", [channel.port2]); // the page looks where it comes from
    tell(changedFromStart(model));
  });
  model.on("change:values", changed);
  frame.src = address;
  el.append(frame);
  return () => {
    model.off("change:values", changed);
    port?.close();
    URL.revokeObjectURL(address);
  };
}

// A page with a record starts with values of the record, which those of the start must not undo.
function changedFromStart(model) {
  const start = model.get("_start");
  return Object.fromEntries(Object.entries(model.get("values")).filter(([name, value]) => value !== start[name]));
}

function receive(model, { values, names, columns, message }) {
  const table = new Float64Array(columns.reduce((length, column) => length + column.length, 0));
  columns.forEach((column, i) => {
    table.set(column, i * column.length);
  });
  const traits = { values, message, _names: names, _table: new DataView(table.buffer) };
  for (const [name, value] of Object.entries(traits)) model.set(name, value);
  model.save_changes();
}

export default { render };
