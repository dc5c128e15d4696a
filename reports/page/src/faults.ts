// Shows which planted faults the harness found, and how many cases it needed for each fault.
import { folded, html, section, table } from "./dom";
import { barPlot, shares } from "./plots";
import type { Findings } from "./report";
import { count, counted } from "./words";

type Power = Findings["power"];
type Fault = Power["faults"][number];

function verdict(f: Fault): string {
  if (f.status === "planted") return f.found ? (f.found_at_random ? "found at random" : "found by its curated case alone") : f.time_over ? "the time was over" : "NOT FOUND";
  if (f.status === "open") return f.found ? "found: no longer open" : "open";
  return f.found ? "FOUND, but equivalent" : "survives, rightly";
}

// Returns a sentence about the canary that took most cases in any run. A canary that was not found
// counts as more than any number of cases.
function canaryText(canaries: Power["canaries"]): string {
  const cases = (c: { found_after: number | null }): number => c.found_after ?? Infinity;
  const worst = [...canaries].sort((a, b) => cases(b) - cases(a))[0];
  if (!worst) return "No canary was tried.";
  return worst.found_after === null
    ? `The canary (${worst.fault}) was NOT FOUND: the harness sees nothing.`
    : `The canary (${worst.fault}) was found after ${counted(worst.found_after, "case")}.`;
}

// Returns how many faults needed "1", "2 to 9", "10 to 99" ... random cases.
function byCases(faults: Fault[]): { label: string; value: number }[] {
  const medians = faults.flatMap((f) => (f.median_cases === null ? [] : [f.median_cases]));
  const rows: { label: string; value: number }[] = [];
  for (let lo = 1; lo <= Math.max(0, ...medians); lo = lo === 1 ? 2 : lo === 2 ? 10 : 10 * lo) {
    const hi = lo === 1 ? 1 : lo === 2 ? 9 : 10 * lo - 1;
    const label = lo === hi ? "1 case" : `${count(lo)} to ${count(hi)} cases`;
    rows.push({ label, value: medians.filter((n) => lo <= n && n <= hi).length });
  }
  const bySomeSeeds = faults.filter((f) => f.median_cases === null && f.found_at_random).length;
  if (bySomeSeeds > 0) rows.push({ label: "found under fewer than half of the seeds", value: bySomeSeeds });
  return rows;
}

function allOf(list: Fault[]): HTMLElement {
  return table(
    "Faults, and the number of random cases needed to find each",
    [
      { head: "fault", cell: (f: Fault) => html("span", {}, f.fault, f.about ? html("span", { class: "about" }, f.about) : null) },
      { head: "law", cell: (f: Fault) => f.law },
      { head: "cases (median)", cell: (f: Fault) => (f.median_cases === null ? "\u2013" : count(f.median_cases)), number: true },
      { head: "curated case", cell: (f: Fault) => (f.curated ? "shows it" : "\u2013") },
      { head: "verdict", cell: verdict },
    ],
    list,
  );
}

export function faults({ power }: Findings): HTMLElement {
  const title = "Planted faults";
  const canary = canaryText(power.canaries);
  const list = power.faults;
  if (list.length === 0) return section("faults", title, html("p", {}, canary, " No faults were planted in this run."));
  const planted = list.filter((f) => f.status === "planted");
  const lost = planted.filter((f) => !f.found);
  const { taken_from: from } = power;
  const rows = byCases(planted);
  return section(
    "faults",
    title,
    html(
      "p",
      {},
      html("strong", {}, `${power.found} of ${power.planted} planted faults were found: ${power.found_at_random} by random cases, ${power.found_by_curated_case_alone} by their curated case alone.`),
      " A planted fault is a detector that is wrong on purpose, in one stage. A curated case was written for its fault, and proves only that the harness sees the fault. ",
      canary,
      from === null
        ? null
        : ` The faults were planted by campaign ${from.campaign}, seed ${from.seed}, of the same build. That they were found proves the harness, not this detector.`,
    ),
    shares("Planted faults", [
      { kind: "at-random", words: `by random cases: ${power.found_at_random}`, value: power.found_at_random },
      { kind: "by-curated", words: `by their curated case alone: ${power.found_by_curated_case_alone}`, value: power.found_by_curated_case_alone },
      { kind: "lost", words: `not found: ${lost.length}`, value: lost.length },
    ]),
    lost.length === 0 ? null : html("p", {}, `Not found: ${lost.map((f) => f.fault).join(", ")}.`),
    rows.length === 0 ? null : html("h3", {}, "Random cases needed to find a fault (median over seeds)"),
    rows.length === 0 ? null : barPlot("Number of faults by the random cases needed to find them", rows),
    folded(`All ${list.length} faults, with those that are equivalent or open`, allOf(list)),
  );
}
