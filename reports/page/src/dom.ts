// Makes an element in one expression. All data is inserted as text, never as markup.

export type Child = Node | string | null;
type Attributes = Record<string, string | number | boolean | ((event: Event) => void)>;

function fill(element: Element, attributes: Attributes, children: Child[]): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name, value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false) element.setAttribute(name, String(value));
  }
  for (const child of children) if (child !== null) element.append(child);
}

export function html<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  fill(element, attributes, children);
  return element;
}

export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: Child[]
): SVGElementTagNameMap[K] {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  fill(element, attributes, children);
  return element;
}

export interface Column<Row> {
  head: string;
  cell: (row: Row) => Child;
  number?: boolean;
  short?: boolean; // never broken into lines
}

// Marks each table that is wider than its place, so that the style can show that the table scrolls.
const widths = new ResizeObserver((entries) => {
  for (const { target } of entries) {
    const scroll = target.closest(".scroll")!;
    scroll.classList.toggle("is-wide", scroll.scrollWidth > scroll.clientWidth + 1);
  }
});

// Makes a table that scrolls by itself if the window is narrow. Rows that are `aside` are grey.
export function table<Row>(
  caption: string,
  columns: Column<Row>[],
  rows: Row[],
  aside: (row: Row) => boolean = () => false,
): HTMLElement {
  const kind = (column: Column<Row>): Attributes =>
    column.number ? { class: "number" } : column.short ? { class: "short" } : {};
  const head = html("tr", {}, ...columns.map((c) => html("th", { scope: "col", ...kind(c) }, c.head)));
  const body = rows.map((row) =>
    html("tr", aside(row) ? { class: "quiet" } : {}, ...columns.map((c) => html("td", kind(c), c.cell(row)))),
  );
  const made = html(
    "table",
    {},
    html("caption", {}, html("span", {}, caption)),
    html("thead", {}, head),
    html("tbody", {}, ...body),
  );
  const scroll = html("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": caption }, made);
  widths.observe(scroll);
  widths.observe(made);
  return scroll;
}

export function section(id: string, title: string, ...children: Child[]): HTMLElement {
  const heading = html("h2", { id: `${id}-title` }, title);
  return html("section", { id, tabindex: -1, "aria-labelledby": heading.id }, heading, ...children);
}

// Makes a list of names with their values. A value has one or more lines. A name without a value is
// left out.
export function facts(rows: [string, Child[] | string | null][]): HTMLElement {
  const shown = rows.filter(([, value]) => value !== null && value.length > 0);
  return html(
    "dl",
    {},
    ...shown.flatMap(([name, value]) => [
      html("dt", {}, name),
      html("dd", {}, ...(Array.isArray(value) ? value.map((line) => html("div", {}, line)) : [value])),
    ]),
  );
}

// Makes a part that is folded until the reader opens it. On paper it is unfolded.
export const folded = (title: string, ...children: Child[]): HTMLElement =>
  html("details", {}, html("summary", {}, title), ...children);
