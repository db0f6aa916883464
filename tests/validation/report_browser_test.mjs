// Opens written reports in Chromium, as a reader would: from a folder, offline.
// usage: node report_browser_test.mjs SAMPLES_DIR PACKAGE_DIR CHROMIUM
//   SAMPLES_DIR  what report_samples wrote;  PACKAGE_DIR  where node_modules/playwright-core is
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import path from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";

const [samples, packages, chromium_path] = process.argv.slice(2).map((argument) => path.resolve(argument));
const { chromium } = createRequire(path.join(packages, "package.json"))("playwright-core");
const args = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-background-networking"];

let browser;
before(async () => (browser = await chromium.launch({ executablePath: chromium_path, args })));
after(() => browser?.close());

// A page at `file`, with all that it complained of and asked for.
async function opened(file, options = {}) {
  const page = await browser.newPage(options);
  const complaints = [];
  const requests = [];
  page.on("console", (message) => message.type() !== "log" && complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("dialog", (dialog) => complaints.push(`dialog ${dialog.message()}`) && dialog.dismiss());
  page.on("request", (request) => requests.push(request.url()));
  const url = String(pathToFileURL(path.join(samples, file)));
  await page.goto(url);
  return { page, url, complaints, requests };
}

function assertQuietAndOffline({ url, complaints, requests }) {
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests.filter((request) => request !== url && !request.startsWith("data:")), []);
}

const rowsOf = (page, selector = "tr.check") => page.locator(selector).count();

// How many colours a canvas holds: 1 is an empty one.
const colorsOf = (canvas) => {
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  return new Set(new Uint32Array(data.buffer)).size;
};

test("a passed report shows verdict, checks and charts", async () => {
  const report = await opened("passed/report.html");
  const { page } = report;
  assert.match(await page.locator("header .verdict").innerText(), /PASS.*8 of 8 checks held/s);
  assert.equal(await rowsOf(page), 8);
  assert.equal(await page.locator("figure").count(), 6);
  const canvases = page.locator("figure canvas");
  assert.equal(await canvases.count(), 6);
  for (const canvas of await canvases.all()) {
    assert.ok((await canvas.evaluate(colorsOf)) > 20, await canvas.getAttribute("aria-label"));
    assert.match(await canvas.getAttribute("aria-label"), /Largest: /);
  }
  assertQuietAndOffline(report);
});

test("the emptiness check of canvases can fail", async () => {
  const { page } = await opened("passed/report.html");
  const blank = await page.evaluateHandle(() => document.createElement("canvas"));
  assert.equal(await blank.evaluate(colorsOf), 1);
});

test("a row opens and closes by click and by keyboard", async () => {
  const { page } = await opened("passed/report.html");
  const detail = page.locator("#detail-2");
  const button = page.locator('button[aria-controls="detail-2"]');
  assert.equal(await detail.isVisible(), false);
  await button.click();
  assert.match(await detail.innerText(), /Limit from\s+integration error/);
  assert.equal(await button.getAttribute("aria-expanded"), "true");
  await button.press("Enter");
  assert.equal(await detail.isVisible(), false);
  await page.getByText("Show all details").click();
  assert.equal(await rowsOf(page, "tr.detail:not(.closed)"), 8);
  await page.getByText("Hide all details").click();
  assert.equal(await rowsOf(page, "tr.detail:not(.closed)"), 0);
});

test("a failed report says so, first and unfolded", async () => {
  const report = await opened("failed/report.html");
  const { page } = report;
  const verdict = await page.locator("header .verdict").innerText();
  assert.match(verdict, /FAIL.*3 of 9 checks failed/s);
  assert.doesNotMatch(verdict, /PASS/);
  assert.equal(await rowsOf(page, "tr.check.fail"), 3);
  assert.equal(await page.locator("tr.check").first().locator(".badge").innerText(), "✗ FAIL");
  assert.equal(await page.locator("tr.check.fail + tr.detail").first().isVisible(), true);
  assert.equal(await page.locator("figure").count(), 1);
  assertQuietAndOffline(report);
});

test("an inconclusive report is neither", async () => {
  const report = await opened("not judgeable/report.html");
  assert.match(await report.page.locator("header .verdict").innerText(), /INCONCLUSIVE.*Nothing failed/s);
  assertQuietAndOffline(report);
});

test("hostile texts and numbers stay texts and gaps", async () => {
  const report = await opened("hostile/report.html");
  assert.match(await report.page.locator("h1").innerText(), /^<\/script><script>alert\('x'\)<\/script>/);
  assert.equal(await report.page.locator("script").count(), 2);
  assert.equal(await report.page.locator("figure").count(), 3);
  assert.equal(await report.page.locator("figure canvas").count(), 2);
  assertQuietAndOffline(report);
});

test("verdict and checks need no script", async () => {
  const report = await opened("failed/report.html", { javaScriptEnabled: false });
  assert.match(await report.page.locator("header .verdict").innerText(), /FAIL/);
  assert.equal(await report.page.locator("tr.detail").first().isVisible(), true);
  assert.match(await report.page.locator("noscript").first().innerText(), /timeseries\.csv/);
});

test("charts follow theme, width and paper", async () => {
  const { page, complaints } = await opened("passed/report.html", { colorScheme: "dark" });
  const marker = "figure svg path";
  const dark = await page.locator(marker).first().getAttribute("stroke");
  await page.emulateMedia({ colorScheme: "light" });
  const differs = ([selector, color]) => document.querySelector(selector).getAttribute("stroke") !== color;
  await page.waitForFunction(differs, [marker, dark]);
  await page.setViewportSize({ width: 420, height: 800 });
  await page.waitForFunction(() => document.documentElement.scrollWidth <= 420);
  await page.pdf();
  assert.deepEqual(complaints, []);
});

test("the index leads to every report", async () => {
  const index = await opened("index.html");
  const { page } = index;
  assert.match(await page.locator("h1").innerText(), /1 of 5 scenarios passed, 3 failed, 1 inconclusive/);
  assert.equal(await rowsOf(page, "tr.scenario"), 5);
  assert.match(await page.locator("tr.scenario.fail").last().innerText(), /expected a value/);
  assertQuietAndOffline(index);
  await page.getByText("near-singular").click();
  assert.equal(await page.locator("h1").innerText(), "near-singular");
});

test("the parsers of a browser accept the JUnit files", async () => {
  const { page } = await opened("index.html");
  const { readFile } = await import("node:fs/promises");
  for (const file of ["junit.xml", "hostile/junit.xml"]) {
    const xml = await readFile(path.join(samples, file), "utf8");
    const parse = (text) => new DOMParser().parseFromString(text, "text/xml").querySelectorAll("parsererror").length;
    assert.equal(await page.evaluate(parse, xml), 0, file);
  }
});
