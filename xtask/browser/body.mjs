// The view of the body of an `rcs` table.

import { pause } from "./chromium.mjs";
import { COLOURS, RECT, openView, slide } from "./looks.mjs";
import { holds } from "./tally.mjs";

export async function bodyIsViewed(page, url) {
  await openView(page, url);
  holds("starts the view of a body", await page.value("typeof waysideViewer === 'object'"));
  await page.value(slide("level", -40));
  const [none, facets, rays] = [
    await page.value(COLOURS([])),
    await page.value(COLOURS(["body"])),
    await page.value(COLOURS(["rays"])),
  ];
  holds("draws facets and sequences", none === 1 && facets > 30 && rays > 10, [none, facets, rays]);
  const [few, many] = [await page.value(slide("level", -3)), await page.value(slide("level", -40))];
  const count = (told) => Number(/strongest: ([\d,]+) /.exec(told)[1].replaceAll(",", ""));
  holds("shows more sequences farther down", count(few) < count(many), [few, many]);
  const strongest = "waysideViewer.view.page.levels.indexOf(Math.max(...waysideViewer.view.page.levels))";
  await page.value(`waysideViewer.choose(${strongest})`);
  const rows = await page.value("document.querySelectorAll('#viewer-panel td').length");
  holds("lists the sequences of a facet", rows >= 4, rows);
  const box = await page.value(RECT("space"));
  await page.click(box.x + box.width / 2, box.y + box.height / 2);
  await pause(100);
  const chosen = await page.value("waysideViewer.view.state.chosen");
  holds("tells which facet is clicked", Number.isInteger(chosen), chosen);
}
