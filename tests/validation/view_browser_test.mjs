// The pages of `ursula view` in a browser: sliders move the machine, and the numbers are those of the program.
// usage: node view_browser_test.mjs SAMPLES_DIR PACKAGE_DIR CHROMIUM
import assert from "node:assert/strict";
import { after, afterEach, before, test } from "node:test";
import { assertQuietAndOffline, close, closePages, launch, machineSeen, opened, sample, seriousFindings } from "../browser/pages.mjs";

before(launch);
after(close);
afterEach(closePages);

const efforts = (page) => page.locator("#motors tbody tr td:last-child").evaluateAll((cells) => cells.map((cell) => Number(cell.dataset.value)));
const moveTo = async (page, values) => {
  for (const [k, value] of values.entries()) {
    const input = page.locator(`[data-exact="${k}"]`);
    await input.fill(String(value));
    await input.dispatchEvent("change");
  }
};

for (const name of ["URS", "UPS", "RUS", "PUS", "fourbar", "fivebar", "delta"])
  test(`${name} moves, and is held by the program's efforts`, async () => {
    const view = await opened(`view/${name}.html`);
    const { page } = view;
    const expected = JSON.parse(await sample("view/expected.json"))[name];
    await page.locator(".screen canvas").waitFor();
    const start = await efforts(page);
    const before_it = await machineSeen(page);
    for (const { sliders, efforts: right } of expected) {
      await moveTo(page, sliders);
      assert.equal(await page.locator("#reach").innerText(), "In reach.");
      const found = await efforts(page);
      const size = Math.max(...right.map(Math.abs));
      right.forEach((effort, k) => assert.ok(Math.abs(found[k] - effort) <= 1e-9 * size, `motor ${k + 1}: ${found[k]}, expected ${effort}`));
      assert.notDeepEqual(found, start);
    }
    assert.ok(!(await machineSeen(page)).equals(before_it));
    assertQuietAndOffline(view);
  });

test("a pose out of reach is told by leg, and the path leads back", async () => {
  const { page } = await opened("view/URS.html");
  const start = await efforts(page);
  await moveTo(page, [1000, 1000, 1000]); // the ends of the sliders
  assert.match(await page.locator("#reach").innerText(), /Out of reach: leg \d: [\d.]+ m, and it spans/);
  assert.equal(await page.locator("#motors tbody td:last-child").first().innerText(), "–");
  await page.locator("#instant").fill("50");
  assert.equal(await page.locator("#reach").innerText(), "In reach.");
  assert.notDeepEqual(await efforts(page), start);
  await page.locator("#instant").fill("0");
  assert.deepEqual(await efforts(page), start);
});

test("loops that cannot close are told by joint, and the machine stays", async () => {
  const { page } = await opened("view/fivebar.html");
  const start = await efforts(page);
  await moveTo(page, [-53.13, 53.13]); // the elbows are farther apart than both forearms
  assert.match(await page.locator("#reach").innerText(), /Out of reach: the loops do not close; the largest gap is at \w+/);
  await page.locator("#instant").fill("0");
  assert.deepEqual(await efforts(page), start);
});

for (const colorScheme of ["light", "dark"])
  for (const width of [1280, 390])
    test(`nothing is cut at ${width} px, ${colorScheme}`, async () => {
      for (const name of ["URS", "delta"]) {
        const { page } = await opened(`view/${name}.html`, { viewport: { width, height: 800 }, colorScheme });
        await page.locator(".screen canvas").waitFor();
        assert.equal(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth), 0);
        assert.deepEqual(await seriousFindings(page), []);
      }
    });
