// Computes the digest of the page's sources. dist/page.html records the digest, and a test
// compares.
import { createHash } from "node:crypto";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";

const sha256 = (bytes) => createHash("sha256").update(bytes).digest("hex");

// Lines "path sha256", ascending by path.
export function sourceDigest(root) {
  const files = ["build.mjs", "digest.mjs", "package.json", "package-lock.json", "tsconfig.json"];
  for (const entry of readdirSync(join(root, "src"), { recursive: true, withFileTypes: true })) {
    if (entry.isFile()) files.push(join(entry.parentPath, entry.name).slice(root.length + 1));
  }
  files.sort();
  return sha256(files.map((file) => `${file} ${sha256(readFileSync(join(root, file)))}\n`).join(""));
}
