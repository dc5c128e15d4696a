// Small plots as SVG, drawn by classes of the style sheet; each has its data in a table too.
import { svg } from "./dom";

export interface LogRow {
  label: string;
  value: number | null;
  limit: number | null; // a mark that the value should stay below
  bad: boolean;
  kind?: string; // a class for the row's words, which gives them a colour of their own
  words: string;
}

const wide = 720;
const letter = 6.6;
const right = 16;
const rowHeight = 22;
const head = 26;

const power = (n: number): string =>
  String(n).replace("-", "\u207b").replace(/[0-9]/g, (d) => "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"[Number(d)]!);

// Whole decades around all numbers.
function decades(rows: LogRow[]): [number, number] {
  const numbers = rows.flatMap((r) => [r.value, r.limit]).filter((n): n is number => n !== null && n > 0);
  const lo = Math.floor(Math.log10(Math.min(...numbers)) + 1e-9);
  const hi = Math.ceil(Math.log10(Math.max(...numbers)) - 1e-9);
  return [lo, Math.max(hi, lo + 1)];
}

// The place of the row labels: as wide as the longest.
const widthOfLabels = (rows: { label: string }[]): number =>
  Math.max(230, ...rows.map((row) => 20 + letter * row.label.length));

const yOf = (row: number): number => head + rowHeight * (row + 0.5);

function frame(title: string, rows: number): SVGSVGElement {
  return svg(
    "svg",
    { class: "plot", viewBox: `0 0 ${wide} ${head + rows * rowHeight + 8}`, role: "img", "aria-label": title },
    svg("title", {}, title),
  );
}

// A disc a row on a logarithmic axis, a bar where the limit is.
export function logPlot(title: string, rows: LogRow[]): SVGSVGElement | null {
  if (!rows.some((r) => r.value !== null && r.value > 0)) return null;
  const [lo, hi] = decades(rows);
  const labels = widthOfLabels(rows);
  const x = (n: number): number => labels + ((wide - right - labels) * (Math.log10(n) - lo)) / (hi - lo);
  const plot = frame(title, rows.length);
  const rule = (n: number, label: string, kind: string): void => {
    const at = x(n);
    plot.append(
      svg("line", { class: kind, x1: at, x2: at, y1: head, y2: head + rows.length * rowHeight }),
      svg("text", { x: at, y: 16, class: "tick-label" }, label),
    );
  };
  for (let d = lo; d <= hi; ++d) rule(10 ** d, d === 0 ? "1" : `10${power(d)}`, "grid");
  // Few decades: their inner lines help.
  if (hi - lo <= 2)
    for (let d = lo; d < hi; ++d) for (const digit of [2, 5]) rule(digit * 10 ** d, `${Number((digit * 10 ** d).toPrecision(1))}`, "grid fine");
  rows.forEach((row, i) => {
    const y = yOf(i);
    plot.append(svg("text", { x: labels - 10, y: y + 4, class: "row-label" }, row.label));
    const group = svg("g", {}, svg("title", {}, `${row.label}: ${row.words}`));
    if (row.limit !== null)
      group.append(svg("line", { class: "limit", x1: x(row.limit), x2: x(row.limit), y1: y - 8, y2: y + 8 }));
    if (row.value !== null && row.value > 0) {
      group.append(
        svg("line", { class: "stem", x1: x(10 ** lo), x2: x(row.value), y1: y, y2: y }),
        row.bad
          ? svg("path", { class: "dot bad", d: `M${x(row.value)} ${y - 6}l6 6-6 6-6-6Z` })
          : svg("circle", { class: "dot", cx: x(row.value), cy: y, r: 5 }),
      );
    } else group.append(svg("text", { x: labels + 4, y: y + 4, class: `none-label ${row.kind ?? ""}`.trim() }, row.words));
    plot.append(group);
  });
  return plot;
}

// Bars of counts, from zero.
export function barPlot(title: string, rows: { label: string; value: number }[]): SVGSVGElement {
  const most = Math.max(1, ...rows.map((r) => r.value));
  const labels = widthOfLabels(rows);
  const plot = frame(title, rows.length);
  rows.forEach((row, i) => {
    const y = yOf(i);
    const width = ((wide - right - labels - 70) * row.value) / most;
    plot.append(
      svg("text", { x: labels - 10, y: y + 4, class: "row-label" }, row.label),
      svg("rect", { class: "bar", x: labels, y: y - 7, width, height: 14 }),
      svg("text", { x: labels + width + 6, y: y + 4, class: "bar-label" }, row.value.toLocaleString("en-US")),
    );
  });
  return plot;
}
