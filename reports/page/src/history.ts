// Shows several runs side by side, in the order in which they were given.
import { addressIn } from "./address";
import { folded, html, section, table } from "./dom";
import { kindOf, named, seedsText, verdictWord } from "./overview";
import { logPlot } from "./plots";
import type { Run } from "./report";
import { open } from "./strata";
import { count, share, sum } from "./words";

const worst = ({ findings: { strata } }: Run): number => Math.max(0, ...strata.flatMap((s) => s.bounds.map((b) => b.bound)));

const trials = ({ findings: { strata } }: Run): number => sum(strata.map((s) => s.trials));
const withDefect = ({ findings: { strata } }: Run): number => sum(strata.map((s) => s.with_defect));
// Sums the undecided cases over the families. In each family the configuration with most of them
// counts.
const undecided = ({ findings: { strata } }: Run): number => sum(strata.map((s) => Math.max(0, ...s.bounds.map(open))));

const nameOf = ({ findings: { campaign } }: Run): string => `${campaign.name}, ${seedsText(campaign)}`;

// Shows which kinds of failure were met in which run, so that new and vanished kinds are seen.
function kinds(runs: Run[]): HTMLElement | null {
  const met = runs.map((run) => new Map(run.findings.failures.filter((f) => f.met > 0).map((f) => [f.signature, f.met])));
  const all = [...new Set(met.flatMap((of) => [...of.keys()]))].sort();
  if (all.length === 0) return null;
  const counts = table(
    "How often each kind of failure was met",
    [
      { head: "kind", cell: (k: string) => k },
      ...met.map((of, i) => ({
        head: `run ${i + 1}`,
        cell: (k: string) => { const times = of.get(k); return times === undefined ? "\u2013" : count(times); },
        number: true,
      })),
    ],
    all,
  );
  return all.length <= 12 ? counts : folded(`${all.length} kinds of failure, by run`, counts);
}

export function history(runs: Run[]): HTMLElement {
  const numbered = runs.map((run, index) => ({ run, index }));
  type Row = (typeof numbered)[number];
  return section(
    "history",
    "History",
    html("p", {}, "Runs in the order in which they were given, the oldest first. Choose a run to see it in full."),
    table(
      "Runs",
      [
        {
          head: "run",
          cell: (r: Row) => html("a", { href: addressIn(r.index)("") }, `${r.index + 1}: ${r.run.folder}`),
        },
        { head: "campaign", cell: (r: Row) => nameOf(r.run) },
        { head: "detector", cell: (r: Row) => named(r.run.findings).name },
        { head: "version", cell: (r: Row) => named(r.run.findings).version ?? "\u2013" },
        { head: "verdict", cell: (r: Row) => html("span", { class: `tag ${kindOf(r.run.verdict)}` }, verdictWord(r.run.verdict)) },
        { head: "trials", cell: (r: Row) => count(trials(r.run)), number: true },
        { head: "with a defect", cell: (r: Row) => count(withDefect(r.run)), number: true },
        { head: "undecided", cell: (r: Row) => count(undecided(r.run)), number: true },
        { head: "worst bound", cell: (r: Row) => share(worst(r.run)), number: true },
      ],
      numbered,
    ),
    html("h3", {}, "Worst bound of each run"),
    logPlot(
      "Worst bound of each run",
      numbered.map(({ run, index }) => ({
        label: `${index + 1}: ${nameOf(run)}`,
        value: worst(run),
        limit: null,
        bad: withDefect(run) > 0,
        words: share(worst(run)),
      })),
    ),
    kinds(runs),
  );
}
