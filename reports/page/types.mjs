// Makes TypeScript types from a JSON Schema, so that the page uses every field of a certificate
// with the name and the type that the schema states. usage: node types.mjs SCHEMA OUT
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname } from "node:path";

const [file, out] = process.argv.slice(2);
const schema = JSON.parse(readFileSync(file, "utf8"));

// "#/$defs/times_off" is the type TimesOff.
const nameOf = (ref) =>
  ref.split("/").at(-1).split("_").map((word) => word[0].toUpperCase() + word.slice(1)).join("");

function objectOf({ properties, required = [], additionalProperties }) {
  if (!properties) return `Record<string, ${typeof additionalProperties === "object" ? typeOf(additionalProperties) : "unknown"}>`;
  const fields = Object.entries(properties).map(
    ([name, of]) => `${JSON.stringify(name)}${required.includes(name) ? "" : "?"}: ${typeOf(of)};`,
  );
  return `{ ${fields.join(" ")} }`;
}

function arrayOf({ items, minItems, maxItems }) {
  const item = typeOf(items);
  return maxItems !== undefined && minItems === maxItems ? `[${Array(minItems).fill(item).join(", ")}]` : `(${item})[]`;
}

const namedTypes = {
  string: () => "string",
  boolean: () => "boolean",
  null: () => "null",
  integer: () => "number",
  number: () => "number",
  array: arrayOf,
  object: objectOf,
};

function typeOf(part) {
  if (part.$ref) return nameOf(part.$ref);
  if (part.anyOf) return part.anyOf.map(typeOf).join(" | ");
  if ("const" in part) return JSON.stringify(part.const);
  if (part.enum) return part.enum.map((word) => JSON.stringify(word)).join(" | ");
  return [part.type].flat().map((name) => namedTypes[name](part)).join(" | ");
}

const types = Object.entries(schema.$defs).map(([name, part]) => `export type ${nameOf(name)} = ${typeOf(part)};`);
mkdirSync(dirname(out), { recursive: true });
writeFileSync(out, [`// Made from ${schema.$id} by types.mjs.`, ...types, `export type Statement = ${typeOf(schema)};`, ""].join("\n"));
