// Strata with their counts and bounds.
import { html, section, table } from "./dom";
import { scope } from "./overview";
import { logPlot } from "./plots";
import type { Run, Stratum } from "./report";
import { count, counted, share } from "./words";

const who = (s: Stratum): string =>
  s.configurations.length === 1 ? s.configurations[0]! : `each of ${s.configurations.length}`;

export function strata(run: Run): HTMLElement {
  const isAbove = (s: Stratum): boolean => s.wanted !== null && s.bound > s.wanted;
  const many = run.strata.some((s, i) => run.strata[i - 1]?.family === s.family);
  const plot = logPlot(
    "Upper bound of each stratum, with the bound wanted",
    run.strata.map((s) => ({
      label: many ? `${s.family}, ${who(s)}` : s.family,
      value: s.bound,
      limit: s.wanted,
      bad: s.defects > 0 || isAbove(s),
      words: s.wanted === null ? share(s.bound) : `${share(s.bound)}, wanted at most ${share(s.wanted)}`,
    })),
  );
  return section(
    "strata",
    "Strata and bounds",
    scope(run),
    plot,
    html("p", { class: "note" }, "A disc or a diamond: the bound; a diamond where there is a defect or the bound is above what is wanted; an upright bar: the bound wanted."),
    table(
      "Trials and bounds by stratum",
      [
        { head: "stratum", cell: (s: Stratum) => s.family },
        { head: "configuration", cell: who },
        { head: "n", cell: (s: Stratum) => (s.n === s.planned ? count(s.n) : `${count(s.n)} of ${count(s.planned)}`), number: true },
        { head: "holds", cell: (s: Stratum) => count(s.holds), number: true },
        { head: "defects", cell: (s: Stratum) => count(s.defects), number: true },
        { head: "undecided", cell: (s: Stratum) => count(s.undecided), number: true },
        { head: "bound", cell: (s: Stratum) => share(s.bound), number: true },
        { head: "wanted", cell: (s: Stratum) => (s.wanted === null ? "\u2013" : share(s.wanted)), number: true },
        { head: "collide", cell: (s: Stratum) => (s.steps ? `${Math.round((100 * s.collisions) / s.steps)} %` : "\u2013"), number: true },
        { head: "steps/s a core", cell: (s: Stratum) => (s.steps_per_second === null ? "\u2013" : count(Math.round(s.steps_per_second))), number: true },
      ],
      run.strata,
    ),
    ...configurations(run),
  );
}

function configurations(run: Run): HTMLElement[] {
  if (run.detector.configurations.length < 2) return [];
  const names = run.detector.configurations;
  return [html("p", { class: "note" }, `The ${counted(names.length, "configuration")}: ${names.join(", ")}.`)];
}
