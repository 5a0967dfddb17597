// Builds the page into dist/ (no argument), keeps building it (--watch), or bundles the tests beside
// the sources and runs them with node:test (--test).
import { spawnSync } from "node:child_process";
import { copyFileSync, mkdirSync, readdirSync, rmSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import * as esbuild from "esbuild";

const root = dirname(fileURLToPath(import.meta.url));
const source = join(root, "src");
const jsx = { jsx: "automatic", jsxImportSource: "preact" };
const mode = process.argv[2] ?? "";

if (mode === "--test") await runTests();
else if (mode === "" || mode === "--watch") await buildPage(mode === "--watch");
else throw new Error(`unknown argument ${mode}: --watch or --test`);

async function buildPage(watch) {
  const output = join(root, "dist");
  rmSync(output, { recursive: true, force: true });
  mkdirSync(output, { recursive: true });
  copyFileSync(join(source, "index.html"), join(output, "index.html"));
  const context = await esbuild.context({
    ...jsx,
    entryPoints: { app: join(source, "main.tsx") },
    outdir: output,
    bundle: true,
    minify: true,
    sourcemap: watch,
    format: "esm",
    target: "es2022",
    charset: "utf8",
    legalComments: "eof",
    logLevel: "info",
  });
  if (watch) return context.watch();
  await context.rebuild();
  await context.dispose();
}

async function runTests() {
  const output = join(root, "node_modules", ".tests");
  rmSync(output, { recursive: true, force: true });
  const tests = readdirSync(source).filter((name) => /\.test\.tsx?$/.test(name));
  await esbuild.build({
    ...jsx,
    entryPoints: tests.map((name) => join(source, name)),
    outdir: output,
    outExtension: { ".js": ".mjs" },
    bundle: true,
    platform: "node",
    format: "esm",
    target: "node18",
    sourcemap: "inline",
    logLevel: "warning",
  });
  const built = tests.map((name) => join(output, name.replace(/\.tsx?$/, ".mjs")));
  const run = spawnSync(process.execPath, ["--enable-source-maps", "--test", ...built], { stdio: "inherit" });
  process.exitCode = run.status ?? 1;
}
