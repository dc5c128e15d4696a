// What the run comes to, what its bounds speak of, and the gates in their order.
import { html, section } from "./dom";
import type { Findings, Run } from "./report";
import { count, counted, sum } from "./words";

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

// Good, bad, open: never by colour alone, the word stands beside.
export const kindOf = (verdict: Run["verdict"]): string =>
  verdict === "certified" || verdict === "holds"
    ? "good"
    : ["defect", "unsound-harness", "unverified"].includes(verdict)
      ? "bad"
      : "open";

export const verdictWord = (verdict: Run["verdict"]): string => sentences[verdict] ?? verdict;

export function overview(run: Run): HTMLElement {
  const { campaign, detector, strata, times } = run.findings;
  // "2/8" is the second of eight.
  const shards = Number(campaign.shards[0]?.split("/")[1] ?? 1);
  const disturbed = sum(times.strata.map((s) => s.disturbed));
  return html(
    "div",
    { class: `verdict ${kindOf(run.verdict)}` },
    html("p", { class: "word" }, verdictWord(run.verdict)),
    html("p", {}, run.why),
    html(
      "p",
      { class: "note" },
      `Detector: ${detector.name} (${counted(detector.configurations.length, "configuration")}); ` +
        `campaign ${campaign.name}, seed ${campaign.seed}${shards === 1 ? "" : `, ${campaign.shards.length} of ${shards} shards`}; ` +
        `${count(sum(strata.map((s) => s.trials)))} of ${count(sum(strata.map((s) => s.planned)))} trials.` +
        (disturbed === 0
          ? ""
          : ` ${counted(disturbed, "trial was", "trials were")} disturbed from outside, and ran again.`) +
        (times.near_the_limit === 0
          ? ""
          : ` ${counted(times.near_the_limit, "trial", "trials")} took more than a third of the time that a case may take.`),
    ),
    run.subject === null && run.verdict !== "unverified"
      ? html("p", { class: "note" }, "No certificate stands beside this run: assay certify issues one.")
      : null,
  );
}

const signs: Record<Findings["gates"][number]["state"], string> = { holds: "\u2713", fails: "\u2717", "not judged": "\u2013" };

// Each in a line, those beyond the third behind a click.
function reasons(lines: string[]): HTMLElement[] {
  const few = 3;
  const shown = lines.slice(0, few).map((line) => html("span", { class: "reason" }, line));
  if (lines.length <= few) return shown;
  const rest = lines.slice(few).map((line) => html("span", { class: "reason" }, line));
  return [...shown, html("details", {}, html("summary", {}, `${rest.length} more`), ...rest)];
}

export function gates({ gates: list }: Findings): HTMLElement {
  const first = list.find((g) => g.state === "fails");
  return section(
    "gates",
    "Gates",
    html(
      "ol",
      { class: "gates" },
      ...list.map((gate) =>
        html(
          "li",
          { class: gate.state.replace(" ", "-") },
          html("span", { class: "sign", "aria-hidden": "true" }, signs[gate.state]),
          html(
            "span",
            {},
            html("strong", {}, `${gate.gate}: ${gate.state}`),
            ` (asked: ${gate.asks})`,
            ...reasons(gate.reasons),
          ),
        ),
      ),
    ),
    first ? html("p", {}, `The first that fails is \u201c${first.gate}\u201d.`) : null,
  );
}

export function scope({ confidence }: Findings): HTMLElement {
  const percent = Math.round(100 * confidence.family);
  return html(
    "div",
    { class: "scope" },
    html("p", {}, html("strong", {}, "What the bounds speak of: "),
      "the share of cases, of this campaign\u2019s random generator, in which the detector would not hold. " +
      "They say nothing of other meshes, yours included, beyond what those have in common with the generator\u2019s."),
    html("p", {}, `All ${count(confidence.bounds)} bounds hold together with a confidence of ${percent} %, without those of the strata of sizes (size-\u2026), of which each stands alone ` +
      "(exact one-sided Clopper and Pearson, Bonferroni). A trial is a whole case; undecided ones count against the detector."),
  );
}
