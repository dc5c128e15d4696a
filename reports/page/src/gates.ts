// Shows the gates in their order, each as a sentence with its reasons.
import { failurePlace } from "./address";
import { folded, html, section, type Child } from "./dom";
import type { Findings } from "./report";
import { capital } from "./words";

type Gate = Findings["gates"][number];

const signs: Record<Gate["state"], string> = { holds: "\u2713", fails: "\u2717", "not judged": "\u2013" };

const failing: Record<Gate["gate"], string> = {
  harness: "The harness is not sound.",
  corpus: "The corpus does not pass.",
  claims: "Not all claims hold.",
  complete: "Some of the planned work is missing.",
  bounds: "Not all bounds are met.",
  speed: "Some measure of speed is above its limit.",
};

const sentence = ({ asks, gate, state }: Gate): string =>
  state === "holds"
    ? `${capital(asks)}.`
    : state === "fails"
      ? (failing[gate] ?? `It does not hold that ${asks}.`)
      : `It was not judged whether ${asks}`;

export function gates(f: Findings, names: string[], address: (place: string) => string): HTMLElement {
  // A reason that begins with the signature of a failure leads to it.
  const linked = (reason: string): Child[] => {
    const signatures = f.failures.map((failure) => failure.signature);
    const [longest] = signatures.filter((s) => reason.startsWith(`${s},`)).sort((a, b) => b.length - a.length);
    if (longest === undefined) return [reason];
    const place = failurePlace + names[signatures.indexOf(longest)]!;
    return [html("a", { href: address(place) }, longest), reason.slice(longest.length)];
  };
  // Returns the reasons, a line each. After the third reason the others are folded.
  const reasons = (lines: string[]): HTMLElement[] => {
    const few = 3;
    const all = lines.map((line) => html("span", { class: "reason" }, ...linked(line)));
    return all.length <= few ? all : [...all.slice(0, few), folded(`${all.length - few} more reasons`, ...all.slice(few))];
  };
  // Says which reasons vanish if the same run goes on, and which do not.
  const remedy = (gate: Gate): HTMLElement[] =>
    gate.remedy === undefined ? [] : [html("span", { class: "reason" }, `${capital(gate.remedy)}.`)];
  return section(
    "gates",
    "Gates",
    html("p", {}, "The gates are judged in this order, and the first gate that fails gives the verdict."),
    html(
      "ol",
      { class: "gates" },
      ...f.gates.map((gate) =>
        html(
          "li",
          { class: gate.state.replace(" ", "-") },
          html("span", { class: "sign", "aria-hidden": "true" }, signs[gate.state]),
          html("strong", {}, gate.gate),
          html("span", { class: "state" }, gate.state),
          gate.state === "not judged"
            ? html("span", {}, `${[sentence(gate), gate.reasons.join("; ")].filter((part) => part).join(": ")}.`)
            : html("span", {}, sentence(gate), ...reasons(gate.reasons), ...remedy(gate)),
        ),
      ),
    ),
  );
}
