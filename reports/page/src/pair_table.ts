// Lists the pairs of a scene that are in contact by the oracle or by the detector, and how the
// detector's claims and contract judge each pair.
import { html, table } from "./dom";
import type { Contact, Scene } from "./report";
import { time } from "./words";

interface Row {
  step: number;
  pair: [number, number];
  exact: Contact | null;
  detector: Contact | null;
  ran: boolean;
  candidate: boolean | null; // null: the detector gives no candidates
  isLeftOut: boolean;
  difference: string;
}

const of = (pairs: Contact[] | undefined, [a, b]: [number, number]): Contact | null =>
  pairs?.find((c) => c.triangles[0] === a && c.triangles[1] === b) ?? null;

// In each step, pairs that count under the contract come first.
function rowsOf(scene: Scene): Row[] {
  return scene.steps.flatMap((step, index) => {
    const rows = step.differences.map(({ triangles: pair, difference }): Row => {
      const counted = of(step.oracle.pairs, pair);
      const exact = counted ?? of(step.left_out, pair);
      return {
        step: index,
        pair,
        exact,
        detector: of(step.detector?.pairs, pair),
        ran: step.detector !== null,
        candidate: step.candidates?.some(([a, b]) => a === pair[0] && b === pair[1]) ?? null,
        isLeftOut: exact !== null && counted === null,
        difference,
      };
    });
    return [...rows.filter((r) => !r.isLeftOut), ...rows.filter((r) => r.isLeftOut)];
  });
}

const stated = (c: Contact): string => (c.time[0] <= 0 && c.time[1] >= 1 ? "not stated" : time(c.time));

function reported(row: Row, scene: Scene): string {
  if (row.detector) return stated(row.detector);
  return row.ran && scene.reports_pairs ? "not reported" : "\u2013";
}

export function pairTable(scene: Scene, choose: (step: number, pair: [number, number]) => void): HTMLElement {
  const rows = rowsOf(scene);
  if (rows.length === 0) return html("p", { class: "note" }, "No pair is in contact, by the oracle or by the detector.");
  const { bodies } = scene;
  const gives = rows.some((r) => r.candidate !== null);
  return table(
    "Pairs in contact",
    [
      {
        head: "pair",
        short: true,
        cell: (r: Row) =>
          html("button", { type: "button", class: "plain", click: () => choose(r.step, r.pair) }, `${r.pair[0]} and ${r.pair[1]}`),
      },
      ...(bodies ? [{ head: "bodies", cell: (r: Row) => `${bodies[r.pair[0]]} and ${bodies[r.pair[1]]}`, short: true }] : []),
      { head: "step", cell: (r: Row) => String(r.step + 1), number: true },
      { head: "feature", cell: (r: Row) => r.exact?.feature ?? "\u2013", short: true },
      { head: "exact time", cell: (r: Row) => (r.exact ? time(r.exact.time) : "no contact") },
      { head: "detector's time", cell: (r: Row) => reported(r, scene) },
      ...(gives ? [{ head: "candidate", cell: (r: Row) => (r.candidate ? "yes" : "no") }] : []),
      { head: "difference", cell: (r: Row) => r.difference },
    ],
    rows,
    (r) => r.isLeftOut,
  );
}
