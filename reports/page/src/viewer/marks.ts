// Draws marks over the 3D picture: where the pair meets or is nearest, its distance, the numbers of
// its triangles, and the places of the view primitive.
import { svg } from "../dom";
import type { Contact, Point } from "../report";
import { shortTime } from "../words";
import type { Motion } from "./motion";
import type { Stage } from "./stage";

export interface MarkedContacts {
  step: number;
  exact: Contact | null;
  detector: Contact | null;
}

const middle = (c: Contact): number => c.time[0] + (c.time[1] - c.time[0]) / 2;

// Returns the time of a contact on the axis of all steps.
export const timeOf = (step: number, contact: Contact): number => step + middle(contact);

export class Marks {
  readonly element = svg("svg", { class: "marks", "aria-hidden": "true" });
  private readonly detector = svg("g", { class: "mark-detector" });
  private readonly exact = svg("g", { class: "mark-exact" });
  private readonly distance = svg("text", { class: "mark-distance", dy: -18 });
  private readonly numbers = [svg("text"), svg("text")] as const;
  private readonly primitive = svg("g", { class: "mark-primitive" });

  constructor(private readonly motion: Motion) {
    this.element.append(this.primitive, ...this.numbers, this.detector, this.exact, this.distance);
  }

  show(
    stage: Stage,
    time: number,
    pair: [number, number] | null,
    contacts: MarkedContacts | null,
    primitive: boolean,
  ): void {
    const { step, exact, detector } = contacts ?? { step: 0, exact: null, detector: null };
    const isNow = (c: Contact | null): boolean => c !== null && Math.abs(time - timeOf(step, c)) < 0.004;
    this.mark(this.exact, 5, stage, exact, isNow(exact));
    this.mark(this.detector, 10, stage, detector, isNow(detector));
    this.label(stage, isNow(detector) && !isNow(exact) ? detector : (exact ?? detector));
    const places = this.motion.places(time);
    this.numbers.forEach((label, k) => {
      const triangle = pair ? this.motion.scene.triangles[pair[k]!] : undefined;
      label.textContent = triangle ? String(pair![k]) : "";
      if (triangle) put(label, stage, centre(triangle.map((v) => places[v]!)));
    });
    this.primitive.replaceChildren(...(primitive ? this.primitiveMarks(stage, time) : []));
  }

  // Draws one circle if the two places coincide in the picture, and otherwise two smaller circles
  // with the segment between them.
  private mark(group: SVGGElement, radius: number, stage: Stage, contact: Contact | null, isNow: boolean): void {
    const [a, b] = contact?.places?.map((p) => stage.project(this.motion.place(p))) ?? [];
    group.classList.toggle("now", isNow);
    group.replaceChildren();
    if (!a || !b) return;
    const isOne = Math.hypot(a.x - b.x, a.y - b.y) < 0.5;
    for (const { x, y } of isOne ? [a] : [a, b])
      group.append(svg("circle", { cx: x, cy: y, r: isOne ? radius : radius - 2 }));
    if (!isOne) group.append(svg("line", { x1: a.x, y1: a.y, x2: b.x, y2: b.y }));
  }

  // Writes the distance above the higher of the two places.
  private label(stage: Stage, contact: Contact | null): void {
    const { asked } = this.motion.scene;
    const height = (p: Point): number => stage.project(p)?.y ?? 0;
    const [p, q] = asked ? (contact?.places?.map((place) => this.motion.place(place)) ?? []) : [];
    this.distance.textContent = p ? `distance ${shortTime(contact!.distance!)}, ${asked}` : "";
    if (p && q) put(this.distance, stage, height(p) < height(q) ? p : q);
  }

  private primitiveMarks(stage: Stage, time: number): Node[] {
    const { step, t } = this.motion.at(time);
    return (step.views?.primitives ?? []).flatMap((p) =>
      [p.q0, p.q1].flatMap((end, k) => {
        if (!end) return [];
        const diamond = svg("path", { d: "M0-7 7 0 0 7-7 0Z" });
        const label = svg("text", { x: 10, y: 4 }, p.q1 ? `q${k}` : "q");
        const mark = svg("g", {}, diamond, label);
        const at = stage.project(this.motion.moving(end, t));
        if (!at) return [];
        mark.setAttribute("transform", `translate(${at.x.toFixed(1)} ${at.y.toFixed(1)})`);
        return [mark];
      }),
    );
  }
}

function put(element: SVGElement, stage: Stage, place: Point): void {
  const at = stage.project(place);
  element.style.visibility = at ? "" : "hidden";
  if (at) element.setAttribute("transform", `translate(${at.x.toFixed(1)} ${at.y.toFixed(1)})`);
}

// Returns the mean of the points; the origin if there are no points.
export function centre(points: Point[]): Point {
  const mean = (k: 0 | 1 | 2): number => points.reduce((sum, p) => sum + p[k], 0) / (points.length || 1);
  return [mean(0), mean(1), mean(2)];
}
