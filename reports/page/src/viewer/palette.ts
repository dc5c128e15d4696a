// Reads the colours of the page's style sheet, for the 3D picture.
import { Color } from "three";
import type { SetName } from "../report";

export const setNames: SetName[] = ["V+", "V-", "V0", "dirty", "violated", "none"];

// If a detector shows no view sets, the two triangles of the pair have the colours of these sets.
export const pairSets: [SetName, SetName] = ["V+", "V-"];

const variables: Record<SetName, string> = {
  "V+": "--set-positive",
  "V-": "--set-negative",
  V0: "--set-zero",
  dirty: "--set-dirty",
  violated: "--set-violated",
  none: "--set-none",
};

export const setClass = (name: SetName): string => variables[name].replace("--", "");

export class Palette {
  private readonly style = getComputedStyle(document.documentElement);

  of(variable: string): Color {
    return new Color(this.style.getPropertyValue(variable).trim());
  }
  set(name: SetName): Color {
    return this.of(variables[name]);
  }
}

// Calls `then` when the reader's colour scheme changes.
export function onSchemeChange(then: () => void): void {
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", then);
}
