// The page of a joystick: scene, hand, records and parameter file beside what every page has.

import { start } from "./app.js";
import { make, save } from "./elements.js";
import { Hand } from "./hand.js";
import { page } from "./page-data.js";
import { PeriodPlot } from "./period-plot.js";
import { Records } from "./records.js";
import { Scene } from "./scene.js";
import { Session } from "./session.js";
import { changedToml, springFault } from "./toml.js";

const TICK = 12; // milliseconds, of a phone that shakes where a spring is released

const scene = new Scene(page.addition);
const periods = new PeriodPlot();
const records = new Records(page.addition.records);

start({
  names: () => [...scene.names, ...periods.names],
  mount(app) {
    app.plots.element.prepend(scene.element);
    periods.mount(app);
    giveHandle(app);
    if (!records.isEmpty) records.mount(app);
    const write = () => {
      const fault = springFault(app.state);
      app.alert(fault ? `A parameter file cannot hold these springs. ${fault}.` : "");
      if (!fault) save("joystick.toml", changedToml(page.addition, app.state), "application/toml");
    };
    document.querySelector(".actions").append(make("button", { type: "button", onclick: write }, "joystick.toml"));
  },
  curves: (panel, theme) => records.curves(panel, theme),
  plots: () => [...records.plots, periods.plot],
  rested: () => periods.rested(),
  shown(run, row, theme, isWhole) {
    periods.show(run, theme, isWhole);
    records.show(run, theme, isWhole);
    scene.show(run, row);
  },
});

function giveHandle(app) {
  const hand = new Hand(scene.whole, {
    stop: () => scene.stop,
    angle: () => scene.theta,
    onGrab() {
      if (!app.simulation) return; // still loading
      app.playback.pause();
      if (app.session) app.session.takeAgain();
      else new Session(app, hand, app.names).begin(scene.theta);
    },
    onLetGo: () => app.session?.letGo(),
  });
  scene.onRelease = () => {
    if (hand.isHolding) navigator.vibrate?.(TICK);
  };
}
