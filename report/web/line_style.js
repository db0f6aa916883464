import { color, lineColor } from "./theme.js";

// Every line has its own dashes, so that lines are distinct without colour, too.
const dashes = [[], [8, 4], [2, 3], [10, 3, 2, 3], [14, 5], [5, 2], [3, 2]];

export const dashOf = (line) => (line.stroke === "ghost" ? [] : line.stroke === "limit" ? [6, 4] : dashes[line.color % 7]);
export const widthOf = (line) => (line.stroke === "ghost" ? 5 : line.stroke === "limit" ? 1.5 : 1.75);
export const colorOf = (line) =>
  line.stroke === "limit" ? color("limit") : lineColor(line.color) + (line.stroke === "ghost" ? "66" : "");
