// Tests how pages look: a certificate, a defect of a plug-in with a contract, a campaign with
// missing shares, a run without a trial, and a built-in detector that fails; each in light colours,
// in dark colours, on a telephone and on paper. ASSAY_LOOKS is the folder of the pages. The
// pictures are written into its folder `looks`, for a reviewer.
import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { after, before, describe, test } from "node:test";
import { launch, openIn } from "./browser.mjs";
import { complaints } from "./measure.mjs";

const folder = process.env.ASSAY_LOOKS;
const names = ["certificate", "defect", "night", "empty", "faulty"];
const looks = {
  light: { width: 1280 },
  dark: { width: 1280, scheme: "dark" },
  telephone: { width: 390 },
  paper: { width: 718, media: "print" }, // A4 less its margins
};

let browser;
before(async () => {
  mkdirSync(`${folder}/looks`, { recursive: true });
  browser = await launch();
});
after(() => browser.close());

// Tables learn of their new width a frame later, those that were folded another one.
const settled = (page) =>
  page.evaluate(async () => {
    for (let i = 0; i < 3; ++i) await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
  });

const unfold = async (page, on) => {
  await page.evaluate((open) => document.querySelectorAll("details").forEach((part) => (part.open = open)), on);
  await settled(page);
};

const visible = (page, selector) => page.locator(selector).filter({ visible: true });

for (const name of names) {
  describe(`the page of ${name}`, () => {
    let at;
    before(async () => (at = await openIn(browser, `${folder}/${name}.html`)));
    after(async () => {
      assert.deepEqual(at.seen.problems, []);
      assert.deepEqual(at.seen.requests, [`file://${folder}/${name}.html`]);
      await at.close();
    });

    for (const [look, { width, scheme = "light", media = null }] of Object.entries(looks)) {
      test(`nothing is cut, small or pale: ${look}`, async () => {
        await at.page.setViewportSize({ width, height: 900 });
        await at.page.emulateMedia({ colorScheme: scheme, media });
        await settled(at.page);
        await at.page.screenshot({ path: `${folder}/looks/${name}-${look}.png`, fullPage: true });
        const folded = await at.page.locator("details:not([open])").count();
        if (media === "print") assert.equal(folded, 0, "everything is unfolded");
        assert.deepEqual(await at.page.evaluate(complaints, { onPaper: media === "print" }), []);
        if (folded === 0) return;
        await unfold(at.page, true);
        assert.deepEqual(await at.page.evaluate(complaints, { onPaper: false }), [], "unfolded");
        await unfold(at.page, false);
      });
    }

    test("it tells no folder of this machine", async () => {
      const text = await at.page.content();
      assert.ok(!text.includes(folder));
    });
  });
}

test("what is cut, small, pale or too wide is found", async () => {
  const at = await openIn(browser, `${folder}/empty.html`);
  const found = async (css, media = null) => {
    await at.page.emulateMedia({ media });
    const sheet = await at.page.evaluateHandle((text) => {
      const made = new CSSStyleSheet();
      made.replaceSync(text);
      document.adoptedStyleSheets = [made];
    }, css);
    await sheet.dispose();
    return at.page.evaluate(complaints, { onPaper: media === "print" });
  };
  const says = (list, word) => assert.ok(list.some((line) => line.startsWith(word)), `${word} in ${list.join("\n")}`);
  assert.deepEqual(await found(""), []);
  says(await found("h1 { width: 3rem; white-space: nowrap; overflow: hidden }"), "cut");
  says(await found(".verdict { height: 4rem; overflow: clip }"), "cut");
  says(await found("h1 { margin-left: -80px }"), "cut");
  says(await found(".note { font-size: 10px }"), "small");
  says(await found(".note { color: #888 }"), "pale");
  says(await found("footer { width: 1400px }"), "the page is");
  says(await found(".contents { width: 300px; overflow: auto } .contents ul { width: 900px }"), "cut");
  await at.close();
});

test("a certificate tells on its first screen what it is about", async () => {
  const at = await openIn(browser, `${folder}/certificate.html`);
  assert.match(await at.page.title(), /^Certified: built-in \d+\.\d+\.\d+ \u2013 short, seed 1 /);
  const told = at.page.locator(".verdict dl");
  const box = await told.boundingBox();
  assert.ok(box.y + box.height < 500);
  const terms = await told.locator("dt").allTextContents();
  assert.deepEqual(terms.filter((term) => term !== "Commit"), ["Detector", "Version", "Date", "Its program, SHA-256", "Campaign"]);
  assert.match(await told.innerText(), /20\d\d-\d\d-\d\d, \d\d:\d\d UTC/);
  const power = await at.page.locator("#faults strong").textContent();
  const [found, planted, random, curated] = power.match(/\d+/g).map(Number);
  assert.match(power, /planted faults were found: \d+ by random cases, \d+ by their curated case alone\.$/);
  assert.equal(random + curated, found);
  assert.ok(planted > 100);
  assert.equal(await visible(at.page, "#faults table").count(), 0, "the list is folded");
  await at.page.locator("#laws summary").click();
  const law = at.page.locator("#laws tr", { hasText: "L4_AllPositiveIsCollisionFree_Point" });
  assert.match(await law.textContent(), /^Seen from a point, a component whose V-, V0 and Vv are empty has no contact in the step\./);
  await at.close();
});

test("beside a defect is its smallest mesh in 3D, and on paper there are all of them", async () => {
  const at = await openIn(browser, `${folder}/defect.html`);
  const box = await at.page.locator(".first-mesh canvas").boundingBox();
  assert.ok(box.y + box.height < 500 && box.x > 600, JSON.stringify(box));
  const links = at.page.locator(".failures .list a");
  const kinds = await links.count();
  assert.ok(kinds >= 3);
  assert.match(await at.page.locator(".verdict p").first().textContent(), new RegExp(await links.first().locator("strong").textContent()));
  assert.equal(await at.page.locator(".detail .legend").getByText(/^triangle \d+$/).count(), 2);
  const differences = at.page.locator(".detail tbody td:last-child");
  assert.equal(await differences.getByText("missing", { exact: true }).count(), 1);
  assert.ok((await differences.getByText("left out by the contract").count()) > 0);
  await at.page.locator(".detail tbody button").nth(1).click();
  const pair = await at.page.locator(".detail tbody button").nth(1).textContent();
  const told = await at.page.locator(".detail .legend").innerText();
  for (const triangle of pair.split(" and ")) assert.match(told, new RegExp(`triangle ${triangle}\\s`));
  await at.page.emulateMedia({ media: "print" });
  assert.equal(await visible(at.page, "canvas").count(), 0);
  const pictures = visible(at.page, ".printed-only article img");
  assert.equal(await pictures.count(), kinds);
  for (const picture of await pictures.all())
    assert.ok((await picture.evaluate((image) => image.decode().then(() => image.naturalWidth))) > 100);
  assert.equal(await visible(at.page, ".printed-only .replay").count() >= kinds, true);
  await at.close();
});

test("a table that is wider than the window says so", async () => {
  const at = await openIn(browser, `${folder}/night.html`, { width: 390 });
  const told = at.page.locator(".scroll.is-wide");
  await told.first().waitFor();
  const words = await told.first().evaluate((scroll) => getComputedStyle(scroll, "::before").content);
  assert.match(words, /scroll it sideways/);
  await at.page.setViewportSize({ width: 1280, height: 900 });
  await at.page.waitForFunction(() => !document.querySelector(".scroll.is-wide"));
  await at.close();
});
