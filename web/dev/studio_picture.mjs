// Takes docs/images/studio.png from a running program: turns the sea by 30 degrees after a while and
// waits a little, so that the plots show a mark.
//
//     build/fairlead serve cases/moored_ship.json &  node web/dev/studio_picture.mjs http://127.0.0.1:8080/
import { mkdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

const [url = "http://127.0.0.1:8080/", turn_s = "6", until_s = "8.5"] = process.argv.slice(2);
const images = join(dirname(fileURLToPath(import.meta.url)), "..", "..", "docs", "images");

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM_BIN ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu", "--headless"],
});
const page = await browser.newPage({ viewport: { width: 1280, height: 800 }, colorScheme: "light" });
await page.goto(url);
await page.getByRole("button", { name: "10 s" }).click();
await page.waitForFunction((time) => Number.parseFloat(document.querySelector(".meter:nth-child(2) dd")?.textContent) > time, Number(turn_s), { timeout: 0 });
await page.locator(".dial").focus();
for (let press = 0; press < 3; press++) await page.keyboard.press("PageUp");
await page.locator(".dial").blur();
await page.waitForFunction((time) => Number.parseFloat(document.querySelector(".meter:nth-child(2) dd")?.textContent) > time, Number(until_s), { timeout: 0 });
mkdirSync(images, { recursive: true });
await page.screenshot({ path: join(images, "studio.png") });
await browser.close();
