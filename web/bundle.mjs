// Bundles the scripts and the style of the pages and writes them as constants of C++: node bundle.mjs OUTPUT.cpp
import { build } from "esbuild";
import { mkdirSync, renameSync, writeFileSync } from "node:fs";
import { dirname } from "node:path";

const output = process.argv[2];
if (!output) {
  throw new Error("usage: node bundle.mjs OUTPUT.cpp");
}

const { outputFiles } = await build({
  entryPoints: ["src/structure.ts", "src/diagnosis.ts", "src/set.ts", "src/page.css"],
  bundle: true,
  minify: true,
  format: "iife",
  target: ["es2021"],
  charset: "ascii",
  legalComments: "inline",
  outdir: "out",
  write: false,
});

const names = { "structure.js": "structure_script", "diagnosis.js": "diagnosis_script", "set.js": "set_script", "page.css": "page_style" };

// A script inside a page ends at the first "</script", wherever it stands.
const pieces = outputFiles
  .filter((file) => !file.path.endsWith(".map"))
  .map(({ path, text }) => {
    const name = names[path.split("/").pop()];
    if (!name) {
      throw new Error(`${path} has no name in C++`);
    }
    const safe = text.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
    return `constexpr char ${name}_text[] = R"_page_(${safe})_page_";\n` +
      `const std::string_view ${name}(${name}_text, sizeof ${name}_text - 1);\n`;
  });

const text = `// Made by web/bundle.mjs.
#include "bundle.hpp"

namespace coagula::report {

${pieces.join("\n")}
}  // namespace coagula::report
`;
mkdirSync(dirname(output), { recursive: true });
writeFileSync(`${output}.new`, text);
renameSync(`${output}.new`, output);
