// Shows the failures: a list of their signatures, and the chosen failure in full with its mesh. On
// paper, where no failure can be chosen, every failure is shown in full with a picture.
import { failurePlace } from "./address";
import { html, section } from "./dom";
import { failureFacts } from "./failure_facts";
import { pairTable } from "./pair_table";
import { legend } from "./legend";
import type { Failure, Run } from "./report";
import { counted, sum } from "./words";
import { picture, staticPicture, Viewer } from "./viewer/viewer";

export interface FailuresView {
  element: HTMLElement;
  all: Failure[];
  open: (name: string) => HTMLElement | null; // where the failure is shown; null: no failure has this name
  viewer: () => Viewer | null;
  close: () => void;
}

const head = (failure: Failure): HTMLElement[] => [
  html("h3", {}, failure.signature),
  html("p", {}, failure.now ?? failure.what),
];

const notShown = (failure: Failure): HTMLElement =>
  html("p", { class: "note" }, `Not shown: ${failure.not_shown ?? "the failure has no step"}.`);

const printed = (run: Run, failure: Failure): HTMLElement =>
  html(
    "article",
    {},
    ...head(failure),
    failure.scene?.steps.length ? picture(failure) : notShown(failure),
    failure.scene?.steps.length ? pairTable(failure.scene, () => {}) : null,
    failureFacts(run, failure),
  );

const mostGroups = 5;

// Shows what the kinds of failure in each group share, because one mistake causes many kinds.
const groups = (run: Run, links: Map<string, string>): HTMLElement[] => {
  const all = run.findings.failure_groups;
  if (all.length === 0) return [];
  const rest = sum(all.slice(mostGroups).map((group) => group.kinds.length));
  const lines = all
    .slice(0, mostGroups)
    .map((group) =>
      html(
        "li",
        {},
        html("strong", {}, group.what),
        "; the smallest: ",
        html("a", { href: links.get(group.smallest) ?? "" }, group.smallest),
      ),
    );
  if (rest > 0) lines.push(html("li", {}, `${rest} more kinds of failure in other groups`));
  return [html("ul", { class: "groups" }, ...lines)];
};

export function failures(run: Run, names: string[], address: (place: string) => string): FailuresView {
  let viewer: Viewer | null = null;
  const detail = html("div", { class: "detail", tabindex: -1, "aria-live": "polite" });

  const close = (): void => {
    viewer?.close();
    viewer = null;
  };

  const show = (failure: Failure, chosen: HTMLElement): void => {
    close();
    for (const link of links) link.removeAttribute("aria-current");
    chosen.setAttribute("aria-current", "true");
    detail.replaceChildren(...head(failure));
    const scene = failure.scene;
    if (!scene || scene.steps.length === 0) {
      detail.append(notShown(failure));
    } else {
      const sets = legend(scene);
      try {
        viewer = new Viewer(scene, sets.show);
        detail.append(viewer.element);
      } catch {
        detail.append(staticPicture(failure));
      }
      detail.append(sets.element, pairTable(scene, (step, pair) => viewer?.showPair(step, pair)));
      if (!viewer) sets.show(scene.shown.step, scene.shown.pair);
    }
    detail.append(failureFacts(run, failure));
  };

  // The links are in the order of the findings, so that the first link is the failure that the
  // verdict names.
  const all = run.findings.failures.map((told, i): Failure => ({ ...told, ...run.failures[i]! }));
  const links = all.map((failure, i) =>
    html(
      "a",
      { href: address(failurePlace + names[i]!) },
      html("strong", {}, failure.signature),
      html("span", {}, `${failure.configuration}; met ${counted(failure.met, "time")}`),
    ),
  );
  const element = section(
    "failures",
    "Failures",
    ...(all.length === 0
      ? [html("p", {}, `No failure was met in ${counted(sum(run.findings.strata.map((s) => s.trials)), "trial")}.`)]
      : [
          html(
            "p",
            {},
            `${counted(all.length, "kind")}, told apart by claim, difference, stage and feature. The kind with the plainest cause comes first, however often it was met; the verdict names this kind. Each kind has the smallest mesh that was found for it.`,
          ),
          ...groups(run, new Map(all.map((failure, i) => [failure.signature, address(failurePlace + names[i]!)]))),
          html(
            "div",
            { class: "failures" },
            html("div", { class: "list", role: "group", "aria-label": "Failures" }, ...links),
            detail,
          ),
          html("div", { class: "printed-only" }, ...all.map((failure) => printed(run, failure))),
        ]),
  );
  const openAt = (i: number): HTMLElement | null => {
    if (!all[i]) return null;
    show(all[i], links[i]!);
    return detail;
  };
  return {
    element,
    all,
    open: (name) => openAt(names.indexOf(name)),
    viewer: () => viewer,
    close,
  };
}
