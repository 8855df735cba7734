// The angle (rad) that the handle can reach: that of the model's stops, else of those that joysticks have.

import { page } from "./page-data.js";
import { parameterOf } from "./request.js";

export function stopOf(run) {
  return parameterOf(run, "stops.theta_stop") || page.addition.stop;
}
