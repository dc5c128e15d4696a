// The colours of the view sets, with how many triangles are in each at the shown step.
import { html } from "./dom";
import type { Scene, SetName } from "./report";
import { setClass, setNames } from "./viewer/palette";

const meaning: Record<SetName, string> = {
  "V+": "V+ positive at all times",
  "V-": "V\u2212 negative at all times",
  V0: "V0 the rest",
  dirty: "dirty: carried doubt",
  violated: "violated: touched by a ghost",
  none: "not seen from a view",
};

export function legend(scene: Scene): { element: HTMLElement; show: (time: number) => void } {
  const list = html("ul", { class: "legend" });
  const by = scene.views_by
    ? html("p", { class: "note" }, `View sets by ${scene.views_by}: the detector itself shows none.`)
    : null;
  let last = -1;
  const show = (time: number): void => {
    const step = Math.min(scene.steps.length - 1, Math.max(0, Math.floor(time)));
    if (step === last) return;
    last = step;
    const sets = scene.steps[step]!.views?.sets ?? scene.triangles.map(() => "none" as const);
    const items = setNames.flatMap((name) => {
      const size = sets.filter((s) => s === name).length;
      if (size === 0) return [];
      return [html("li", {}, html("span", { class: `swatch ${setClass(name)}` }), `${meaning[name]}: ${size}`)];
    });
    const ghosts = scene.steps[step]!.views?.ghosts.length ?? 0;
    list.replaceChildren(
      ...items,
      ...(ghosts ? [html("li", {}, html("span", { class: "swatch ghost" }), `ghosts that close the mesh: ${ghosts}`)] : []),
      html("li", {}, html("span", { class: "swatch pair" }), "the pair"),
      html("li", {}, html("span", { class: "swatch exact" }), "exact contact"),
      html("li", {}, html("span", { class: "swatch detector" }), "the detector's"),
    );
  };
  return { element: html("div", {}, list, by), show };
}
