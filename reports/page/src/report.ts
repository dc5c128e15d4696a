// The data of the page: schema assay-report/3, reports/schemas/report.schema.json. The findings of
// a run are the predicate of a certificate, whose types are made from its schema (types.mjs).
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
  places: [Point, Point] | null; // the nearest points of the two; in a contact they coincide
  distance: number | null; // of these
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
  oracle: Answer; // what counts under the detector's contract
  left_out: Contact[]; // by the contract
  differences: { triangles: [number, number]; difference: string }[]; // of each pair that meets or is reported
  detector: Answer | null;
  candidates: [number, number][] | null; // of a plug-in that gives some
  views: Views | null;
}

export interface Scene {
  triangles: [number, number, number][];
  bodies: number[] | null; // by triangle; null: the case has none
  frames: Point[][];
  steps: Step[];
  reports_pairs: boolean;
  asked: string | null; // what the contract wants of distances: "d 0.01, slack 0.002"
  ended: string | null;
  shown: { step: number; pair: [number, number] | null };
}

// What is shown of a failure beside what the findings say of it.
export interface ShownFailure {
  stage: string | null;
  now: string | null;
  scene: Scene | null;
  svg: string | null;
  not_shown: string | null;
  printed: string | null; // by a plug-in when it failed
  others: { id: string; configuration: string; what: string; replay: string }[];
}

export type Findings = Statement["predicate"];
export type Failure = Findings["failures"][number] & ShownFailure;
export type Stratum = Findings["strata"][number];

export interface Run {
  folder: string;
  library: string | null; // from that folder
  verdict: Findings["verdict"] | "unverified";
  why: string;
  begun: string | null; // in UTC; null: not stored
  subject: Statement["subject"] | null; // null: no certificate that verifies
  findings: Findings;
  law_statements: Record<string, string>; // by the names of the laws
  failures: ShownFailure[]; // in the order of those of the findings
}

export interface Report {
  schema: string;
  version: string;
  runs: Run[];
}
