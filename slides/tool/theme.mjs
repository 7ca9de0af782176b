// The theme with embedded fonts: slides look the same, and take the same room, everywhere.

import fs from "node:fs";
import path from "node:path";

const faces = ["source-sans-3/400", "source-sans-3/400-italic", "source-sans-3/600", "source-code-pro/400"];
const subsets = ["latin", "greek"];

/** Returns the rules for drawings from the pages' style sheet, in the light colours. */
export const drawingRules = (css) =>
  [/^:root \{[^}]*\}/m, /^\.(?:c[1-8]|plot|tiles)[^{]*\{[^}]*\}/gm].flatMap((rules) => css.match(rules) ?? []);

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
  const [own, pages] = ["slides/theme.css", "common/course/report/web/page.css"].map((file) =>
    fs.readFileSync(path.join(root, file), "utf8"),
  );
  fs.writeFileSync(theme, [own, ...drawingRules(pages), ...rules].join("\n"));
  return theme;
}

/** Embeds the first source of a @font-face. */
function inlined(rule, folder) {
  return rule.replace(/src: url\(([^)]+)\) format\('woff2'\)[^;]*;/, (_, file) => {
    const font = fs.readFileSync(path.join(folder, file)).toString("base64");
    return `src: url(data:font/woff2;base64,${font}) format("woff2");`;
  });
}
