// Shows the strata with their counts and bounds.
import { html, section, table } from "./dom";
import { logPlot } from "./plots";
import type { Findings, Stratum } from "./report";
import { count, counted, share } from "./words";

type Bound = Stratum["bounds"][number];

interface Row {
  stratum: Stratum;
  bound: Bound;
  who: string;
}

// Returns the number of cases without a verdict.
export const open = ({ undecided, errors }: Bound): number => undecided + errors;

// Makes one row for all configurations of a stratum if they agree, and otherwise a row for each.
const rowsOf = (f: Findings): Row[] =>
  f.strata.flatMap((stratum) => {
    const rows = stratum.bounds.map((bound) => ({ stratum, bound, who: bound.configuration }));
    return stratum.agree && rows.length > 1 ? [{ ...rows[0]!, who: `each of ${rows.length}` }] : rows;
  });

function stepsPerSecond(f: Findings, { family, steps }: Stratum): string {
  const times = f.times.strata.find((t) => t.family === family);
  const seconds = times ? 1e-6 * (times.oracle_us + times.detector_us) : 0;
  return seconds > 0 ? count(Math.round(steps / seconds)) : "\u2013";
}

function scope({ confidence }: Findings): HTMLElement {
  const percent = Math.round(100 * confidence.family);
  return html(
    "div",
    { class: "scope" },
    html("p", {}, html("strong", {}, "What the bounds speak of: "),
      "the share of cases of this campaign\u2019s random generator on which a claim does not hold. " +
      "The bounds say nothing of other meshes, yours included, unless those meshes are like the generator\u2019s meshes."),
    html("p", {}, `All ${count(confidence.bounds)} bounds hold together with a confidence of ${percent} % (exact one-sided bounds of Clopper and Pearson, Bonferroni). ` +
      "The bounds of the strata of sizes (size-\u2026) are not among them: each of those holds by itself. A trial is a whole case; undecided trials count against the detector."),
  );
}

export function strata(f: Findings): HTMLElement {
  const rows = rowsOf(f);
  const many = rows.length > f.strata.length;
  const plot = logPlot(
    "Upper bound of each stratum, with the bound wanted",
    rows.map(({ stratum: { family, wanted_bound: wanted }, bound: { bound, defects, met }, who }) => ({
      label: many ? `${family}, ${who}` : family,
      value: bound,
      limit: wanted,
      bad: defects > 0 || !met,
      words: wanted === null ? share(bound) : `${share(bound)}, wanted at most ${share(wanted)}`,
    })),
  );
  return section(
    "strata",
    "Strata and bounds",
    scope(f),
    plot,
    html("p", { class: "note" }, "Each disc or diamond is a bound. It is a diamond if there is a defect or the bound is not met. An upright bar is the bound wanted."),
    table(
      "Trials and bounds by stratum",
      [
        { head: "stratum", cell: (r: Row) => r.stratum.family },
        { head: "configuration", cell: (r: Row) => r.who },
        { head: "n", cell: ({ stratum, bound: { n } }: Row) => (n === stratum.planned ? count(n) : `${count(n)} of ${count(stratum.planned)}`), number: true },
        { head: "holds", cell: (r: Row) => count(r.bound.holds), number: true },
        { head: "defects", cell: (r: Row) => count(r.bound.defects), number: true },
        { head: "undecided", cell: (r: Row) => count(open(r.bound)), number: true },
        { head: "bound", cell: (r: Row) => share(r.bound.bound), number: true },
        { head: "wanted", cell: ({ stratum: { wanted_bound: wanted } }: Row) => (wanted === null ? "\u2013" : share(wanted)), number: true },
        { head: "collide", cell: ({ stratum: { steps, collisions } }: Row) => (steps ? `${Math.round((100 * collisions) / steps)} %` : "\u2013"), number: true },
        { head: "steps/s a core", cell: (r: Row) => stepsPerSecond(f, r.stratum), number: true },
      ],
      rows,
    ),
    ...configurations(f),
  );
}

function configurations(f: Findings): HTMLElement[] {
  if (f.detector.configurations.length < 2) return [];
  const names = f.detector.configurations.map((c) => c.name);
  return [html("p", { class: "note" }, `The ${counted(names.length, "configuration")}: ${names.join(", ")}.`)];
}
