// Bundles scripts and style of the report, and records the hashes of their sources.
// usage: node build.mjs FOLDER, with node_modules beside this file; ./dev bundle calls it
import { build } from "esbuild";
import katex from "katex";
import { createHash } from "node:crypto";
import { mkdir, readFile, readdir, writeFile } from "node:fs/promises";
import path from "node:path";
import { formulas } from "./formulas.mjs";

const here = new URL(".", import.meta.url);
const out = path.resolve(process.argv[2]);
const read = (name) => readFile(new URL(name, here), "utf8");

async function bundled(entry, extra) {
  const result = await build({
    absWorkingDir: decodeURIComponent(here.pathname),
    entryPoints: [entry],
    bundle: true,
    minify: true,
    write: false,
    target: "es2022",
    legalComments: "inline",
    ...extra,
  });
  return result.outputFiles[0].text;
}

// KaTeX wraps its MathML for a style sheet that the page lacks, and repeats the LaTeX, which no reader needs.
function mathml(latex) {
  const wrapped = katex.renderToString(latex, { output: "mathml", displayMode: false, strict: "error", throwOnError: true });
  const [math] = wrapped.match(/<math[\s\S]*<\/math>/);
  return math
    .replace(/<annotation[\s\S]*?<\/annotation>/, "")
    .replace(/<\/?semantics>/g, "")
    // Adds the thin spaces around names of functions, which browsers leave out.
    .replace(/(<\/m(?:i|over|row|sup)>)<mi>(sin|cos)<\/mi>/g, '$1<mspace width="0.17em"/><mi>$2</mi>')
    .replace(/<mo>\u2061<\/mo>(?=<m(?:i|over))/g, '<mo>\u2061</mo><mspace width="0.17em"/>')
    .replace("<math", '<math display="inline" displaystyle="true"');
}

function mathmlTable() {
  const texts = formulas.map(([text]) => text);
  const twice = texts.filter((text, k) => texts.indexOf(text) !== k);
  if (twice.length > 0) throw new Error(`formulas.mjs holds twice: ${twice.join("; ")}`);
  return `${JSON.stringify(Object.fromEntries(formulas.map(([text, latex]) => [text, mathml(latex)])), null, 0)}\n`;
}

const license = async (name) => `${name}\n${await read(`node_modules/${name}/LICENSE`)}`;
const uplot = `/*! ${await license("uplot")}*/`;
const both = `/*! ${await license("uplot")}\n${await license("three")}*/`;
const script = { format: "iife", charset: "ascii" };
const files = {
  "report.css": await bundled("style.css", { banner: { css: uplot } }),
  "report.js": await bundled("main.js", { ...script, banner: { js: both } }),
  "charts.js": await bundled("charts.js", { ...script, banner: { js: uplot } }),
  "index.js": await bundled("suite.js", script),
  "formulas.json": mathmlTable(),
};
for (const [name, text] of Object.entries(files)) {
  if (text.includes(')ursula"')) throw new Error(`${name} holds the delimiter of its C++ literal`);
  if (name.endsWith(".js") && /<\/script|<!--/i.test(text)) throw new Error(`${name} cannot stand inside <script>`);
}

// The hashes of the bundle's sources, by which CMake notices a stale bundle. Templates go into the program unchanged.
const sources = (await readdir(here)).filter((name) => /\.(m?js|css|json)$/.test(name)).sort();
const hash = (text) => createHash("sha256").update(text).digest("hex");
const lines = await Promise.all(sources.map(async (name) => `${hash(await read(name))}  ${name}\n`));
files["sources.sha256"] = lines.join("");

await mkdir(out, { recursive: true });
for (const [name, text] of Object.entries(files)) await writeFile(path.join(out, name), text);
