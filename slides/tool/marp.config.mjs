// No network access: emoji stay text, the theme embeds its fonts.
import { fileURLToPath } from "node:url";

export default {
  html: true,
  themeSet: fileURLToPath(new URL("../../build/slides/theme.css", import.meta.url)),
  options: { emoji: { shortcode: false, unicode: false } },
};
