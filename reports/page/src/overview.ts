// What the run comes to, what its bounds speak of, and the gates in their order.
import { html, section } from "./dom";
import type { Gate, Run } from "./report";
import { count, counted } from "./words";

const sentences: Record<string, string> = {
  certified: "Certified",
  defect: "Defect",
  undecided: "Undecided",
  "unsound-harness": "Unsound harness",
  incomplete: "Incomplete",
  holds: "Holds, not certified",
};

// Good, bad, open: never by colour alone, the word stands beside.
export const kindOf = (verdict: string): string =>
  verdict === "certified" || verdict === "holds"
    ? "good"
    : verdict === "defect" || verdict === "unsound-harness"
      ? "bad"
      : "open";

export const verdictWord = (verdict: string): string => sentences[verdict] ?? verdict;

export function overview(run: Run): HTMLElement {
  const shards =
    run.shards.count === 1 ? "" : `, ${run.shards.present.length} of ${run.shards.count} shards`;
  return html(
    "div",
    { class: `verdict ${kindOf(run.verdict)}` },
    html("p", { class: "word" }, verdictWord(run.verdict)),
    html("p", {}, run.why),
    html(
      "p",
      { class: "note" },
      `Detector ${run.detector.name} in ${counted(run.detector.configurations.length, "configuration")}; ` +
        `campaign ${run.campaign}, seed ${run.seed}${shards}; ` +
        `${count(run.trials.done)} of ${count(run.trials.planned)} trials.`,
    ),
    run.certificate === null
      ? html("p", { class: "note" }, "No certificate stands beside this run: assay certify issues one.")
      : null,
  );
}

const signs: Record<Gate["state"], string> = { passed: "\u2713", failed: "\u2717", "not judged": "\u2013" };

export function gates(run: Run): HTMLElement {
  const first = run.gates.find((g) => g.state === "failed");
  return section(
    "gates",
    "Gates",
    html(
      "ol",
      { class: "gates" },
      ...run.gates.map((gate) =>
        html(
          "li",
          { class: gate.state.replace(" ", "-") },
          html("span", { class: "sign", "aria-hidden": "true" }, signs[gate.state]),
          html("span", {}, html("strong", {}, `${gate.name}: ${gate.state}`), html("br"), gate.text),
        ),
      ),
    ),
    first ? html("p", {}, `The first that fails is \u201c${first.name}\u201d.`) : null,
  );
}

export function scope(run: Run): HTMLElement {
  const percent = Math.round(100 * run.bounds.confidence);
  return html(
    "div",
    { class: "scope" },
    html("p", {}, html("strong", {}, "What the bounds speak of: "),
      "the share of cases, of this campaign\u2019s random generator, in which the detector would not hold. " +
      "They say nothing of other meshes, yours included, beyond what those have in common with the generator\u2019s."),
    html("p", {}, `All ${count(run.bounds.together)} bounds hold together with a confidence of ${percent} % ` +
      "(exact one-sided Clopper and Pearson, Bonferroni). A trial is a whole case; undecided ones count against the detector."),
  );
}
