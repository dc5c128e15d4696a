// Bundles src/ into one HTML file that needs no network. usage: node build.mjs [OUT.html]
import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { sourceDigest } from "./digest.mjs";

const root = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2] ?? join(root, "dist", "page.html");

const bundle = async (entry) => {
  const made = await build({
    absWorkingDir: root,
    entryPoints: [entry],
    bundle: true,
    write: false,
    minify: true,
    format: "iife",
    target: "es2022",
    charset: "ascii",
    legalComments: "inline",
  });
  return made.outputFiles[0].text.trim();
};

// Only what was built here may run or style the page.
const hash = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;

const script = (await bundle("src/main.ts")).replaceAll("</script", "<\\/script");
const style = await bundle("src/style.css");
const policy = [
  "default-src 'none'",
  `script-src ${hash(script)}`,
  `style-src ${hash(style)}`,
  "img-src data:",
  "base-uri 'none'",
  "form-action 'none'",
].join("; ");

const page = readFileSync(join(root, "src", "page.html"), "utf8")
  .replace("PAGE_POLICY", () => policy)
  .replace("PAGE_SOURCES", () => sourceDigest(root))
  .replace("PAGE_STYLE", () => style)
  .replace("PAGE_SCRIPT", () => script);
if (page.split("ASSAY_REPORT_DATA").length !== 2) throw new Error("the mark of the data must stand once");
if (/[^\t\n\x20-\x7e]/.test(page)) throw new Error("the page must be plain ASCII");
mkdirSync(dirname(out), { recursive: true });
writeFileSync(out, page);
console.log(`${out}: ${page.length} bytes`);
