// The pairs in contact of a scene: what the oracle has, what the detector has.
import { html, table } from "./dom";
import type { Contact, Scene } from "./report";
import { time } from "./words";

interface Row {
  step: number;
  pair: [number, number];
  exact: Contact | null;
  detector: Contact | null;
  ran: boolean;
  reported: boolean; // whether the detector says anything of pairs
  candidate: boolean | null; // null: it gives none
}

function rowsOf(scene: Scene): Row[] {
  const rows: Row[] = [];
  scene.steps.forEach((step, index) => {
    const found = new Map<string, Row>();
    const row = (c: Contact): Row => {
      const key = c.triangles.join(",");
      const known = found.get(key);
      if (known) return known;
      const candidate = step.candidates?.some(([a, b]) => `${a},${b}` === key) ?? null;
      const made = { step: index, pair: c.triangles, exact: null, detector: null, ran: step.detector !== null, reported: scene.reports_pairs, candidate };
      found.set(key, made);
      return made;
    };
    for (const c of step.oracle.pairs) row(c).exact = c;
    for (const c of step.detector?.pairs ?? []) row(c).detector = c;
    rows.push(...found.values());
  });
  return rows.sort((a, b) => a.step - b.step || a.pair[0] - b.pair[0] || a.pair[1] - b.pair[1]);
}

function difference(row: Row): string {
  if (!row.ran) return "not run";
  if (!row.reported) return row.candidate === false ? "no candidate" : "\u2013";
  if (!row.detector) return "missing";
  if (!row.exact) return "spurious";
  const [lo, hi] = row.detector.time;
  if (lo > row.exact.time[0]) return "late";
  return hi < row.exact.time[1] ? "early" : "agrees";
}

const stated = (c: Contact): string => (c.time[1] - c.time[0] >= 1 ? "not stated" : time(c.time));

export function pairTable(scene: Scene, choose: (step: number, pair: [number, number]) => void): HTMLElement {
  const rows = rowsOf(scene);
  if (rows.length === 0) return html("p", { class: "note" }, "No pair is in contact, by the oracle or by the detector.");
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
      { head: "step", cell: (r: Row) => String(r.step + 1), number: true },
      { head: "feature", cell: (r: Row) => r.exact?.feature ?? "\u2013", short: true },
      { head: "exact time", cell: (r: Row) => (r.exact ? time(r.exact.time) : "no contact") },
      { head: "detector's time", cell: (r: Row) => (r.detector ? stated(r.detector) : r.ran ? "not reported" : "\u2013") },
      ...(gives ? [{ head: "candidate", cell: (r: Row) => (r.candidate ? "yes" : "no") }] : []),
      { head: "difference", cell: difference },
    ],
    rows,
  );
}
