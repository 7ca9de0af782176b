// Nothing from the network: emoji stay text, no fonts are fetched.
import { fileURLToPath } from "node:url";

export default {
  html: true,
  themeSet: fileURLToPath(new URL("../theme.css", import.meta.url)),
  options: { emoji: { shortcode: false, unicode: false } },
};
