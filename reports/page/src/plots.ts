// Draws small plots with classes of the style sheet. Letters keep their size in a narrow window. A
// table or a sentence also shows the data of each plot.
import { html } from "./dom";

export interface LogRow {
  label: string;
  value: number | null;
  limit: number | null; // a mark that the value should stay below
  bad: boolean;
  words: string;
}

const power = (n: number): string =>
  String(n).replace("-", "\u207b").replace(/[0-9]/g, (d) => "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"[Number(d)]!);

// Returns the first and the last power of ten of an axis that has all numbers of the rows.
function decades(rows: LogRow[]): [number, number] {
  const numbers = rows.flatMap((r) => [r.value, r.limit]).filter((n): n is number => n !== null && n > 0);
  const lo = Math.floor(Math.log10(Math.min(...numbers)) + 1e-9);
  const hi = Math.ceil(Math.log10(Math.max(...numbers)) - 1e-9);
  return [lo, Math.max(hi, lo + 1)];
}

const plotOf = (title: string, rows: HTMLElement[]): HTMLElement =>
  html("div", { class: "plot", role: "img", "aria-label": title }, ...rows);

const rowOf = (label: string, words: string, ...marks: HTMLElement[]): HTMLElement =>
  html("div", { class: "row", title: words }, html("span", { class: "label" }, label), html("span", { class: "scale" }, ...marks));

// Makes a mark whose place or width is a percentage of the scale.
function mark(kind: string, side: "left" | "width", percent: number, words = ""): HTMLElement {
  const made = html("span", { class: kind }, words);
  made.style[side] = `${percent.toFixed(2)}%`;
  return made;
}

// Draws a disc for each row on a logarithmic axis, and a bar at the row's limit.
export function logPlot(title: string, rows: LogRow[]): HTMLElement | null {
  if (!rows.some((r) => r.value !== null && r.value > 0)) return null;
  const [lo, hi] = decades(rows);
  const at = (n: number): number => (100 * (Math.log10(n) - lo)) / (hi - lo);
  const rules: { n: number; words: string; fine: boolean }[] = [];
  for (let d = lo; d <= hi; ++d) rules.push({ n: 10 ** d, words: d === 0 ? "1" : `10${power(d)}`, fine: false });
  // If there are few decades, lines inside them help.
  if (hi - lo <= 2)
    for (let d = lo; d < hi; ++d)
      for (const digit of [2, 5])
        rules.push({ n: digit * 10 ** d, words: `${Number((digit * 10 ** d).toPrecision(1))}`, fine: true });
  const grid = (): HTMLElement[] => rules.map(({ n, fine }) => mark(fine ? "grid fine" : "grid", "left", at(n)));
  const axis = rowOf("", title, ...rules.map(({ n, words }) => mark("tick-label", "left", at(n), words)));
  return plotOf(title, [
    axis,
    ...rows.map((row) =>
      rowOf(
        row.label,
        `${row.label}: ${row.words}`,
        ...grid(),
        ...(row.limit === null ? [] : [mark("limit", "left", at(row.limit))]),
        row.value !== null && row.value > 0
          ? mark(row.bad ? "dot bad" : "dot", "left", at(row.value))
          : html("span", { class: "none-label" }, row.words),
      ),
    ),
  ]);
}

// Draws counts as bars that begin at zero.
export function barPlot(title: string, rows: { label: string; value: number }[]): HTMLElement {
  const most = Math.max(1, ...rows.map((r) => r.value));
  const longest = 80; // percent, so that the number fits after the bar
  return plotOf(
    title,
    rows.map(({ label, value }) => {
      const words = value.toLocaleString("en-US");
      return rowOf(label, `${label}: ${words}`, mark("bar", "width", (longest * value) / most), html("span", { class: "bar-label" }, words));
    }),
  );
}

// Draws the parts of a whole side by side, with a legend. Parts of size 0 are left out.
export function shares(title: string, parts: { kind: string; words: string; value: number }[]): HTMLElement {
  const shown = parts.filter((part) => part.value > 0);
  const whole = shown.reduce((sum, part) => sum + part.value, 0);
  return html(
    "div",
    { class: "shares", role: "img", "aria-label": `${title}: ${shown.map((part) => part.words).join(", ")}` },
    html("div", { class: "whole" }, ...shown.map((part) => mark(`share ${part.kind}`, "width", (100 * part.value) / whole))),
    html("ul", { class: "legend" }, ...shown.map((part) => html("li", {}, html("span", { class: `swatch ${part.kind}` }), part.words))),
  );
}
