// Shows the colours of the view sets, each with its number of triangles in the shown step. For a
// detector that shows no view sets, the legend has the colours of the pair's two triangles.
import { html } from "./dom";
import type { Scene, SetName } from "./report";
import { pairSets, setClass, setNames } from "./viewer/palette";

const meaning: Record<SetName, string> = {
  "V+": "V+ positive at all times",
  "V-": "V\u2212 negative at all times",
  V0: "V0 the rest",
  dirty: "dirty: carried doubt",
  violated: "violated: touched by a ghost",
  none: "other triangles",
};

const swatch = (kind: string, words: string): HTMLElement =>
  html("li", {}, html("span", { class: `swatch ${kind}` }), words);

export interface Legend {
  element: HTMLElement;
  show: (time: number, pair: [number, number] | null) => void;
}

export function legend(scene: Scene): Legend {
  const list = html("ul", { class: "legend" });
  const pairItems = (pair: [number, number] | null): HTMLElement[] => {
    const [a, b] = pair ?? [];
    const others = scene.triangles.length - (pair ? 2 : 0);
    return [
      ...(a === undefined ? [] : [swatch(setClass(pairSets[0]), `triangle ${a}`)]),
      ...(b === undefined ? [] : [swatch(setClass(pairSets[1]), `triangle ${b}`)]),
      ...(others > 0 ? [swatch(setClass("none"), `${meaning.none}: ${others}`)] : []),
    ];
  };
  let last = "";
  const show = (time: number, pair: [number, number] | null): void => {
    const step = Math.min(scene.steps.length - 1, Math.max(0, Math.floor(time)));
    const now = [step, ...(pair ?? [])].join();
    if (now === last) return;
    last = now;
    const sets = scene.steps[step]!.views?.sets;
    const items = !sets ? pairItems(pair) : setNames.flatMap((name) => {
      const size = sets.filter((s) => s === name).length;
      if (size === 0) return [];
      return [swatch(setClass(name), `${meaning[name]}: ${size}`)];
    });
    const ghosts = scene.steps[step]!.views?.ghosts.length ?? 0;
    list.replaceChildren(
      ...items,
      ...(ghosts ? [swatch("ghost", `ghosts that close the mesh: ${ghosts}`)] : []),
      swatch("pair", "the pair"),
      swatch("exact", scene.asked ? `nearest points when first near; ${scene.asked}` : "exact contact"),
      ...(scene.steps.some((s) => s.detector?.pairs.some((c) => c.places)) ? [swatch("detector", "the detector's contact")] : []),
    );
  };
  return { element: list, show };
}
