// The pages of compare and prove, and what is printed of the paper's helix, in a browser.
// usage: node pages_browser_test.mjs SAMPLES_DIR PACKAGE_DIR CHROMIUM
import assert from "node:assert/strict";
import { after, afterEach, before, test } from "node:test";
import { assertQuietAndOffline, close, closePages, colorsOf, cutTexts, launch, opened, seriousFindings, wideTables } from "../browser/pages.mjs";

before(launch);
after(close);
afterEach(closePages);

test("a comparison leads with the worst channel, both curves and the difference drawn", async () => {
  const comparison = await opened("comparison/compare.html");
  const { page } = comparison;
  assert.match(await page.locator("header").innerText(), /FAIL[\s\S]*differs from the reference in 1 of 31 channels/);
  assert.equal(await page.locator("h1").innerText(), "<b>tested</b>");
  const worst = page.locator("details.group").first();
  assert.match(await worst.innerText(), /FAIL\s+torque of motor 3\s+tau_3_Nm/);
  for (const host of await worst.locator("[data-plot]").all()) {
    await host.scrollIntoViewIfNeeded();
    await host.locator("canvas").waitFor();
    assert.ok((await host.locator("canvas").evaluate(colorsOf)) > 20);
  }
  assert.deepEqual(await worst.locator("figure").first().locator(".u-legend button").allInnerTexts(), ["upper limit", "lower limit", "reference", "test"]);
  assert.equal(await worst.locator("figure").count(), 2);
  assertQuietAndOffline(comparison);
});

test("a folded channel is drawn when it is opened, also by its link", async () => {
  const { page } = await opened("comparison/compare.html");
  const last = page.locator("details.group").last();
  assert.equal(await last.locator("canvas").count(), 0);
  await page.locator("#table tbody tr").last().locator("a").click();
  await last.locator("canvas").first().waitFor();
  assert.equal(await last.evaluate((details) => details.open), true);
});

test("what is the same is a pass, and needs no script", async () => {
  const { page } = await opened("same/compare.html", { javaScriptEnabled: false });
  assert.match(await page.locator("header").innerText(), /PASS\s+The test is the same as the reference in 32 of 32 channels/);
  assert.match(await page.locator("figure").first().innerText(), /A script draws this chart/);
});

test("a proof's defects are filtered and sorted", async () => {
  const proof = await opened("weak.html");
  const { page } = proof;
  assert.match(await page.locator("header").innerText(), /FAIL[\s\S]*1 of 3 defects were caught on fewer formulations/);
  const rows = page.locator("tr.scenario");
  assert.match(await rows.first().innerText(), /✗ too few/);
  await page.getByLabel("Outcome").selectOption({ label: "too few" });
  assert.equal(await page.locator("tr.scenario:visible").count(), 1);
  await page.getByLabel("Outcome").selectOption("");
  await page.getByLabel("Find").fill("coriolis");
  assert.equal(await page.locator("tr.scenario:visible").count(), 1);
  assert.match(await page.locator("tr.scenario:visible .reason").first().innerText(), /^Efforts against Simbody\s+and 1 more/);
  await page.getByLabel("Find").fill("");
  await page.getByRole("button", { name: "Formulations" }).click();
  assert.match(await rows.first().innerText(), /0, 2 needed/);
  assertQuietAndOffline(proof);
});

test("a sweep says in its head what came of it, and draws the grid, without a script", async () => {
  const sweep = await opened("sweep/report.html", { javaScriptEnabled: false });
  const { page } = sweep;
  assert.match(await page.locator("header").innerText(), /3,721 points: 3,686 computed, 35 out of reach\. Largest torque of a motor: up to 46\.32\s+MN·m, of motor\s6 at point\s1258/);
  const maps = page.locator("main svg");
  assert.ok((await maps.count()) >= 3);
  const box = await maps.first().boundingBox();
  assert.ok(box.width > 200 && box.height > 200);
  assert.match(await page.locator("main").innerText(), /Least \|sin θ\|[\s\S]*ursula sweep show .*workspace\.toml \d+/);
  assertQuietAndOffline(sweep);
});

test("one time for a minute at a kilohertz, too", async () => {
  const report = await opened("long/report.html");
  const { page } = report;
  await page.locator("[data-role=time]").evaluate((slider) => {
    slider.value = 30;
    slider.dispatchEvent(new Event("input"));
  });
  assert.match(await page.locator("[data-role=now]").innerText(), /^30\.00 s$/);
  assert.match(await page.locator("header").innerText(), /60.s/);
  const chart = page.locator("#errors [data-plot]").first();
  await chart.scrollIntoViewIfNeeded();
  await chart.locator("canvas").waitFor();
  assert.match(await chart.innerText(), /Least and largest of 60001 instants/);
  assertQuietAndOffline(report);
});

