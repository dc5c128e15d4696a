// Addresses within the page: "#gates", "#failure/all-pairs-missing-pair", and on a page of several
// runs "#run-2/gates".
import { html } from "./dom";

export interface Address {
  run: number | null; // from 0; null: the address names no run
  place: string; // the id of an element, or "failure/" and the name of a failure
}

export const failurePlace = "failure/";

export function parseAddress(hash: string): Address {
  const [, run, place] = /^#?(?:run-([1-9]\d*)(?:\/|$))?(.*)$/.exec(hash)!;
  return { run: run === undefined ? null : Number(run) - 1, place: place! };
}

// Returns the writer of addresses within one run. `run` is null if the page has only one run.
export const addressIn = (run: number | null) => (place: string): string =>
  run === null ? `#${place}` : `#run-${run + 1}/${place}`;

// Returns the names of failures in addresses: their signatures in small letters and hyphens. A name
// that occurs again gets a number.
export function namesOf(signatures: string[]): string[] {
  const times = new Map<string, number>();
  return signatures.map((signature) => {
    const name = signature.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "");
    const before = times.get(name) ?? 0;
    times.set(name, before + 1);
    return before === 0 ? name : `${name}-${before + 1}`;
  });
}

// Makes `hash` the address of the page, so that a reader can send the address, and can leave the
// place by going back.
export function remember(hash: string): void {
  try {
    history.pushState(null, "", hash);
  } catch {
    // A page in a frame has no address that could change.
  }
}

// Calls `then` when the reader follows a link within the page. The browser does not follow the link
// itself, because it would leave a page that is shown in a frame of another page.
export function onFollow(then: (hash: string, link: HTMLAnchorElement) => void): void {
  document.addEventListener("click", (event) => {
    const link = event.target instanceof Element ? event.target.closest("a") : null;
    const hash = link?.getAttribute("href");
    if (!link || !hash?.startsWith("#") || event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    remember(hash);
    then(hash, link);
  });
}

export function goTo(element: HTMLElement, withFocus: boolean): void {
  const { top } = element.getBoundingClientRect();
  if (top < 0 || top > innerHeight / 2) element.scrollIntoView();
  if (withFocus) element.focus({ preventScroll: true });
}

// Returns links to the sections of a run, in their order.
export function contents(sections: HTMLElement[], address: (place: string) => string): HTMLElement {
  const items = sections.map((s) =>
    html("li", {}, html("a", { href: address(s.id) }, s.querySelector("h2")!.textContent)),
  );
  return html("nav", { class: "contents", "aria-label": "Contents" }, html("ul", {}, ...items));
}
