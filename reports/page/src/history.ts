// Several runs side by side, in the order in which they were given.
import { html, section, table } from "./dom";
import { kindOf, verdictWord } from "./overview";
import { logPlot } from "./plots";
import type { Run } from "./report";
import { count, share } from "./words";

const worst = (run: Run): number => Math.max(0, ...run.strata.map((s) => s.bound));

const sum = (run: Run, of: (s: Run["strata"][number]) => number): number => {
  const most = new Map<string, number>();
  for (const s of run.strata) most.set(s.family, Math.max(most.get(s.family) ?? 0, of(s)));
  return [...most.values()].reduce((a, b) => a + b, 0);
};

// Which kinds of failure were met in which run: what is new, and what is gone.
function kinds(runs: Run[]): HTMLElement | null {
  const all = [...new Set(runs.flatMap((r) => Object.keys(r.signatures)))].sort();
  if (all.length === 0) return null;
  const counts = table(
    "How often each kind of failure was met",
    [
      { head: "kind", cell: (k: string) => k },
      ...runs.map((run, i) => ({
        head: `run ${i + 1}`,
        cell: (k: string) => (run.signatures[k] === undefined ? "\u2013" : count(run.signatures[k])),
        number: true,
      })),
    ],
    all,
  );
  return html("details", { open: all.length <= 12 }, html("summary", {}, `${all.length} kinds of failure, by run`), counts);
}

export function history(runs: Run[], choose: (index: number) => void): HTMLElement {
  const numbered = runs.map((run, index) => ({ run, index }));
  type Row = (typeof numbered)[number];
  return section(
    "history",
    "History",
    html("p", {}, "Runs in the order in which they were given, the oldest first. Choose one to see it in full."),
    table(
      "Runs",
      [
        {
          head: "run",
          cell: (r: Row) =>
            html("button", { type: "button", class: "plain", click: () => choose(r.index) }, `${r.index + 1}: ${r.run.folder}`),
        },
        { head: "campaign", cell: (r: Row) => `${r.run.campaign}, seed ${r.run.seed}` },
        { head: "detector", cell: (r: Row) => r.run.detector.name },
        { head: "verdict", cell: (r: Row) => html("span", { class: `tag ${kindOf(r.run.verdict)}` }, verdictWord(r.run.verdict)) },
        { head: "trials", cell: (r: Row) => count(r.run.trials.done), number: true },
        { head: "with a defect", cell: (r: Row) => count(r.run.defect_trials), number: true },
        { head: "undecided", cell: (r: Row) => count(sum(r.run, (s) => s.undecided)), number: true },
        { head: "worst bound", cell: (r: Row) => share(worst(r.run)), number: true },
      ],
      numbered,
    ),
    logPlot(
      "Worst bound of each run",
      numbered.map(({ run, index }) => ({
        label: `${index + 1}: ${run.campaign}, seed ${run.seed}`,
        value: worst(run),
        limit: null,
        bad: run.defect_trials > 0,
        words: share(worst(run)),
      })),
    ),
    kinds(runs),
  );
}
