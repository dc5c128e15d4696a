// The page: what it shows of each run, and which run it shows.
import { cases, laws, worlds } from "./cases";
import { certificate } from "./certificate";
import { html } from "./dom";
import { failures, type FailuresView } from "./failures";
import { faults } from "./faults";
import { history } from "./history";
import { judged } from "./judged";
import { gates, overview, verdictWord } from "./overview";
import type { Report, Run } from "./report";
import { strata } from "./strata";

declare global {
  interface Window {
    // The time and the vertices that the viewer shows, or null. For tests.
    assayViewerState?: () => { time: number; vertices: number[][] } | null;
  }
}

function runView(run: Run): { element: HTMLElement; failures: FailuresView } {
  const failed = failures(run);
  const element = html("div", { class: "run" });
  const parts = [overview(run), gates(run.findings), judged(run.findings), failed.element, strata(run.findings), faults(run.findings), worlds(run.findings), ...certificate(run), laws(run.findings), cases(run.findings)];
  for (const part of parts) if (part) element.append(part);
  return { element, failures: failed };
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
  const place = html("div", {});
  const choice = html("select", { "aria-label": "Run", change: () => choose(Number(choice.value)) });
  let shown: FailuresView | null = null;
  report.runs.forEach((run, i) => choice.append(html("option", { value: i }, `${i + 1}: ${run.folder} (${run.verdict})`)));

  const choose = (index: number): void => {
    shown?.viewer()?.close();
    const view = runView(report.runs[index]!);
    shown = view.failures;
    choice.value = String(index);
    const run = report.runs[index]!;
    document.title = `${run.findings.detector.name}: ${verdictWord(run.verdict)} \u2013 Assay report`;
    place.replaceChildren(view.element);
    view.failures.viewer();
  };

  const many = report.runs.length > 1;
  page.append(
    html(
      "header",
      {},
      html("h1", {}, "Assay report"),
      html("p", { class: "note" }, "Continuous self-collision detection, judged by an exact oracle."),
      many ? html("label", { class: "choice" }, "Run ", choice) : null,
    ),
    many ? history(report.runs, (index) => choose(index)) : "",
    place,
    html("footer", {}, `${report.version}. Schema ${report.schema}.`),
  );
  choose(report.runs.length - 1);
  window.assayViewerState = () => shown?.viewer()?.state() ?? null;
}

const page = document.getElementById("page")!;
const report = read();
if (report && report.runs.length > 0) show(page, report);
else page.append(html("p", {}, "This page holds no report: it is the template of `assay report`."));
