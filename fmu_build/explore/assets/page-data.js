// What the page carries: the description of the model, the module, and the worker's script.

export const page = JSON.parse(document.getElementById("data").textContent);

export const byName = new Map(page.variables.map((one) => [one.name, one]));

export async function module() {
  const packed = Uint8Array.from(atob(document.getElementById("wasm").textContent), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

export function workerSource() {
  return document.getElementById("worker").textContent;
}
