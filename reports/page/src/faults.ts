// Planted faults: what the harness was shown to find, and how small it made each.
import { html, section, table } from "./dom";
import { logPlot } from "./plots";
import type { Findings } from "./report";
import { count, counted } from "./words";

type Fault = Findings["power"]["faults"][number];

function verdict(f: Fault): string {
  if (f.status === "planted") return f.found ? (f.found_at_random ? "found at random" : "found by its curated case alone") : f.time_over ? "the time was over" : "NOT FOUND";
  if (f.status === "open") return f.found ? "found: no longer open" : "open";
  return f.found ? "FOUND, but equivalent" : "survives, rightly";
}

// The median is none if most seeds did not show the fault.
function wordsOf(f: Fault): string {
  if (f.median_cases !== null) return counted(f.median_cases, "case");
  if (f.found_at_random) return `by random cases of ${f.needed.filter((n) => n !== null).length} of ${f.needed.length} seeds`;
  return f.found ? "by its curated case alone" : "not found";
}

const details = (title: string, content: HTMLElement): HTMLElement =>
  html("details", {}, html("summary", {}, title), content);

// The worst of all shards: one that was not found is worse than any number of cases.
function canaryText(canaries: Findings["power"]["canaries"]): string {
  const cases = (c: { found_after: number | null }): number => c.found_after ?? Infinity;
  const worst = [...canaries].sort((a, b) => cases(b) - cases(a))[0];
  if (!worst) return "No canary was met.";
  return worst.found_after === null
    ? `The canary (${worst.fault}) was NOT FOUND: the harness sees nothing.`
    : `The canary (${worst.fault}) was found after ${counted(worst.found_after, "case")}.`;
}

export function faults({ power }: Findings): HTMLElement {
  const title = "Planted faults";
  const canary = canaryText(power.canaries);
  const list = power.faults;
  if (list.length === 0) return section("faults", title, html("p", {}, canary, " No faults were planted in this run."));
  const planted = list.filter((f) => f.status === "planted");
  const lost = planted.filter((f) => !f.found);
  const shrunk = list.filter((f) => f.shrunk);
  return section(
    "faults",
    title,
    html(
      "p",
      {},
      `${canary} ${power.found} of ${power.planted} planted faults were found, ${power.found_at_random} by random cases, ` +
        `${power.found_by_curated_case_alone} by their curated case alone. A planted fault is a detector that is wrong on purpose, in one stage. ` +
        "The cases that each takes say how sharp the campaign is; a curated case was written for its fault, and proves only that the harness sees it." +
        (power.taken_from === null
          ? ""
          : ` They were planted by campaign ${power.taken_from.campaign}, seed ${power.taken_from.seed}, of the same build: they prove the harness, not this detector.`),
    ),
    lost.length === 0 ? null : html("p", {}, `Not found: ${lost.map((f) => f.fault).join(", ")}.`),
    logPlot(
      "Random cases until each planted fault showed (median over seeds)",
      [...planted]
        .sort((a, b) => (b.median_cases ?? Infinity) - (a.median_cases ?? Infinity))
        .map((f) => ({
          label: f.fault,
          value: f.median_cases,
          limit: null,
          bad: !f.found,
          kind: f.found && !f.found_at_random ? "curated" : "",
          words: wordsOf(f),
        })),
    ),
    details(`All ${list.length} faults, with those that are equivalent or open`, table(
      "Faults, and the cases that each took",
      [
        { head: "fault", cell: (f: Fault) => (f.about ? html("span", { title: f.about }, f.fault) : f.fault) },
        { head: "law", cell: (f: Fault) => f.law },
        { head: "cases (median)", cell: (f: Fault) => (f.median_cases === null ? "\u2013" : count(f.median_cases)), number: true },
        { head: "curated case", cell: (f: Fault) => (f.curated ? "shows it" : "\u2013") },
        { head: "verdict", cell: verdict },
      ],
      list,
    )),
    shrunk.length === 0
      ? html("p", { class: "note" }, "This campaign does not shrink what planted faults show.")
      : table(
          "How small each fault's mesh became",
          [
            { head: "fault", cell: (f: Fault) => f.fault },
            { head: "triangles, steps from", cell: (f: Fault) => `${f.shrunk!.before.triangles}, ${f.shrunk!.before.steps}`, number: true },
            { head: "to vertices", cell: (f: Fault) => count(f.shrunk!.after.vertices), number: true },
            { head: "smallest known", cell: (f: Fault) => (f.known_vertices === 0 ? "\u2013" : count(f.known_vertices)), number: true },
            { head: "runs", cell: (f: Fault) => count(f.shrunk!.calls), number: true },
          ],
          shrunk,
        ),
  );
}
