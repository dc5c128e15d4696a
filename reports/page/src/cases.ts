// What the cases were: laws met, sizes, contacts, set pairs.
import { html, section, table } from "./dom";
import { barPlot } from "./plots";
import type { Law, Run, World } from "./report";
import { count } from "./words";

export function laws(run: Run): HTMLElement | null {
  if (run.laws.length === 0) return null;
  const close = (l: Law): string => (l.premise ? `${Math.round((100 * l.close) / l.premise)} %` : "\u2013");
  return section(
    "laws",
    "Laws",
    html("p", {}, "How often each law\u2019s premise held, how often it was close to being broken, and how often it was."),
    table(
      "Laws",
      [
        { head: "law", cell: (l: Law) => l.name },
        { head: "premise", cell: (l: Law) => count(l.premise) + (l.premise < l.wanted_premise ? " (too few)" : ""), number: true },
        { head: "close", cell: close, number: true },
        { head: "broken", cell: (l: Law) => count(l.broken), number: true },
      ],
      run.laws,
    ),
  );
}

// The exhaustive part: no bound, but all there is on a small grid.
export function worlds(run: Run): HTMLElement | null {
  if (run.worlds.length === 0) return null;
  return section(
    "worlds",
    "Every motion of a tetrahedron",
    table(
      "On a small grid, up to symmetry",
      [
        { head: "world", cell: (w: World) => w.world },
        { head: "classes proved", cell: (w: World) => (w.classes === null ? "\u2013" : count(w.classes)), number: true },
        { head: "motions", cell: (w: World) => (w.motions === null ? "\u2013" : count(w.motions)), number: true },
        { head: "outcome", cell: (w: World) => w.counterexample ?? (w.complete ? "all of it holds" : "the time was over") },
      ],
      run.worlds,
    ),
  );
}

// [from, to, cases] of all families together, ascending.
function together(lists: number[][][]): { label: string; value: number }[] {
  const sums = new Map<number, [number, number]>();
  for (const list of lists)
    for (const [lo, hi, n] of list as [number, number, number][])
      sums.set(lo, [hi, (sums.get(lo)?.[1] ?? 0) + n]);
  return [...sums.entries()]
    .sort((a, b) => a[0] - b[0])
    .map(([lo, [hi, n]]) => ({ label: lo === 0 ? "none" : lo === hi ? `${lo}` : `${lo} to ${hi}`, value: n }));
}

export function cases(run: Run): HTMLElement {
  const sets = run.set_pairs;
  const tags = Object.entries(run.tags).sort((a, b) => a[0].localeCompare(b[0]));
  return section(
    "cases",
    "The cases",
    html("h3", {}, "Cases by number of triangles"),
    barPlot("Cases by number of triangles", together(run.distributions.map((d) => d.triangles))),
    html("h3", {}, "Cases by pairs in contact"),
    barPlot("Cases by number of pairs in contact", together(run.distributions.map((d) => d.pairs))),
    sets.length === 0
      ? null
      : table(
          "Contacts by the view sets of their two triangles",
          [
            { head: "sets", cell: (s) => s.sets },
            { head: "contacts", cell: (s) => count(s.contacts), number: true },
            { head: "first contacts", cell: (s) => count(s.first_contacts), number: true },
          ],
          sets,
        ),
    tags.length === 0
      ? null
      : html(
          "details",
          {},
          html("summary", {}, `${tags.length} tags: what the generator put into the cases`),
          table(
            "Cases by tag",
            [
              { head: "tag", cell: ([tag]) => tag },
              { head: "cases", cell: ([, n]) => count(n), number: true },
            ],
            tags,
          ),
        ),
  );
}
