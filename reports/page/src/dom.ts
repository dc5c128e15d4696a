// Elements made in one expression. All text goes in as text: nothing of the data is ever markup.

type Child = Node | string | null;
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

// A table that scrolls by itself where the window is narrow. Rows that are `aside` are grey.
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
  return html(
    "div",
    { class: "scroll", tabindex: 0, role: "region", "aria-label": caption },
    html(
      "table",
      {},
      html("caption", {}, caption),
      html("thead", {}, head),
      html("tbody", {}, ...body),
    ),
  );
}

export function section(id: string, title: string, ...children: Child[]): HTMLElement {
  return html("section", { id, "aria-labelledby": `${id}-title` }, html("h2", { id: `${id}-title` }, title), ...children);
}
