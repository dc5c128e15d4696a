// Shows the first screen: the verdict of a run, its detector and campaign, and the mesh of a
// defect.
import { failurePlace } from "./address";
import { facts, html } from "./dom";
import type { Failure, Findings, Run } from "./report";
import { capital, count, counted, sum } from "./words";
import { staticPicture, Viewer } from "./viewer/viewer";

const sentences: Record<Run["verdict"], string> = {
  certified: "Certified",
  defect: "Defect",
  undecided: "Undecided",
  "unsound-harness": "Unsound harness",
  incomplete: "Incomplete",
  holds: "Holds, not certified",
  "not judged": "Not judged",
  unverified: "The certificate does not verify",
};

// Returns the kind of a verdict, which gives its colour. The word of the verdict is always shown
// too.
export const kindOf = (verdict: Run["verdict"]): string =>
  verdict === "certified" || verdict === "holds"
    ? "good"
    : ["defect", "unsound-harness", "unverified"].includes(verdict)
      ? "bad"
      : "open";

export const verdictWord = (verdict: Run["verdict"]): string => sentences[verdict] ?? verdict;

// Splits the name of a plug-in, which is "NAME VERSION". Its first configuration is named "NAME".
export function named({ detector, versions }: Findings): { name: string; version: string | null } {
  if (detector.built_in) return { name: detector.name, version: versions?.assay ?? null };
  const name = detector.configurations[0]?.name ?? "";
  return detector.name.startsWith(`${name} `)
    ? { name, version: detector.name.slice(name.length + 1) }
    : { name: detector.name, version: null };
}

// Returns a title that begins with the words that differ most between pages, because a row of tabs
// shows only the beginning.
export function titleOf({ verdict, findings }: Run): string {
  const { name, version } = named(findings);
  const { campaign } = findings;
  return `${verdictWord(verdict)}: ${name}${version ? ` ${version}` : ""} \u2013 ${campaign.name}, ${seedsText(campaign)} \u2013 Assay report`;
}

// Returns "seed 3, share 1/8" or "seeds 1, 2, 3".
export const seedsText = ({ parts }: Findings["campaign"]): string =>
  parts.length > 1
    ? `seeds ${parts.map((part) => part.seed).join(", ")}`
    : parts.map(({ seed, share }) => `seed ${seed}${share === "1/1" ? "" : `, share ${share}`}`)[0]!;

const dirty = "-dirty";
const commitText = (commit: string): string =>
  commit.endsWith(dirty) ? `${commit.slice(0, -dirty.length)}, and changes that are in no commit` : commit;

// Turns "2026-01-31T12:00:00Z" into "2026-01-31, 12:00 UTC".
const dayText = (issued: string): string => issued.replace(/T(\d\d:\d\d):\d\dZ$/, ", $1 UTC");

function about(run: Run): HTMLElement {
  const { campaign, detector, digests, strata, times, versions } = run.findings;
  const { name, version } = named(run.findings);
  const digest = detector.built_in ? digests.worker : digests.plugin;
  const { length } = detector.configurations;
  return facts([
    ["Detector", `${name}${length === 1 ? "" : `, in ${counted(length, "configuration")}`}`],
    ["Version", version],
    ["Commit", detector.built_in && versions?.commit ? commitText(versions.commit) : null],
    [
      "Judged by",
      detector.built_in || !versions
        ? null
        : `assay ${versions.assay}${versions.commit ? `, commit ${commitText(versions.commit)}` : ""}`,
    ],
    ["Date", times.issued === null ? null : dayText(times.issued)],
    ["Begun", times.issued !== null || run.begun === null ? null : dayText(run.begun)],
    [detector.built_in ? "Its program, SHA-256" : "Its library, SHA-256", digest === null ? null : [html("code", {}, digest)]],
    [
      "Campaign",
      `${campaign.name}, ${seedsText(campaign)}; ${count(sum(strata.map((s) => s.trials)))} of ${count(sum(strata.map((s) => s.planned)))} trials`,
    ],
  ]);
}

function notes({ findings: { times, versions }, subject, verdict, begun }: Run): string[] {
  const absent = [begun === null ? "no date" : "", versions ? "" : "no version of the program"].filter((word) => word !== "");
  const disturbed = sum(times.strata.map((s) => s.disturbed));
  return [
    disturbed === 0 ? "" : `${counted(disturbed, "trial was", "trials were")} disturbed from outside, and ran again.`,
    times.near_the_limit === 0
      ? ""
      : `${counted(times.near_the_limit, "trial", "trials")} took more than a third of the time that a case may take.`,
    subject !== null || verdict === "unverified"
      ? ""
      : `No certificate stands beside this run${absent.length > 0 ? `, so ${absent.join(" and ")} is stored` : ""}. To issue a certificate, run assay certify.`,
  ].filter((note) => note !== "");
}

export interface Overview {
  element: HTMLElement;
  close: () => void;
}

// Returns the place for the mesh. `start` draws the mesh in 3D, and is called once the page shows
// the place.
function smallestMesh(failure: Failure, address: string): { element: HTMLElement; start: () => Viewer | null } {
  const place = html("div", {});
  const element = html(
    "div",
    { class: "first-mesh" },
    place,
    html("p", { class: "note" }, "The smallest mesh of ", html("a", { href: address }, failure.signature), ": ", failure.now ?? failure.what),
  );
  const start = (): Viewer | null => {
    try {
      const viewer = new Viewer(failure.scene!, () => {});
      place.append(viewer.element);
      return viewer;
    } catch {
      place.append(staticPicture(failure));
      return null;
    }
  };
  return { element, start };
}

export function overview(run: Run, first: { failure: Failure; name: string } | null, address: (place: string) => string): Overview {
  const shown = first?.failure.scene?.steps.length ? first : null;
  const mesh = shown ? smallestMesh(shown.failure, address(failurePlace + shown.name)) : null;
  const element = html(
    "div",
    { class: `verdict ${kindOf(run.verdict)}` },
    html(
      "div",
      {},
      html("h1", {}, verdictWord(run.verdict)),
      html("p", {}, `${capital(run.why)}.`),
      about(run),
      ...notes(run).map((note) => html("p", { class: "note" }, note)),
    ),
    mesh?.element ?? null,
  );
  const viewer = mesh?.start() ?? null;
  return { element, close: () => viewer?.close() };
}
