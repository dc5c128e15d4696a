// Shows one failing mesh in 3D, with time slider and play button, the pair, contact points, ghosts,
// and the view primitive.
import { html } from "../dom";
import type { Contact, Failure, Scene } from "../report";
import { shortTime } from "../words";
import { centre, Marks, timeOf, type MarkedContacts } from "./marks";
import { Motion } from "./motion";
import { onSchemeChange, Palette } from "./palette";
import { bestSide } from "./side";
import { Solids } from "./solids";
import { Stage } from "./stage";
import { TimeControls } from "./time_controls";

export class Viewer {
  readonly element = html("div", { class: "viewer" });
  private readonly motion: Motion;
  private readonly solids: Solids;
  private readonly marks: Marks;
  private readonly controls: TimeControls;
  private readonly canvas = html("canvas", {
    tabindex: 0,
    role: "img",
    "aria-label": "The mesh in 3D. Arrow keys turn it, plus and minus come closer and go away.",
  });
  private readonly stage: Stage;
  private pair: [number, number] | null;
  private contacts: MarkedContacts | null = null;
  private ghosts = true;
  private primitive = true;

  // Throws if there is no WebGL.
  constructor(
    private readonly scene: Scene,
    private readonly onShown: (time: number, pair: [number, number] | null) => void,
  ) {
    this.motion = new Motion(scene);
    this.pair = scene.shown.pair;
    this.solids = new Solids(this.motion, new Palette());
    this.marks = new Marks(this.motion);
    const frame = html("div", { class: "frame" }, this.canvas, this.marks.element);
    this.controls = new TimeControls(this.motion.length, () => this.refresh());
    const note = html("p", { class: "note" }, "All vertices of this mesh stand at one place, at all times.");
    this.element.append(frame, this.motion.isOnePlace ? note : "", this.controls.element, this.toggles());
    this.stage = new Stage(this.canvas, this.solids.group, () => this.drawMarks());
    this.canvas.addEventListener("keydown", (event) => this.turnByKey(event));
    onSchemeChange(() => {
      this.solids.recolour(new Palette());
      this.refresh();
    });
    this.showPair(scene.shown.step, scene.shown.pair);
  }

  // Marks a pair of a step, and goes to the time at which it meets.
  showPair(step: number, pair: [number, number] | null): void {
    this.pair = pair;
    const of = (pairs: Contact[] | undefined): Contact | null =>
      pairs?.find((c) => c.triangles[0] === pair?.[0] && c.triangles[1] === pair?.[1]) ?? null;
    const at = this.scene.steps[step]!;
    const exact = of(at.oracle.pairs) ?? of(at.left_out);
    const detector = of(at.detector?.pairs);
    this.contacts = { step, exact, detector };
    // A time that a detector does not state is the whole step, so it is not marked.
    const stated = detector && detector.time[1] - detector.time[0] < 1 ? detector : null;
    this.controls.setStops(
      exact ? timeOf(step, exact) : null,
      stated ? timeOf(step, stated) : null,
    );
    this.controls.set(exact ? timeOf(step, exact) : stated ? timeOf(step, stated) : step);
    const places = this.motion.places(this.controls.time);
    const shown = (pair ?? []).flatMap((i) => {
      const f = this.scene.triangles[i];
      return f ? [[places[f[0]]!, places[f[1]]!, places[f[2]]!] as [never, never, never]] : [];
    });
    // The camera looks at the nearest points, because only from close by can they be told apart.
    const nearest = this.scene.asked ? (exact ?? detector)?.places : null;
    this.stage.lookFrom(bestSide(shown), centre((nearest ?? []).map((p) => this.motion.place(p))));
    this.refresh();
  }

  // Returns what is shown now, for tests and for other tools.
  state(): { time: number; vertices: number[][] } {
    return { time: this.controls.time, vertices: this.motion.places(this.controls.time) };
  }

  close(): void {
    this.controls.pause();
    this.stage.close();
  }

  private refresh(): void {
    const { index, t } = this.motion.at(this.controls.time);
    this.controls.describe(`step ${index + 1} of ${this.motion.length}, t = ${shortTime(t)}`);
    this.solids.show(this.controls.time, this.pair, this.ghosts, this.primitive);
    this.stage.draw();
    this.onShown(this.controls.time, this.pair);
  }

  private drawMarks(): void {
    if (this.stage) this.marks.show(this.stage, this.controls.time, this.pair, this.contacts, this.primitive);
  }

  private toggles(): HTMLElement {
    const box = (label: string, checked: boolean, then: (on: boolean) => void): HTMLElement => {
      const input = html("input", {
        type: "checkbox",
        checked,
        change: () => {
          then(input.checked);
          this.refresh();
        },
      });
      return html("label", {}, input, ` ${label}`);
    };
    const views = this.scene.steps.some((s) => s.views !== null);
    const hasGhosts = this.scene.steps.some((s) => (s.views?.ghosts.length ?? 0) > 0);
    // If there are no view sets to show, faces are see-through, so that nothing hides a triangle of
    // the pair.
    this.solids.seeThrough(!views);
    return html(
      "div",
      { class: "toggles" },
      box("see-through", !views, (on) => this.solids.seeThrough(on)),
      hasGhosts ? box("ghosts", true, (on) => (this.ghosts = on)) : null,
      views ? box("view primitive", true, (on) => (this.primitive = on)) : null,
    );
  }

  private turnByKey(event: KeyboardEvent): void {
    const angle = 0.12;
    const moves: Record<string, [number, number, number?]> = {
      ArrowLeft: [-angle, 0],
      ArrowRight: [angle, 0],
      ArrowUp: [0, -angle],
      ArrowDown: [0, angle],
      "+": [0, 0, 0.9],
      "-": [0, 0, 1 / 0.9],
    };
    const move = moves[event.key];
    if (!move) return;
    event.preventDefault();
    this.stage.turn(...move);
  }
}

// Returns the picture of the contact, for paper and for browsers that cannot draw in 3D.
export function picture(failure: Failure): HTMLElement | null {
  const source = `data:image/svg+xml,${encodeURIComponent(failure.svg ?? "")}`;
  return failure.svg ? html("img", { src: source, alt: `The mesh of ${failure.signature} at its contact` }) : null;
}

export function staticPicture(failure: Failure): HTMLElement {
  return html(
    "div",
    { class: "static" },
    html("p", { class: "note" }, "This browser draws no WebGL: a picture at the time of the contact instead."),
    picture(failure),
  );
}
