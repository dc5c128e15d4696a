// Chooses the side from which a pair of triangles is best seen.
import type { Point } from "../report";

const minus = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a: Point, b: Point): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a: Point, b: Point): Point => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const unit = (a: Point): Point => {
  const length = Math.hypot(...a) || 1;
  return [a[0] / length, a[1] / length, a[2] / length];
};

// Returns directions all around, from a little above and a little below. None is along an axis,
// because a flat mesh looks like a line from there.
function directions(): Point[] {
  const list: Point[] = [];
  for (const height of [0.55, 1.1, -0.55])
    for (let k = 0; k < 12; ++k) {
      const angle = 0.4 + (k * Math.PI) / 6;
      list.push(unit([Math.cos(angle), Math.sin(angle), height]));
    }
  return list;
}

// Returns the direction from which all triangles are seen best: it makes the smallest visible share
// of a triangle's area largest. Triangles without area do not count, because they look like lines
// from everywhere.
export function bestSide(triangles: [Point, Point, Point][]): Point {
  const normals = triangles
    .map(([a, b, c]) => cross(minus(b, a), minus(c, a)))
    .filter((n) => Math.hypot(...n) > 1e-12)
    .map(unit);
  let best: Point = unit([1, 0.6, 0.55]);
  let most = -1;
  for (const direction of directions()) {
    const facing = normals.map((n) => Math.abs(dot(n, direction)));
    const least = Math.min(1, ...facing);
    // Two parallel triangles can be told apart only if they are seen at a slant.
    const worth = least > 0.85 ? 1.7 - least : least;
    if (worth > most + 1e-9) {
      most = worth;
      best = direction;
    }
  }
  return best;
}
