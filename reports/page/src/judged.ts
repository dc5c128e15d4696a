// What the verdict is about: the detector's claims, under which contract, how a plug-in was kept
// apart, and the campaign.
import { html, section } from "./dom";
import type { Run } from "./report";

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

const isolations: Record<string, string> = {
  full: "full: its process wrote to no file but temporary ones of its own, saw no other process, and opened no socket",
  none: "none: its process was kept apart from nothing",
};

export function judged(run: Run): HTMLElement {
  const { contract } = run.detector;
  const margin = contract.margin > 0 ? `, margin ${contract.margin}` : "";
  const rows: [string, string[]][] = [
    ["Claims", claimsOf(run)],
    ["Contract", [`adjacency ${contract.adjacency}, coordinates ${contract.coordinates}${margin}`]],
    ...(run.isolation === null ? [] : ([["Isolation", [isolations[run.isolation] ?? run.isolation]]] as [string, string[]][])),
    ["Campaign", [`${run.campaign}, seed ${run.seed}`]],
  ];
  return section(
    "judged",
    "What was judged",
    html("p", {}, "The verdict speaks of these claims, under this contract, and of no others."),
    html(
      "dl",
      { class: "judged" },
      ...rows.flatMap(([name, lines]) => [html("dt", {}, name), html("dd", {}, ...lines.map((line) => html("div", {}, line)))]),
    ),
  );
}
