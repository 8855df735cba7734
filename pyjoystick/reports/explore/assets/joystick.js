// The page of a joystick: scene, records and parameter file beside what every page has.

import { start } from "./app.js";
import { make, save } from "./elements.js";
import { page } from "./page-data.js";
import { Records } from "./records.js";
import { Scene } from "./scene.js";
import { changedToml, springFault } from "./toml.js";

const scene = new Scene(page.addition);
const records = new Records(page.addition.records);

start({
  names: () => [...scene.names, ...(records.isEmpty ? [] : ["theta"])],
  mount(app) {
    app.plots.element.prepend(scene.element);
    if (!records.isEmpty) records.mount(app);
    const write = () => {
      const fault = springFault(app.state);
      app.alert(fault ? `A parameter file cannot hold these springs. ${fault}.` : "");
      if (!fault) save("joystick.toml", changedToml(page.addition, app.state), "application/toml");
    };
    document.querySelector(".actions").append(make("button", { type: "button", onclick: write }, "joystick.toml"));
  },
  curves: (panel, theme) => records.curves(panel, theme),
  shown(run, row, state, theme) {
    scene.show(run, row, state);
    records.show(run, theme);
  },
});
