// Opens written reports in Chromium, as a reader would: from a folder, offline. What the browser tests share.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import path from "node:path";
import { pathToFileURL } from "node:url";

// SAMPLES_DIR: what report_samples wrote; PACKAGE_DIR: where node_modules is.
const [samples, packages, chromium_path] = process.argv.slice(2).map((argument) => path.resolve(argument));
const require = createRequire(path.join(packages, "package.json"));
const { chromium } = require("playwright-core");
const args = ["--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-background-networking"];

let browser;
const pages = [];
export const launch = async () => (browser = await chromium.launch({ executablePath: chromium_path, args }));
export const close = () => browser?.close();
export const closePages = () => Promise.all(pages.splice(0).map((page) => page.close()));
export const sample = (file) => readFile(path.join(samples, file), "utf8");

// What the driver says of its own software renderer is no complaint of the page.
const of_driver = /GL Driver Message|GPU stall due to ReadPixels/;

/** A page at `file`, with all that it complained of and asked for. */
export async function opened(file, options = {}) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, ...options });
  pages.push(page);
  page.setDefaultTimeout(60000);
  const complaints = [];
  const requests = [];
  page.on("console", (message) => message.type() !== "log" && !of_driver.test(message.text()) && complaints.push(message.text()));
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("dialog", (dialog) => complaints.push(`dialog ${dialog.message()}`) && dialog.dismiss());
  page.on("request", (request) => requests.push(request.url()));
  const url = String(pathToFileURL(path.join(samples, file)));
  await page.goto(url);
  return { page, url, complaints, requests };
}

export function assertQuietAndOffline({ url, complaints, requests }) {
  assert.deepEqual(complaints, []);
  assert.deepEqual(requests.filter((request) => request !== url && !/^(data|blob):/.test(request)), []);
}

/** How many colours a canvas holds: 1 is an empty one. */
export const colorsOf = (canvas) => {
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  return new Set(new Uint32Array(data.buffer)).size;
};

/** Every chart is made when it comes near the screen: goes there. */
export async function drawAll(page) {
  for (const host of await page.locator("[data-plot]").all()) {
    await host.scrollIntoViewIfNeeded();
    await host.locator("canvas").waitFor();
  }
}

/** A picture of the machine as it is seen. */
export const machineSeen = (page) => page.locator(".screen").screenshot();

/** The pixels that the machine's canvas draws, as a box in shares of the canvas: an edge at 0 or 1 is cut off. */
export async function drawnBox(page) {
  const canvas = page.locator(".screen canvas");
  const opacity = (value) => canvas.evaluate((element, shown) => (element.style.opacity = shown), value);
  await page.evaluate(() => new Promise((drawn) => requestAnimationFrame(() => requestAnimationFrame(drawn))));
  const drawn = await machineSeen(page);
  await opacity(0);
  const blank = await machineSeen(page);
  await opacity(1);
  return page.evaluate(async (pictures) => {
    const pixels = async (png) => {
      const image = new Image();
      image.src = `data:image/png;base64,${png}`;
      await image.decode();
      const ink = new OffscreenCanvas(image.width, image.height).getContext("2d");
      ink.drawImage(image, 0, 0);
      return ink.getImageData(0, 0, image.width, image.height);
    };
    const [one, other] = [await pixels(pictures[0]), await pixels(pictures[1])];
    const [with_it, without] = [one, other].map(({ data }) => new Uint32Array(data.buffer));
    const box = { left: 1, right: 0, top: 1, bottom: 0 };
    with_it.forEach((pixel, k) => {
      if (pixel === without[k]) return;
      const [x, y] = [k % one.width, Math.floor(k / one.width)];
      box.left = Math.min(box.left, x / one.width);
      box.right = Math.max(box.right, (x + 1) / one.width);
      box.top = Math.min(box.top, y / one.height);
      box.bottom = Math.max(box.bottom, (y + 1) / one.height);
    });
    return box;
  }, [drawn.toString("base64"), blank.toString("base64")]);
}

/** Tables that are wider than the place they have, so that a reader must scroll sideways. */
export const wideTables = (page) =>
  page.evaluate(() =>
    [...document.querySelectorAll(".wide:has(> table:not(.map))")].filter((box) => box.scrollWidth > box.clientWidth + 1).map((box) => box.getAttribute("aria-label") ?? box.className),
  );

/** Texts that a box without a scroll bar hides, wholly or in part. */
export const cutTexts = (page) =>
  page.evaluate(() => {
    const slack = 3; // px, of a line's own height
    const isBeyond = (inner, outer) =>
      inner.right > outer.right + slack || inner.left < outer.left - slack || inner.bottom > outer.bottom + slack || inner.top < outer.top - slack;
    const isCut = (box, element) => {
      for (let around = element; around && around !== document.body; around = around.parentElement) {
        const { overflowX } = getComputedStyle(around);
        if (overflowX === "auto" || overflowX === "scroll") return false;
        if (overflowX !== "visible" && isBeyond(box, around.getBoundingClientRect())) return true;
      }
      return false;
    };
    const cut = new Set();
    const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (texts.nextNode()) {
      const { currentNode: text } = texts;
      if (!text.data.trim() || text.parentElement.closest("script, style, math, .unseen")) continue;
      const range = document.createRange();
      range.selectNodeContents(text);
      if ([...range.getClientRects()].some((box) => box.width > 1 && isCut(box, text.parentElement))) cut.add(text.data.trim());
    }
    return [...cut];
  });

const findings = async (page, options) => {
  const { violations } = await page.evaluate((asked) => globalThis.axe.run(document, asked), { resultTypes: ["violations"], ...options });
  return violations
    .filter(({ impact }) => impact === "serious" || impact === "critical")
    .map(({ id, nodes }) => `${id}: ${nodes.slice(0, 3).map(({ html }) => html.slice(0, 120)).join(" | ")}`);
};

/** What axe finds serious or worse in the page's light form; in its dark one the colours alone differ. */
export async function seriousFindings(page) {
  await page.evaluate(await readFile(require.resolve("axe-core/axe.min.js"), "utf8"));
  const light = await findings(page, {});
  await page.emulateMedia({ colorScheme: "dark" });
  return [...light, ...(await findings(page, { runOnly: ["color-contrast"] }))];
}
