// The page in a real browser against the real program (or the mock: FAIRLEAD_BIN=mock).
// One server and one page for most of it: the tests are one visit, in order.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { readPng } from "../../web/dev/png.mjs";
import {
  AXE,
  difference,
  frameNumber,
  freePort,
  launchBrowser,
  openPage,
  Program,
  setRunning,
  thumbnail,
  until,
} from "./harness.mjs";

let program;
let browser;
let page;

before(async () => {
  program = new Program(await freePort());
  await program.start();
  browser = await launchBrowser();
  page = await openPage(browser, program.url);
});

after(async () => {
  await browser?.close();
  await program?.discard();
});

test("the page loads and its picture changes while the simulation runs", async () => {
  await setRunning(page, true);
  const first = await frameNumber(page);
  const before = await thumbnail(page);
  await until("ten more pictures", async () => (await frameNumber(page)) >= first + 10);
  await until("the picture has changed", async () => difference(before, await thumbnail(page)) > 0.05);
  assert.ok(page.sent.some(({ type }) => type === "ack"));
  assert.deepEqual(page.errors, []);
});

test("the view asked for has the size of the picture's frame", async () => {
  const box = await page.locator(".frame").boundingBox();
  const size = await page.evaluate(() => {
    const { width, height } = document.querySelector(".frame canvas");
    return { width, height };
  });
  assert.ok(size.width <= 960 && size.height <= 540, JSON.stringify(size));
  assert.ok(Math.abs(size.width / size.height - box.width / box.height) < 0.02, JSON.stringify({ size, box }));
});

test("dragging turns the camera and the picture follows; Home brings the first view back", async () => {
  await setRunning(page, false);
  await page.waitForTimeout(500);
  const still = await thumbnail(page);
  const box = await page.locator(".frame").boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 160, y + 40, { steps: 8 });
  await page.mouse.up();
  const [first, last] = [page.sent.find(({ type }) => type === "camera"), page.sent.findLast(({ type }) => type === "camera")];
  assert.notEqual(first.azimuth_deg, last.azimuth_deg);
  await until("the picture has turned", async () => difference(still, await thumbnail(page)) > 3);
  await page.focus(".frame");
  await page.keyboard.press("Home");
  await until("the picture is the first one again", async () => difference(still, await thumbnail(page)) < 1.5);
});

test("the heading set by keyboard on the dial is accepted and marked in every plot", async () => {
  await setRunning(page, true);
  const dial = page.getByRole("slider", { name: /heading/i });
  const before = Number(await dial.getAttribute("aria-valuenow"));
  await dial.focus();
  for (let press = 0; press < 3; press++) await page.keyboard.press("PageUp");
  const asked = Number(await dial.getAttribute("aria-valuenow"));
  assert.notEqual(asked, before);
  const wave = await until("the last heading is sent", () => page.sent.findLast(({ type, heading_deg }) => type === "wave" && heading_deg === asked));
  await until("it is accepted", () => page.received.some(({ type, id }) => type === "accepted" && id === wave.id));
  await until("the status says so", () => Math.abs(page.received.findLast(({ type }) => type === "status").wave.asked.heading_deg - asked) < 0.01);
  const panels = await page.locator(".panel").count();
  assert.ok(panels >= 4, `${panels} panels`);
  await until("a mark in every panel", async () => (await page.locator(".panel:has(.mark)").count()) === panels);
  assert.notEqual(await page.locator(".mark .label").last().innerText(), "");
});

test("a wave height typed acts at once; one out of range is refused and told", async () => {
  const limits = page.received.findLast(({ type }) => type === "hello").limits.height_m;
  const wanted = Number(((limits[0] + limits[1]) / 2).toFixed(2));
  const field = page.getByLabel("Height m", { exact: true });
  await field.fill(String(wanted));
  await page.keyboard.press("Enter");
  const wave = await until("the height is sent", () => page.sent.findLast(({ type, height_m }) => type === "wave" && height_m === wanted));
  await until("it is accepted", () => page.received.some(({ type, id }) => type === "accepted" && id === wave.id));
  const sent = page.sent.filter(({ type }) => type === "wave").length;
  await field.fill("1000");
  await page.keyboard.press("Enter");
  await page.locator(".notice.bad").waitFor();
  assert.equal(Number(await field.inputValue()), wanted);
  assert.equal(page.sent.filter(({ type }) => type === "wave").length, sent);
});

