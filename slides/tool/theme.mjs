// The theme with its fonts inside: slides look the same, and take the same room, everywhere.

import fs from "node:fs";
import path from "node:path";

const faces = ["source-sans-3/400", "source-sans-3/400-italic", "source-sans-3/600", "source-code-pro/400"];
const subsets = ["latin", "greek"];

/** Writes build/slides/theme.css; returns its name. */
export function writeTheme(root) {
  const fonts = path.join(root, "build/slides/node_modules/@fontsource");
  const rules = faces.flatMap((face) => {
    const file = path.join(fonts, `${face}.css`);
    return fs
      .readFileSync(file, "utf8")
      .split("/* ")
      .slice(1)
      .filter((rule) => {
        const subset = /^source-(?:sans-3|code-pro)-([a-z-]+?)-[0-9]/.exec(rule)?.[1];
        return subsets.includes(subset);
      })
      .map((rule) => inlined(`/* ${rule}`, path.dirname(file)));
  });
  const theme = path.join(root, "build/slides/theme.css");
  fs.writeFileSync(theme, fs.readFileSync(path.join(root, "slides/theme.css"), "utf8") + rules.join(""));
  return theme;
}

/** The first source of a @font-face, as part of it. */
function inlined(rule, folder) {
  return rule.replace(/src: url\(([^)]+)\) format\('woff2'\)[^;]*;/, (_, file) => {
    const font = fs.readFileSync(path.join(folder, file)).toString("base64");
    return `src: url(data:font/woff2;base64,${font}) format("woff2");`;
  });
}
