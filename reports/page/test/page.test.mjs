// Tests the page in a headless browser. ASSAY_PAGE: a page of two runs; the second run is of a
// plug-in with wrong times, and has failures. ASSAY_NEAR_PAGE: a page of a plug-in that is asked
// for pairs within 0.01, and answers with the pairs that touch. See tests/page/run.
import assert from "node:assert/strict";
import { after, before, describe, test } from "node:test";
import { open, state } from "./browser.mjs";

const file = process.env.ASSAY_PAGE;

const sliderOf = (page) => page.locator(".detail").getByRole("slider", { name: "Time of the motion" });

// The smallest mesh of some failures does not move at all: goes on to one that does.
async function showOneThatMoves(page) {
  const slider = sliderOf(page);
  const links = page.locator(".failures .list a");
  for (let i = 0; i < (await links.count()); ++i) {
    await links.nth(i).click();
    const at = [];
    for (const time of ["0", "1"]) {
      await slider.fill(time);
      at.push(JSON.stringify((await state(page)).vertices));
    }
    if (at[0] !== at[1]) return;
  }
  assert.fail("no failure has a mesh that moves");
}

describe("the page", () => {
  let at;
  before(async () => {
    at = await open(file);
    await showOneThatMoves(at.page);
  });
  after(async () => {
    assert.deepEqual(at.seen.problems, [], "nothing went wrong in the console");
    assert.deepEqual(at.seen.requests, [`file://${file}`], "no request left");
    await at.close();
  });

  test("says what the run comes to, and what the bounds speak of", async () => {
    assert.equal(await at.page.locator(".verdict h1").textContent(), "Defect");
    assert.equal(await at.page.locator(".gates li").count(), 6);
    const text = await at.page.locator("#strata").textContent();
    assert.match(text, /this campaign.s random generator/);
    assert.match(text, /say nothing of other meshes/);
    const rows = at.page.locator("#strata tbody tr");
    assert.ok((await rows.count()) >= 2);
    assert.ok((await at.page.locator("#strata .dot").count()) >= 2);
  });

  test("says which claims were judged, under which contract, and how the plug-in was kept apart", async () => {
    const terms = await at.page.locator("#judged dt").allTextContents();
    assert.deepEqual(terms, ["Claims", "Tried on meshes", "Largest tried", "Contract", "Isolation", "Campaign"]);
    const text = await at.page.locator("#judged").textContent();
    assert.match(text, /free-sound, not-late, /);
    assert.match(text, /Contract\s*leaves nothing out/);
    assert.match(text, /[1-9]\d* steps? between two starts, [1-9]\d* triangles? at a vertex, .* \d+ pairs? in a step, .*; relations: 0 cases/);
    assert.match(text, /(bubblewrap|limits alone): /);
    assert.match(text, /tiny, seed 2/);
  });

  test("shows a failure with its mesh, pair and times", async () => {
    assert.ok((await at.page.locator(".failures .list a").count()) >= 2);
    const differences = await at.page.locator(".detail table tbody tr td:last-child").allTextContents();
    assert.ok(differences.some((d) => ["missing", "spurious", "late", "early"].includes(d)), differences.join());
    assert.ok((await at.page.locator(".detail .mark-exact, .detail .mark-detector").count()) === 2);
    assert.equal(await at.page.locator(".detail .mark-exact line").count(), 0, "the places of a contact coincide");
    assert.equal(await at.page.locator(".detail .mark-distance").textContent(), "");
    assert.ok((await at.page.locator(".detail .tick").count()) >= 1);
    assert.ok((await at.page.locator(".detail .legend li").count()) >= 3);
  });

  test("the slider moves the mesh", async () => {
    const slider = sliderOf(at.page);
    const canvas = at.page.locator(".detail canvas");
    const look = async (time) => {
      await slider.fill(String(time));
      return { ...(await state(at.page)), pixels: (await canvas.screenshot()).toString("base64") };
    };
    const start = await look(0);
    const end = await look(1);
    const again = await look(0);
    assert.equal(start.time, 0);
    assert.equal(end.time, 1);
    assert.notDeepEqual(start.vertices, end.vertices);
    assert.notEqual(start.pixels, end.pixels);
    assert.deepEqual(start, again);
  });

  test("keys move the slider and turn the mesh", async () => {
    const slider = sliderOf(at.page);
    await slider.fill("0.5");
    await slider.press("ArrowRight");
    assert.ok(Math.abs((await state(at.page)).time - 0.501) < 1e-9);
    assert.match(await slider.getAttribute("aria-valuetext"), /^step 1 of \d+, t = 0.501$/);
    const canvas = at.page.locator(".detail canvas");
    const before_ = (await canvas.screenshot()).toString("base64");
    await canvas.press("ArrowLeft");
    assert.notEqual((await canvas.screenshot()).toString("base64"), before_);
  });

  test("plays, and stops at the exact contact when asked", async () => {
    await at.page.locator(".detail").getByRole("button", { name: "Start", exact: true }).click();
    await at.page.locator(".detail").getByRole("button", { name: "Play" }).click();
    await at.page.waitForFunction(() => window.assayViewerState().time > 0.05);
    for (const who of ["exact", "detector"]) {
      const stop = at.page.locator(`.detail .stop-${who}`);
      if (!(await stop.isVisible())) continue; // no such contact of this pair
      await stop.click();
      const { time } = await state(at.page);
      await at.page.waitForTimeout(200);
      assert.equal((await state(at.page)).time, time, "it stands still");
      assert.ok(await at.page.locator(`.detail .mark-${who}.now`).isVisible());
    }
  });

  test("dragging turns the mesh", async () => {
    const box = await at.page.locator(".detail canvas").boundingBox();
    const shot = async () => (await at.page.locator(".detail canvas").screenshot()).toString("base64");
    const before_ = await shot();
    await at.page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await at.page.mouse.down();
    await at.page.mouse.move(box.x + box.width / 2 + 80, box.y + box.height / 2 + 30, { steps: 4 });
    await at.page.mouse.up();
    assert.notEqual(await shot(), before_);
  });

  test("a plug-in's pair is seen in two colours, and nothing of views", async () => {
    assert.equal(await at.page.locator(".detail .mark-primitive path").count(), 0);
    assert.equal(await at.page.getByLabel("view primitive").count(), 0);
    const items = await at.page.locator(".detail .legend li").allTextContents();
    assert.equal(items.filter((item) => /^triangle \d+$/.test(item)).length, 2, items.join());
    assert.ok(items.every((item) => !item.includes("violated")), items.join());
  });

  test("its title tells verdict, detector and version, its first screen the same and the digest", async () => {
    assert.match(await at.page.title(), /^Defect: brute force, fast math 1 \u2013 tiny, seed 2 \u2013 Assay report$/);
    const told = await at.page.locator(".verdict").innerText();
    assert.match(told, /Detector\s+brute force, fast math\s+Version\s+1\s+Judged by\s+assay \d+\.\d+\.\d+[\s,]/);
    assert.match(told, /Its library, SHA-256\s+[0-9a-f]{64}/);
    assert.match(told, /Begun\s+20\d\d-\d\d-\d\d, \d\d:\d\d UTC/);
    assert.match(told, /No certificate stands beside this run\. To issue a certificate, run assay certify\./);
  });

  test("the contents lead to each section", async () => {
    const links = at.page.locator(".contents a");
    const titles = await at.page.locator("section > h2").allTextContents();
    assert.deepEqual(await links.allTextContents(), titles);
    for (let i = 0; i < (await links.count()); ++i) {
      await links.nth(i).click();
      const focused = await at.page.evaluate(() => document.activeElement.querySelector("h2")?.textContent);
      assert.equal(focused, titles[i]);
    }
  });

  test("each failure has an address, which opens it, and back leads to the one before", async (t) => {
    const links = at.page.locator(".failures .list a");
    const shown = () => at.page.locator(".detail h3").textContent();
    const hash = () => at.page.evaluate(() => location.hash);
    const signatures = await at.page.locator(".failures .list strong").allTextContents();
    await links.nth(0).click();
    assert.equal(await shown(), signatures[0]);
    await links.nth(1).click();
    const address = await hash();
    assert.match(address, /^#run-2\/failure\/[a-z0-9-]+$/);
    assert.equal(await shown(), signatures[1]);
    await at.page.goBack();
    await at.page.waitForFunction((before) => location.hash !== before, address);
    assert.equal(await shown(), signatures[0]);
    const anew = await open(file + address);
    t.after(() => anew.close());
    assert.equal(await anew.page.locator(".detail h3").textContent(), signatures[1]);
    const top = await anew.page.locator(".detail").evaluate((element) => element.getBoundingClientRect().top);
    assert.ok(top >= 0 && top < 450, `it is in view: ${top}`);
    assert.deepEqual(anew.seen.problems, []);
  });

  test("kinds of failure are grouped, and each group leads to its smallest mesh", async () => {
    const groups = at.page.locator(".groups li");
    const kinds = await at.page.locator(".failures .list a").count();
    let grouped = 0;
    for (let i = 0; i < (await groups.count()); ++i) {
      const [, of, all] = /^(all|\d+ of) (\d+) kinds of failure /.exec(await groups.nth(i).textContent());
      assert.equal(Number(all), kinds);
      grouped += of === "all" ? kinds : parseInt(of);
      const link = groups.nth(i).locator("a");
      await link.click();
      assert.equal(await at.page.locator(".detail h3").textContent(), await link.textContent());
    }
    assert.equal(grouped, kinds);
  });

  test("the reasons of a gate lead to the failures that they name", async () => {
    const link = at.page.locator(".gates .reason a").first();
    const signature = await link.textContent();
    await link.click();
    assert.equal(await at.page.locator(".detail h3").textContent(), signature);
  });

  test("the replay line can be copied", async () => {
    const line = await at.page.locator(".detail .replay code").first().textContent();
    assert.match(line, /^assay replay \S+-(smallest|original)\.json --detector \S+\.so$/);
    await at.page.locator(".detail .replay .copy").first().click();
    await at.page.waitForFunction(() => document.querySelector(".detail .said").textContent !== "");
    assert.equal(await at.page.locator(".detail .said").first().textContent(), "copied");
    assert.equal(await at.page.evaluate(() => navigator.clipboard.readText()), line);
  });

  test("every failure can be shown, one after the other", async () => {
    const links = at.page.locator(".failures .list a");
    for (let i = 0; i < (await links.count()); ++i) {
      await links.nth(i).click();
      assert.equal(await links.nth(i).getAttribute("aria-current"), "true");
      assert.equal(await at.page.locator(".detail canvas").count(), 1);
      assert.ok((await state(at.page)).vertices.flat().every(Number.isFinite));
    }
  });

  test("history: the other run can be chosen", async () => {
    const rows = at.page.locator("#history table").first().locator("tbody tr");
    assert.equal(await rows.count(), 2);
    await rows.first().getByRole("link").click();
    assert.notEqual(await at.page.locator(".verdict h1").textContent(), "Defect");
    assert.equal(await at.page.locator(".detail canvas").count(), 0);
    await at.page.getByLabel("Run", { exact: true }).selectOption("1");
    assert.equal(await at.page.evaluate(() => location.hash), "#run-2/");
    assert.equal(await at.page.locator(".verdict h1").textContent(), "Defect");
    assert.equal(await at.page.locator(".detail canvas").count(), 1);
  });
});

test("under a distance: nearest points, the segment between them, how near", async (t) => {
  const at = await open(process.env.ASSAY_NEAR_PAGE);
  t.after(() => at.close());
  const links = at.page.locator(".failures .list a");
  assert.ok((await links.count()) > 0);
  let looked = 0;
  for (let i = 0; i < (await links.count()); ++i) {
    await links.nth(i).click();
    const label = await at.page.locator(".detail .mark-distance").textContent();
    assert.match(label, /^distance (0|0\.0\d+), d 0\.01$/);
    const items = await at.page.locator(".detail .legend li").allTextContents();
    assert.ok(items.includes("nearest points when first near; d 0.01"), items.join());
    // Whoever comes closer, comes closer to the pair: in three of them, because drawing takes long.
    if (!label.startsWith("distance 0,") && ++looked <= 3) {
      await at.page.locator(".detail canvas").press("+");
      await at.page.locator(".detail canvas").evaluate((canvas) => {
        for (let k = 1; k < 50; ++k) canvas.dispatchEvent(new KeyboardEvent("keydown", { key: "+" }));
      });
      assert.equal(await at.page.locator(".detail .mark-exact circle").count(), 2, label);
      // The camera looks at the middle of the segment, which perspective moves along it on the screen.
      // The marks follow the camera, which may still be on its way for some frames.
      let frame, segment;
      const isBeside = (k, length) => {
        const middle = frame[k] + frame[length] / 2;
        return middle < segment[k] - 2 || middle > segment[k] + segment[length] + 2;
      };
      for (let n = 0; n < 300 && (!segment || isBeside("x", "width") || isBeside("y", "height")); ++n) {
        await at.page.evaluate(() => new Promise(requestAnimationFrame));
        frame = await at.page.locator(".detail canvas").boundingBox();
        segment = await at.page.locator(".detail .mark-exact line").boundingBox();
      }
      assert.ok(Math.hypot(segment.width, segment.height) > 5, JSON.stringify(segment));
      assert.ok(!isBeside("x", "width") && !isBeside("y", "height"), JSON.stringify({ segment, frame }));
    }
  }
  assert.ok(looked > 0);
  assert.deepEqual(at.seen.problems, []);
});

// A detector that ignores which pairs count reports some of bodies that do not meet.
test("names the bodies of the pairs where a failure has some", async (t) => {
  const at = await open(process.env.ASSAY_BODIES_PAGE);
  t.after(() => at.close());
  const links = at.page.locator(".failures .list a");
  let bodies = 0;
  for (let i = 0; i < (await links.count()); ++i) {
    await links.nth(i).click();
    const heads = await at.page.locator(".detail table th").allTextContents();
    if (!heads.includes("bodies")) continue;
    assert.match(await at.page.locator(".detail table tbody td").nth(1).textContent(), /^\d+ and \d+$/);
    ++bodies;
  }
  assert.ok(bodies > 0);
  assert.deepEqual(at.seen.problems, []);
});

test("the page itself forbids every request", async () => {
  const at = await open(file);
  const refused = await at.page.evaluate(
    () =>
      new Promise((resolve) => {
        addEventListener("securitypolicyviolation", (event) => resolve(event.effectiveDirective));
        fetch("http://127.0.0.1:9/").catch(() => {});
      }),
  );
  assert.equal(refused, "connect-src");
  assert.deepEqual(at.seen.requests, [`file://${file}`]);
  await at.close();
});

test("without WebGL there is a message and a picture", async () => {
  const at = await open(file, { webgl: false });
  assert.equal(await at.page.locator(".detail canvas").count(), 0);
  assert.match(await at.page.locator(".detail .static").textContent(), /no WebGL/);
  const width = await at.page.locator(".detail .static img").evaluate((image) => image.decode().then(() => image.naturalWidth));
  assert.ok(width > 100);
  assert.deepEqual(at.seen.requests, [`file://${file}`]);
  await at.close();
});