test("the plots move with the run and the arrow keys read values from them", async () => {
  const drawn = () => page.evaluate(() => document.querySelector(".panel canvas").toDataURL());
  const [early, legend] = [await drawn(), await page.locator(".legend").first().innerText()];
  await until("the curves have moved on", async () => (await drawn()) !== early);
  await until("the legend has moved on", async () => (await page.locator(".legend").first().innerText()) !== legend);
  await page.locator(".chart").first().focus();
  await page.keyboard.press("ArrowLeft");
  await until("the values are told", async () => /seconds: .*surge/.test(await page.locator(".chart [aria-live]").first().innerText()));
  await page.keyboard.press("Escape");
});

test("the series download has the columns of the run and a row for each sample", async () => {
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "CSV" }).click()]);
  assert.match(download.suggestedFilename(), /_t[\d.]+s_series\.csv$/);
  const [head, ...rows] = readFileSync(await download.path(), "utf8").trim().split("\n");
  assert.deepEqual(head.split(","), page.received.findLast(({ type }) => type === "hello").columns);
  const samples = page.received.filter(({ type }) => type === "series").reduce((sum, { rows: some }) => sum + some.length, 0);
  assert.ok(rows.length > 10 && rows.length <= samples, `${rows.length} rows of ${samples}`);
});

test("the snapshot is a PNG of the size chosen, named after case and time, and shows something", async () => {
  await page.getByLabel("Still", { exact: true }).selectOption("1920 × 1080");
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Save PNG" }).click()]);
  const name = page.received.findLast(({ type }) => type === "hello").case.name;
  assert.match(download.suggestedFilename(), new RegExp(`^${name}_t[\\d.]+s_1920x1080\\.png$`));
  const { width, height, channels, pixels } = readPng(readFileSync(await download.path()));
  assert.deepEqual([width, height], [1920, 1080]);
  const colours = new Set();
  for (let at = 0; at < pixels.length; at += 97 * channels) colours.add((pixels[at] << 16) | (pixels[at + 1] << 8) | pixels[at + 2]);
  assert.ok(colours.size > 50, `${colours.size} colours`);
});

test("a line is hauled in by its winch within its limits, and cut after asking; both are marked", async () => {
  await setRunning(page, true);
  const answered = (id) => until("it is accepted", () => page.received.some((message) => message.type === "accepted" && message.id === id));
  const winch = page.getByLabel("Winch to m", { exact: true });
  await winch.fill("5.8");
  await page.keyboard.press("Enter");
  const haul = await until("the length is sent", () => page.sent.findLast(({ type, length_m }) => type === "line" && length_m === 5.8));
  await answered(haul.id);
  await until("the status says so", () => page.received.findLast(({ type }) => type === "status").lines[0].asked_m === 5.8);
  const orders = page.sent.filter(({ type }) => type === "line").length;
  await winch.fill("50");
  await page.keyboard.press("Enter");
  await page.locator(".notice.bad", { hasText: "Length must be" }).waitFor();
  assert.equal(Number(await winch.inputValue()), 5.8);
  assert.equal(page.sent.filter(({ type }) => type === "line").length, orders);
  await page.getByRole("button", { name: "Cut…" }).click();
  await page.locator("dialog").getByRole("button", { name: "At the fairlead" }).click();
  const cut = await until("the cut is sent", () => page.sent.findLast(({ type, cut: place }) => type === "line" && place === "fairlead"));
  await answered(cut.id);
  await page.locator(".line-bar .parted").waitFor();
  assert.equal(await page.getByRole("button", { name: "Cut…" }).isDisabled(), true);
  await until("both are marked", () => page.received.filter(({ type, text }) => type === "marker" && /line/.test(text)).length >= 2);
});

test("reset asks first and then begins at zero with empty plots", async () => {
  await page.getByRole("button", { name: "Reset" }).click();
  const time = () => page.received.findLast(({ type }) => type === "status").time_s;
  const reached = time();
  await page.locator("dialog").getByRole("button", { name: "Reset" }).click();
  await until("the reset is told", () => page.received.some(({ type }) => type === "reset"));
  await until("the time is early again", () => time() < reached);
  await setRunning(page, true);
});

