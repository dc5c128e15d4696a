// Describes the cases of a campaign: how often laws were tested, sizes, contacts, pairs of view
// sets.
import { folded, html, section, table } from "./dom";
import { barPlot } from "./plots";
import type { Findings, Run } from "./report";
import { count, counted } from "./words";

export function laws({ findings: { laws: told }, law_statements: statements }: Run): HTMLElement | null {
  type Law = NonNullable<Findings["laws"]>["laws"][number];
  const wanted = told?.wanted_premises ?? 0;
  const shown = (told?.laws ?? []).filter((law) => law.premises > 0 || wanted > 0);
  if (shown.length === 0) return null;
  const close = (l: Law): string => (l.premises ? `${Math.round((100 * l.close) / l.premises)} %` : "\u2013");
  const rowsOf = (caption: string, list: Law[]): HTMLElement =>
    table(
      caption,
      [
        { head: "law", cell: (l: Law) => html("span", {}, statements[l.law] ?? l.law, html("span", { class: "about" }, l.law.startsWith(l.number) ? l.law : `${l.number}: ${l.law}`)) },
        { head: "premise", cell: (l: Law) => count(l.premises) + (l.premises < wanted ? " (too few)" : ""), number: true },
        { head: "close", cell: close, number: true },
        { head: "broken", cell: (l: Law) => count(l.broken), number: true },
      ],
      list,
    );
  const isBad = (l: Law): boolean => l.broken > 0 || l.premises < wanted;
  const bad = shown.filter(isBad);
  const broken = shown.filter((l) => l.broken > 0).length;
  const fewest = Math.min(...shown.map((l) => l.premises));
  return section(
    "laws",
    "Laws",
    html(
      "p",
      {},
      html("strong", {}, `${counted(shown.length, "law")} of the theory were tested on the cases: ${broken === 0 ? "none was broken" : `${broken} of them were broken`}.`),
      ` The premise of each law held in ${counted(fewest, "step")} or more${wanted > 0 ? `; ${count(wanted)} are wanted` : ""}. ` +
        "A step is close if it almost broke the law or almost left its premise.",
    ),
    bad.length === 0 ? null : rowsOf("Laws that were broken, or met too seldom", bad),
    shown.length === bad.length ? null : folded(`What ${counted(shown.length - bad.length, "law that holds says", "laws that hold say")}`, rowsOf("Laws, and how often each was met", shown.filter((l) => !isBad(l)))),
  );
}

// Shows the exhaustive part of a run: it needs no bound, because it proves all motions on a small
// grid.
export function worlds(f: Findings): HTMLElement | null {
  type World = Findings["power"]["worlds"][number];
  if (f.power.worlds.length === 0) return null;
  return section(
    "worlds",
    "Every motion of a tetrahedron",
    table(
      "On a small grid, up to symmetry",
      [
        { head: "world", cell: (w: World) => w.world },
        { head: "classes proved", cell: (w: World) => (w.classes === null ? "\u2013" : count(w.classes)), number: true },
        { head: "motions", cell: (w: World) => (w.motions === null ? "\u2013" : count(w.motions)), number: true },
        { head: "outcome", cell: (w: World) => w.counterexample ?? (w.complete ? "no counterexample in any motion" : "the time was over") },
      ],
      f.power.worlds,
    ),
  );
}

// Sums the cases of all families in each range [from, to, cases], and sorts the ranges.
function together(lists: [number, number, number][][]): { label: string; value: number }[] {
  const sums = new Map<number, [number, number]>();
  for (const list of lists)
    for (const [lo, hi, n] of list)
      sums.set(lo, [hi, (sums.get(lo)?.[1] ?? 0) + n]);
  return [...sums.entries()]
    .sort((a, b) => a[0] - b[0])
    .map(([lo, [hi, n]]) => ({ label: lo === 0 ? "none" : lo === hi ? `${lo}` : `${lo} to ${hi}`, value: n }));
}

export function cases(f: Findings): HTMLElement {
  const { distributions, set_pairs: sets } = f.cases;
  const tags = Object.entries(f.cases.tags).sort((a, b) => a[0].localeCompare(b[0]));
  const sizes = together(distributions.map((d) => d.triangles));
  if (sizes.length === 0) return section("cases", "The cases", html("p", {}, "No case was judged."));
  return section(
    "cases",
    "The cases",
    html("h3", {}, "Cases by number of triangles"),
    barPlot("Cases by number of triangles", sizes),
    html("h3", {}, "Cases by number of pairs in contact"),
    barPlot("Cases by number of pairs in contact", together(distributions.map((d) => d.pairs))),
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
      : folded(
          `${tags.length} tags: what the generator put into the cases`,
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
