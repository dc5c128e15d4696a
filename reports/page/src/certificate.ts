// Shows the parts that a certificate adds to a run: the corpus, speed, the checks of the oracle,
// and the digests of everything that was judged.
import { facts, html, section, table } from "./dom";
import { pasteNote, replayLine } from "./failure_facts";
import type { Findings, Run } from "./report";
import { count, counted } from "./words";

type CorpusRow = NonNullable<Findings["corpus"]>[number];

// Puts configurations with the same result on an input into one row.
function together(rows: CorpusRow[]): { row: CorpusRow; who: string }[] {
  const groups = new Map<string, CorpusRow[]>();
  for (const row of rows) {
    const key = [row.input, row.cases, row.left_out, row.steps, row.collisions, row.pairs, row.defects].join("|");
    groups.set(key, [...(groups.get(key) ?? []), row]);
  }
  return [...groups.values()].map((same) => ({
    row: same[0]!,
    who: same.length === 1 ? same[0]!.configuration : `each of ${same.length}`,
  }));
}

function corpus(rows: CorpusRow[] | null): HTMLElement {
  if (rows === null) return section("corpus", "Corpus", html("p", {}, "The corpus was not run."));
  const open = rows.flatMap((row) => row.open.map((o) => ({ ...o, signature: "no answer", row })));
  const failed = [...rows.flatMap((row) => row.failed.map((f) => ({ ...f, row }))), ...open];
  type Failed = (typeof failed)[number];
  type Row = ReturnType<typeof together>[number];
  return section(
    "corpus",
    "Corpus",
    html("p", {}, "The shipped cases and scenes are judged like the trials, but they are no trials: no bound rests on them."),
    failed.length === 0
      ? null
      : table(
          "Cases that do not hold",
          [
            { head: "case", cell: (f: Failed) => f.id },
            { head: "configuration", cell: (f: Failed) => f.row.configuration },
            { head: "what", cell: (f: Failed) => f.what },
          ],
          failed,
        ),
    table(
      "Cases and scenes",
      [
        { head: "input", cell: (r: Row) => r.row.input },
        { head: "configuration", cell: (r: Row) => r.who },
        { head: "cases", cell: (r: Row) => count(r.row.cases), number: true },
        { head: "steps", cell: (r: Row) => count(r.row.steps), number: true },
        { head: "collide", cell: (r: Row) => count(r.row.collisions), number: true },
        { head: "pairs", cell: (r: Row) => count(r.row.pairs), number: true },
        { head: "defects", cell: (r: Row) => count(r.row.defects), number: true },
      ],
      together(rows),
    ),
  );
}

function speed(f: Findings): HTMLElement | null {
  if (f.times.speed.length === 0) return null;
  type Figure = Findings["times"]["speed"][number];
  const limits = f.campaign.plan.policy.speed_limits;
  return section(
    "speed",
    "Speed",
    html("p", {}, "Each ratio compares processor times of interleaved steps. Its interval contains the median with a confidence of 95 % or more."),
    table(
      "Speed",
      [
        { head: "ratio", cell: (f: Figure) => f.what },
        { head: "median", cell: (f: Figure) => f.median.toPrecision(3), number: true },
        { head: "interval", cell: (f: Figure) => `${f.lo.toPrecision(3)} to ${f.hi.toPrecision(3)}`, number: true },
        { head: "limit", cell: (f: Figure) => String(limits[f.what] ?? "\u2013"), number: true },
      ],
      f.times.speed,
    ),
  );
}

function selfTest(t: Findings["self_test"]): HTMLElement {
  const text = t
    ? `Against other exact methods: ${counted(t.contradictions, "contradiction")} in ${counted(t.queries, "query", "queries")}${t.complete ? "" : ", not all that were planned"}.`
    : "No self-test of the oracle was run.";
  return section("oracle", "The oracle, checked", html("p", {}, text));
}

// Shows the digests of what was judged.
function digests(run: Run): HTMLElement {
  const f = run.findings;
  const { issued, seconds } = f.times;
  const told = run.subject ?? [];
  const words: Record<string, string> = { sha256: "its SHA-256", gitCommit: "its commit" };
  const rows: [string, (Node | string)[] | string | null][] = [
    ...told.flatMap((s): [string, string | Node[]][] => [
      ["Detector", s.name],
      ...Object.entries(s.digest).map(([kind, digest]): [string, Node[]] => [words[kind] ?? kind, [html("code", {}, digest)]]),
    ]),
    ...Object.entries(f.digests).map(([kind, digest]): [string, Node[] | null] => [`digest of ${kind}`, digest ? [html("code", {}, digest)] : null]),
    ["Issued", issued],
    ["Took", seconds === null ? null : `${Math.round(seconds)} s`],
  ];
  return section(
    "digests",
    run.subject ? "Certificate" : "Digests",
    html("p", {}, `${run.subject ? "The certificate speaks" : "The run speaks"} of exactly these bytes (SHA-256), and of ${f.confidence.speaks_of}.`),
    facts(rows),
    ...(f.replay.length === 0 ? [] : [html("h3", {}, "To repeat the run and to verify the certificate"), ...f.replay.map(replayLine), pasteNote(run)]),
  );
}

export function certificate(run: Run): (HTMLElement | null)[] {
  const f = run.findings;
  const own = run.subject === null ? [] : [corpus(f.corpus), selfTest(f.self_test), speed(f)];
  return [...own, digests(run)];
}
