// Shows the scope of the verdict: the detector's claims, its contract, a plug-in's isolation, and
// the campaign. Then come the measures of a plug-in, which do not depend on its claims.
import type { Rate, TimesOff } from "../made/certificate";
import { facts, html, section, table } from "./dom";
import { seedsText } from "./overview";
import type { Findings, Stratum } from "./report";
import { count, counted } from "./words";

// Puts configurations with the same claims into one line.
function claimsOf(f: Findings): string[] {
  const groups = new Map<string, string[]>();
  for (const { name, claims } of f.detector.configurations) {
    const key = claims.length === 0 ? "nothing" : claims.join(", ");
    groups.set(key, [...(groups.get(key) ?? []), name]);
  }
  if (groups.size === 1) return [...groups.keys()];
  return [...groups].map(([claims, names]) => `${names.join(", ")}: ${claims}`);
}

// Describes the large meshes on which the plug-in was run several times.
function repeated(list: NonNullable<Findings["repeated"]>): string[] {
  const most = Math.max(...list.map((one) => one.triangles));
  const threads = Math.max(...list.flatMap((one) => one.threads), 1);
  const differing = list.filter((one) => one.broken).length;
  const steps = list.flatMap((one) => one.judged);
  const wrong = steps.filter((one) => !one.holds).length;
  return [
    `${count(list.length)} sequences of up to ${count(most)} triangles, with up to ${threads} threads: ${differing === 0 ? "no two runs differ" : `runs differ on ${differing} of them`}`,
    `${count(steps.length)} of their steps were judged by the oracle, ${count(steps.filter((one) => one.contacts > 0).length)} of them with a contact: ${wrong === 0 ? "no step breaks a claim" : `${counted(wrong, "step breaks", "steps break")} a claim`}`,
    ...list.filter((one) => one.what !== "").map((one) => `${one.input}: ${one.what}`),
  ];
}

// Says how many cases the search made, and what it found. Its cases are no trials.
const searched = (s: NonNullable<Findings["search"]>): string =>
  `${count(s.cases)} aimed cases, ${s.defects === 0 ? "none" : count(s.defects)} with a defect; the archives hold ${count(s.causes.length)} causes of contact`;

// Returns each size with the claims that were tried on meshes up to this size, the largest size
// first.
function sizesOf(list: Findings["judged_up_to"]): string[] {
  const sizes = new Map<number, string[]>();
  for (const { claim, triangles } of list) sizes.set(triangles, [...(sizes.get(triangles) ?? []), claim]);
  return [...sizes].sort(([a], [b]) => b - a).map(([triangles, claims]) => `${triangles === 0 ? "none yet" : `up to ${count(triangles)} triangles`}: ${claims.join(", ")}`);
}

// Returns the largest value of each measure among the judged meshes.
const triedText = ({ largest: most, relations }: NonNullable<Findings["tried"]>): string =>
  `${counted(most.steps_in_a_row, "step")} between two starts, ${counted(most.valence, "triangle")} at a vertex, ${counted(most.bodies, "body", "bodies")}, ${counted(most.components, "component")}, ${counted(most.pairs, "pair")} in a step, ${counted(most.triangles, "triangle")}; relations: ${counted(relations, "case")}`;

// Returns what was not judged: claims, parts of the library, families.
const notJudged = (f: Findings): string[] => [
  ...f.not_judged.map(({ claim, reason }) => `${claim}: ${reason}`),
  ...f.detector.unjudged_parts.map((part) => `the ${part} of this library`),
  ...f.left_out_families.map((family) => `family ${family}, which the contract leaves out`),
];

const isolations: Record<string, string> = {
  bubblewrap: "bubblewrap: the plug-in's process had limits, wrote only temporary files of its own, saw no other process, and had no network",
  "limits alone": "limits alone: the plug-in's process had limits of processor time, memory, files and processes, and no other isolation",
};

export function judged(f: Findings): HTMLElement {
  const { contract } = f.detector;
  const rows: [string, string[] | null][] = [
    ["Claims", claimsOf(f)],
    ["Claims of its query", f.detector.query_claims.length === 0 || f.judged_up_to.length === 0 ? null : [f.detector.query_claims.join(", ")]],
    ["Not judged", notJudged(f)],
    ["Tried on meshes", sizesOf(f.judged_up_to)],
    ["Largest tried", f.tried === null ? null : [triedText(f.tried)]],
    ["Contract", [contract.leaves_out.length === 0 ? "leaves nothing out" : contract.leaves_out.join(", ")]],
    ["Isolation", f.isolation === null ? null : [isolations[f.isolation] ?? f.isolation]],
    ["Larger meshes", f.repeated === null ? null : repeated(f.repeated)],
    ["Search", f.search === null ? null : [searched(f.search)]],
    ["Campaign", [`${f.campaign.name}, ${seedsText(f.campaign)}${f.campaign.is_default_seed ? ", the default seed, whose cases everybody knows" : ""}`]],
  ];
  return section(
    "judged",
    "What was judged",
    html("p", {}, "The verdict speaks of these claims, under this contract. It says nothing about claims that were not judged, about meshes larger than those on which a claim was tried, or about cases beyond the largest tried."),
    facts(rows),
    ...measures(f),
  );
}

