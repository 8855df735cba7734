// A page without additions.

import { start } from "./app.js";

start();
