// Sorts and filters the index of a suite, or the defects of a proof; both are complete without this script.
const table = document.querySelector("table.suite");
const body = table.tBodies[0];
const rows = [...body.rows];

function keyOf(row, column) {
  const { value } = row.cells[column].dataset;
  if (value !== undefined) return Number(value);
  const text = row.cells[column].textContent.trim();
  if (column === 0) return ["fail", "inconclusive", "pass", "not_applicable"].indexOf(row.dataset.verdict);
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

const sorted = [...table.tHead.querySelectorAll(".sorts")]; // the first columns
sorted.forEach((head, column) => {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = head.textContent;
  button.addEventListener("click", () => sortBy(column, head));
  head.replaceChildren(button);
});

// The verdicts that occur, in the words of their badges.
const word = (row) => row.cells[0].querySelector(".badge").lastChild.textContent.trim().toLowerCase();
const choices = new Map(rows.map((row) => [row.dataset.verdict, word(row)]));
const tools = document.createElement("div");
tools.className = "filter";
tools.innerHTML = `<label>Find <input type="search"></label>
  <label>${sorted[0].textContent} <select><option value="">all</option></select></label> <span role="status"></span>`;
for (const [value, text] of choices) tools.querySelector("select").add(new Option(text, value));
table.before(tools);
const [text, verdict, shown] = [tools.querySelector("input"), tools.querySelector("select"), tools.querySelector("[role]")];

function filter() {
  const wanted = text.value.trim().toLowerCase();
  let count = 0;
  for (const row of rows) {
    const words = [...row.cells].slice(0, sorted.length).map((cell) => cell.textContent).join(" ").toLowerCase();
    row.hidden = !(words.includes(wanted) && (!verdict.value || row.dataset.verdict === verdict.value));
    count += !row.hidden;
  }
  shown.textContent = count < rows.length ? `${count} of ${rows.length} shown` : "";
}
text.addEventListener("input", filter);
verdict.addEventListener("change", filter);
