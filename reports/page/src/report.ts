// The data of the page: schema assay-report/2, documented in reports/README.md.

export type Point = [number, number, number];
export type Interval = [number, number];
export type Moving = [Point, Point];
export type SetName = "none" | "V+" | "V-" | "V0" | "dirty" | "violated";

export interface Contact {
  triangles: [number, number];
  time: Interval;
  feature: string;
  vertices: number[];
  point: Point | null;
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
  frames: Point[][];
  steps: Step[];
  reports_pairs: boolean;
  ended: string | null;
  shown: { step: number; pair: [number, number] | null };
}

export interface Size {
  triangles: number;
  vertices: number;
  steps: number;
}

export interface Failure {
  signature: string;
  configuration: string;
  id: string;
  what: string;
  met: number;
  flaky: boolean;
  original: Size | null;
  smallest: Size | null;
  replay: string;
  stage: string | null;
  now: string | null;
  scene: Scene | null;
  svg: string | null;
  not_shown: string | null;
  printed: string | null; // by a plug-in when it failed
  others: { id: string; configuration: string; what: string; replay: string }[];
}

export interface Stratum {
  family: string;
  configurations: string[];
  planned: number;
  n: number;
  holds: number;
  defects: number;
  undecided: number;
  disturbed: number;
  bound: number;
  wanted: number | null;
  steps: number;
  collisions: number;
  steps_per_second: number | null;
}

export interface Fault {
  name: string;
  about: string | null;
  law: string;
  status: "planted" | "open" | "equivalent";
  found: boolean;
  found_at_random: boolean; // by a random case, not by its curated case alone
  time_over: boolean;
  median_cases: number | null;
  cases: (number | null)[];
  by_curated: boolean;
  known_vertices: number | null;
  shrunk: {
    from_triangles: number;
    from_steps: number;
    vertices: number;
    triangles: number;
    steps: number;
    calls: number;
  } | null;
}

export interface Gate {
  gate: string;
  asks: string;
  state: "holds" | "fails" | "not judged";
  reasons: string[];
}

export interface Law {
  name: string;
  premise: number;
  close: number;
  broken: number;
  wanted_premise: number;
}

export interface World {
  world: string;
  complete: boolean;
  classes: number | null;
  motions: number | null;
  counterexample: string | null;
}

export interface CorpusRow {
  input: string;
  configuration: string;
  cases: number;
  left_out: number;
  steps: number;
  collisions: number;
  pairs: number;
  defects: number;
  open: { id: string; what: string }[];
  failed: { id: string; signature: string; what: string; waived: boolean }[];
}

export interface Waiver {
  signature: string;
  reason: string;
  link: string;
  expires: string;
  expired: boolean;
  met: number;
}

// What a certificate (assay-certificate/4) says beyond the run.
export interface Certificate {
  subject: { name: string; digest: Record<string, string> }[];
  versions: { assay: string; commit: string | null; libraries: string } | null;
  issued: string | null;
  seconds: number | null;
  speaks_of: string;
  self_test: { queries: number; contradictions: number; complete: boolean } | null;
  corpus: CorpusRow[] | null;
  waivers: Waiver[];
  speed: { what: string; median: number; lo: number; hi: number; limit: number | null }[];
  digests: Record<string, string | null>;
  replay: string[];
}

export interface Claims {
  name: string; // of a configuration
  claims: string[];
}

export interface Contract {
  adjacency: string;
  coordinates: string;
  margin: number;
  leaves_out: string[]; // in words; empty: nothing
}

export interface NotJudged {
  claim: string;
  reason: string;
}

// The size of the largest mesh that tried a claim.
export interface JudgedSize {
  claim: string;
  triangles: number;
}

// A share of counted steps, with its interval of confidence 95 %.
export interface Rate {
  of: number;
  in: number;
  share: number;
  interval: [number, number];
}

// Times that are off, in shares of the step.
export interface TimesOff {
  steps: number;
  median: number;
  p99: number;
  worst: number;
}

// What a plug-in's steps come to, whatever it claims.
export interface Measures {
  steps: number;
  false_alarms: Rate;
  answered_free: Rate;
  spurious_pairs: number;
  spurious_pairs_a_step: number;
  collisions: number;
  without_time: number;
  late: TimesOff;
  early: TimesOff;
  // Of a broad phase: candidate pairs in these steps, and the pairs in contact in them.
  candidates: { steps: number; given: number; least: number; over_least: number };
  left_out: { cases_redrawn: number; steps: number; would_be_misses: number };
}

