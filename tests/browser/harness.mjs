// Starts the program and a browser for the page's tests, and waits for things on the page.
import { spawn } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { createRequire } from "node:module";
import { createServer } from "node:net";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const root = join(dirname(fileURLToPath(import.meta.url)), "..", "..");
const web = join(root, "web");
const require = createRequire(join(web, "package.json"));
const { chromium } = require("playwright-core");

export const AXE = join(web, "node_modules", "axe-core", "axe.min.js");
/** The program under test; "mock" is the stand-in of web/dev. */
const PROGRAM = process.env.FAIRLEAD_BIN ?? join(root, "build", "fairlead");
const CASE = process.env.FAIRLEAD_CASE ?? join(root, "cases", "moored_ship_draft.json");
const CHROMIUM = process.env.CHROMIUM_BIN ?? "/usr/bin/chromium";
/** The machine may be busy with other tests: waits are long, and end as soon as they can. */
export const PATIENCE_MS = 60_000;

export async function freePort() {
  const probe = createServer();
  await new Promise((resolve) => probe.listen(0, "127.0.0.1", resolve));
  const { port } = probe.address();
  await new Promise((resolve) => probe.close(resolve));
  return port;
}

/** The program serving on a port. */
export class Program {
  constructor(port) {
    this.port = port;
    this.url = `http://127.0.0.1:${port}/`;
    this.said = "";
    this.data = mkdtempSync(join(tmpdir(), "fairlead-page-"));
  }

  async start() {
    const [command, ...leading] =
      PROGRAM === "mock" ? [process.execPath, join(web, "dev", "mock_server.mjs")] : [PROGRAM, "serve", CASE, "--data", this.data];
    if (PROGRAM !== "mock" && !existsSync(PROGRAM)) throw new Error(`no program ${PROGRAM}: build it, or FAIRLEAD_BIN=mock`);
    this.child = spawn(command, [...leading, "--port", String(this.port)], { cwd: root, stdio: ["ignore", "pipe", "pipe"] });
    for (const stream of [this.child.stdout, this.child.stderr]) stream.on("data", (data) => (this.said += data));
    this.ended = new Promise((resolve) => this.child.on("exit", resolve));
    await until("the program serves", async () => {
      if (this.child.exitCode !== null) throw new Error(`the program ended with ${this.child.exitCode}: ${this.said}`);
      return fetch(this.url).then((response) => response.ok, () => false);
    });
  }

  /** Ends it for good and takes away what it wrote. */
  async discard() {
    await this.stop();
    rmSync(this.data, { recursive: true, force: true });
  }

  async stop() {
    if (!this.child || this.child.exitCode !== null) return;
    this.child.kill("SIGTERM");
    const late = setTimeout(() => this.child.kill("SIGKILL"), 10_000);
    await this.ended;
    clearTimeout(late);
  }
}

export function launchBrowser() {
  return chromium.launch({ executablePath: CHROMIUM, args: ["--no-sandbox", "--disable-gpu", "--headless"] });
}

/** Asks until the answer is true. */
export async function until(what, ask, patience = PATIENCE_MS) {
  const end = Date.now() + patience;
  for (;;) {
    const answer = await ask();
    if (answer) return answer;
    if (Date.now() > end) throw new Error(`waited ${patience / 1000} s in vain: ${what}`);
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
}

/** A page that remembers what went over its web socket and which errors it had. */
export async function openPage(browser, url, options = {}) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, ...options });
  page.setDefaultTimeout(PATIENCE_MS);
  page.sent = [];
  page.received = [];
  page.errors = [];
  page.on("pageerror", (error) => page.errors.push(String(error)));
  page.on("websocket", (socket) => {
    socket.on("framesent", ({ payload }) => page.sent.push(JSON.parse(String(payload))));
    socket.on("framereceived", ({ payload }) => {
      if (typeof payload === "string") page.received.push(JSON.parse(payload));
    });
  });
  await page.goto(url);
  await until("the first picture is drawn", () => frameNumber(page));
  return page;
}

/** Number of the live picture shown, 0 before the first. */
export function frameNumber(page) {
  return page.evaluate(() => Number(document.querySelector(".frame canvas").dataset.frame ?? 0));
}

/** The live picture as 64 x 36 grey levels. */
export function thumbnail(page) {
  return page.evaluate(() => {
    const small = new OffscreenCanvas(64, 36).getContext("2d");
    small.drawImage(document.querySelector(".frame canvas"), 0, 0, 64, 36);
    const { data } = small.getImageData(0, 0, 64, 36);
    return Array.from({ length: 64 * 36 }, (_, index) => (data[4 * index] + data[4 * index + 1] + data[4 * index + 2]) / 3);
  });
}

/** Mean difference of two thumbnails in grey levels. */
export function difference(one, other) {
  return one.reduce((sum, value, index) => sum + Math.abs(value - other[index]), 0) / one.length;
}

/** Presses Start or Pause where needed. */
export async function setRunning(page, running) {
  const wanted = running ? "Pause" : "Start"; // what the button offers once it is so
  const button = page.locator(".run .primary");
  if ((await button.innerText()).trim() !== wanted) await button.click();
  await until(running ? "it runs" : "it is paused", async () => (await button.innerText()).trim() === wanted);
}
