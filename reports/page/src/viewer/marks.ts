// Marks over the 3D picture: contact points, numbers of the pair, places of the view primitive.
import { svg } from "../dom";
import type { Contact, Point } from "../report";
import type { Motion } from "./motion";
import type { Stage } from "./stage";

export interface MarkedContacts {
  step: number;
  exact: Contact | null;
  detector: Contact | null;
}

const middle = (c: Contact): number => c.time[0] + (c.time[1] - c.time[0]) / 2;

// When a contact is, over all steps.
export const timeOf = (step: number, contact: Contact): number => step + middle(contact);

export class Marks {
  readonly element = svg("svg", { class: "marks", "aria-hidden": "true" });
  private readonly detector = svg("circle", { class: "mark-detector", r: 10 });
  private readonly exact = svg("circle", { class: "mark-exact", r: 5 });
  private readonly numbers = [svg("text"), svg("text")] as const;
  private readonly primitive = svg("g", { class: "mark-primitive" });

  constructor(private readonly motion: Motion) {
    this.element.append(this.primitive, ...this.numbers, this.detector, this.exact);
  }

  show(
    stage: Stage,
    time: number,
    pair: [number, number] | null,
    contacts: MarkedContacts | null,
    primitive: boolean,
  ): void {
    this.mark(this.exact, stage, time, contacts?.step ?? 0, contacts?.exact ?? null);
    this.mark(this.detector, stage, time, contacts?.step ?? 0, contacts?.detector ?? null);
    const places = this.motion.places(time);
    this.numbers.forEach((label, k) => {
      const triangle = pair ? this.motion.scene.triangles[pair[k]!] : undefined;
      label.textContent = triangle ? String(pair![k]) : "";
      if (triangle) put(label, stage, centre(triangle.map((v) => places[v]!)));
    });
    this.primitive.replaceChildren(...(primitive ? this.primitiveMarks(stage, time) : []));
  }

  private mark(circle: SVGCircleElement, stage: Stage, time: number, step: number, contact: Contact | null): void {
    const point = contact?.point;
    circle.style.display = point ? "" : "none";
    if (!contact || !point) return;
    put(circle, stage, this.motion.place(point));
    circle.classList.toggle("now", Math.abs(time - timeOf(step, contact)) < 0.004);
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

function centre(points: Point[]): Point {
  const mean = (k: 0 | 1 | 2): number => points.reduce((sum, p) => sum + p[k], 0) / points.length;
  return [mean(0), mean(1), mean(2)];
}
