// What the verdict is about: the detector's claims, under which contract, how a plug-in was kept
// apart, the campaign; and what a plug-in does whatever it claims.
import { html, section, table } from "./dom";
import type { Measures, Rate, Repetition, Run, TimesOff } from "./report";
import { count } from "./words";

// Configurations that claim the same are one line.
function claimsOf(run: Run): string[] {
  const groups = new Map<string, string[]>();
  for (const { name, claims } of run.detector.claims) {
    const key = claims.length === 0 ? "nothing" : claims.join(", ");
    groups.set(key, [...(groups.get(key) ?? []), name]);
  }
  if (groups.size === 1) return [...groups.keys()];
  return [...groups].map(([claims, names]) => `${names.join(", ")}: ${claims}`);
}

// Large meshes on which the plug-in was run again and again.
function repeated(list: Repetition[]): string[] {
  const most = Math.max(...list.map((one) => one.triangles));
  const threads = Math.max(...list.flatMap((one) => one.threads), 1);
  const differing = list.filter((one) => one.broken).length;
  return [
    `${count(list.length)} sequences of up to ${count(most)} triangles, with up to ${threads} threads: ${differing === 0 ? "no two runs differ" : `runs differ on ${differing}`}`,
    ...list.filter((one) => one.what !== "").map((one) => `${one.input}: ${one.what}`),
  ];
}

const isolations: Record<string, string> = {
  full: "full: its process wrote to no file but temporary ones of its own, saw no other process, and opened no socket",
  none: "none: its process was kept apart from nothing",
};

export function judged(run: Run): HTMLElement {
  const { contract } = run.detector;
  const rows: [string, string[]][] = [
    ["Claims", claimsOf(run)],
    ...(run.not_judged.length === 0
      ? []
      : ([["Not judged", run.not_judged.map(({ claim, reason }) => `${claim}: ${reason}`)]] as [string, string[]][])),
    ["Contract", [contract.leaves_out.length === 0 ? "leaves nothing out" : contract.leaves_out.join(", ")]],
    ...(run.isolation === null ? [] : ([["Isolation", [isolations[run.isolation] ?? run.isolation]]] as [string, string[]][])),
    ...(run.repeated === null ? [] : ([["Repeated", repeated(run.repeated)]] as [string, string[]][])),
    ["Campaign", [`${run.campaign}, seed ${run.seed}`]],
  ];
  return section(
    "judged",
    "What was judged",
    html("p", {}, "The verdict speaks of these claims, under this contract, and of no others. What is not judged holds for nobody."),
    html(
      "dl",
      { class: "judged" },
      ...rows.flatMap(([name, lines]) => [html("dt", {}, name), html("dd", {}, ...lines.map((line) => html("div", {}, line)))]),
    ),
    ...measures(run),
  );
}

const rate = ({ of, in: all, interval }: Rate): string =>
  all === 0 ? "\u2013" : `${count(of)} of ${count(all)} (${percent(interval[0])} to ${percent(interval[1])})`;
const percent = (x: number): string => `${(100 * x).toPrecision(2)} %`;
const off = ({ steps, median, p99, worst }: TimesOff): string =>
  steps === 0 ? "none" : `${count(steps)}: ${[median, p99, worst].map((x) => x.toPrecision(2)).join(", ")}`;

// Beside the least possible: the pairs in contact.
const candidatesText = ({ steps, given, least, over_least }: Measures["candidates"]): string =>
  steps === 0 ? "\u2013" : `${count(given)} of ${count(least)}` + (least === 0 ? "" : `: ${over_least.toPrecision(3)} times`);

// What a plug-in does, be it claimed or not.
function measures(run: Run): HTMLElement[] {
  if (run.measures.length === 0) return [];
  type Row = Run["measures"][number];
  const gives = run.measures.some(({ measures }) => measures.candidates.steps > 0);
  return [
    html("p", {}, "Counted whatever is claimed. Intervals have a confidence of 95 %; times are shares of the step, given as median, 99 of 100, and worst."),
    table(
      "What the detector does, whatever it claims",
      [
        { head: "stratum", cell: (r: Row) => r.family },
        { head: "free, answered collision", cell: (r: Row) => rate(r.measures.false_alarms), number: true },
        { head: "contact, answered free", cell: (r: Row) => `${count(r.measures.answered_free.of)} of ${count(r.measures.answered_free.in)}`, number: true },
        { head: "spurious pairs a step", cell: (r: Row) => r.measures.spurious_pairs_a_step.toPrecision(2), number: true },
        { head: "late", cell: (r: Row) => off(r.measures.late), number: true },
        { head: "early", cell: (r: Row) => off(r.measures.early), number: true },
        ...(gives ? [{ head: "candidates, of at least", cell: (r: Row) => candidatesText(r.measures.candidates), number: true }] : []),
        { head: "left out: cases, steps", cell: (r: Row) => `${count(r.measures.left_out.cases_redrawn)}, ${count(r.measures.left_out.steps)}`, number: true },
      ],
      run.measures,
    ),
  ];
}