export interface Repetition {
  input: string;
  triangles: number;
  steps: number;
  threads: number[];
  what: string;
  broken: boolean;
  judged: { step: number; contacts: number; holds: boolean }[]; // by the oracle
}

export interface Run {
  folder: string;
  campaign: string;
  seed: number;
  is_default_seed: boolean;
  shards: { count: number; present: number[] };
  detector: {
    name: string;
    built_in: boolean;
    library: string | null;
    configurations: string[];
    claims: Claims[];
    contract: Contract;
    query_claims: string[]; // of its elementary query; empty: not judged
    unjudged_parts: string[]; // "elementary query": held by the library, judged by nobody
  };
  judged_up_to: JudgedSize[];
  left_out_families: string[];
  // Of a plug-in that was put to large meshes.
  repeated: Repetition[] | null;
  // "full", "none", "partial: lacks files"; null: of no plug-in.
  isolation: string | null;
  not_judged: NotJudged[];
  // By family; of a plug-in.
  measures: { family: string; measures: Measures }[];
  verdict: string;
  why: string;
  gates: Gate[];
  trials: { done: number; planned: number; disturbed: number; near_the_limit: number };
  defect_trials: number;
  bounds: { confidence: number; together: number };
  strata: Stratum[];
  distributions: { family: string; triangles: number[][]; pairs: number[][] }[];
  set_pairs: { sets: string; contacts: number; first_contacts: number }[];
  tags: Record<string, number>;
  laws: Law[];
  canary: { fault: string; found_after: number | null } | null;
  faults: Fault[] | null;
  power: { planted: number; found: number; found_at_random: number; found_by_curated_case_alone: number };
  faults_taken_from: { campaign: string; seed: number } | null;
  worlds: World[];
  signatures: Record<string, number>;
  certificate: Certificate | null;
  failures: Failure[];
}

export interface Report {
  schema: string;
  version: string;
  runs: Run[];
}

export interface StoredReport {
  schema: string;
  version: string;
  runs: StoredRun[];
}

// What stands in the page of a run: findings are the predicate of assay-certificate/4.
export interface StoredRun {
  folder: string;
  library: string | null;
  verdict: string;
  why: string;
  subject: Certificate["subject"] | null;
  findings: Findings;
  failures: Omit<Failure, keyof StoredFailure | "id" | "original" | "smallest">[];
}

export interface StoredFailure {
  signature: string;
  configuration: string;
  what: string;
  met: number;
  flaky: boolean;
  replay: string;
}

export interface Findings {
  gates: Gate[];
  detector: { name: string; built_in: boolean; contract: Contract; configurations: Claims[]; query_claims: string[]; unjudged_parts: string[] };
  repeated: Repetition[] | null;
  isolation: string | null;
  not_judged: NotJudged[];
  judged_up_to: JudgedSize[];
  left_out_families: string[];
  versions: Certificate["versions"];
  campaign: { name: string; seed: number; is_default_seed: boolean; shards: string[]; plan: { policy: { speed_limits: Record<string, number> } } };
  confidence: { family: number; bounds: number; speaks_of: string };
  strata: {
    family: string;
    planned: number;
    trials: number;
    with_defect: number;
    measures: Measures | null;
    steps: number;
    collisions: number;
    wanted_bound: number | null;
    bounds: { configuration: string; n: number; holds: number; defects: number; undecided: number; errors: number; bound: number }[];
  }[];
  cases: Pick<Run, "distributions" | "set_pairs" | "tags">;
  laws: { wanted_premises: number; laws: { law: string; premises: number; close: number; broken: number }[] } | null;
  power: {
    canaries: { fault: string; found_after: number | null }[];
    taken_from: Run["faults_taken_from"];
    planted: number;
    found: number;
    found_at_random: number;
    found_by_curated_case_alone: number;
    faults: {
      fault: string;
      about: string | null;
      law: string;
      status: Fault["status"];
      found: boolean;
      found_at_random: boolean;
      time_over: boolean;
      median_cases: number | null;
      needed: (number | null)[];
      curated: boolean;
      known_vertices: number;
      shrunk: { before: Size; after: Size; calls: number } | null;
    }[];
    worlds: World[];
  };
  self_test: Certificate["self_test"];
  corpus: CorpusRow[] | null;
  failures: (StoredFailure & { case: string; before: Size | null; after: Size | null })[];
  waivers: Waiver[];
  replay: string[];
  digests: Certificate["digests"];
  times: {
    issued: string | null;
    seconds: number | null;
    near_the_limit: number;
    speed: { what: string; median: number; lo: number; hi: number }[];
    strata: { family: string; oracle_us: number; detector_us: number; disturbed: number }[];
  };
}
