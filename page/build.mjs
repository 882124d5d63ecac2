// Bundles src/main.ts and its style into one module without imports. `--check [FILE]` writes nothing, and fails where the
// committed file (or FILE) is another.

import { readFile, writeFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const target = fileURLToPath(new URL("../src/bayesmap/app/static/mapview.js", import.meta.url));
const bundle = await build({
  absWorkingDir: fileURLToPath(new URL(".", import.meta.url)),
  entryPoints: ["src/main.ts"],
  bundle: true,
  format: "esm",
  target: "es2022",
  minify: true,
  charset: "utf8",
  lineLimit: 160,
  legalComments: "inline",
  loader: { ".css": "text" },
  banner: { js: "// Built by `make page` from page/src: edit there. Contains uPlot (MIT), (c) Leon Sorokin." },
  write: false,
});
const text = bundle.outputFiles[0].text;
if (process.argv[2] === "--check") {
  if (text !== (await readFile(process.argv[3] ?? target, "utf8"))) {
    console.error("src/bayesmap/app/static/mapview.js is not what page/src builds: run make page");
    process.exit(1);
  }
} else await writeFile(target, text);