test("the singular directions and the legs of the enlarged error are drawn on demand", async () => {
  const report = await opened("helix/report.html");
  const { page } = report;
  await page.locator(".screen canvas").waitFor();
  const seen = () => page.locator(".screen").screenshot();
  await page.getByRole("button", { name: /nearest to a singular pose/ }).click();
  await page.locator("[data-layer=error]").setChecked(false);
  const before = await seen();
  assert.ok(before.equals(await seen()), "what stands still looks the same");
  await page.locator("[data-layer=weak]").setChecked(true);
  const directions = await seen();
  assert.ok(!before.equals(directions), "no direction is drawn");
  await page.locator("[data-layer=weak]").setChecked(false);
  await page.locator("[data-layer=error]").setChecked(true);
  await page.locator("[data-role=time]").press("End");
  const off = await seen();
  await page.locator("[data-layer=error]").setChecked(false);
  assert.ok(!off.equals(await seen()), "no error is drawn");
  assertQuietAndOffline(report);
});

test("the paper's helix is printed on four pages of A4, charts first", async () => {
  const { page, complaints } = await opened("helix/report.html");
  const pdf = (await page.pdf({ format: "A4", preferCSSPageSize: true })).toString("latin1");
  const pages = pdf.match(/\/Type\s*\/Page\b/g).length;
  assert.ok(pages > 1 && pages <= 4, `${pages} pages of A4`);
  await page.emulateMedia({ media: "print" });
  const top = (id) => page.locator(id).evaluate((element) => element.getBoundingClientRect().top);
  for (const charts of ["#errors", "#efforts", "#motion", "#reactions", "#numerics"])
    for (const words of ["#checks", "#statistics", "#input", "#findings", "#provenance"])
      assert.ok((await top(charts)) < (await top(words)), `${charts} before ${words}`);
  assert.deepEqual(complaints, []);
});

test("a suite's reports lead back to it, a report alone nowhere", async () => {
  const { page } = await opened("passed/report.html");
  await page.getByRole("link", { name: "The suite" }).click();
  assert.match(await page.locator("h1").innerText(), /scenarios passed/);
  const alone = await opened("alone/report.html");
  assert.equal(await alone.page.locator("a[href*='index.html']").count(), 0);
});

test("a text that its box hides is found", async () => {
  const { page } = await opened("prove.html");
  await page.evaluate(() => document.body.insertAdjacentHTML("beforeend", "<p style='width:3em;overflow:hidden;white-space:nowrap'>a text that is cut</p>"));
  assert.deepEqual(await cutTexts(page), ["a text that is cut"]);
});

test("a table that must be scrolled is found", async () => {
  const { page } = await opened("prove.html", { viewport: { width: 390, height: 800 } });
  await page.evaluate(() => document.body.insertAdjacentHTML("beforeend", "<div class=wide aria-label=broad><table><tr><td style='white-space:nowrap'>a table of many words that is broader than a phone or more</table></div>"));
  assert.deepEqual(await wideTables(page), ["broad"]);
});

for (const file of ["identify/report.html", "sweep/report.html"])
  test(`the sections of ${file} can all be reached at 1280 pixels`, async () => {
    const { page } = await opened(file);
    assert.deepEqual(await page.locator("nav").evaluate((nav) => nav.scrollWidth - nav.clientWidth), 0);
  });

test("axes and legends print powers of ten", async () => {
  const { page } = await opened("comparison/compare.html");
  const legend = page.locator("details.group[open] .u-legend").nth(1);
  await legend.scrollIntoViewIfNeeded();
  assert.match(await legend.innerText(), /upper limit\s*:?\s*[\d.]+\s×\s10⁻⁶/u);
  assert.doesNotMatch(await legend.innerText(), /\d(e−?\d|\.0000)/);
});

test("an index prints the colours of its checks, and no filter", async () => {
  const { page } = await opened("index.html");
  await page.emulateMedia({ media: "print" });
  assert.equal(await page.locator(".filter").isVisible(), false);
  assert.equal(await page.locator("td.cell.fail").first().evaluate((cell) => getComputedStyle(cell).printColorAdjust), "exact");
});

const kinds = ["index.html", "failed/report.html", "external/report.html", "fourbar/report.html", "engines/report.html", "comparison/compare.html",
  "prove.html", "weak.html", "sweep/report.html", "identify/report.html", "view/UPS.html", "view/delta.html"];
for (const file of kinds)
  test(`axe finds nothing serious in ${file}, light or dark, and 390 pixels hold it with every text whole`, async () => {
    const { page, complaints } = await opened(file, { viewport: { width: 390, height: 800 } });
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
    assert.deepEqual(await cutTexts(page), []);
    assert.deepEqual(await wideTables(page), []);
    assert.deepEqual(await seriousFindings(page), []);
    assert.deepEqual(complaints, []);
  });
