// The failures: a list of their signatures, and one of them in full with its mesh.
import { html, section } from "./dom";
import { failureFacts } from "./failure_facts";
import { pairTable } from "./pair_table";
import { legend } from "./legend";
import type { Failure, Run } from "./report";
import { counted } from "./words";
import { picture, staticPicture, Viewer } from "./viewer/viewer";

export interface FailuresView {
  element: HTMLElement;
  viewer: () => Viewer | null;
}

export function failures(run: Run): FailuresView {
  let viewer: Viewer | null = null;
  const detail = html("div", { class: "detail", "aria-live": "polite" });
  const buttons: HTMLButtonElement[] = [];

  const show = (failure: Failure, chosen: HTMLButtonElement): void => {
    viewer?.close();
    viewer = null;
    for (const button of buttons) button.setAttribute("aria-pressed", String(button === chosen));
    detail.replaceChildren(html("h3", {}, failure.signature), html("p", {}, failure.now ?? failure.what));
    const scene = failure.scene;
    if (!scene || scene.steps.length === 0) {
      detail.append(html("p", { class: "note" }, `Not shown: ${failure.not_shown ?? "it has no step"}.`));
    } else {
      const sets = legend(scene);
      try {
        viewer = new Viewer(scene, (time) => sets.show(time));
        detail.append(viewer.element, html("div", { class: "printed-only" }, picture(failure)));
      } catch {
        detail.append(staticPicture(failure));
      }
      detail.append(sets.element, pairTable(scene, (step, pair) => viewer?.showPair(step, pair)));
      sets.show(scene.shown.step);
    }
    detail.append(failureFacts(failure));
  };

  // In the order of the findings, so that the first is the one that the verdict names.
  const all = run.findings.failures.map((told, i): Failure => ({ ...told, ...run.failures[i]! }));
  for (const failure of all) {
    const button = html(
      "button",
      { type: "button", "aria-pressed": "false", click: () => show(failure, button) },
      html("strong", {}, failure.signature),
      html("span", {}, `${failure.configuration}; met ${counted(failure.met, "time")}`),
    );
    buttons.push(button);
  }
  const element = section(
    "failures",
    "Failures",
    all.length === 0
      ? html("p", {}, "None was met.")
      : html(
          "p",
          {},
          `${counted(all.length, "kind")}, told apart by claim, difference, stage and feature. Each has the smallest mesh that was found for it.`,
        ),
    all.length === 0
      ? null
      : html("div", { class: "failures" }, html("div", { class: "list", role: "group", "aria-label": "Failures" }, ...buttons), detail),
  );
  return {
    element,
    viewer: () => {
      if (!viewer && buttons[0] && detail.childElementCount === 0) buttons[0].click();
      return viewer;
    },
  };
}
