function save(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

const fileName = (scenario, plot, ending) =>
  `${scenario}-${plot.title}`.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "") + ending;

function csv(plot) {
  const cell = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
  const head = [plot.xLabel, ...plot.lines.map((line) => (line.unit ? `${line.label} (${line.unit})` : line.label))];
  const rows = plot.x.map((x, k) => [x, ...plot.lines.map((line) => line.values[k] ?? "")].join(","));
  return [head.map(cell).join(","), ...rows, ""].join("\n");
}

function png(chart, background) {
  const canvas = document.createElement("canvas");
  const from = chart.ctx.canvas;
  [canvas.width, canvas.height] = [from.width, from.height];
  const context = canvas.getContext("2d");
  context.fillStyle = background;
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.drawImage(from, 0, 0);
  return new Promise((resolve) => canvas.toBlob(resolve));
}

function button(text, title, action) {
  const out = document.createElement("button");
  out.type = "button";
  out.textContent = text;
  out.title = title;
  out.addEventListener("click", action);
  return out;
}

/** Buttons below a chart: one shows the whole range again, the others save it as a file. */
export function addTools(host, chart, plot, { scenario, machine }) {
  const bar = document.createElement("div");
  bar.className = "tools";
  const whole = () => chart.setScale("x", { min: plot.x[0], max: plot.x.at(-1) });
  const saveCsv = () => save(fileName(scenario, plot, ".csv"), new Blob([csv(plot)], { type: "text/csv" }));
  bar.append(
    button("Whole range", "Drag over the chart to zoom; this, or a double click, goes back", whole),
    button("PNG", "Save this chart as it is now, as PNG", async () =>
      save(fileName(scenario, plot, ".png"), await png(chart, getComputedStyle(document.body).backgroundColor)),
    ),
    button("CSV", "Save the drawn points as CSV", saveCsv),
  );
  if (plot.rows > plot.x.length) {
    const note = document.createElement("span");
    note.textContent = `Least and largest of ${plot.rows} instants${machine ? "; all are in timeseries.csv" : ""}.`;
    bar.append(note);
  }
  host.append(bar);
}