const rate = ({ of, in: all, interval }: Rate): HTMLElement | string =>
  all === 0 ? "\u2013" : lines(`${count(of)} of ${count(all)}`, `${percent(interval[0])} to ${percent(interval[1])}`);
const percent = (x: number): string => `${(100 * x).toPrecision(2)} %`;

// Returns the lines of a table's cell.
const lines = (...of: string[]): HTMLElement => html("span", {}, ...of.map((line) => html("span", { class: "line" }, line)));

const off = ({ steps, median, p99, worst }: TimesOff): HTMLElement | string =>
  steps === 0
    ? "none"
    : lines(`${counted(steps, "step")}`, `median ${median.toPrecision(2)}`, `99 of 100 ${p99.toPrecision(2)}`, `worst ${worst.toPrecision(2)}`);

// Compares the number of candidates with the least possible number, which is the number of pairs in
// contact.
const candidatesText = ({ steps, given, least, over_least }: NonNullable<Stratum["measures"]>["candidates"]): string =>
  steps === 0 ? "\u2013" : `${count(given)} of ${count(least)}` + (least === 0 ? "" : `: ${over_least.toPrecision(3)} times`);

// Says how much of the time until a contact a limiter uses, and how often it allows no motion
// although the step has room.
const limitsText = ({ free, cut, contact, used, stalls }: NonNullable<Stratum["measures"]>["limits"]): string =>
  free + contact === 0
    ? "\u2013"
    : [
        `${count(cut)} of ${count(free)} cut`,
        ...(used === null ? [] : [`${[used.median, used.p1, used.worst].map((x) => x.toPrecision(2)).join(", ")} of ${count(contact)}`]),
        ...stalls.map(({ cause, steps }) => `stalled ${count(steps)}: ${cause}`),
      ].join("; ");

// Shows the measures of a plug-in, which do not depend on its claims.
function measures(f: Findings): HTMLElement[] {
  const rows = f.strata.flatMap(({ family, measures }) => (measures === null ? [] : [{ family, measures }]));
  if (rows.length === 0) return [];
  type Row = (typeof rows)[number];
  const gives = rows.some(({ measures }) => measures.candidates.steps > 0);
  const limits = rows.some(({ measures }) => measures.limits.free + measures.limits.contact > 0);
  const refuses = rows.some(({ measures }) => measures.left_out.refused > 0);
  return [
    html("p", {}, "These counts do not depend on the claims. Intervals have a confidence of 95 %. The columns late and early say by which share of the step the first time is wrong. They count only steps whose time is late (or early), and give the median of these shares, the share that 99 of 100 such steps stay below, and the largest share."),
    table(
      "What the detector does, whatever it claims",
      [
        { head: "stratum", cell: (r: Row) => r.family },
        { head: "free, answered collision", cell: (r: Row) => rate(r.measures.false_alarms), number: true },
        { head: "contact, answered free", cell: (r: Row) => `${count(r.measures.answered_free.of)} of ${count(r.measures.answered_free.in)}`, number: true },
        { head: "spurious pairs a step", cell: (r: Row) => r.measures.spurious_pairs_a_step.toPrecision(2), number: true },
        { head: "late", cell: (r: Row) => off(r.measures.late), number: true },
        { head: "early", cell: (r: Row) => off(r.measures.early), number: true },
        ...(gives ? [{ head: "candidates, of the fewest possible", cell: (r: Row) => candidatesText(r.measures.candidates), number: true }] : []),
        ...(limits ? [{ head: "limits: free steps cut; share used of the time until a contact: median, 99 of 100, worst", cell: (r: Row) => limitsText(r.measures.limits) }] : []),
        { head: "left out: cases, steps", cell: (r: Row) => `${count(r.measures.left_out.cases_redrawn)}, ${count(r.measures.left_out.steps)}`, number: true },
        ...(refuses ? [{ head: "refused: capacity, steps", cell: (r: Row) => count(r.measures.left_out.refused), number: true }] : []),
      ],
      rows,
    ),
  ];
}
