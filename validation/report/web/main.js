// The report is complete without this script but for its charts: it only folds the details of checks and draws.
import { foldDetails } from "./details.js";
import { drawCharts } from "./charts.js";

foldDetails(document);
drawCharts(document, JSON.parse(document.getElementById("plots").textContent));
