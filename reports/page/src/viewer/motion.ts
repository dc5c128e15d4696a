// Computes where everything in a scene is at a given time. Times count steps: 1.25 is a quarter
// into the second step. Places are scaled into a box of size one about the origin.
import type { Moving, Point, Scene, Step } from "../report";

export class Motion {
  readonly length: number;
  private readonly largest: number;
  private readonly centre: Point;
  private readonly extent: number;
  readonly isOnePlace: boolean; // all vertices are at one place at all times

  constructor(readonly scene: Scene) {
    this.length = scene.steps.length;
    // Coordinates can be of any size, so they are divided by the largest before they are added.
    let largest = 0;
    for (const frame of scene.frames)
      for (const p of frame) largest = Math.max(largest, Math.abs(p[0]), Math.abs(p[1]), Math.abs(p[2]));
    this.largest = largest > 0 ? largest : 1;
    const low: Point = [Infinity, Infinity, Infinity];
    const high: Point = [-Infinity, -Infinity, -Infinity];
    for (const frame of scene.frames)
      for (const p of frame)
        for (let k = 0; k < 3; ++k) {
          const x = p[k]! / this.largest;
          low[k] = Math.min(low[k]!, x);
          high[k] = Math.max(high[k]!, x);
        }
    this.centre = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2];
    const extent = Math.max(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
    this.isOnePlace = extent === 0;
    this.extent = extent || 1;
  }

  // Returns the step at this time, its number from 0, and the part of the step that is over.
  at(time: number): { index: number; step: Step; t: number } {
    const index = Math.max(0, Math.min(this.length - 1, Math.floor(time)));
    return { index, step: this.scene.steps[index]!, t: Math.min(1, Math.max(0, time - index)) };
  }

  place(p: Point): Point {
    const unit = (k: 0 | 1 | 2): number => (p[k] / this.largest - this.centre[k]) / this.extent;
    return [unit(0), unit(1), unit(2)];
  }

  moving(m: Moving, t: number): Point {
    return this.place(between(m[0], m[1], t));
  }

  // Returns the places of all vertices, then of the ghosts' apexes.
  places(time: number): Point[] {
    const { step, t } = this.at(time);
    const from = this.scene.frames[step.from]!;
    const to = this.scene.frames[step.to]!;
    const places = from.map((p, v) => this.place(between(p, to[v]!, t)));
    for (const apex of step.views?.apexes ?? []) places.push(this.moving(apex, t));
    return places;
  }
}

function between(a: Point, b: Point, t: number): Point {
  const part = (k: 0 | 1 | 2): number => (t === 0 ? a[k] : t === 1 ? b[k] : (1 - t) * a[k] + t * b[k]);
  return [part(0), part(1), part(2)];
}
