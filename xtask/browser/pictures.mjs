// Pictures of the views, to be looked at: a page and a telephone, light and dark, each opened anew.

import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { pause } from "./chromium.mjs";
import { openView, slide } from "./looks.mjs";

export const SIZES = [
  [1400, 900],
  [400, 800],
];
export const SCHEMES = ["light", "dark"];

/** What a reader does before the picture is taken: of a report a click on the body of the strongest path. */
const BEFORE = {
  report: "waysideViewer.choose(waysideViewer.view.state.frame.paths?.targets[0] ?? 0)",
  body: slide("level", -20),
  study: "null",
};

const PLACE_OF_VIEW = `(() => {
  const { y, height } = document.getElementById("viewer").getBoundingClientRect();
  return [y + scrollY, height];
})()`;

export async function takePictures(page, name, url, folder) {
  for (const [width, height] of SIZES) {
    for (const scheme of SCHEMES) {
      await openView(page, url, [width, height], scheme);
      await page.value(BEFORE[name]);
      await pause(800);
      const [top, tall] = await page.value(PLACE_OF_VIEW);
      const clip = { x: 0, y: Math.max(0, top - 20), width, height: tall + 40, scale: 1 };
      writeFileSync(join(folder, `${name}-${width}-${scheme}.png`), await page.picture(clip));
    }
  }
}
