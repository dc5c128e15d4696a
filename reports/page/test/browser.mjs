// Starts Chromium for the tests: without a network, and with pictures drawn by the processor.
import { chromium } from "playwright-core";

const drawnByProcessor = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
const without3d = ["--disable-3d-apis"];

// A busy machine takes its time; what hangs is ended by the test's own limit.
const patience = 20 * 60 * 1000;

export const launch = ({ webgl = true } = {}) =>
  chromium.launch({
    timeout: patience,
    executablePath: process.env.ASSAY_CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", ...(webgl ? drawnByProcessor : without3d)],
  });

export async function openIn(browser, file, { scheme = "light", width = 1280 } = {}) {
  const context = await browser.newContext({
    colorScheme: scheme,
    viewport: { width, height: 900 },
    permissions: ["clipboard-read", "clipboard-write"],
    reducedMotion: "reduce",
  });
  context.setDefaultTimeout(patience);
  const page = await context.newPage();
  const seen = { requests: [], problems: [] };
  page.on("request", (request) => {
    if (!request.url().startsWith("data:")) seen.requests.push(request.url());
  });
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) seen.problems.push(message.text());
  });
  page.on("pageerror", (error) => seen.problems.push(error.message));
  await page.goto(`file://${file}`);
  return { browser, page, seen, close: () => context.close() };
}

// The same in a browser of its own.
export async function open(file, options = {}) {
  const browser = await launch(options);
  try {
    return { ...(await openIn(browser, file, options)), close: () => browser.close() };
  } catch (error) {
    await browser.close(); // else the process would not end
    throw error;
  }
}

// What the viewer shows now.
export const state = (page) => page.evaluate(() => window.assayViewerState());
