// Writes numbers and times in the form that people read.
import type { Size } from "../made/certificate";
import type { Interval } from "./report";

export const sum = (numbers: number[]): number => numbers.reduce((a, b) => a + b, 0);

export const capital = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);

export const count = (n: number): string => n.toLocaleString("en-US");

export const counted = (n: number, one: string, many = `${one}s`): string =>
  `${count(n)} ${n === 1 ? one : many}`;

// Writes a share below one with enough digits to tell two bounds apart.
export function share(p: number): string {
  if (p >= 1) return "1";
  return p === 0 ? "0" : p >= 0.01 ? p.toPrecision(2) : p.toExponential(1).replace("e-", "e\u2212");
}

// Writes a time as one double if it is exact, and otherwise as the two doubles around it.
export const time = (t: Interval | null): string =>
  t === null ? "none" : t[0] === t[1] ? `${t[0]}` : `between ${t[0]} and ${t[1]}`;

export const shortTime = (t: number): string => `${Number(t.toPrecision(6))}`;

export const size = (s: Size): string =>
  s.query ? `one ${s.query} query` : `${counted(s.triangles, "triangle")}, ${counted(s.vertices, "vertex", "vertices")}, ${counted(s.steps, "step")}`;
