// Makes the whole page: the sections of a run, and the choice among several runs.
import { addressIn, contents, failurePlace, goTo, namesOf, onFollow, parseAddress, remember } from "./address";
import { cases, laws, worlds } from "./cases";
import { certificate } from "./certificate";
import { html } from "./dom";
import { failures, type FailuresView } from "./failures";
import { faults } from "./faults";
import { gates } from "./gates";
import { history } from "./history";
import { judged } from "./judged";
import { overview, titleOf } from "./overview";
import { unfoldOnPaper } from "./paper";
import type { Report, Run } from "./report";
import { strata } from "./strata";

declare global {
  interface Window {
    // The time and the vertices that the viewer of the failures shows, or null. For tests.
    assayViewerState?: () => { time: number; vertices: number[][] } | null;
  }
}

interface RunView {
  element: HTMLElement;
  failures: FailuresView;
  close: () => void;
}

function runView(run: Run, address: (place: string) => string, beside: HTMLElement | null): RunView {
  const { findings } = run;
  const names = namesOf(findings.failures.map((f) => f.signature));
  const failed = failures(run, names, address);
  const first = failed.all[0];
  const top = overview(run, first ? { failure: first, name: names[0]! } : null, address);
  const all = [
    beside,
    first ? failed.element : null,
    gates(findings, names, address),
    judged(findings),
    first ? null : failed.element,
    strata(findings),
    faults(findings),
    worlds(findings),
    ...certificate(run),
    laws(run),
    cases(findings),
  ];
  const sections = all.filter((part) => part !== null);
  return {
    element: html("div", { class: "run" }, top.element, contents(sections, address), ...sections),
    failures: failed,
    close: () => {
      top.close();
      failed.close();
    },
  };
}

function read(): Report | null {
  try {
    const stored = JSON.parse(document.getElementById("assay-report")?.textContent ?? "") as Report;
    return stored.schema === "assay-report/3" ? stored : null;
  } catch {
    return null;
  }
}

function show(page: HTMLElement, report: Report): void {
  const many = report.runs.length > 1;
  const place = html("div", {});
  const choice = html("select", {
    "aria-label": "Run",
    change: () => {
      const hash = addressIn(Number(choice.value))("");
      remember(hash);
      open(hash);
    },
  });
  report.runs.forEach((run, i) => choice.append(html("option", { value: i }, `${i + 1}: ${run.folder} (${run.verdict})`)));
  let shown: RunView | null = null;
  let index = -1;

  const choose = (next: number): void => {
    const run = report.runs[next]!;
    const address = addressIn(many ? next : null);
    shown?.close();
    index = next;
    choice.value = String(next);
    document.title = titleOf(run);
    shown = runView(run, address, many ? history(report.runs) : null);
    place.replaceChildren(shown.element);
    const [first] = namesOf(run.findings.failures.map((f) => f.signature));
    if (first !== undefined) shown.failures.open(first);
  };

  // Shows the place that an address names. If the address names no run, the place is in the shown
  // run.
  const open = (hash: string, withFocus = true): void => {
    const { run, place: at } = parseAddress(hash);
    if (run !== null && run !== index && report.runs[run]) choose(run);
    const target = at.startsWith(failurePlace)
      ? shown?.failures.open(at.slice(failurePlace.length))
      : document.getElementById(at);
    if (target) goTo(target, withFocus);
  };

  page.append(
    html(
      "header",
      {},
      html("p", { class: "note" }, "Assay report: a continuous self-collision detector, judged by an exact oracle."),
      many ? html("label", { class: "choice" }, "Run ", choice) : null,
    ),
    place,
    html("footer", {}, `${report.version}. Schema ${report.schema}.`),
  );
  choose(report.runs.length - 1);
  if (location.hash) open(location.hash);
  addEventListener("hashchange", () => open(location.hash));
  onFollow((hash, link) => open(hash, link.closest(".list") === null));
  unfoldOnPaper();
  window.assayViewerState = () => shown?.failures.viewer()?.state() ?? null;
}

const page = document.getElementById("page")!;
const report = read();
if (report && report.runs.length > 0) show(page, report);
else page.append(html("p", {}, "This page holds no report: it is the template of `assay report`."));
