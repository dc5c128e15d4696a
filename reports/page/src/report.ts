// The data of the page: schema assay-report/3, reports/schemas/report.schema.json. The findings of
// a run are the predicate of a certificate. The types of the predicate are made from the schema of
// certificates (types.mjs).
import type { Statement } from "../made/certificate";

export type Point = [number, number, number];
export type Interval = [number, number];
export type Moving = [Point, Point];
export type SetName = "none" | "V+" | "V-" | "V0" | "dirty" | "violated";

export interface Contact {
  triangles: [number, number];
  time: Interval;
  feature: string;
  vertices: number[];
  // The nearest points of the two triangles; in a contact they coincide.
  places: [Point, Point] | null;
  distance: number | null; // between these points
}

export interface Answer {
  answer: string;
  first_time: Interval | null;
  pairs: Contact[];
}

export interface Views {
  sets: SetName[];
  ghosts: [number, number, number][];
  ghost_sets: SetName[];
  apexes: Moving[];
  primitives: { q0: Moving; q1: Moving | null }[];
}

export interface Step {
  from: number;
  to: number;
  commit: boolean;
  oracle: Answer; // the pairs that count under the detector's contract
  left_out: Contact[]; // contacts that the contract leaves out
  // For each pair that meets or is reported.
  differences: { triangles: [number, number]; difference: string }[];
  detector: Answer | null;
  candidates: [number, number][] | null; // null: the detector gives no candidates
  views: Views | null;
}

export interface Scene {
  triangles: [number, number, number][];
  bodies: number[] | null; // by triangle; null: the case has no bodies
  frames: Point[][];
  steps: Step[];
  reports_pairs: boolean;
  asked: string | null; // the distances of the contract: "d 0.01, slack 0.002"
  ended: string | null;
  shown: { step: number; pair: [number, number] | null };
}

// What the page shows of a failure besides its entry in the findings.
export interface ShownFailure {
  stage: string | null;
  now: string | null;
  scene: Scene | null;
  svg: string | null;
  not_shown: string | null;
  printed: string | null; // what a plug-in printed when it failed
  others: { id: string; configuration: string; what: string; replay: string }[];
}

export type Findings = Statement["predicate"];
export type Failure = Findings["failures"][number] & ShownFailure;
export type Stratum = Findings["strata"][number];

export interface Run {
  folder: string;
  library: string | null; // its path, relative to the folder
  verdict: Findings["verdict"] | "unverified";
  why: string;
  begun: string | null; // when, in UTC; null: not stored
  subject: Statement["subject"] | null; // null: no certificate that verifies
  findings: Findings;
  law_statements: Record<string, string>; // by the name of the law
  failures: ShownFailure[]; // in the order of the failures in `findings`
}

export interface Report {
  schema: string;
  version: string;
  runs: Run[];
}
