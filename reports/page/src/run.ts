// A run as its sections show it, from what stands in the page of it.
import type { Fault, Findings, Run, StoredRun, Stratum } from "./report";

const sum = (numbers: number[]): number => numbers.reduce((a, b) => a + b, 0);

// One row for configurations that agree in all of a family's counts, else a row for each.
function strataOf(f: Findings): Stratum[] {
  return f.strata.flatMap((s) => {
    const times = f.times.strata.find((t) => t.family === s.family);
    const seconds = times ? 1e-6 * (times.oracle_us + times.detector_us) : 0;
    const rows = s.bounds.map((b) => ({
      family: s.family,
      configurations: [b.configuration],
      planned: s.planned,
      n: b.n,
      holds: b.holds,
      defects: b.defects,
      undecided: b.undecided + b.errors,
      disturbed: times?.disturbed ?? 0,
      bound: b.bound,
      wanted: s.wanted_bound,
      steps: s.steps,
      collisions: s.collisions,
      steps_per_second: seconds > 0 ? s.steps / seconds : null,
    }));
    const key = (row: Stratum): string => [row.holds, row.defects, row.undecided].join();
    const together = rows.every((row) => key(row) === key(rows[0]!));
    return together ? [{ ...rows[0]!, configurations: rows.flatMap((row) => row.configurations) }] : rows;
  });
}

// The worst of all shards: one that was not found is worse than any number of cases.
function canaryOf(f: Findings): Run["canary"] {
  const cases = (c: { found_after: number | null }): number => c.found_after ?? Infinity;
  return [...f.power.canaries].sort((a, b) => cases(b) - cases(a))[0] ?? null;
}

function faultOf(f: Findings["power"]["faults"][number]): Fault {
  const { fault, needed, curated, known_vertices, shrunk, ...same } = f;
  const small = shrunk && { from_triangles: shrunk.before.triangles, from_steps: shrunk.before.steps, ...shrunk.after, calls: shrunk.calls };
  return { ...same, name: fault, cases: needed, by_curated: curated, known_vertices: known_vertices || null, shrunk: small };
}

function certificateOf(run: StoredRun): Run["certificate"] {
  const f = run.findings;
  if (run.subject === null) return null;
  const limits = f.campaign.plan.policy.speed_limits;
  return {
    subject: run.subject,
    versions: f.versions,
    issued: f.times.issued,
    seconds: f.times.seconds,
    speaks_of: f.confidence.speaks_of,
    self_test: f.self_test,
    corpus: f.corpus,
    waivers: f.waivers,
    speed: f.times.speed.map((figure) => ({ ...figure, limit: limits[figure.what] ?? null })),
    digests: f.digests,
    replay: f.replay,
  };
}

export function runOf(run: StoredRun): Run {
  const f = run.findings;
  const shards = f.campaign.shards.map((shard) => shard.split("/").map(Number));
  const wanted = f.laws?.wanted_premises ?? 0;
  return {
    folder: run.folder,
    campaign: f.campaign.name,
    seed: f.campaign.seed,
    is_default_seed: f.campaign.is_default_seed,
    shards: { count: shards[0]?.[1] ?? 1, present: shards.map((shard) => shard[0]!) },
    detector: {
      ...f.detector,
      library: run.library,
      configurations: f.detector.configurations.map((c) => c.name),
      claims: f.detector.configurations,
    },
    repeated: f.repeated,
    isolation: f.isolation,
    not_judged: f.not_judged,
    judged_up_to: f.judged_up_to,
    left_out_families: f.left_out_families,
    measures: f.strata.flatMap(({ family, measures }) => (measures === null ? [] : [{ family, measures }])),
    verdict: run.verdict,
    why: run.why,
    gates: f.gates,
    trials: {
      done: sum(f.strata.map((s) => s.trials)),
      planned: sum(f.strata.map((s) => s.planned)),
      disturbed: sum(f.times.strata.map((s) => s.disturbed)),
      near_the_limit: f.times.near_the_limit,
    },
    defect_trials: sum(f.strata.map((s) => s.with_defect)),
    bounds: { confidence: f.confidence.family, together: f.confidence.bounds },
    strata: strataOf(f),
    ...f.cases,
    laws: (f.laws?.laws ?? [])
      .filter((law) => law.premises > 0 || wanted > 0)
      .map((law) => ({ name: law.law, premise: law.premises, close: law.close, broken: law.broken, wanted_premise: wanted })),
    canary: canaryOf(f),
    faults: f.power.faults.length === 0 ? null : f.power.faults.map(faultOf),
    power: f.power,
    faults_taken_from: f.power.taken_from,
    worlds: f.power.worlds,
    signatures: Object.fromEntries(f.failures.filter((x) => x.met > 0).map((x) => [x.signature, x.met])),
    certificate: certificateOf(run),
    failures: f.failures.map((told, i) => ({
      ...told,
      id: told.case,
      original: told.before,
      smallest: told.after,
      ...run.failures[i]!,
    })),
  };
}
