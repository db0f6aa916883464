function setOpen(button, detail, open) {
  button.setAttribute("aria-expanded", String(open));
  detail.classList.toggle("closed", !open);
}

function foldable(row) {
  const detail = document.getElementById(row.dataset.detail);
  const cell = row.querySelector("th");
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = cell.textContent;
  button.setAttribute("aria-controls", detail.id);
  cell.replaceChildren(button);
  button.addEventListener("click", () => setOpen(button, detail, detail.classList.contains("closed")));
  return { button, detail, passed: row.classList.contains("pass") };
}

function addSwitchForAll(table, rows) {
  const button = document.createElement("button");
  button.type = "button";
  button.className = "all";
  const isAnyClosed = () => rows.some(({ detail }) => detail.classList.contains("closed"));
  const label = () => (button.textContent = isAnyClosed() ? "Show all details" : "Hide all details");
  button.addEventListener("click", () => {
    const open = isAnyClosed();
    for (const row of rows) setOpen(row.button, row.detail, open);
    label();
  });
  table.addEventListener("click", label);
  label();
  table.before(button);
}

/** Puts a button into every row of checks that shows its details; what did not pass starts open. */
export function foldDetails(document) {
  const table = document.querySelector("table.checks");
  if (!table) return;
  const rows = [...table.querySelectorAll("tr.check")].map(foldable);
  for (const row of rows) setOpen(row.button, row.detail, !row.passed);
  addSwitchForAll(table, rows);
}
