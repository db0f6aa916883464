// The pages of a validation in a browser.
// usage: node report_browser_test.mjs SAMPLES_DIR PACKAGE_DIR CHROMIUM
import assert from "node:assert/strict";
import { after, afterEach, before, test } from "node:test";
import { assertQuietAndOffline, close, closePages, colorsOf, drawAll, drawnBox, launch, machineSeen, opened, sample, seriousFindings } from "../browser/pages.mjs";

before(launch);
after(close);
afterEach(closePages);

const setTime = (page, t) =>
  page.locator("[data-role=time]").evaluate((slider, value) => {
    slider.value = value;
    slider.dispatchEvent(new Event("input"));
  }, t);

test("a passed report says what was found, with checks and charts", async () => {
  const report = await opened("passed/report.html");
  const { page } = report;
  assert.match(await page.locator("header .verdict").innerText(), /PASS/);
  assert.match(await page.locator("header .sentence").innerText(), /drive Simbody's loop along the helix to 2\.9.nm in 3.s/);
  assert.match(await page.locator("header .machine-line").innerText(), /Six URS legs .* 500 kg · helix, 3.s/);
  assert.equal(await page.locator("details.check").count(), 8);
  assert.equal(await page.locator("details.group[open]").count(), 0);
  await drawAll(page);
  const canvases = page.locator("figure canvas");
  assert.equal(await canvases.count(), await page.locator("figure").count());
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

for (const [folder, legs] of [["passed", "six URS legs"], ["external", "three UPS legs"]])
  test(`the machine of ${legs} is drawn, moves and can be turned`, async () => {
    const report = await opened(`${folder}/report.html`);
    const { page } = report;
    const screen = page.locator(".screen canvas");
    await screen.waitFor();
    const hide = (hidden) => screen.evaluate((canvas, value) => (canvas.style.opacity = value), hidden ? 0 : 1);
    await hide(true);
    const blank = await machineSeen(page);
    await hide(false);
    const start = await machineSeen(page);
    assert.ok(!start.equals(blank), "the canvas is blank");
    assert.ok(start.equals(await machineSeen(page)), "what stands still looks the same");
    await page.locator("[data-role=play]").click();
    await page.waitForFunction(() => Number.parseFloat(document.querySelector("[data-role=now]").value) > 0.5);
    await page.locator("[data-role=play]").click();
    const later = await machineSeen(page);
    assert.ok(!start.equals(later), "nothing moved");
    const canvas = await screen.boundingBox();
    await page.mouse.move(canvas.x + 200, canvas.y + 200);
    await page.mouse.down();
    await page.mouse.move(canvas.x + 300, canvas.y + 220, { steps: 3 });
    await page.mouse.up();
    assert.ok(!(await machineSeen(page)).equals(later), "the view did not turn");
    for (const layer of await page.locator("[data-layer]").all()) await layer.setChecked(true);
    const switchText = await page.locator("label", { has: page.locator("[data-layer=efforts]") }).innerText();
    assert.equal(switchText.trim(), (await page.locator("#efforts > h2").innerText()).toLowerCase(), "two words for efforts");
    assertQuietAndOffline(report);
  });

const isInside = ({ left, right, top, bottom }) => Math.min(left, top, 1 - right, 1 - bottom) > 0.005;

for (const folder of ["passed", "external", "flight-simulator", "hexa", "hexaglide"])
  test(`machine, labels and path of ${folder} fit into the stage at every width`, async () => {
    const { page } = await opened(`${folder}/report.html`);
    await page.locator(".screen canvas").waitFor();
    const errors = page.locator("[data-layer=error]"); // enlarged at will
    if ((await errors.count()) > 0) await errors.setChecked(false);
    await drawAll(page); // a chart that is drawn later would move the stage
    for (const width of [1280, 700, 390]) {
      await page.setViewportSize({ width, height: 800 });
      await page.waitForFunction(() => document.documentElement.scrollWidth <= innerWidth);
      const duration = await page.locator("[data-role=time]").evaluate(({ max }) => Number(max));
      for (const share of [0, 0.4, 1]) {
        await setTime(page, share * duration);
        const box = await drawnBox(page);
        assert.ok(isInside(box), `${width} px, ${share}: ${JSON.stringify(box)}`);
        assert.ok(Math.max(box.right - box.left, box.bottom - box.top) > 0.6, `small at ${width} px: ${JSON.stringify(box)}`);
      }
    }
    await page.locator(".screen canvas").hover();
    for (let k = 0; k < 8; ++k) await page.mouse.wheel(0, -300);
    assert.ok(!isInside(await drawnBox(page)), "a machine that is too near is cut off");
    await page.locator("[data-role=reset]").click();
    assert.ok(isInside(await drawnBox(page)), "and is seen again");
  });

test("one time for the machine and all charts", async () => {
  const { page } = await opened("passed/report.html");
  await drawAll(page);
  await setTime(page, 1.2);
  const marks = () => page.locator(".now").evaluateAll((all) => all.map((mark) => Number(mark.dataset.t)));
  const shown = await marks();
  assert.ok(shown.length > 8);
  assert.ok(shown.every((t) => Math.abs(t - 1.2) < 0.01), String(shown));
  assert.match(await page.locator("[data-role=now]").innerText(), /^1\.200 s$/);
  const over = page.locator("#errors .u-over").first();
  await over.scrollIntoViewIfNeeded();
  const { width } = await over.boundingBox();
  await over.click({ position: { x: width / 2, y: 60 } });
  assert.ok((await marks()).every((t) => Math.abs(t - 1.5) < 0.05), "a click in a chart is a jump");
  await page.getByRole("button", { name: /nearest to a singular pose/ }).click();
  assert.ok((await marks()).every((t) => Math.abs(t - 1.88) < 0.01));
});

test("charts are zoomed together, hide lines and are saved", async () => {
  const { page } = await opened("passed/report.html");
  await drawAll(page);
  const figure = page.locator("#errors figure").first();
  const over = figure.locator(".u-over");
  await over.scrollIntoViewIfNeeded();
  const box = await over.boundingBox();
  await page.mouse.move(box.x + 0.25 * box.width, box.y + 50);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.5 * box.width, box.y + 50, { steps: 4 });
  await page.mouse.up();
  await setTime(page, 2.9); // now out of every time chart
  const hidden = await page.locator(".now").evaluateAll((all) => all.filter((mark) => mark.hidden).length);
  assert.ok(hidden > 8, `${hidden} charts follow the zoom`);
  await figure.getByRole("button", { name: "Whole range" }).click();
  const line = figure.locator(".u-legend button").first();
  await line.press("Enter");
  assert.equal(await line.getAttribute("aria-pressed"), "false");
  for (const [name, ending, content] of [["CSV", ".csv", /^t \(s\),/], ["PNG", ".png", /PNG/]]) {
    const [download] = await Promise.all([page.waitForEvent("download"), figure.getByRole("button", { name }).click()]);
    assert.ok(download.suggestedFilename().endsWith(ending));
    const { readFile } = await import("node:fs/promises");
    assert.match(await readFile(await download.path(), "latin1"), content);
  }
});

test("groups and checks open by click and by keyboard", async () => {
  const { page } = await opened("passed/report.html");
  const group = page.locator("details.group").first();
  await group.locator("> summary").press("Enter");
  const check = group.locator("details.check").first();
  await check.locator("> summary").click();
  assert.match(await check.innerText(), /Means[\s\S]*Limit from/);
  await check.locator("> summary").press("Enter");
  assert.equal(await check.evaluate((details) => details.open), false);
});

test("all that can be done can be done by keyboard", async () => {
  const { page } = await opened("passed/report.html");
  await page.locator("[data-role=play]").focus();
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => Number.parseFloat(document.querySelector("[data-role=now]").value) > 0.1);
  await page.keyboard.press("Enter");
  await page.keyboard.press("Tab");
  await page.keyboard.press("Home");
  assert.match(await page.locator("[data-role=now]").innerText(), /^0\.000 s$/);
  await page.keyboard.press("Tab");
  assert.equal(await page.evaluate(() => document.activeElement.dataset.role), "speed");
});

test("a failed report says so, first and unfolded", async () => {
  const report = await opened("failed/report.html");
  const { page } = report;
  const header = await page.locator("header").innerText();
  assert.match(header, /FAIL[\s\S]*Efforts against Simbody: off by 41\.3.N·m[\s\S]*leg 2 is off/i);
  assert.doesNotMatch(header, /PASS/);
  assert.equal(await page.locator("details.check.fail[open]").count(), 3);
  assert.match(await page.locator("details.group").first().innerText(), /FAIL/);
  assertQuietAndOffline(report);
});

test("wrong efforts of a file lead with the likely cause", async () => {
  const report = await opened("external/report.html");
  const header = await report.page.locator("header").innerText();
  assert.match(header, /The efforts of leg3\.csv are wrong: motor 3 was given .* is expected, off by .*\. Likely cause: a factor of 1\.001 on leg 3\./);
  assert.equal(header.match(/Likely cause/g).length, 1);
  assert.match(await report.page.locator("#provenance").innerText(), /--torques leg3\.csv/);
  assertQuietAndOffline(report);
});

test("an inconclusive report is neither", async () => {
  const report = await opened("not judgeable/report.html");
  assert.match(await report.page.locator("header").innerText(), /INCONCLUSIVE\s+Nothing failed, but one check/);
  assertQuietAndOffline(report);
});

test("hostile texts and numbers stay texts and gaps", async () => {
  const report = await opened("hostile/report.html");
  assert.match(await report.page.locator("h1").innerText(), /^<\/script><script>alert\('x'\)<\/script>/);
  assert.equal(await report.page.locator("script").count(), 2);
  assert.equal(await report.page.locator("figure").count(), 3);
  await drawAll(report.page);
  assert.equal(await report.page.locator("figure canvas").count(), 2);
  assertQuietAndOffline(report);
});

test("verdict, checks, machine and each chart's largest value need no script", async () => {
  const { page } = await opened("passed/report.html", { javaScriptEnabled: false });
  assert.match(await page.locator("header .verdict").innerText(), /PASS/);
  assert.equal(await page.locator("svg.machine").isVisible(), true);
  assert.match(await page.locator("figure").last().innerText(), /Largest: .* at [\s\S]*A script draws this chart/);
  assert.equal(await page.locator("details.check").count(), 8);
});

test("charts follow theme and width", async () => {
  const { page, complaints } = await opened("passed/report.html", { colorScheme: "dark" });
  await drawAll(page);
  const stroke = () => page.locator(".u-legend svg path").first().getAttribute("stroke");
  const dark = await stroke();
  await page.emulateMedia({ colorScheme: "light" });
  await page.waitForFunction((color) => document.querySelector(".u-legend svg path").getAttribute("stroke") !== color, dark);
  await page.setViewportSize({ width: 400, height: 800 });
  await page.waitForFunction(() => document.documentElement.scrollWidth <= 400);
});

test("all charts are on paper, in light colours, from a dark page that was not scrolled", async () => {
  const { page, complaints } = await opened("passed/report.html", { colorScheme: "dark" });
  const charts = await page.locator("[data-plot]").count();
  assert.ok((await page.locator("canvas").count()) < charts);
  const pdf = (await page.pdf({ format: "A4" })).toString("latin1");
  assert.equal(await page.locator("[data-plot] canvas").count(), charts);
  const background = (event) =>
    page.evaluate((name) => {
      if (name) window.dispatchEvent(new Event(name));
      return getComputedStyle(document.body).backgroundColor;
    }, event);
  const dark = await background();
  assert.equal(await background("beforeprint"), "rgb(255, 255, 255)");
  assert.equal(await background("afterprint"), dark);
  assert.notEqual(dark, "rgb(255, 255, 255)");
  const pages = pdf.match(/\/Type\s*\/Page\b/g).length;
  assert.ok(pages <= 4, `${pages} pages of A4`);
  assert.deepEqual(complaints, []);
});

test("the index leads to every report, sorts and filters", async () => {
  const index = await opened("index.html");
  const { page } = index;
  assert.match(await page.locator("h1").innerText(), /1 of 6 scenarios passed, 3 failed, 1 inconclusive, 1 in error/);
  assert.equal(await page.locator("tr.scenario").count(), 6);
  assert.match(await page.locator("tr.scenario").first().innerText(), /FAIL/);
  assert.match(await page.locator(".suite tbody").innerText(), /expected a value/);
  await page.getByLabel("Find").fill("helix");
  assert.equal(await page.locator("tr.scenario:visible").count(), 1);
  await page.getByLabel("Find").fill("");
  await page.getByLabel("Verdict").selectOption("inconclusive");
  assert.equal(await page.locator("tr.scenario:visible").count(), 1);
  await page.getByLabel("Verdict").selectOption("");
  await page.getByRole("button", { name: "Verdict" }).click();
  await page.getByRole("button", { name: "Verdict" }).click();
  assert.match(await page.locator("tr.scenario").first().innerText(), /PASS/);
  await page.getByRole("button", { name: "Seconds" }).click();
  await page.getByRole("button", { name: "Seconds" }).click();
  assert.match(await page.locator("tr.scenario").first().innerText(), /near-singular[\s\S]*\t4\.4\t/);
  assert.match(await page.locator("tr.scenario", { hasText: "leg 3" }).first().innerText(), /likely cause: a factor of 1\.001 on leg 3/i);
  assert.equal(await page.locator("tr.scenario svg.spark").count(), 3);
  assertQuietAndOffline(index);
  await page.getByRole("link", { name: "near-singular" }).click();
  assert.equal(await page.locator("h1").innerText(), "near-singular");
});

for (const file of ["passed/report.html", "failed/report.html", "not judgeable/report.html", "external/report.html", "index.html"])
  test(`axe finds nothing serious in ${file}, light or dark`, async () => {
    const { page } = await opened(file);
    await page.evaluate(() => document.querySelectorAll("details").forEach((element) => (element.open = true)));
    assert.deepEqual(await seriousFindings(page), []);
  });

for (const file of ["passed/report.html", "failed/report.html", "not judgeable/report.html", "external/report.html", "index.html"])
  test(`${file} is whole at every width`, async () => {
    const { page } = await opened(file);
    for (const width of [1280, 390]) {
      await page.setViewportSize({ width, height: 800 });
      await page.waitForFunction(() => document.documentElement.scrollWidth <= innerWidth); // charts follow the width
    }
    // Rows of the suite are blocks on a phone: no cell is out of sight.
    const right = await page.locator(".suite td, .suite th:not([hidden])").evaluateAll((cells) => Math.max(0, ...cells.map((cell) => cell.getBoundingClientRect().right)));
    assert.ok(right <= 390, `a cell ends at ${right} px`);
  });

test("the rows of a suite begin on the first screen, before any upright head", async () => {
  const { page } = await opened("index.html");
  const top = (selector) => page.locator(selector).first().evaluate((element) => element.getBoundingClientRect().top);
  assert.ok((await top("tr.scenario")) < 400);
  assert.ok((await top(".upright")) > (await top("tr.scenario")));
});

test("wrong efforts are drawn first, then the machine; the replay's sources come later", async () => {
  const { page } = await opened("external/report.html");
  const titles = await page.locator("figcaption").allInnerTexts();
  assert.match(titles[0], /^Motor 3: given and expected/);
  assert.match(titles[1], /^Motor 3: .* less expected/);
  assert.match(await page.locator("table.motors thead").innerText(), /given\s+expected\s+off by/);
});

test("the parsers of a browser accept the JUnit files", async () => {
  const { page } = await opened("index.html");
  for (const file of ["junit.xml", "hostile/junit.xml"]) {
    const parse = (text) => new DOMParser().parseFromString(text, "text/xml").querySelectorAll("parsererror").length;
    assert.equal(await page.evaluate(parse, await sample(file)), 0, file);
  }
});
