// Unfolds all folded parts for printing, because nobody can open them on paper.

export function unfoldOnPaper(): void {
  const opened: HTMLDetailsElement[] = [];
  const set = (onPaper: boolean): void => {
    if (onPaper)
      for (const part of document.querySelectorAll<HTMLDetailsElement>("details:not([open])")) opened.push(part);
    for (const part of opened) part.open = onPaper;
    if (!onPaper) opened.length = 0;
  };
  // Browsers differ: some send only one of these events, and some send an event only for a print
  // preview.
  matchMedia("print").addEventListener("change", (event) => set(event.matches));
  addEventListener("beforeprint", () => set(true));
  addEventListener("afterprint", () => set(false));
}