test("a restart of the program is shown and healed", async () => {
  const greetings = () => page.received.filter(({ type }) => type === "hello").length;
  const before = greetings();
  await program.stop();
  await page.locator(".banner").waitFor();
  assert.match(await page.locator(".banner").innerText(), /Connection lost/);
  assert.equal(await page.locator("canvas.stale").count(), 1);
  await program.start();
  await page.locator(".banner").waitFor({ state: "detached" });
  await until("it was greeted anew", () => greetings() > before);
  await setRunning(page, true);
  const first = await frameNumber(page);
  await until("pictures come again", async () => (await frameNumber(page)) !== first);
  await until("series come again", async () => (await page.locator(".legend .figure").first().innerText()) !== "–");
  assert.deepEqual(page.errors, []);
});

async function seriousViolations(visited) {
  await visited.evaluate(readFileSync(AXE, "utf8"));
  const { violations } = await visited.evaluate(() => globalThis.axe.run(document));
  return violations
    .filter(({ impact }) => impact === "serious" || impact === "critical")
    .map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 120)).join(" | ")}`);
}

for (const colorScheme of ["light", "dark"])
  test(`axe finds nothing serious in ${colorScheme} colours, with the dialog open too`, async () => {
    const visited = await openPage(browser, program.url, { colorScheme });
    assert.equal(await visited.evaluate(() => document.documentElement.dataset.theme), colorScheme);
    assert.deepEqual(await seriousViolations(visited), []);
    await visited.locator(".bar > button").first().click();
    await visited.locator("dialog[open]").waitFor();
    assert.deepEqual(await seriousViolations(visited), []);
    await visited.close();
  });

test("at 1280 x 800 nothing scrolls, on a phone nothing scrolls sideways", async () => {
  const overflow = () =>
    page.evaluate(() => {
      const { scrollWidth, scrollHeight, clientWidth, clientHeight } = document.documentElement;
      return { right: scrollWidth - clientWidth, down: scrollHeight - clientHeight };
    });
  assert.deepEqual(await overflow(), { right: 0, down: 0 });
  for (const width of [390, 320]) {
    const phone = await openPage(browser, program.url, { viewport: { width, height: 844 }, deviceScaleFactor: 2, hasTouch: true });
    const wide = await phone.evaluate(
      (limit) => [...document.querySelectorAll("body *")].filter((element) => element.getBoundingClientRect().right > limit + 0.5 && !element.closest(".traces, .scroll, .marks")).map(({ outerHTML }) => outerHTML.slice(0, 80)),
      width,
    );
    assert.deepEqual(wide, [], `at ${width}`);
    assert.equal(await phone.evaluate(() => document.documentElement.scrollWidth), width);
    await phone.close();
  }
});

test("the keyboard alone reaches every control, and what has the focus is outlined", async () => {
  await page.evaluate(() => document.activeElement?.blur());
  const wanted = new Set(["Start or pause", "Live picture", "Wave heading", "field-height_m", "field-period_s", "field-heading_deg", "water", "field", "quality", "still-size", "plot"]);
  for (let press = 0; press < 80 && wanted.size > 0; press++) {
    await page.keyboard.press("Tab");
    const focus = await page.evaluate(() => {
      const element = document.activeElement;
      const { outlineStyle, outlineWidth } = getComputedStyle(element);
      return {
        id: element.id,
        label: element.getAttribute("aria-label") ?? "",
        role: element.getAttribute("aria-roledescription") ?? "",
        run: element.matches(".run .primary"),
        outlined: outlineStyle !== "none" && parseFloat(outlineWidth) >= 2,
        html: element.outerHTML.slice(0, 100),
      };
    });
    if (focus.html.startsWith("<body")) continue;
    assert.ok(focus.outlined, `no outline: ${focus.html}`);
    for (const name of wanted) if (focus.id === name || focus.role === name || focus.label.startsWith(name)) wanted.delete(name);
    if (focus.run) wanted.delete("Start or pause");
  }
  assert.deepEqual([...wanted], []);
});
