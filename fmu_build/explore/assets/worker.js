// The model, in a worker of its own: it cannot freeze the page, and the page can end it.

import { Model } from "./model.js";

let model = null;

self.onmessage = async ({ data }) => {
  try {
    if (data.module) {
      model = await Model.load(data.module);
      self.postMessage({ ready: true });
    } else {
      const result = model.run(data.run);
      self.postMessage({ id: data.id, ...result }, [result.table.buffer]);
    }
  } catch (error) {
    self.postMessage({ id: data.id, failed: String(error?.message ?? error) });
  }
};
