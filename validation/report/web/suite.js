// Sorts and filters the index of a suite, which is complete without this script.
const table = document.querySelector("table.suite");
const body = table.tBodies[0];
const rows = [...body.rows];

function keyOf(row, column) {
  const text = row.cells[column].textContent.trim();
  if (column === 0) return ["fail", "inconclusive", "pass"].indexOf(row.dataset.verdict);
  return /^\d+ of \d+$/.test(text) ? Number.parseInt(text, 10) : text.toLowerCase();
}

function sortBy(column, head) {
  const direction = head.getAttribute("aria-sort") === "ascending" ? -1 : 1;
  for (const other of table.tHead.querySelectorAll("[aria-sort]")) other.removeAttribute("aria-sort");
  head.setAttribute("aria-sort", direction > 0 ? "ascending" : "descending");
  const keyed = rows.map((row, index) => ({ row, index, key: keyOf(row, column) }));
  keyed.sort((a, b) => direction * (a.key < b.key ? -1 : a.key > b.key ? 1 : 0) || a.index - b.index);
  body.append(...keyed.map(({ row }) => row));
}

[...table.tHead.rows[0].cells].slice(0, 5).forEach((head, column) => {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = head.textContent;
  button.addEventListener("click", () => sortBy(column, head));
  head.replaceChildren(button);
});

const tools = document.createElement("div");
tools.className = "filter";
tools.innerHTML = `<label>Find <input type="search"></label>
  <label>Verdict <select><option value="">all</option><option value="fail">failed</option>
  <option value="inconclusive">inconclusive</option><option value="pass">passed</option></select></label>
  <span role="status"></span>`;
table.parentElement.before(tools);
const [text, verdict, shown] = [tools.querySelector("input"), tools.querySelector("select"), tools.querySelector("[role]")];

function filter() {
  const wanted = text.value.trim().toLowerCase();
  let count = 0;
  for (const row of rows) {
    const words = [...row.cells].slice(0, 5).map((cell) => cell.textContent).join(" ").toLowerCase();
    row.hidden = !(words.includes(wanted) && (!verdict.value || row.dataset.verdict === verdict.value));
    count += !row.hidden;
  }
  shown.textContent = count < rows.length ? `${count} of ${rows.length} shown` : "";
}
text.addEventListener("input", filter);
verdict.addEventListener("change", filter);
