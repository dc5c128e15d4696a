// Shows the facts about a failure besides its picture, and the line that replays it.
import { facts, folded, html } from "./dom";
import type { Answer, Failure, Run } from "./report";
import { counted, size, time } from "./words";

export function replayLine(line: string): HTMLElement {
  const said = html("span", { class: "said", role: "status" });
  const code = html("code", {}, line);
  const button = html(
    "button",
    {
      type: "button",
      class: "copy",
      click: async () => {
        said.textContent = (await copy(line)) ? "copied" : "press Ctrl+C: the line is selected";
        if (said.textContent !== "copied") getSelection()?.selectAllChildren(code);
      },
    },
    "Copy",
  );
  return html("div", { class: "replay" }, code, button, said);
}

// Tries the clipboard, then an older way, because some browsers give a page from file:// no
// clipboard.
async function copy(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const area = html("textarea", { class: "aside" });
    area.value = text;
    document.body.append(area);
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    return done;
  }
}

const said = ({ answer, first_time }: Answer): string =>
  first_time === null ? answer : `${answer}, first contact ${time(first_time)}`;

export function pasteNote({ folder, subject }: Run): HTMLElement {
  return html("p", { class: "note" }, `Paste into a shell in the folder of this ${subject ? "certificate" : "run"} (${folder}). The shell has to find assay on its PATH.`);
}

export function failureFacts(run: Run, failure: Failure): HTMLElement {
  const rows: [string, string | null][] = [];
  const law = failure.configuration.split(", law ")[1];
  rows.push([law ? "Law" : "Claim", law ?? failure.signature.split(":")[0] ?? null]);
  if (law) rows.push(["The law says", run.law_statements[law] ?? null]);
  rows.push(["Configuration", failure.configuration]);
  rows.push(["Case", failure.case]);
  rows.push(["As met", failure.before ? size(failure.before) : null]);
  rows.push(["Smallest", failure.after ? size(failure.after) : "not shrunk"]);
  rows.push(["Stage that lost the pair", failure.stage]);
  const scene = failure.scene;
  if (scene && scene.steps.length > 0) {
    const step = scene.steps[scene.shown.step]!;
    rows.push(["Oracle", said(step.oracle)]);
    if (step.left_out.length > 0)
      rows.push([
        "Left out by the contract",
        `${counted(step.left_out.length, "pair")}, which the detector may report or not`,
      ]);
    rows.push([
      "Detector",
      step.detector
        ? said(step.detector)
        : `no answer (${scene.ended ?? "not run"})`,
    ]);
  }
  if (failure.now && failure.now !== failure.what) rows.push(["In the mesh as met", failure.what]);
  if (failure.flaky) rows.push(["Repeatable", "no: the case gives another result if it runs by itself"]);
  const others = failure.others.map((o) =>
    html("li", {}, `${o.id} (${o.configuration}): ${o.what}`, replayLine(o.replay)),
  );
  return html(
    "div",
    {},
    html("h4", {}, "Replay"),
    replayLine(failure.replay),
    pasteNote(run),
    facts(rows),
    failure.printed === null ? null : folded("What the plug-in printed", html("pre", { class: "printed" }, failure.printed)),
    others.length === 0 ? null : folded(`${others.length} more failures of this kind`, html("ul", { class: "others" }, ...others)),
  );
}
